"""What the search and the longest ways say of the cost of each function."""
from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path
from typing import Iterable, NamedTuple, Optional

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
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


def read_ways(path: str) -> dict[str, Optional[int]]:
    """The longest ways, lines "name way"; None: no bound."""
    return {row["name"]: None if row["way"] == "-" else row.count("way")
            for row in read.read_words(path, ["name", "way"])}


def most(calls: Iterable[Call]) -> dict[str, dict[int, int]]:
    """The largest count of each function, by units."""
    found: dict[str, dict[int, int]] = defaultdict(dict)
    for call in calls:
        of = found[call.name]
        of[call.units] = max(call.count, of.get(call.units, 0))
    return found
