#!/usr/bin/python3 -B
"""Makes the assembly of x86-64 (gcc -S, or clang) count its own instructions.

In front of every stretch that is run as a whole stands one instruction that
adds the length of the stretch to register mm7. Nothing else uses the MMX
registers, and that addition changes neither flags nor other registers, so the
code does what it did, in the same instructions. A repeated string instruction
counts as one. calls.c opens and closes a window. The memory functions that a
compiler may call get names of their own: those that the rest of a program calls
are not counted.
"""
from __future__ import annotations

import argparse
import re
from typing import Iterable, Iterator

MEMORY = re.compile(r"mem(?:set|cpy|move)")
LABEL = re.compile(r"[A-Za-z_.][\w.$]*:")
INSTRUCTION = re.compile(r"[ \t]+([a-z]\S*)")
LAST = re.compile(r"j[a-z]*|ret[a-z]*|notrack|ud2|call[a-z]*")


class Counter:
    """Adds up stretches; `longest` is the length of the longest so far."""

    def __init__(self) -> None:
        self.longest = 0

    def stretch(self, lines: list[str], length: int, first: int) -> list[str]:
        """The lines with the addition in front of the first instruction."""
        self.longest = max(self.longest, length)
        if length == 0:
            return lines
        addition = f"\tpaddq\t.Lcounts+{8 * length}(%rip), %mm7"
        return lines[:first] + [addition] + lines[first:]

    def counted(self, lines: Iterable[str]) -> Iterator[str]:
        """The assembly that counts."""
        held: list[str] = []
        length = first = 0
        for line in lines:
            line = MEMORY.sub(r"counted_\g<0>", line)
            instruction = INSTRUCTION.match(line)
            if LABEL.match(line):
                yield from self.stretch(held, length, first)
                held, length = [], 0
            held.append(line)
            if not instruction:
                continue
            if length == 0:
                first = len(held) - 1
            length += 1
            if LAST.fullmatch(instruction[1]):
                yield from self.stretch(held, length, first)
                held, length = [], 0
        yield from self.stretch(held, length, first)
        yield "\t.section\t.rodata\n\t.align 8\n.Lcounts:"
        for i in range(self.longest + 1):
            yield f"\t.quad\t{i}"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("assembly", help="what gcc -S has made")
    with open(parser.parse_args().assembly, encoding="utf-8") as file:
        for line in Counter().counted(file.read().splitlines()):
            print(line)


if __name__ == "__main__":
    main()
