#!/usr/bin/python3 -B
"""The longest way through the code of each function, whatever its inputs.

It is in instructions, from the assembly of x86-64 (gcc -S -g1) that the
Makefile has compiled for counting, as lines "name A B": no call takes more
than A + B n, n the units of loops.bounds (segments of a budget, states), B = 0
where nothing depends on them. What is called and what is jumped to is a part of
the way, a table's jump goes to any of its entries, and a repeated string
instruction is one. "name - why": no number, of it and of what calls it.

Why it is an upper bound: every run is a path through the blocks. Of each
strongly connected part, the path from one passage of its entry to the next is
no longer than the longest that does not pass the entry again, found in the same
way for the parts inside; turns.py says how often the entry is passed while the
part is not left. A part with several entries counts once more, from any block
of it. calls.bounds has calls that are fewer than that, with the reason. Nothing
else is known of which branches exclude each other, nor of loops that
do not all run their most in one call, so it is more than any call takes.
"""
from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Callable, Iterable, Optional

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "check"))
import loop_table  # noqa: E402
from assembly import Block, Code, Label  # noqa: E402
from turns import Cycle, Loop, NoBound, Turns  # noqa: E402

FEWER_CALLS = Path(__file__).with_name("calls.bounds")
DEFINES = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
# Numbers of units that show how the way grows at most: by single states, by
# blocks of 16, and to the largest budget, for it may grow faster than a line.
UNITS = 1, 15, 16, 1000


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

    def __init__(self, code: Code, turns: Turns, units: int,
                 fewer: Optional[dict[tuple[str, str], int]] = None) -> None:
        self.code, self.turns, self.units = code, turns, units
        self.fewer = fewer or {}
        self.caller = ""
        self.counted_once: set[Label] = set()  # in the caller
        self.found: dict[Label, Optional[int]] = {}  # None: no number
        self.why: dict[Label, str] = {}

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
        if block.why_unknown:
            raise NoBound(block.why_unknown)
        called = [self.call(self.code.place(target)[1])
                  for target in block.calls]
        tails = [self.longest(tail) for tail in self.edges(block)[1]]
        return len(block.code) + sum(called) + max(tails, default=0)

    def call(self, function: Optional[Label]) -> int:
        """Instructions of a call, 0 of one that is counted elsewhere."""
        if function and (self.caller, base(function)) in self.fewer:
            self.counted_once.add(function)
            return 0
        return self.longest(function)

    def whole(self, function: Label) -> int:
        """The longest way of a function that is not known yet."""
        before = self.caller, self.counted_once
        self.caller, self.counted_once = base(function), set()
        try:
            way = self.way(None, self.code.functions[function])
            return way + sum(
                self.fewer[self.caller, base(callee)] * self.longest(callee)
                for callee in self.counted_once)
        finally:
            self.caller, self.counted_once = before

    def way(self, region: Optional[frozenset[Block]], entry: Block,
            anywhere: bool = False) -> int:
        """The longest way from the entry of a region, None: a function.

        An edge back to the entry is not followed. anywhere: from any block.
        """
        def after(block: Block) -> list[Block]:
            return [b for b in self.edges(block)[0] if b is not entry and
                    (region is None or b in region)]

        parts = loops(entry, after)
        part_of = {block: i for i, part in enumerate(parts) for block in part}
        best = [0] * len(parts)
        for i, part in reversed(list(enumerate(parts))):
            if len(part) > 1 or part[0] in after(part[0]):
                cost = self.cycle(part, after, parts)
            else:
                cost = self.block_cost(part[0])
            best[i] = cost + max((best[part_of[b]] for block in part
                                  for b in after(block) if part_of[b] > i),
                                 default=0)
        return max(best) if anywhere else best[0]

    def cycle(self, part: list[Block], after: Callable[[Block], list[Block]],
              parts: list[list[Block]]) -> int:
        """The longest way through a cycle of a region with these parts."""
        entry, inside = part[0], frozenset(part)
        cycle = Cycle(
            entry, inside,
            {block: [b for b in self.edges(block)[0] if b in inside]
             for block in part},
            frozenset(block for block in part
                      if not inside.issuperset(self.edges(block)[0]) or
                      self.edges(block)[1]))
        several = any(b in inside and b is not entry for other in parts
                      if other is not part for block in other
                      for b in after(block))
        turns = self.turns.of_cycle(cycle)(self.units) + several
        if not self.goes_on_without(cycle, entry):
            return turns * self.way(inside, entry, anywhere=several)
        # Another block that is passed in each turn, and the way to it.
        ways = [turns * self.way(inside, entry, anywhere=several)]
        for block, passes in self.turns.each_turn(cycle):
            if not self.goes_on_without(cycle, block):
                ways.append(
                    self.way(inside - {block}, entry, anywhere=several) +
                    passes(self.units) * self.way(inside, block))
        return min(ways)

    def goes_on_without(self, cycle: Cycle, without: Block) -> bool:
        """Whether a cycle of the same loop is left without a block."""
        rest = cycle.blocks - {without}
        return any(
            len(part) > 1 and self.turns.is_same(part, cycle.blocks)
            for start in cycle.after[without] if start in rest
            for part in loops(start, lambda block: [
                b for b in cycle.after[block] if b in rest]))

    def longest(self, function: Optional[Label]) -> int:
        """The longest way through a function."""
        if function not in self.code.functions:
            raise NoBound(f"calls {function[1] if function else '?'}, which is "
                          "not of the core")
        found = self.try_longest(function)
        if found is None:
            raise NoBound(self.why[function])
        return found

    def try_longest(self, function: Label) -> Optional[int]:
        """The same; None where it has no number."""
        if function not in self.found:
            self.found[function] = None
            self.why[function] = f"{function[1]} calls itself"
            try:
                self.found[function] = self.whole(function)
            except NoBound as why:
                self.why[function] = str(why)
        return self.found[function]


