#!/usr/bin/python3 -B
"""Figures of the rows "Cost", as lines "name Cost A B W V": found by search at
most A + B units, by the longest way W + V units, 0 where that is not known.

They are two leading digits rounded up, so that a search which finds a little
more does not break a row. Where the longest way is hardly longer than what was
found, A is that: no input whatever takes more.
"""
from __future__ import annotations

import argparse
from typing import Optional

from costs import Way, longer, most, read_found, read_ways
from tables import read  # costs sets its path

SLACK = 1.25  # what a row may say of what was found


def up(number: int) -> int:
    """Two leading digits, rounded up."""
    unit = 1
    while number > 100 * unit:
        unit *= 10
    return -(-number // unit) * unit


def constant(found: int, way: Optional[Way]) -> str:
    """The row of a function whose cost depends on no number of units."""
    cost, longest = up(found), way.first if way else 0
    if found <= longest <= SLACK * found:
        cost = up(longest) if up(longest) <= SLACK * found else longest
    return f"Cost {cost} 0"


def linear(found: dict[int, int]) -> str:
    """The row of a function whose cost grows with the units."""
    last = max(found)
    slope = up(-(-(found[last] - found[0]) // last))
    first = max(0, *(count - slope * units for units, count in found.items()))
    return f"Cost {up(first)} {slope}"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    for real in "double", "float":
        parser.add_argument(f"ways_{real}", help=f"longest ways of {real}")
        parser.add_argument(real, help=f"what was found in {real}")
    given = parser.parse_args()
    double, single = read_ways(given.ways_double), read_ways(given.ways_float)
    calls = read_found(given.double) + read_found(given.float)
    for name, found in most(calls).items():
        if 0 not in found:
            raise read.TableError(f"{name}: was not called with 0 units")
        way = longer(double.get(name), single.get(name))
        print(name, linear(found) if max(found) > 0
              else constant(found[0], way), *map(up, way or Way(0, 0)))


if __name__ == "__main__":
    read.run_script(main)
