"""How often a cycle of the assembly is run: which loop of the source it is.

Its loop is the innermost in which all of its conditional jumps stand, by their
lines and those of the calls from which they were inlined. (Jumps do not move,
as loads and constants do, which may carry the line of another place.) So while
the cycle is not left, one run of that loop is going on: who goes from one run
to the next makes the comparison of a loop around it, which is such a jump.

Each time round is a turn of that loop, not of one inside it, where everyone who
goes round passes one of
* a jump that is the loop's own comparison, the one of which check `loops` knows
  the bound, or one of its copies; or a jump that is of the loop's condition.
  (gcc may give it the place of `for`, too.) The condition is met at most once a
  turn, and once more to leave;
* a jump of the loop's body that is in no loop inside it: it is met at most once
  a turn.
Unrolled, rotated, peeled, threaded or split, a loop does not have more turns
than in the source, and where two cycles share them, each is counted in full.
The entry is passed as often as there are turns if some of the body stands
before the first comparison, for a compiler does not run a body before it knows
that there is a turn; else once more, when the comparison fails.

Where no loop is found so, there is no number: nothing is guessed.
"""
from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections import defaultdict
from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Optional

from assembly import Block, Instruction

Frames = tuple[tuple[str, int], ...]  # file and line, the caller's first
Nest = tuple[tuple[Frames, "Loop"], ...]  # from where it was called, and it


class Loop(NamedTuple):
    """A loop of the source: see tools/verify/check/loop_table.py."""
    file: str
    function: str
    first: int
    column: int
    last: int
    test: tuple[tuple[int, int], ...]
    condition: tuple[tuple[int, int], ...]
    body: tuple[int, int]
    turns: Optional[Callable[[int], int]]  # of how many units


def within(at: tuple[int, int], words: tuple[tuple[int, int], ...]) -> bool:
    """Whether a place is among words, given by the first and the last."""
    return bool(words) and words[0] <= at <= words[1]


class Cycle(NamedTuple):
    """Blocks that can be run again and again, the one by which they are
    entered, which comes after which, and which may lead out."""
    entry: Block
    blocks: frozenset[Block]
    after: dict[Block, list[Block]]
    leaving: frozenset[Block]

    def key(self) -> tuple[Block, frozenset[Block]]:
        """What tells it from others."""
        return self.entry, self.blocks

    def reached(self, first: Block, allowed: Iterable[Block]) -> set[Block]:
        """What comes after a block, if only allowed ones come between."""
        allowed, seen = set(allowed), set()
        stack = [first] if first in allowed else []
        while stack:
            for block in self.after[stack.pop()]:
                if block not in seen:
                    seen.add(block)
                    if block in allowed:
                        stack.append(block)
        return seen

    def leads(self, first: Block, last: Block,
              allowed: Iterable[Block]) -> bool:
        """Whether allowed blocks lead from one to another."""
        return last in self.reached(first, allowed)

    def is_cut_by(self, blocks: set[Block]) -> bool:
        """Whether all ways round pass one of the blocks."""
        return not self.leads(self.entry, self.entry, self.blocks - blocks)

    def is_left_before(self, block: Block) -> bool:
        """Whether a way leads from the entry out of it and not by a block."""
        rest = self.blocks - {block}
        return self.entry is not block and bool(
            self.leaving & ({self.entry} | self.reached(self.entry, rest)) -
            {block})


class NoBound(Exception):
    """A path of unknown length, and why."""


def addresses(path: Path, folder: str) -> dict[str, dict[int, int]]:
    """Assembles a file to FOLDER/a.o. Address of a line, by its section."""
    listing = subprocess.run(
        ["as", "-aln", "-o", f"{folder}/a.o", str(path)], check=True,
        stdout=subprocess.PIPE, text=True).stdout
    at = {}
    for line in listing.splitlines():
        if found := re.match(r" *(\d+) ([0-9a-f]{4,}) [0-9A-F]", line):
            at.setdefault(int(found[1]), int(found[2], 16))
    section, found = ".text", defaultdict(dict)
    text = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(text, start=1):
        words = line.replace(",", " ").split()
        if words[:1] in ([".text"], [".data"], [".bss"]):
            section = words[0]
        elif words[:1] == [".section"]:
            section = words[1]
        elif number in at and section.startswith(".text"):
            found[section][number] = at[number]
    return found


def frames_at(command: list[str], ats: Iterable[int]) -> Iterable[Frames]:
    """The places in the source that addr2line knows of addresses."""
    told = subprocess.run(
        [*command, "-a", "-i"], input="".join(f"{at:x}\n" for at in ats),
        check=True, stdout=subprocess.PIPE, text=True).stdout
    for part in re.split(r"^0x\w+\n", told, flags=re.M)[1:]:
        places = re.findall(r"^(.+):(\d+)", part, re.M)
        yield tuple((os.path.relpath(file), int(line))
                    for file, line in reversed(places))


def frames_of(path: Path) -> dict[int, Frames]:
    """The places in the source that each line of an assembly is of."""
    found: dict[int, Frames] = {}
    with tempfile.TemporaryDirectory() as folder:
        for section, lines in addresses(path, folder).items():
            found.update(zip(lines, frames_at(
                ["addr2line", "-j", section, "-e", f"{folder}/a.o"],
                lines.values())))
    return found


