#!/usr/bin/python3 -B
"""The longest way through the code of each function, whatever its inputs.

It is in instructions, from the assembly of x86-64 (gcc -S) that the Makefile
has compiled for counting, as lines "name instructions". What is called and
what is jumped to is a part of the way. The longest way through a loop counts as
often as the loop is run, and so on for loops inside it. Where `trips` says
nothing of a loop, and where a jump goes through a table or a pointer, the
function and its callers have no bound: "name -".
"""
from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Callable, Iterable, Optional

Label = tuple[int, str]  # of which file, and its name there


def trips(real: str) -> dict[str, tuple[int, ...]]:
    """How often loops are run: file and function, a number a depth.

    The most where there are several: rounds of Philox; modes, once more for
    the test at the end; terms of the angle's series but one, whose loop is one
    block.
    """
    terms, either = (7, 7) if real == "double" else (3, 6)
    modes = 6
    told = {"philox/tf_philox": (10,), "select/tf_select": (modes,),
            "begin/tf_begin": (modes,)}
    for name in ("tyre/jump_force", "step/tf_step",
                 "step/step_reaches_codim2", "compensated/tf_step_compensated",
                 "compensated/commit_pairs",
                 "compensated/compensated_step_reaches_codim2"):
        told[name] = (terms,)
    for name in ("step/degraded_step", "compensated/degraded_compensated_step"):
        told[name] = (either, terms)
    return told


class NoBound(Exception):
    """A way whose length nothing tells."""


class Block:
    """Instructions that are run one after the other."""

    def __init__(self) -> None:
        self.size = 0
        self.calls: list[Label] = []
        self.jumps: list[Label] = []
        self.falls_to: Optional[Block] = None
        self.by_table = False


class Code:
    """The blocks of all files, by their labels."""

    LABEL = re.compile(r"([A-Za-z_.][\w.$]*):")
    INSTRUCTION = re.compile(r"[ \t]+([a-z]\S*)(?:.*\s)?(\S*)$")

    def __init__(self, paths: Iterable[Path]) -> None:
        self.blocks: dict[Label, Block] = {}
        self.functions: dict[Label, Block] = {}
        self.file_names: list[str] = []
        self.public: dict[str, Label] = {}
        for path in paths:
            self.file_names.append(path.name.split(".")[0])
            self._read(path.read_text(encoding="utf-8").splitlines())

    def _read(self, lines: Iterable[str]) -> None:
        """Takes in one file."""
        file, here = len(self.file_names) - 1, None
        for line in lines:
            label = self.LABEL.match(line)
            if label:
                key = file, label[1]
                inside = re.match(r"\.L|.*\.cold$", label[1])
                here = self._open(here if inside else None)
                self.blocks[key] = here
                if not inside:
                    self.functions[key] = here
            elif line.split()[:1] == [".globl"]:
                self.public[line.split()[1]] = file, line.split()[1]
            elif instruction := self.INSTRUCTION.match(line):
                here = self._take(here or Block(), file, *instruction.groups())

    @staticmethod
    def _open(before: Optional[Block]) -> Block:
        """A new block, to which the one before falls through."""
        block = Block()
        if before:
            before.falls_to = block
        return block

    def _take(self, here: Block, file: int, name: str,
              operand: str) -> Optional[Block]:
        """Adds an instruction. Returns: the block that goes on, if one does."""
        here.size += 1
        target = file, operand.split("@")[0]
        if name == "call":
            if operand.startswith("*"):
                here.by_table = True
            else:
                here.calls.append(target)
            return here
        if name in ("jmp", "notrack") and operand.startswith("*"):
            here.by_table = True
            return None
        if name.startswith("j") or name == "notrack":
            here.jumps.append(target)
            return None if name in ("jmp", "notrack") else self._open(here)
        return None if name.startswith(("ret", "ud2")) else here

    def place(self, target: Label) -> tuple[Optional[Block], Optional[Label]]:
        """What a name means in its file: a block, or a function."""
        if target in self.functions:
            return None, target
        if target in self.blocks:
            return self.blocks[target], None
        return None, self.public.get(target[1], target)


