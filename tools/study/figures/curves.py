#!/usr/bin/python3 -B
"""Curves that a figure picks out of its data: curves.py FIGURE FOLDER.

Each is written behind a line `# NAME` and before two empty lines, so that
gnuplot finds it by `index 'NAME'`; an empty line within it is a gap. FOLDER has
the data, whose columns are read by name.
"""
from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import Callable, Iterable, Iterator

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

Curves = Iterator[tuple[str, list[str]]]
PATH = ("t", "r", "omega", "h", "g", "mode")
KINDS = ("random", "noise", "smoothing", "hysteresis", "delay")


def picked(rows: Iterable[read.Row], *columns: str) -> list[str]:
    """Some columns of some rows, as they are written in the data."""
    return [" ".join(row[column] for column in columns) for row in rows]


def side(row: read.Row, column: str) -> int:
    """The sign of h in a slip."""
    return 1 if row[column] == "slip+" else -1


def trajectories(path: Path) -> Iterator[tuple[str, list[read.Row]]]:
    """Name and rows of each trajectory that paths.py has written."""
    for block in path.read_text(encoding="utf-8").split("\n\n\n"):
        name, *lines = block.strip().splitlines() or [""]
        if lines:
            yield name[2:], [read.Row(f"{path}: {name}", PATH, line.split())
                             for line in lines]


def exits(folder: Path) -> Curves:
    """When, where and in which phase trajectories leave."""
    rows = read.read_csv(str(folder / "exits-random.csv"), counted=True)
    times = sorted(rows, key=lambda row: row.number("time"))
    yield "when", [f"{row['time']} {i / len(times):.6g}"
                   for i, row in enumerate(times, 1) if i % 20 == 1]
    yield "where", [f"{row['time']} {row['r']} {side(row, 'side')}"
                    for row in rows[8::10]]
    passed = [row for row in rows if row["phase"] != ""]
    yield "phase", [f"{row['time']} {row['phase']} {side(row, 'side')}"
                    for row in passed]
    bins = [int(row.number("phase") * 10) for row in passed]
    shares = [bins.count(i) / len(bins) for i in range(10)]
    yield "bins", [
        f"{i / 10 + 0.05:.6g} {p:.6g} "
        f"{1.96 * math.sqrt(p * (1 - p) / len(bins)):.6g}"
        for i, p in enumerate(shares)]
    branches = read.read_csv(str(folder / "branches.csv"))
    yield "stick", picked((row for row in branches if row["mode"] == "slip+"),
                          "stick_time", "exit_r")


def regions(folder: Path) -> Curves:
    """Where the stick from the two-fold ends."""
    rows = read.read_csv(str(folder / "branches.csv"))
    yield "stick", picked((row for row in rows if row["mode"] == "slip+"),
                          "exit_r", "exit_omega")


def normal(folder: Path) -> Curves:
    """The stick from the two-fold up to its last exit that is drawn."""
    rows = read.read_csv(str(folder / "branches.csv"))
    yield "stick", picked(rows[:1], "r", "omega") + picked(
        (row for row in rows if row.number("stick_time") <= 0.28),
        "exit_r", "exit_omega")


def perturbations(folder: Path) -> Curves:
    """Of each kind the quantiles of exits, landings and returns."""
    for kind in KINDS:
        came = read.read_csv(str(folder / f"returns-{kind}.csv"),
                             counted=True)
        left = read.read_csv(str(folder / f"exits-{kind}.csv"),
                             counted=True)
        returned = [row for row in came if row["outcome"] == "returned"]
        for name, rows, column in (("exit", left, "time"),
                                   ("landing", came, "landing_r"),
                                   ("return", returned, "time")):
            texts = sorted((row[column] for row in rows
                            if row[column] and row.number(column) > 0),
                           key=float)
            yield f"{name} {kind}", quantiles(texts, len(came))


def quantiles(texts: list[str], n: int) -> list[str]:
    """100 steps at most, from share 0 on; the shares are of n."""
    if not texts:
        return []
    step = len(texts) // 100 + 1
    return [f"{texts[0]} 0"] + [f"{texts[i - 1]} {i / n:.6g}" for i in [
        *range(step, len(texts) + 1, step), len(texts)]]


def returns(folder: Path) -> Curves:
    """From an exit to the first landing, and from there to the two-fold."""
    left = read.read_csv(str(folder / "exits-random.csv"), counted=True)
    came = read.read_csv(str(folder / "returns-random.csv"), counted=True)
    yield "sampled", [
        f"{exit_['time']} {back['landing_r']} {back['time']} {back['landings']}"
        for exit_, back in list(zip(left, came))[3::5] if back["landing_r"]]
    branches = read.read_csv(str(folder / "branches.csv"))
    yield "branches", [
        f"{row['stick_time']} {side(row, 'mode')} {row['end_r']}"
        for row in branches if row["end"] == "codim2"]
    # Where the stick from the two-fold comes to rest if it never ends.
    yield "rest", picked([row for row in branches if row["mode"] == "slip+"],
                         "exit_r")[-1:]


def motions(folder: Path) -> Curves:
    """The trajectories of the set by mode, each with the row it ends in."""
    paths = list(trajectories(folder / "set.dat"))
    for mode in "1234":
        lines = []
        for _, rows in paths:
            last = None
            for row in rows:
                if mode in (row["mode"], last):
                    lines.append(f"{row['r']} {row['omega']} "
                                 f"{row.number('h') * 1e6:.6g}")
                if last == mode != row["mode"]:
                    lines.append("")
                last = row["mode"]
            lines.append("")
        yield f"mode {mode}", lines


def surface(folder: Path) -> Curves:
    """Trajectories near h = 0, on either side of it; those that cross whole."""
    paths = list(trajectories(folder / "fans.dat"))
    for what, sign in (("crossing", 0), ("crossing", -1), ("sliding", 1),
                       ("sliding", -1), ("escaping", 1), ("escaping", -1)):
        lines = []
        for name, rows in paths:
            if name == what:
                lines += [f"{row['t']} {row['h']}" if sign == 0 or
                          sign * row.number("h") > 1e-11 else ""
                          for row in rows] + [""]
        yield f"{what} {sign}", lines


FIGURES: dict[str, Callable[[Path], Curves]] = {
    "exits": exits, "normal": normal, "perturbations": perturbations,
    "regions": regions, "return": returns, "set": motions, "surface": surface}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figure", choices=FIGURES)
    parser.add_argument("folder", type=Path)
    given = parser.parse_args()
    for name, lines in FIGURES[given.figure](given.folder):
        gap = ""
        print(f"# {name}")
        for line in lines:  # two gaps in a row would end the curve
            if line or gap:
                print(line)
            gap = line
        print("\n")


if __name__ == "__main__":
    read.run_script(main)
