"""The code of a program for Cortex-M as blocks, from its ELF file.

Each instruction counts, also in an IT block one whose condition does not hold:
the processor skips it, but an emulator counts it. A conditional return is a
jump to an empty block, a conditional call is a call. A call of a function of
SIZED has the number of bytes in its name, as "memset(64)", where every way to
it loads r2 with a number; of several numbers it is the largest.
"""
from __future__ import annotations

import re
from bisect import bisect
from typing import Optional

from assembly import Block, Code, Instruction, Label
from thumb import Line, Listing

SIZED = {"memset", "memcpy", "memmove"}
SIZE = "r2"
# What a called function leaves as it was.
KEPT = {f"r{i}" for i in range(4, 12)} | {"sl", "fp"}
CONSTANT = re.compile(r"mov[sw]? (\w+), #(\d+)")
COPY = re.compile(r"mov (\w+), (\w+)")
READS = re.compile(r"(?:cmp|cmn|tst|teq|v?str|vldr|cbn?z)\S* .*")
# The first operand is all that they write.
WRITES_FIRST = re.compile(
    r"(?:mov|mvn|add|adc|sub|sbc|rsb|neg|and|orr|orn|eor|bic|lsl|lsr|asr|ror|"
    r"mul|ldr(?!d|ex)|[us]bfx|[us]xt|clz)\S* (\w+), .*")


