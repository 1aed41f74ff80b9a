#!/usr/bin/python3 -B
"""Whether the rows "Cost" of the headers hold; prints what is wrong.

A count above A + B units breaks the promise; where the row says more than 1.25
times the most that was found at the fewest or at the most units, its figure no
longer holds: between them the worst need not lie on a line. So with W + V
units and the longest way, which no count is above. Exits with code 1 where
something is wrong.
"""
from __future__ import annotations

import argparse
from typing import Iterable, Optional

from costs import Call, Way, longer, most, read_found, read_ways
from figures import SLACK
from tables import read  # costs sets its path

Claims = dict[str, tuple[int, int, int, int]]
Ways = dict[str, Optional[Way]]


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
        first, slope, *_ = claims[call.name]
        bound = first + slope * call.units
        if call.count > bound:
            yield (f"{call.name}: its header says {bound} instructions for "
                   f"{call.units} units, it took {call.count} ({call.genes})")


def above_way(ways: Ways, calls: Iterable[Call]) -> Iterable[str]:
    """Calls that take more than the longest way has."""
    for call in calls:
        way = ways.get(call.name)
        if way and call.count > way.of(call.units):
            yield (f"{call.name}: took {call.count}, its longest way has "
                   f"{way.of(call.units)} ({call.genes})")


def too_much(claims: Claims, ways: Ways,
             calls: Iterable[Call]) -> Iterable[str]:
    """Rows that say more than was found."""
    found = most(calls)
    for name, (first, slope, *claimed) in claims.items():
        if name not in found:
            yield f"{name}: tools/verify/cost does not call it"
            continue
        said, way = Way(*claimed), ways.get(name) or Way(0, 0)
        for units in {min(found[name]), max(found[name])}:
            longest = way.of(units)
            if any(claimed) and \
                    not longest <= said.of(units) <= SLACK * longest:
                yield (f"{name}: its header says {said.of(units)} by the "
                       f"longest way, which has {longest}")
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
    for real in "double", "float":
        parser.add_argument(f"ways_{real}", help=f"longest ways of {real}")
        parser.add_argument(real, help=f"what was found in {real}")
    given = parser.parse_args()
    claims = read_claims(given.claims)
    ways = read_ways(given.ways_double), read_ways(given.ways_float)
    double, single = read_found(given.double), read_found(given.float)
    both = {name: longer(way, ways[1].get(name))
            for name, way in ways[0].items()}
    wrong = [*above_way(ways[0], double), *above_way(ways[1], single),
             *above(claims, double + single),
             *too_much(claims, both, double + single)]
    for text in wrong:
        print(text)
    return int(bool(wrong))


if __name__ == "__main__":
    read.run_script(main)
