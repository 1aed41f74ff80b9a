#!/usr/bin/python3 -B
"""Writes the tables of worst costs and stacks.

WORK is what tools/verify/cost/run left, CHECK what check `stack` did.
"""
from __future__ import annotations

import argparse
import textwrap
from collections import defaultdict
from pathlib import Path
from typing import Iterable

from costs import most, read_found, read_reasons, read_ways
from headers import read_figures
from tables import markdown, read

REALS = "double", "float"
SHOWN = "step", "step_compensated", "step_located"


def instructions(work: Path) -> str:
    """A table of the worst costs, of the most units that were tried."""
    ways = [read_ways(str(work / f"ways.{real}")) for real in REALS]
    figures = read_figures(str(work / "figures"))
    found = [most(read_found(str(work / f"worst.{real}"))) for real in REALS]
    rows = []
    for name in found[0]:
        units = max(found[0][name])
        cells: list[object] = [f"`{name}`", f"n = {units}" if units else ""]
        for counts, way in zip(found, ways):
            count, longest = counts[name].get(units), way.get(name)
            met = " (met)" if longest and longest.of(units) == count else ""
            cells += [count or "-", f"{longest or '-'}{met}"]
        row = "-"
        if (name, "Cost") in figures:
            first, slope, *_ = figures[name, "Cost"]
            row = first if slope == "0" else f"{first} + {slope} n"
        rows.append([*cells, row])
    return markdown.table(["function", "of", "double", "longest way", "float",
                           "longest way", "row"], rows, right=range(2, 7))


def unknown(work: Path) -> Iterable[str]:
    """Why functions have no longest way, a line a reason."""
    public = most(read_found(str(work / "worst.double")))
    reasons = defaultdict(list)
    for name, why in read_reasons(str(work / "ways.double")).items():
        if name in public:
            reasons[why].append(f"`{name}`")
    for why, names in reasons.items():
        yield textwrap.fill(f"* {why}: {', '.join(names)}", 80,
                            subsequent_indent="  ", break_long_words=False,
                            break_on_hyphens=False)


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
    """The calls that cost most, as `cost show` prints them."""
    for real in REALS:
        for name in SHOWN:
            yield f"\n### The most expensive tf_{name} in {real}\n"
            told = (work / f"{name}.{real}").read_text(encoding="utf-8")
            yield from (f"    {line}" for line in told.splitlines())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("work", type=Path, help="folder of tools/verify/cost/run")
    parser.add_argument("check", type=Path, help="folder of check `stack`")
    given = parser.parse_args()
    preface = Path(__file__).with_name("preface.md")
    print(preface.read_text(encoding="utf-8"))
    print("## Instructions\n")
    print(instructions(given.work))
    print("\nNo longest way:\n")
    for line in unknown(given.work):
        print(line)
    for line in most_expensive(given.work):
        print(line)
    print("\n## Stack\n\nWorst of double and float, in bytes.\n")
    print(stacks(given.check))


if __name__ == "__main__":
    read.run_script(main)
