#!/usr/bin/python3 -B
"""Writes the tables of worst costs and stacks.

WORK is what tools/cost/run left, CHECK what check `stack` did.
"""
from __future__ import annotations

import argparse
from pathlib import Path
from typing import Iterable

from costs import most, read_found, read_ways
from headers import read_figures
from tables import markdown, read

SHOWN = "step", "step_compensated", "step_located"


def instructions(work: Path) -> str:
    """A table of the worst costs, of the most units that were tried."""
    ways = read_ways(str(work / "ways.double"))
    figures = read_figures(str(work / "figures"))
    double = most(read_found(str(work / "worst.double")))
    single = most(read_found(str(work / "worst.float")))
    rows = []
    for name, counts in double.items():
        units = max(counts)
        way = str(ways.get(name) or "-")
        if way == str(counts[units]):
            way += " (met)"
        row = "-"
        if (name, "Cost") in figures:
            first, slope, _ = figures[name, "Cost"]
            row = first if slope == "0" else f"{first} + {slope} n"
        rows.append([f"`{name}`", f"n = {units}" if units else "",
                     counts[units], single[name].get(units, "-"), way, row])
    return markdown.table(["function", "of", "double", "float", "longest way",
                           "row"], rows, right=range(2, 6))


def stacks(check: Path) -> str:
    """A table of the worst stacks, a column a target."""
    row = {one["name"]: one["rounded"] for one in
           read.read_words(str(check / "stack.worst"),
                           ["name", "claimed", "worst", "rounded", "where"])}
    table = read.read_words(str(check / "stack.table"),
                            ["name", "target", "real", "bytes"])
    targets = list(dict.fromkeys(one["target"] for one in table))
    worst: dict[tuple[str, str], int] = {}
    for one in table:
        key = one["name"], one["target"]
        worst[key] = max(one.count("bytes"), worst.get(key, 0))
    names = sorted({one["name"] for one in table}, key=lambda n: f"`{n}`")
    return markdown.table(
        ["function", *targets, "row"],
        [[f"`{name}`", *(worst.get((name, target), "")
                         for target in targets), row.get(name, "")]
         for name in names], right=range(1, len(targets) + 2))


def most_expensive(work: Path) -> Iterable[str]:
    """The calls that cost most, as `cost show` tells them."""
    for real in "double", "float":
        for name in SHOWN:
            yield f"\n### The most expensive tf_{name} in {real}\n"
            told = (work / f"{name}.{real}").read_text(encoding="utf-8")
            yield from (f"    {line}" for line in told.splitlines())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("work", type=Path, help="folder of tools/cost/run")
    parser.add_argument("check", type=Path, help="folder of check `stack`")
    given = parser.parse_args()
    preface = Path(__file__).with_name("preface.md")
    print(preface.read_text(encoding="utf-8"))
    print("## Instructions\n")
    print(instructions(given.work))
    for line in most_expensive(given.work):
        print(line)
    print("\n## Stack\n\nWorst of double and float, in bytes.\n")
    print(stacks(given.check))


if __name__ == "__main__":
    read.run_script(main)
