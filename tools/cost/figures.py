#!/usr/bin/python3 -B
"""Figures of the rows "Cost", as lines "name Cost A B W".

They are two leading digits rounded up, so that a search which finds a little
more does not break a row. Where the longest way is hardly longer than what was
found, A is that: no input whatever takes more.
"""
from __future__ import annotations

import argparse
from typing import Optional

from costs import most, read_found, read_ways
from tables import read  # costs has told where

SLACK = 1.25  # what a row may say of what was found


def up(number: int) -> int:
    """Two leading digits, rounded up."""
    unit = 1
    while number > 100 * unit:
        unit *= 10
    return -(-number // unit) * unit


def constant(found: int, way: Optional[int]) -> str:
    """The row of a function whose cost depends on no number of units."""
    cost = up(found)
    if way is not None and found <= way <= SLACK * found:
        cost = up(way) if up(way) <= SLACK * found else way
    return f"Cost {cost} 0 {up(way or 0)}"


def linear(found: dict[int, int]) -> str:
    """The row of a function whose cost grows with the units."""
    last = max(found)
    slope = up(-(-(found[last] - found[0]) // last))
    first = max(0, *(count - slope * units for units, count in found.items()))
    return f"Cost {up(first)} {slope} 0"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ways", help="longest ways of double")
    parser.add_argument("found", nargs="+", help="what a search has found")
    given = parser.parse_args()
    ways = read_ways(given.ways)
    calls = [call for path in given.found for call in read_found(path)]
    for name, found in most(calls).items():
        if 0 not in found:
            raise read.TableError(f"{name}: was not called with 0 units")
        print(name, linear(found) if max(found) > 0
              else constant(found[0], ways.get(name)))


if __name__ == "__main__":
    read.run_script(main)