def left_order(entry: Block,
               after: Callable[[Block], Iterable[Block]]) -> list[Block]:
    """What can be reached from a block, in the order in which it is left."""
    seen, order, stack = {entry}, [], [(entry, iter(after(entry)))]
    while stack:
        block, rest = stack[-1]
        for other in rest:
            if other not in seen:
                seen.add(other)
                stack.append((other, iter(after(other))))
                break
        else:
            order.append(block)
            stack.pop()
    return order


def loops(entry: Block,
          after: Callable[[Block], Iterable[Block]]) -> list[list[Block]]:
    """The strongly connected parts (Kosaraju), in the order of the way.

    The first block of each is where it is entered.
    """
    order = left_order(entry, after)
    before: dict[Block, list[Block]] = {block: [] for block in order}
    for block in order:
        for other in after(block):
            before[other].append(block)
    parts: list[list[Block]] = []
    taken: set[Block] = set()
    for block in reversed(order):
        if block not in taken:
            part = left_order(block, lambda b: [x for x in before[b]
                                                if x not in taken])
            taken.update(part)
            parts.append([block] + [b for b in part if b is not block])
    return parts


class Ways:
    """Longest ways through functions."""

    def __init__(self, code: Code, told: dict[str, tuple[int, ...]]) -> None:
        self.code, self.told = code, told
        self.found: dict[Label, Optional[int]] = {}

    def edges(self, block: Block) -> tuple[list[Block], list[Label]]:
        """Blocks that come next, and functions that the block ends in."""
        nexts = [block.falls_to] if block.falls_to else []
        tails = []
        for target in block.jumps:
            inside, function = self.code.place(target)
            if inside:
                nexts.append(inside)
            else:
                tails.append(function)
        return nexts, tails

    def block_cost(self, block: Block) -> int:
        """Instructions of a block and of what it calls or ends in."""
        if block.by_table:
            raise NoBound
        called = [self.longest(self.code.place(target)[1])
                  for target in block.calls]
        tails = [self.longest(tail) for tail in self.edges(block)[1]]
        return block.size + sum(called) + max(tails, default=0)

    def way(self, name: str, region: Optional[set[Block]], entry: Block,
            depth: int) -> int:
        """The longest way from the entry of a region, None: a function.

        An edge back to the entry is not followed. depth: how many loops are
        around the region.
        """
        def after(block: Block) -> list[Block]:
            return [b for b in self.edges(block)[0] if b is not entry and
                    (region is None or b in region)]

        parts = loops(entry, after)
        part_of = {block: i for i, part in enumerate(parts) for block in part}
        best = [0] * len(parts)
        for i, part in reversed(list(enumerate(parts))):
            if len(part) > 1 or part[0] in after(part[0]):
                turns = self.told.get(name, ())
                if len(turns) <= depth:
                    raise NoBound
                cost = turns[depth] * self.way(name, set(part), part[0],
                                               depth + 1)
            else:
                cost = self.block_cost(part[0])
            best[i] = cost + max((best[part_of[b]] for block in part
                                  for b in after(block) if part_of[b] > i),
                                 default=0)
        return best[0]

    def longest(self, function: Optional[Label]) -> int:
        """The longest way through a function."""
        if function not in self.code.functions:
            raise NoBound
        if function not in self.found:
            self.found[function] = None  # one that calls itself has no bound
            file, name = function
            name = f"{self.code.file_names[file]}/{plain(name)}"
            self.found[function] = self.way(
                name, None, self.code.functions[function], 0)
        found = self.found[function]
        if found is None:
            raise NoBound
        return found


def plain(name: str) -> str:
    """A name without its real type."""
    return re.sub(r"_f(32|64)$", "", name)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("real", choices=["double", "float"], help="real type")
    parser.add_argument("build", type=Path, help="folder of the build")
    given = parser.parse_args()
    folder = given.build / given.real / "counted"
    code = Code(sorted(folder.glob("**/*.s")))
    if not code.functions:
        print(f"{sys.argv[0]}: {folder}: has no assembly", file=sys.stderr)
        return 1
    ways = Ways(code, trips(given.real))
    for function in sorted(code.functions, key=lambda label: label[1]):
        if re.fullmatch(r"tf_.*_f(32|64)", function[1]):
            try:
                print(plain(function[1]), ways.longest(function))
            except NoBound:
                print(plain(function[1]), "-")
    return 0


if __name__ == "__main__":
    sys.exit(main())