def source_loops(real: str) -> list[Loop]:
    """The loops of the core with the numbers of their turns."""
    define = DEFINES[real]
    told = loop_table.numbers(define)
    return [Loop(one.file, one.function, one.line, one.column, one.last,
                 one.test, one.condition, one.body, loop_table.turns(one, told))
            for one in loop_table.loops_of_core(define)]


def base(function: Label) -> str:
    """The name of a function in the source."""
    return plain(re.sub(r"\..*", "", function[1]))


def fewer_calls() -> dict[tuple[str, str], int]:
    """What calls.bounds says, by caller and callee."""
    found = {}
    for line in FEWER_CALLS.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            caller, callee, at_most, _ = line.split(" : ")
            found[caller, callee] = int(at_most)
    return found


def plain(name: str) -> str:
    """A name without its real type, or that of the inline function which a
    function of inline.c is."""
    return re.sub(r"_f(32|64)$", "", re.sub("^cost_", "tf_", name))


def told(code: Code, turns: Turns) -> Iterable[str]:
    """The lines that are printed."""
    functions = sorted((function for function in code.functions
                        if re.fullmatch(r"tf_.*_f(32|64)|cost_.*",
                                        function[1])),
                       key=lambda label: plain(label[1]))
    fewer = fewer_calls()
    ends = [Ways(code, turns, units, fewer) for units in (0, max(UNITS))]
    for function in functions:
        for ways in ends:
            ways.try_longest(function)
    none, most = ends
    same = {function: way for function, way in none.found.items()
            if most.found[function] == way}
    between = [Ways(code, turns, units, fewer) for units in UNITS]
    for ways in between:
        ways.found, ways.why = dict(same), none.why
    for function in functions:
        name, first = plain(function[1]), none.found[function]
        if first is None:
            yield f"{name} - {none.why[function]}"
        else:
            slope = max(-(-(ways.longest(function) - first) // ways.units)
                        for ways in between)
            yield f"{name} {first} {slope}"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("real", choices=list(DEFINES), help="real type")
    parser.add_argument("build", type=Path, help="folder of the build")
    given = parser.parse_args()
    folder = given.build / given.real / "counted"
    code = Code(sorted(folder.glob("**/*.s")))
    if not code.functions:
        print(f"{sys.argv[0]}: {folder}: has no assembly", file=sys.stderr)
        return 1
    for line in told(code, Turns(code.files, source_loops(given.real))):
        print(line)
    return 0


if __name__ == "__main__":
    sys.exit(main())
