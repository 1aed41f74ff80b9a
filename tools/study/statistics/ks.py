#!/usr/bin/python3 -B
"""Kolmogorov-Smirnov distance of one column of two files of `diverge`.

Prints n, m, the distance D of the two distributions, the band that D stays
below in 95 % of cases if both were one, and the probability p of a distance
as large. Empty fields are left out.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read, statistics  # noqa: E402


def column(path: str, name: str) -> list[float]:
    """The numbers of a column, of which there must be one at least."""
    values = read.numbers(read.read_csv(path, [name], counted=True), name)
    if not values:
        raise read.TableError(f"{path}: column '{name}' has no number")
    return values


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", help="file with a header, or -")
    parser.add_argument("second", help="another one")
    parser.add_argument("column", help="a name of both headers")
    given = parser.parse_args()
    found = statistics.kolmogorov_smirnov(column(given.first, given.column),
                                          column(given.second, given.column))
    print(f"n {found.n}  m {found.m}  D {found.value:.4f}  "
          f"band {found.band:.4f}  p {found.p:.3g}")


if __name__ == "__main__":
    read.run_script(main)
