"""Thumb-2 instructions and what they do to the flow, as objdump prints them.

Registers are used as compilers use them: a jump to lr, or to a pc that was
taken from the stack, goes back to where the function was called. Loops and
branches of Armv8.1-M have no number, like jumps through a pointer.
"""
from __future__ import annotations

import re
from itertools import takewhile
from typing import NamedTuple, Optional

IF = "(eq|ne|cs|cc|hs|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)"
HEAD = re.compile(r"([0-9a-f]{8}) <(.+)>:$")
LINE = re.compile(r" *([0-9a-f]+):\t([0-9a-f ]+?) *\t(\.?[a-z]\S*)(?:\t(.*))?$")
# In this order, for "bls" is no call, and "ldmia.w sp!, {r4, pc}" a return.
KINDS = [(kind, re.compile(text)) for kind, text in (
    ("branch", rf"(?:b{IF}?|cbn?z) .*"),
    ("call", rf"bl{IF}? .*"),
    ("return", rf"bx{IF}? lr|pop{IF}? .*\bpc}}.*|ldm(?:ia|fd)?{IF}? sp!.*\bpc}}"
               rf"|ldr{IF}? pc, \[sp\], #.*|mov{IF}? pc, lr"),
    ("table", r"tb[bh] \[pc, .*|ldr pc, \[\w+, \w+, lsl #2\]"),
    ("pointer call", rf"blx{IF}? .*"),
    ("end", r"udf .*"),
    ("", r"(?:cmp|cmn|tst|teq|v?str|v?stm|v?push|it)\S* .*"),
    ("pointer", r"(?:bx|blxns|tb[bh]|letp|wls|dls)\S* .*|le .*"
                r"|bf(?:l|x|lx|csel)? .*|\S+ (?:pc\b|.*\bpc}).*"))]


class Line(NamedTuple):
    """An instruction: where it stands, its bytes, and what it does."""
    at: int
    size: int
    text: str
    kind: str

    def target(self) -> int:
        """Where a branch or a call goes to."""
        return int(self.text.split()[-1], 16)

    def may_go_on(self) -> bool:
        """Whether what follows may be run next."""
        if self.kind in ("branch", "return"):
            return bool(re.match(rf"cb|\w+?{IF} ", self.text))
        return self.kind in ("", "call", "pointer call")


def kind_of(text: str) -> str:
    """What an instruction does to the flow."""
    return next((kind for kind, one in KINDS if one.fullmatch(text)), "")


class Listing(NamedTuple):
    """Instructions and data in order, and names of functions, by addresses."""
    lines: dict[int, Line]
    data: dict[int, bytes]
    names: dict[int, str]

    def table(self, line: Line) -> list[int]:
        """Where a jump by a table goes to, [] where that is not understood.

        The table of offsets that tbb and tbh take follows them and ends where
        the first place that it leads to begins, or where the comparison before
        says. A table of addresses follows the load that takes one, to the first
        word that is none of code.
        """
        start = line.at + line.size
        if line.text.startswith("ldr"):
            start = self._named_before(line)
        content = b""
        while start + len(content) in self.data:
            content += self.data[start + len(content)]
        width = 4 if line.text.startswith("ldr") else \
            1 if line.text.startswith("tbb") else 2
        words = [int.from_bytes(content[i:i + width], "little")
                 for i in range(0, len(content) - width + 1, width)]
        if width == 4:
            codes = takewhile(lambda w: w % 2 and w - 1 in self.lines, words)
            return sorted({word - 1 for word in codes})
        found: list[int] = []
        for i, word in enumerate(words[:self._entries(line)]):
            if start + i * width >= min(found, default=start + i * width + 1):
                break
            found.append(start + 2 * word)
        if width == 1 and found[-1:] == [start]:
            found.pop()  # fills the table up to an even address
        return sorted(set(found))

    def _entries(self, line: Line) -> Optional[int]:
        """How many entries a jump by a table takes, if "cmp r3, #4" and "bhi"
        stand before it and nothing jumps past them; else None."""
        index = line.text.split()[2].strip("],")
        before = [at for at in range(line.at - 8, line.at, 2)
                  if at in self.lines][-2:]
        if {*before[1:], line.at} & {one.target() for one in
                                     self.lines.values()
                                     if one.kind == "branch"}:
            return None
        texts = [self.lines[at].text for at in before]
        found = re.fullmatch(rf"cmp {index}, #(\d+)", texts[0]) \
            if len(texts) == 2 and texts[1].startswith("bhi ") else None
        return int(found[1]) + 1 if found else None

    def _named_before(self, line: Line) -> int:
        """The address of which a load of pc has the table, by the instruction
        before it; -1 if that does not say."""
        register = line.text.split("[")[1].split(",")[0]
        for at in range(line.at - 2, line.at - 6, -2):
            if at in self.lines and (found := re.fullmatch(
                    rf"addw? {register}, pc, #(\d+)", self.lines[at].text)):
                return (at + 4) // 4 * 4 + int(found[1])
        return -1


def read_listing(listing: str) -> Listing:
    """What `objdump -dz` has printed."""
    lines, data, names = {}, {}, {}
    for row in listing.splitlines():
        if head := HEAD.match(row):
            names[int(head[1], 16)] = head[2]
        elif found := LINE.match(row):
            at, code = int(found[1], 16), found[2].split()
            if found[3].startswith("."):
                data[at] = b"".join(bytes.fromhex(word)[::-1] for word in code)
                continue
            name = re.sub(r"\.[nw]$", "", found[3])
            operands = re.sub(r"\s*[@;].*| <.*", "", found[4] or "")
            text = f"{name} {operands}"
            lines[at] = Line(at, sum(map(len, code)) // 2, text, kind_of(text))
    return Listing(lines, data, names)
