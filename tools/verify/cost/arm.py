#!/usr/bin/python3 -B
"""The longest way through a program for Cortex-M, whatever its inputs.

As paths.py has it for x86-64, in instructions, of the very program that is run:
ELF is linked with the lines of the source (gcc -g1). Functions of libgcc and of
the C library are parts of the ways too. They have no lines: how often their
loops run stands in library.bounds, by the address in the function, and a loop
that is not there, or is not as long as there, has no number. The functions of
port/arch/memory.c run their loops once a byte.

Prints lines "name A B" or "name - why", as paths.py does; with --window OPEN
CLOSE only what is run from a call of OPEN to one of CLOSE.
"""
from __future__ import annotations

import argparse
import re
import subprocess
from pathlib import Path
from typing import Callable, Iterable, Optional

from assembly import Label
from firmware import SIZED, Program
from paths import (DEFINES, UNITS, Ways, base, fewer_calls,
                   source_loops)
from turns import Cycle, Frames, Loop, NoBound, Turns, frames_at
from thumb import read_listing
import loop_table

LIBRARY = Path(__file__).with_name("library.bounds")
MEMORY = "port/arch/memory.c"
ROW = re.compile(r"(?:Copy|Special opcode .* to (0x[0-9a-f]+|0)(?:\[\d+\])? "
                 r"and Line by -?\d+ to (\d+))")
ADDRESS = re.compile(
    r"(?:Extended opcode 2: set Address to|Advance PC by .* to|"
    r"Advance a fixed size amount .* to) (0x[0-9a-f]+|0)")


def places_of(told: str, code: Iterable[int]) -> dict[int, tuple[int, int]]:
    """Line and column of instructions, of what `objdump --dwarf=rawline` says.

    What the linker has left out still has rows, from address 0 on.
    """
    rows: dict[int, tuple[int, int]] = {}
    known, found = sorted(code), {}
    at, line, column, ends = 0, 1, 0, []
    there = set(known)
    sequence: dict[int, tuple[int, int]] = {}
    for text in told.splitlines():
        text = re.sub(r"^ *\[0x\w+\] *", "", text)
        if address := ADDRESS.match(text):
            at = int(address[1], 16)
        elif moved := re.match(r"Advance Line by -?\d+ to (\d+)", text):
            line = int(moved[1])
        elif moved := re.match(r"Set column to (\d+)", text):
            column = int(moved[1])
        elif row := ROW.match(text):
            if row[1]:
                at, line = int(row[1], 16), int(row[2])
            sequence[at] = line, column
        elif text.startswith("Extended opcode 1:"):
            if min(sequence, default=0) in there:
                rows.update(sequence)
                ends.append(at)
                rows.setdefault(at, (0, 0))
            at, line, column, sequence = 0, 1, 0, {}
    here, begins = (0, 0), sorted(rows, reverse=True)
    for address in known:
        while begins and begins[-1] <= address:
            here = rows[begins.pop()]
        found[address] = here
    return found


class Elf:
    """A program and the tools that read it."""

    def __init__(self, path: Path, tools: str = "arm-none-eabi-") -> None:
        self.path, self.tools = path, tools

    def told(self, *options: str) -> str:
        """What objdump prints."""
        return subprocess.run([f"{self.tools}objdump", *options,
                               str(self.path)], stdout=subprocess.PIPE,
                              text=True, check=True).stdout

    def program(self, window: tuple[str, str] = ("", "")) -> Program:
        """Its blocks."""
        listing = read_listing(self.told("-dz", "-j", ".text"))
        places = places_of(self.told("--dwarf=rawline"), listing.lines)
        return Program(listing, places, window)

    def frames(self, code: Program) -> dict[int, Frames]:
        """Where its instructions come from; () where the two tables of the
        program do not say the same."""
        ats = list(code.listing.lines)
        found = zip(ats, frames_at(
            [f"{self.tools}addr2line", "-e", str(self.path)], ats))
        return {at: frames if frames and frames[-1][1] ==
                code.places[at][0] else () for at, frames in found}


def library_bounds() -> dict[str, tuple[int, int]]:
    """Instructions and turns of the loops of library.bounds, by their place."""
    found = {}
    for line in LIBRARY.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            place, length, turns, _ = line.split(" : ")
            found[place] = int(length), int(turns)
    return found


