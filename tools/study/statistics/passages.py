#!/usr/bin/python3 -B
"""Where each run of `diverge` passed the section, one run a line.

Prints side (1 or -1), time of the exit [s], time at which the section was
passed [s], phase there [windings]; both times since the unperturbed motion
arrived at the two-fold. Runs that did not wind at the section are left out.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Iterator, NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402


class Passage(NamedTuple):
    """One run; `phase` is text, as it was read."""
    side: int
    exit: float
    passed: float
    phase: str

    def __str__(self) -> str:
        return (f"{self.side} {self.exit:.17g} {self.passed:.17g} "
                f"{self.phase}")


def passages(exits: str, returns: str, arrival: float) -> Iterator[Passage]:
    """The passages of one run of `diverge`, in its order."""
    arrived = {(row["sample"], row["cycle"]): row.number("arrived")
               for row in read.read_csv(returns, counted=True)}
    for row in read.read_csv(exits, counted=True):
        if row["phase"] == "":
            continue
        cycle = row["sample"], row["cycle"]
        if cycle not in arrived:
            raise read.TableError(f"{row.where}: cycle {cycle[1]} of sample "
                                  f"{cycle[0]} is not in {returns}")
        begin = arrived[cycle] - arrival
        yield Passage(1 if row["side"] == "slip+" else -1,
                      begin + row.number("time"),
                      begin + row.number("section_time"), row["phase"])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("exits", help="file of --exits")
    parser.add_argument("returns", help="file of --returns, of the same run")
    parser.add_argument("arrival", type=float,
                        help="when the unperturbed motion arrives [s]; 0 for "
                        "runs that start at the two-fold")
    given = parser.parse_args()
    for passage in passages(given.exits, given.returns, given.arrival):
        print(passage)


if __name__ == "__main__":
    read.run_script(main)