class Turns:
    """How often cycles are run."""

    def __init__(self, files: list[Path], loops: Iterable[Loop]) -> None:
        self.files = files
        self.loops: dict[str, list[Loop]] = defaultdict(list)
        for loop in sorted(loops, key=lambda one: (one.first, -one.last)):
            self.loops[loop.file].append(loop)
        self.frames: dict[int, dict[int, Frames]] = {}
        self.known: dict[frozenset[Block], Callable[[int], int]] = {}

    def places(self, block: Block, code: Instruction) -> Frames:
        """Where an instruction comes from, its callers first; () if unknown."""
        if block.file not in self.frames:
            self.frames[block.file] = frames_of(self.files[block.file])
        return self.frames[block.file].get(code.at, ())

    def nest(self, places: Frames) -> Nest:
        """The loops around an instruction, the outermost first."""
        return tuple((places[:depth], loop)
                     for depth, (file, line) in enumerate(places)
                     for loop in self.loops[file]
                     if loop.first <= line <= loop.last)

    def own(self, cycle: Iterable[Block]) -> tuple[Frames, Loop]:
        """The innermost loop that holds all conditional jumps of a cycle, and
        from where it was called."""
        common: Optional[Nest] = None
        for block in cycle:
            if block.is_conditional():
                nest = self.nest(self.places(block, block.code[-1]))
                common = nest if common is None else tuple(
                    a for a, b in zip(common, nest) if a == b)
        if not common:
            raise NoBound(f"a cycle that is no loop's ({self.told(cycle)})")
        return common[-1]

    def told(self, cycle: Iterable[Block]) -> str:
        """Where a cycle is, for who reads of it."""
        files = sorted({f"{Path(places[-1][0]).name}:{places[-1][1]}"
                        for block in cycle for code in block.code
                        if (places := self.places(block, code))})
        return " ".join(files[:4])

    def of_cycle(self, cycle: Cycle) -> Callable[[int], int]:
        """How often the entry of a cycle is passed, by the number of units."""
        if cycle.key() not in self.known:
            self.known[cycle.key()] = self._of_cycle(cycle)
        return self.known[cycle.key()]

    def _of_cycle(self, cycle: Cycle) -> Callable[[int], int]:
        turns, more = self.own(cycle.blocks)[1].turns, [
            late for _, blocks, late in self.passed(cycle)
            if cycle.is_cut_by(blocks)]
        if not more:
            loop = self.own(cycle.blocks)[1]
            raise NoBound("a cycle that may be of several loops, in that at "
                          f"{loop.file}:{loop.first} "
                          f"({self.told(cycle.blocks)})")
        return turns if not min(more) else lambda units: turns(units) + 1

    def each_turn(self, cycle: Cycle
                  ) -> Iterable[tuple[Block, Callable[[int], int]]]:
        """Blocks that all ways round pass, and how often they are passed."""
        turns = self.own(cycle.blocks)[1].turns
        for is_test, blocks, once_more in self.passed(cycle):
            if len(blocks) == 1 and cycle.is_cut_by(blocks):
                more = int(is_test and once_more)
                yield (next(iter(blocks)),
                       lambda units, more=more: turns(units) + more)

    def is_same(self, a: Iterable[Block], b: Iterable[Block]) -> bool:
        """Whether two cycles are of the same loop."""
        try:
            return self.own(a) == self.own(b)
        except NoBound:
            return True

    def passed(self, cycle: Cycle) -> list[tuple[bool, frozenset[Block], bool]]:
        """What is passed at most once a turn: whether in the condition, the
        copies, and whether the entry may be passed once more than turns are."""
        calls, loop = self.own(cycle.blocks)
        if loop.turns is None:
            raise NoBound(f"the loop at {loop.file}:{loop.first} has no number")
        compares = defaultdict(set)  # by its place in the text
        found = []
        for block in cycle.blocks:
            if not block.is_conditional():
                continue
            places = self.places(block, block.code[-1])
            direct = len(places) == len(calls) + 1
            if direct and within(block.code[-1].of, loop.test):
                compares[block.code[-1].of].add(block)
            elif direct and (within(block.code[-1].of, loop.condition) or
                             block.code[-1].of == (loop.first, loop.column)):
                compares[block.code[-1].of, block] = {block}
            elif self.nest(places)[-1] == (calls, loop) and \
                    self.is_body(block, block.code[-1], loop, len(calls)):
                found.append((False, frozenset({block}),
                              cycle.is_left_before(block)))
        return found + [
            (True, frozenset(blocks),
             not self.is_entered_late(cycle, blocks, loop, len(calls)))
            for blocks in compares.values()]

    def is_entered_late(self, cycle: Cycle, tests: set[Block], loop: Loop,
                        depth: int) -> bool:
        """Whether some of the body stands before the first of the tests."""
        before = {block for block in cycle.blocks if not any(
            self.is_body(block, code, loop, depth) for code in block.code)}
        return not any(test in before and
                       (test is cycle.entry or
                        cycle.leads(cycle.entry, test, before))
                       for test in tests)

    def is_body(self, block: Block, code: Instruction, loop: Loop,
                depth: int) -> bool:
        """Whether an instruction is of what a loop's condition guards."""
        places = self.places(block, code)
        if len(places) <= depth or places[depth][0] != loop.file:
            return False
        line = places[depth][1]
        column = code.of[1] if len(places) == depth + 1 else 0
        return (loop.body <= (line, column) and line <= loop.last) or \
            loop.body[0] < line <= loop.last
