#!/usr/bin/python3 -B
"""Makes the assembly of x86-64 (gcc -S, or clang) count its own instructions:
count.py FILE prints what counts.

In front of every stretch that is run as a whole stands one instruction that
adds the length of the stretch to register mm7. Nothing else uses the MMX
registers, and that addition changes neither flags nor other registers, so the
code does what it did, in the same instructions. A repeated string instruction
counts as one. cost.c opens and closes a window. The memory functions that a
compiler may call get names of their own: those that the rest of a program calls
are not counted.
"""
import re
import sys
from pathlib import Path

MEMORY = re.compile(r"mem(?:set|cpy|move)")
LABEL = re.compile(r"[A-Za-z_.][\w.$]*:")
INSTRUCTION = re.compile(r"[ \t]+([a-z]\S*)")
LAST = re.compile(r"j[a-z]*|ret[a-z]*|notrack|ud2|call[a-z]*")


def stretches(lines):
    """(lines, places of its instructions) of each stretch."""
    held, places = [], []
    for line in lines:
        line = MEMORY.sub(r"counted_\g<0>", line)
        instruction = INSTRUCTION.match(line)
        if LABEL.match(line):
            yield held, places
            held, places = [], []
        held.append(line)
        if instruction:
            places.append(len(held) - 1)
            if LAST.fullmatch(instruction[1]):
                yield held, places
                held, places = [], []
    yield held, places


longest = 0
for held, places in stretches(Path(sys.argv[1]).read_text().splitlines()):
    longest = max(longest, len(places))
    if places:
        held.insert(places[0],
                    f"\tpaddq\t.Lcounts+{8 * len(places)}(%rip), %mm7")
    print(*held, sep="\n", end="\n" * bool(held))
print("\t.section\t.rodata\n\t.align 8\n.Lcounts:")
for i in range(longest + 1):
    print(f"\t.quad\t{i}")
