#!/usr/bin/python3 -B
"""Lists of starts for paths.py: NAME T_BEGIN T_END R OMEGA H, one a line.

fans      starts near h = 0 at three places of the surface of the scene `chaos`
          near its two-fold, over 2 ms
leavers   slips that leave the escaping region one after the other: exits 40 ms
          apart, to either side, as long as they lie off h = g = 0
loop      two cycles that begin at the two-fold: `straight` is the first future
          that lands so far down that it comes back to the two-fold at once,
          `winding` one that winds much and lands higher
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Iterator

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

OFF = 1e-12  # so far beside the surface a slip begins [m/s]
END = 2e-3   # of the fans [s]


def fans() -> Iterator[str]:
    """Starts on either side of the surface, and on it."""
    for i in range(-4, 5):
        if i != 0:
            yield f"sliding 0 {END:g} 0.188 -1.059 {i * 2e-6:g}"
            # Off the escaping surface one after the other, from either side.
            begin, h = (abs(i) - 1) * 4e-4, OFF if i > 0 else -OFF
            yield f"escaping {begin:g} {END:g} 0.1838 -1.016 {h:g}"
        yield f"crossing 0 {END:g} 0.183 -1.058 {-i * 2e-6 - 6e-6:g}"
    yield f"stays 0 {END:g} 0.188 -1.059 0"
    yield f"stays 0 {END:g} 0.1838 -1.016 0"


def start(name: str, end: str, row: read.Row) -> str:
    """The slip that one branch begins with."""
    h = OFF if row["mode"] == "slip+" else -OFF
    return f"{name} 0 {end} {row['exit_r']} {row['exit_omega']} {h:g}"


def leavers(branches: list[read.Row]) -> Iterator[str]:
    """Exits 40 ms apart."""
    for row in branches:
        stick = row.number("stick_time")
        if stick <= 0.4 and round(stick * 1000) % 40 == 0:
            yield start(f"t={row['stick_time']}", "2.3", row)


def loop(branches: list[read.Row]) -> Iterator[str]:
    """One branch of each kind, in the order of the branches."""
    done = set()
    for row in branches:
        winding = row.count("windings")
        if "winding" not in done and winding == 7:
            done.add("winding")
            yield start("winding", "2.1", row)
        if "straight" not in done and winding > 0 and \
                row.number("end_r") < 0.1821:
            done.add("straight")
            yield start("straight", "4", row)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("list", choices=["fans", "leavers", "loop"])
    parser.add_argument("branches", nargs="?", help="of `twofold diverge chaos "
                        "--exhaustive`, for leavers and loop")
    given = parser.parse_args()
    if given.list == "fans":
        lines = fans()
    elif given.branches is None:
        parser.error(f"{given.list} needs the branches")
    else:
        branches = [row for row in read.read_csv(given.branches)
                    if row["end"] == "codim2"]
        lines = (leavers if given.list == "leavers" else loop)(branches)
    for line in lines:
        print(line)


if __name__ == "__main__":
    read.run_script(main)
