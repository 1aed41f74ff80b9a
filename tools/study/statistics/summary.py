#!/usr/bin/python3 -B
"""What the files of `diverge` say, with 95 % confidence intervals.

Shares have Wilson's interval. Samples that follow one another from the
two-fold are independent under --by random, which starts afresh there; the
perturbations without a draw are not, so judge those by --cycles 1. An end of
an interval is - where the samples are too few to tell.
"""
from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import markdown, read, statistics  # noqa: E402

RETURNED = "returned"


def share(k: int, n: int) -> str:
    """A share with its interval, `-` where nothing was counted."""
    if n == 0:
        return "-"
    return "{:.5f} [{:.5f}, {:.5f}]".format(*statistics.wilson(k, n))


def print_outcomes(rows: list[read.Row]) -> None:
    """Outcomes, and how many samples have come so far."""
    begun = Counter(row.count("cycle") for row in rows)
    lived = Counter(row.count("cycle") for row in rows
                    if row["outcome"] == RETURNED)
    windings = sum(read.numbers(rows, "windings"))
    print(f"samples {begun[1]}, cycles {len(rows)}, "
          f"windings a cycle {windings / len(rows):.3f}")
    for name, n in sorted(Counter(row["outcome"] for row in rows).items()):
        print(f"outcome {name:<12} {n:8}  share {share(n, len(rows))}")
    print("survival: cycle, samples that began it, "
          "share of these that returned")
    cycle = 1
    while cycle <= max(begun):
        print(f"  {cycle:6} {begun[cycle]:8}  "
              f"{share(lived[cycle], begun[cycle])}")
        cycle *= 2


def print_quantiles(title: str, values: list[float]) -> None:
    """Mean and quantiles of a column."""
    if len(values) < 2:
        return
    print(f"{title}: mean {markdown.estimate(*statistics.mean(values), 6)}")
    for p in 0.1, 0.5, 0.9, 0.99:
        found = markdown.estimate(*statistics.quantile(values, p), 6)
        print(f"  {100 * p:4.0f} %  {found}")


def print_exits(rows: list[read.Row]) -> None:
    """Sides, releases and the phases at the section."""
    sides = Counter(row["side"] for row in rows)
    released = sum(row["how"] == "released" for row in rows)
    print(f"exits {len(rows)}, slip+ share {share(sides['slip+'], len(rows))}")
    print(f"released by |lambda| = mu: share {share(released, len(rows))}")
    bins = phase_bins(rows)
    n = sum(bins)
    if n == 0:
        return
    print(f"phase at the section [windings], share of {n}")
    for i, k in enumerate(bins):
        print(f"  {i / 10:.1f}-{(i + 1) / 10:.1f}  {share(k, n)}")
    print(f"chi^2 against even: {statistics.chi_square_even(bins):.2f} at 9 "
          f"degrees ({statistics.chi_square_limit(9):.2f} at 5 %)")


def phase_bins(rows: list[read.Row]) -> list[int]:
    """How many phases there are in each tenth of a winding."""
    bins = [0] * 10
    for phase in read.numbers(rows, "phase"):
        bins[int(phase * 10) % 10] += 1
    return bins


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("returns", help="file of --returns, or -")
    parser.add_argument("exits", nargs="?", help="file of --exits")
    given = parser.parse_args()
    rows = read.read_csv(given.returns,
                         ["cycle", "outcome", "time", "landing_r", "windings"],
                         counted=True)
    if not rows:
        raise read.TableError(f"{given.returns}: no cycle")
    exits = read.read_csv(given.exits, ["side", "phase", "how"],
                          counted=True) if given.exits else None
    print_outcomes(rows)
    back = [row for row in rows if row["outcome"] == RETURNED]
    print_quantiles("time from exit to return [s]", read.numbers(back, "time"))
    print_quantiles("place of landing r [m]", read.numbers(back, "landing_r"))
    if exits is not None:
        print_exits(exits)


if __name__ == "__main__":
    read.run_script(main)