class ArmTurns(Turns):
    """How often cycles are run, those of libraries included."""

    def __init__(self, code: Program, loops: list[Loop],
                 frames: dict[int, Frames], size: Optional[int] = None,
                 library: Optional[dict[str, tuple[int, int]]] = None) -> None:
        super().__init__([], loops)
        self.code, self.all_loops, self.size = code, loops, size
        self.library = library_bounds() if library is None else library
        self.frames[0] = frames
        for loop in self.loops[MEMORY]:
            at = self.loops[MEMORY].index(loop)
            self.loops[MEMORY][at] = loop._replace(
                turns=None if size is None else lambda units: size)

    def of_size(self, size: int) -> ArmTurns:
        """The same where memory functions are called with so many bytes."""
        return ArmTurns(self.code, self.all_loops, self.frames[0], size,
                        self.library)

    def _of_cycle(self, cycle: Cycle) -> Callable[[int], int]:
        place = self.code.at(cycle.entry)
        if place in self.library:
            length, turns = self.library[place]
            found = sum(len(block.code) for block in cycle.blocks)
            if found != length:
                raise NoBound(f"the loop at {place} has {found} instructions, "
                              f"not {length} as in {LIBRARY.name}")
            return lambda units: turns
        try:
            return super()._of_cycle(cycle)
        except NoBound as why:
            raise NoBound(f"{why}, at {place}") from None


class ArmWays(Ways):
    """Longest ways through a program."""

    def __init__(self, code: Program, turns: ArmTurns, units: int,
                 fewer: Optional[dict[tuple[str, str], int]] = None) -> None:
        super().__init__(code, turns, units, fewer)
        self.of_size: dict[int, ArmWays] = {}

    def longest(self, function: Optional[Label]) -> int:
        sized = re.fullmatch(r"(\w+)\((\d+)\)", function[1]) if function \
            else None
        if not sized:
            if function and function[1].split()[0] in SIZED and \
                    self.turns.size is None:
                raise NoBound(function[1])
            return super().longest(function)
        size = int(sized[2])
        if size not in self.of_size:
            self.of_size[size] = ArmWays(self.code, self.turns.of_size(size),
                                         self.units)
        return self.of_size[size].longest((0, sized[1]))


def memory_loops(define: str) -> list[Loop]:
    """The loops of the memory functions."""
    return [Loop(one.file, one.function, one.line, one.column, one.last,
                 one.test, one.condition, one.body, None)
            for one in loop_table.loops_of(MEMORY, {MEMORY}, define)]


class Bounds:
    """Longest ways through a program on a board, by functions."""

    def __init__(self, elf: Elf, loops: list[Loop],
                 window: tuple[str, str] = ("", "")) -> None:
        self.code = elf.program(window)
        self.turns = ArmTurns(self.code, loops, elf.frames(self.code))
        self.window = window[0]

    def ways(self, units: int, free: Iterable[str] = ()) -> ArmWays:
        """Ways of so many units; functions that are free count nothing."""
        ways = ArmWays(self.code, self.turns, units, fewer_calls())
        ways.found.update({label: 0 for label in self.code.functions
                           if base(label) in free})
        return ways

    def of_window(self, units: int, free: Iterable[str] = ()) -> int:
        """The most that is run from a mark to a mark."""
        ways = self.ways(units, free)
        return max(ways.longest(label) for label in self.code.functions
                   if label[1].startswith(f"{self.window}+"))

    def lines(self) -> Iterable[str]:
        """What is printed: of the window, or of all functions of the core."""
        by_units = {units: self.ways(units) for units in (0, *UNITS)}
        for label in sorted(self.code.functions, key=lambda one: one[1]):
            named = f"{self.window}+" if self.window else "tf_"
            if not label[1].startswith(named):
                continue
            found = {units: ways.try_longest(label)
                     for units, ways in by_units.items()}
            if found[0] is None:
                yield f"{base(label)} - {by_units[0].why[label]}"
            else:
                slope = max(-(-(found[units] - found[0]) // units)
                            for units in UNITS)
                yield f"{base(label)} {found[0]} {slope}"


def all_loops(real: str) -> list[Loop]:
    """Those of the core and of the memory functions."""
    return source_loops(real) + memory_loops(DEFINES[real])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("elf", type=Path, metavar="ELF")
    parser.add_argument("real", choices=list(DEFINES), help="real type")
    parser.add_argument("--window", nargs=2, metavar=("OPEN", "CLOSE"),
                        default=("", ""), help="functions that mark a part")
    parser.add_argument("--tools", default="arm-none-eabi-",
                        help="what their names begin with")
    given = parser.parse_args()
    for line in Bounds(Elf(given.elf, given.tools), all_loops(given.real),
                       tuple(given.window)).lines():
        print(line)


if __name__ == "__main__":
    main()
