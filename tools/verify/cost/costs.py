"""What the search and the longest ways say of the cost of each function."""
from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path
from typing import Iterable, NamedTuple, Optional

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402


class Call(NamedTuple):
    """A call that the search found: of so many units, with these genes."""
    name: str
    units: int
    count: int
    genes: str


def read_found(path: str) -> list[Call]:
    """What a search has found, lines "name units count genes"."""
    return [Call(row["name"], row.count("units"), row.count("count"),
                 row["genes"])
            for row in read.read_words(path, ["name", "units", "count",
                                              "genes"])]


class Way(NamedTuple):
    """The longest way: so many instructions, and so many more a unit."""
    first: int
    slope: int

    def of(self, units: int) -> int:
        """The most that a call of so many units takes."""
        return self.first + self.slope * units

    def __str__(self) -> str:
        return str(self.first) + (f" + {self.slope} n" if self.slope else "")


def read_ways(path: str) -> dict[str, Optional[Way]]:
    """The longest ways, lines "name A B"; None: no bound, "name - why"."""
    return {row["name"]: None if row["way"].startswith("-")
            else Way(*map(int, row["way"].split()))
            for row in read.read_words(path, ["name", "way"])}


def read_reasons(path: str) -> dict[str, str]:
    """Why there is no longest way, of those that have none."""
    return {row["name"]: row["way"][2:]
            for row in read.read_words(path, ["name", "way"])
            if row["way"].startswith("-")}


def longer(a: Optional[Way], b: Optional[Way]) -> Optional[Way]:
    """A way that is as long as both; None where one is not known."""
    return Way(*map(max, a, b)) if a and b else None


def most(calls: Iterable[Call]) -> dict[str, dict[int, int]]:
    """The largest count of each function, by units."""
    found: dict[str, dict[int, int]] = defaultdict(dict)
    for call in calls:
        of = found[call.name]
        of[call.units] = max(call.count, of.get(call.units, 0))
    return found
