#!/usr/bin/python3 -B
"""Whether the rows "Cost" of the headers hold; prints what is wrong.

A count above A + B units breaks the promise; where the row says more than 1.25
times the most that was found at the fewest or at the most units, its figure no
longer holds: between them the worst need not lie on a line. So with W and the
longest way, which no count of double is above. Exits with code 1 where
something is wrong.
"""
from __future__ import annotations

import argparse
from typing import Iterable, Optional

from costs import Call, most, read_found, read_ways
from figures import SLACK
from tables import read  # costs has told where

Claims = dict[str, tuple[int, int, int]]


def read_claims(path: str) -> Claims:
    """What `headers.py claims` prints; what has no row is left out."""
    rows = read.read_words(path, ["name", "figures"])
    return {row["name"]: tuple(map(int, row["figures"].split()))
            for row in rows if row["figures"] != "none"}


def above(claims: Claims, calls: Iterable[Call]) -> Iterable[str]:
    """Calls that take more than their header says."""
    for call in calls:
        if call.name not in claims:
            yield f"{call.name}: no row of a header has its cost"
            continue
        first, slope, _ = claims[call.name]
        bound = first + slope * call.units
        if call.count > bound:
            yield (f"{call.name}: its header says {bound} instructions for "
                   f"{call.units} units, it took {call.count} ({call.genes})")


def above_way(ways: dict[str, Optional[int]],
              calls: Iterable[Call]) -> Iterable[str]:
    """Calls that take more than the longest way has."""
    for call in calls:
        way = ways.get(call.name)
        if way is not None and call.count > way:
            yield (f"{call.name}: took {call.count}, its longest way has "
                   f"{way}")


def too_much(claims: Claims, ways: dict[str, Optional[int]],
             calls: Iterable[Call]) -> Iterable[str]:
    """Rows that say more than was found."""
    found = most(calls)
    for name, (first, slope, claimed) in claims.items():
        if name not in found:
            yield f"{name}: tools/cost does not call it"
            continue
        way = ways.get(name) or 0
        if claimed > 0 and not way <= claimed <= SLACK * way:
            yield (f"{name}: its header says that no way has more than "
                   f"{claimed} instructions, the longest has {way}")
        for units in {min(found[name]), max(found[name])}:
            count = found[name][units]
            bound = first + slope * units
            if bound > SLACK * count:
                yield (f"{name}: its header says {bound} instructions for "
                       f"{units} units, {count} is the most that was found")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("claims", help="what the headers say")
    parser.add_argument("ways", help="longest ways of double")
    parser.add_argument("double", help="what was found in double")
    parser.add_argument("float", help="what was found in float")
    given = parser.parse_args()
    claims, ways = read_claims(given.claims), read_ways(given.ways)
    double, single = read_found(given.double), read_found(given.float)
    wrong = [*above_way(ways, double), *above(claims, double + single),
             *too_much(claims, ways, double + single)]
    for text in wrong:
        print(text)
    return int(bool(wrong))


if __name__ == "__main__":
    read.run_script(main)
