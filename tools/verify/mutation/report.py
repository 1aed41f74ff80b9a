#!/usr/bin/python3 -B
"""The log of tools/verify/mutation/run as a table by file, what survived, and a sum.

"same" are changes that compile to the same bytes, "invalid" those that do not
compile. The share that is noticed has Wilson's interval.
"""
from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read, statistics  # noqa: E402

# The columns of a log; the last takes the rest of the line.
LOG = ("result", "by", "file", "number", "line", "column", "change")
RESULTS = "noticed", "survived", "same", "invalid"


def table(log: list[read.Row]) -> str:
    """Files and results, then the survivors in the order of the source."""
    count = Counter((row["file"], row["result"]) for row in log)
    lines = [f"{'file':<26}" + "".join(f" {one:>8}" for one in RESULTS)]
    for name in sorted({row["file"] for row in log}):
        lines.append(f"{name:<26}" + "".join(f" {count[name, one]:8}"
                                             for one in RESULTS))
    lines.append("")
    survived = [row for row in log if row["result"] == "survived"]
    survived.sort(key=lambda row: (row["file"], row.count("line"),
                                   row.count("column")))
    lines += [f"{row['file']}:{row['line']}:{row['column']}: {row['change']}"
              for row in survived]
    return "\n".join(lines)


def total(log: list[read.Row]) -> str:
    """How many were noticed."""
    count = Counter(row["result"] for row in log)
    tried = count["noticed"] + count["survived"]
    share = "none was tried"
    if tried:
        of = statistics.wilson(count["noticed"], tried)
        share = "{:.1f} % (95 % interval {:.1f} to {:.1f})".format(
            *(100 * x for x in of))
    return (f"{count['noticed']} of {tried} changes noticed: {share}; "
            f"{count['same']} compile to the same, {count['invalid']} not at "
            "all")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", required=True, help="of the order")
    parser.add_argument("--all", required=True, help="list of all changes")
    parser.add_argument("--excused", required=True,
                        help="list of those without effect")
    parser.add_argument("log", help="what tools/verify/mutation/run has written")
    given = parser.parse_args()
    log = read.read_words(given.log, LOG)
    of_all, excused = (len(read.read_words(path, ["change"]))
                       for path in (given.all, given.excused))
    print(table(log))
    print(total(log))
    print(f"seed {given.seed}, of {of_all} changes in all, {excused} of them "
          "excused")


if __name__ == "__main__":
    read.run_script(main)
