#!/usr/bin/python3 -B
"""Trajectories for the figures, by `twofold run`, as gnuplot reads them.

A line of standard input is one trajectory: NAME T_BEGIN T_END R OMEGA H. It
starts at T_BEGIN on its clock. Written are t,r,omega,h,g,mode, each trajectory
behind a line `# NAME` and before two empty lines; mode is its number, 1 to 5. A
trajectory that has reached the two-fold again ends there: behind it all is
open.
"""
from __future__ import annotations

import argparse
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Iterable, Iterator

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

MODES = {"slip+": 1, "slip-": 2, "stick+": 3, "stick-": 4, "pinned": 5}
# What the set of the trajectories takes of each.
WINDOW = {"r": 0.012, "omega": 0.06, "h": 1.4e-4}


def apart(a: read.Row, b: read.Row) -> float:
    """How far two rows lie from each other, in windows."""
    return math.hypot(*((a.number(name) - b.number(name)) / size
                        for name, size in WINDOW.items()))


def thinned(rows: Iterable[read.Row], thin: float) -> Iterator[read.Row]:
    """Rows that lie `thin` windows apart, and all ends of a mode."""
    last = held = None
    for row in rows:
        if last and row["mode"] == last["mode"] and apart(row, last) < thin:
            held = row
            continue
        # The last row before a change of mode is kept, lest a switch is cut.
        if held and row["mode"] != last["mode"]:
            yield held
        yield row
        last, held = row, None
    if held:
        yield held


def reached_again(log: str) -> float:
    """When the two-fold was reached behind the start, infinity if never."""
    times = re.findall(r"^ *(\d\S*) .*two-fold reached", log, re.MULTILINE)
    return min((float(t) for t in times if float(t) > 0), default=math.inf)


def trajectory(given: argparse.Namespace, start: read.Row) -> Iterator[str]:
    """One trajectory."""
    length = start.number("end") - start.number("begin")
    with tempfile.NamedTemporaryFile(suffix=".csv") as out:
        done = subprocess.run(
            [given.twofold, "run", "chaos", "--scheme", "located", "--dt",
             given.dt, "--set", f"r={start['r']}", "--set",
             f"omega={start['omega']}", "--set", f"h={start['h']}", "--out",
             out.name, "--events", "1000000", "--t-end", f"{length:.6g}"],
            stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise read.TableError(f"{start.where}: {done.stderr.strip()}")
        rows = read.read_csv(out.name)
    end = reached_again(done.stderr) + 1e-9
    for row in thinned((row for row in rows if row.number("t") <= end),
                       given.thin):
        t, r, omega, h, g = map(row.number, ("t", "r", "omega", "h", "g"))
        yield (f"{start.number('begin') + t:.6g} {r:.6g} {omega:.6g} "
               f"{h:.4g} {g:.4g} {MODES[row['mode']]}")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("twofold", help="the command line program")
    parser.add_argument("dt", help="step [s]")
    parser.add_argument("thin", type=float, help="0: every row is written, "
                        "else those that lie so many windows from the last, "
                        "the window being what the set of the trajectories "
                        "takes of r, omega and h")
    given = parser.parse_args()
    for start in read.read_words("-", ["name", "begin", "end", "r", "omega",
                                       "h"]):
        print(f"# {start['name']}")
        for line in trajectory(given, start):
            print(line)
        print("\n")


if __name__ == "__main__":
    read.run_script(main)
