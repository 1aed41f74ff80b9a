#!/usr/bin/python3 -B
"""How much of a tick the worst known step takes on a board:

    budget.py BOARD REAL SCENE SCHEME RATE CLOCK UPLINK

by its instructions, one a cycle, which only a Cortex-M7 does better. A locked
firmware runs the trajectory of its scene, whose longest step is in
docs/bench/sizes.csv. With other parameters, those of a file or of commands, the
worst is that of docs/bench/worst.csv, found on mps2-an500 and here multiplied
by what `chaos` takes more. Ends with code 1 where that is more than the tick.
"""
from __future__ import annotations

import csv
import sys
from pathlib import Path

TABLES = Path(__file__).resolve().parents[2] / "docs/bench"
COUNTED = "mps2-an500"  # the board on which the worst was counted
FUNCTION = {"moreau": "tf_step", "located": "tf_step_located",
            "compensated": "tf_step_compensated"}


def rows(name: str) -> list[dict[str, str]]:
    with open(TABLES / name, encoding="ascii") as file:
        return list(csv.DictReader(line for line in file if line[0] != "#"))


def longest(board: str, real: str) -> dict[str, int]:
    """By scene."""
    return {row["scene"]: int(row["most"]) for row in rows("sizes.csv")
            if (row["board"], row["real"]) == (board, real) and row["most"]}


def worst(real: str, scheme: str) -> int:
    """Of all parameters; where it was not counted on a board, here."""
    return max(int(row.get(f"M4F {real}") or row[f"M7 {real}"] or
                   row[f"x86-64 {real}"])
               for row in rows("worst.csv")
               if row["function"] == FUNCTION[scheme])


def main() -> None:
    board, real, scene, scheme, rate, clock, uplink = sys.argv[1:]
    most = longest(board, real)
    if not most:
        sys.exit(f"no step is counted on {board}: BOARD_LIKE names a board with"
                 " its processor (docs/PORTS.md)")
    if scene in {*most} - {"generic"} and scheme == "moreau" and not uplink:
        steps, of = most[scene], f"of {scene}"
    else:
        known = longest(COUNTED, real)
        like = "chaos" if "chaos" in most else min(most)
        steps = worst(real, scheme) * most[like] // known[like]
        of = "of any parameters"
    share = steps * int(rate) / int(clock)
    print(f"the worst known step ({of}, {scheme}) takes {steps} instructions:"
          f" {share:.0%} of a tick of {rate} Hz at {int(clock) / 1e6:g} MHz",
          file=sys.stderr)
    sys.exit(share > 1)


if __name__ == "__main__":
    main()