class Program(Code):
    """The blocks of a program.

    places: line and column of the source, by addresses. window: two functions
    that mark what is counted. After each call of the first a function begins,
    named as it with "+1", "+2" and so on, which ends before a call of the
    second.
    """
    END: Label = 0, "return"

    def __init__(self, listing: Listing,
                 places: Optional[dict[int, tuple[int, int]]] = None,
                 window: tuple[str, str] = ("", "")) -> None:
        super().__init__([])
        self.listing, self.places = listing, places or {}
        self.window = window
        self.starts = sorted(self.listing.names)
        self.lines: dict[Block, list[Line]] = {}
        self.before: dict[Block, list[Block]] = {}
        self.blocks[self.END] = Block(0)
        for at in self._leaders():
            self._read_block(at)
        for block, lines in self.lines.items():
            self._link(block, lines[-1])
        self._name_functions()
        for block, lines in self.lines.items():
            block.calls = [self._callee(block, i)
                           for i, line in enumerate(lines)
                           if line.kind == "call"]

    def name_of(self, at: int) -> str:
        """An address as function and offset."""
        start = self.starts[max(0, bisect(self.starts, at) - 1)]
        return self.listing.names[start] + (f"+{at - start:#x}"
                                            if at != start else "")

    def at(self, block: Block) -> str:
        """Where a block begins."""
        return self.name_of(block.code[0].at) if block.code else "return"

    def _is_mark(self, line: Line, which: int) -> bool:
        """Whether an instruction opens (0) or closes (1) the window."""
        return line.kind == "call" and \
            self.listing.names.get(line.target()) == self.window[which]

    def _leaders(self) -> list[int]:
        """Where blocks begin."""
        lines, found = self.listing.lines, set(self.listing.names)
        for line in lines.values():
            if line.kind in ("branch", "call"):
                found.add(line.target())
            if line.kind == "table":
                found.update(self.listing.table(line))
            if line.kind not in ("", "call") or self._is_mark(line, 0):
                found.add(line.at + line.size)
            if self._is_mark(line, 1):
                found.add(line.at)
        self.leaders = found & set(lines)
        return sorted(self.leaders)

    def _read_block(self, at: int) -> None:
        """The instructions from a leader on."""
        block = self.blocks[0, f"{at:x}"] = Block(0)
        lines: list[Line] = []
        line = self.listing.lines[at]
        while not lines or line.at not in self.leaders:
            lines.append(line)
            after = self.listing.lines.get(line.at + line.size)
            if after is None or line.kind not in ("", "call"):
                break
            line = after
        block.code = [Instruction(one.at, self.places.get(one.at, (0, 0)))
                      for one in lines]
        self.lines[block] = lines

    def _link(self, block: Block, last: Line) -> None:
        """Where a block leads to."""
        if self._is_mark(self.lines[block][0], 1):
            block.code, self.lines[block] = [], []
            return
        if last.kind == "table":
            block.jumps = [(0, f"{at:x}") for at in self.listing.table(last)]
            if not block.jumps or not all(label in self.blocks
                                          for label in block.jumps):
                block.why_unknown = f"a table that is not understood at " \
                    f"{self.name_of(last.at)}"
        elif last.kind == "branch":
            block.jumps = [self._label(last)]
        elif last.kind == "return" and last.may_go_on():
            block.jumps = [self.END]
        pointers = [line for line in self.lines[block]
                    if line.kind.startswith("pointer")]
        if pointers:
            block.why_unknown = \
                f"a {'call' if 'call' in pointers[0].kind else 'jump'} " \
                f"through a pointer at {self.name_of(pointers[0].at)}"
        if last.may_go_on():
            block.falls_to = self.blocks.get((0, f"{last.at + last.size:x}"))
            if not block.falls_to and not block.why_unknown:
                block.why_unknown = f"no code follows {self.name_of(last.at)}"
        for label in block.jumps:
            self.before.setdefault(self.blocks.get(label), []).append(block)
        if block.falls_to:
            self.before.setdefault(block.falls_to, []).append(block)

    def _label(self, line: Line) -> Label:
        """Where a branch leads: a block, or the start of another function."""
        name = self.listing.names.get(line.target(), "")
        own = re.sub(r"\+0x.*", "", self.name_of(line.at))
        if name and name != own and not name.endswith(".cold"):
            return 0, name
        return 0, f"{line.target():x}"

    def _name_functions(self) -> None:
        """What can be called, and what begins after marks."""
        lines = self.listing.lines.values()
        named = dict(self.listing.names)
        for line in lines:
            if line.kind == "call":
                named[line.target()] = self.name_of(line.target())
        opened = [line for line in lines if self._is_mark(line, 0)]
        for number, line in enumerate(opened, start=1):
            named[line.at + line.size] = f"{self.window[0]}+{number}"
        for at, name in named.items():
            if at in self.leaders:
                # What is entered once, also where a loop begins there.
                entry = self.functions[0, name] = Block(0)
                entry.falls_to = self.blocks[0, f"{at:x}"]
        self.entries = {entry.falls_to for entry in self.functions.values()}

    def _callee(self, block: Block, i: int) -> Label:
        """What an instruction of a block calls."""
        line = self.lines[block][i]
        name = self.name_of(line.target())
        if name not in SIZED:
            return 0, name
        sizes = self._numbers(block, i, SIZE, set())
        return 0, f"{name}({max(sizes)})" if sizes else \
            f"{name} of an unknown size at {self.name_of(line.at)}"

    def _numbers(self, block: Block, end: int, register: str,
                 seen: set[tuple[Block, str]]) -> Optional[set[int]]:
        """What a register may hold before an instruction, if constants."""
        for line in reversed(self.lines[block][:end]):
            if line.kind == "pointer call" or line.kind == "call" and \
                    not self._keeps(line.target(), register):
                return None
            if not re.search(rf"\b{register}\b", line.text):
                continue
            number, copy = CONSTANT.fullmatch(line.text), \
                COPY.fullmatch(line.text)
            if number and number[1] == register:
                return {int(number[2])}
            if copy and copy[1] == register:
                register = copy[2]
            elif not only_reads(line.text, register):
                return None
        if block in self.entries:
            return None
        found: set[int] = set()
        seen.add((block, register))
        for other in self.before.get(block, []):
            if (other, register) not in seen:
                more = self._numbers(other, len(self.lines[other]), register,
                                     seen)
                if more is None:
                    return None
                found |= more
        return found


    def _keeps(self, function: int, register: str) -> bool:
        """Whether a function leaves a register as it was. gcc relies on more
        than the convention where it knows the function (-fipa-ra)."""
        if register in KEPT:
            return True
        first = self.blocks.get((0, f"{function:x}"))
        seen, stack = {first}, [first]
        while stack:
            block = stack.pop()
            if block is None or block.why_unknown or not all(
                    only_reads(line.text, register)
                    for line in self.lines.get(block, [])
                    if re.search(rf"\b{register}\b", line.text)):
                return False
            after = [block.falls_to] if block.falls_to else []
            after += [self.place(label)[0] or self.functions.get(label)
                      for label in block.jumps]
            after += [self.blocks.get((0, f"{line.target():x}"))
                      for line in self.lines.get(block, [])
                      if line.kind == "call"]
            stack += [one for one in after if one not in seen]
            seen.update(after)
        return True


def only_reads(text: str, register: str) -> bool:
    """Whether an instruction that names a register leaves it as it is."""
    if "!" in text or "], " in text:
        return False
    first = WRITES_FIRST.fullmatch(text)
    return bool(READS.fullmatch(text) or (first and first[1] != register))
