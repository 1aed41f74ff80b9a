#!/usr/bin/python3 -B
"""Rows of all rounds into a CSV file with their median times, and a table.

ROWS are lines `problem,peer,setting,steps,error,ns,branch`; what is none is
left out. The table has for each problem and peer the least time at which an
error is reached and kept at every finer setting of the sweep. Where a peer has
two settings (width of a smoothed law, then step or tolerance), the best width
counts, with the steps or tolerances at that width. Fewer than three settings
in a row are luck. The first line of the CSV file says what was measured.
"""
from __future__ import annotations

import argparse
import math
import statistics
import sys
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

COLUMNS = "problem", "peer", "setting", "steps", "error", "ns", "branch"
LEVELS = 1e-3, 1e-6, 1e-9


class Setting(NamedTuple):
    """A peer at one setting, with the median of its times."""
    row: read.Row
    ns: float

    @property
    def width(self) -> str:
        """The first of two settings, if there are two."""
        words = self.row["setting"].split()
        return words[0] if len(words) > 1 else ""

    @property
    def value(self) -> float:
        """The step or tolerance."""
        text = self.row["setting"].split()[-1].split("=")[-1]
        try:
            return float(text)
        except ValueError:
            raise read.TableError(f"{self.row.where}: column 'setting' ends "
                                  f"in '{text}', not a number") from None


def read_rounds(path: str) -> list[Setting]:
    """All settings, in the order in which they were met first."""
    rows: dict[tuple[str, str, str], list[read.Row]] = defaultdict(list)
    for line in read.read_words(path, ["line"], "\n"):
        fields = line["line"].split(",")
        if len(fields) == len(COLUMNS):
            row = read.Row(line.where, COLUMNS, fields)
            rows[row["problem"], row["peer"], row["setting"]].append(row)
    return [Setting(of[0], statistics.median(row.number("ns") for row in of))
            for of in rows.values()]


def write_csv(path: str, stamp: str, settings: list[Setting]) -> None:
    """All settings with their median times."""
    with open(path, "w", encoding="utf-8") as file:
        print(f"# {stamp}", ",".join(COLUMNS), sep="\n", file=file)
        for row, ns in settings:
            print(*(row[column] for column in COLUMNS[:5]), f"{ns:.0f}",
                  row["branch"], sep=",", file=file)


def kept(series: list[Setting], error: float) -> float:
    """The least time to keep an error, infinity where it is not kept."""
    times = []
    for setting in sorted(series, key=lambda one: one.value):
        if not setting.row.number("error") <= error:
            break
        times.append(setting.ns)
    return min(times) if len(times) >= 3 else math.inf


def shown(ns: float) -> str:
    """A time as it is read."""
    if ns == math.inf:
        return "never"
    for limit, unit, size in ((1e6, "us", 1e3), (1e9, "ms", 1e6)):
        if ns < limit:
            return f"{ns / size:.3g} {unit}"
    return f"{ns / 1e9:.3g} s"


def line(settings: list[Setting]) -> str:
    """A peer on a problem."""
    widths: dict[str, list[Setting]] = defaultdict(list)
    for setting in settings:
        widths[setting.width].append(setting)
    times = [shown(min(kept(series, level) for series in widths.values()))
             for level in LEVELS]
    wrong = sum(setting.row["branch"] == "0" for setting in settings)
    row = settings[0].row
    return (f"{row['problem']:<10} {row['peer']:<15}"
            + "".join(f" {time:>10}" for time in times)
            + f"  {len(settings)}, {wrong}")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--csv", required=True, help="file to write")
    parser.add_argument("--stamp", required=True, help="what was measured")
    parser.add_argument("rows", help="rows of all rounds")
    given = parser.parse_args()
    settings = read_rounds(given.rows)
    write_csv(given.csv, given.stamp, settings)
    peers: dict[str, dict[str, list[Setting]]] = defaultdict(
        lambda: defaultdict(list))
    for setting in settings:
        peers[setting.row["problem"]][setting.row["peer"]].append(setting)
    print(f"{'problem':<10} {'peer':<15} {'1e-3':>10} {'1e-6':>10} "
          f"{'1e-9':>10}  settings, of them wrong branch or failed")
    for of in peers.values():
        for one in of.values():
            print(line(one))


if __name__ == "__main__":
    read.run_script(main)
