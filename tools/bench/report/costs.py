"""Median, 99 % and largest cost of the steps of each run."""
from __future__ import annotations

from collections import defaultdict
from typing import Iterable, Sequence

import numpy as np

from tables import read

KEY = "real", "scheme", "build", "part", "steps"
COLUMNS = ("unit", *KEY, "n", "median", "p99", "max")


def rows(path: str, unit: str) -> Iterable[Sequence[object]]:
    """The rows, from lines "REAL SCHEME BUILD PART STEPS step cost"."""
    runs: dict[tuple[str, ...], list[float]] = defaultdict(list)
    for row in read.read_words(path, [*KEY, "step", "cost"]):
        runs[tuple(row[name] for name in KEY)].append(row.number("cost"))
    for key in sorted(runs):
        costs = runs[key]
        figures = np.quantile(costs, [0.5, 0.99, 1], method="inverted_cdf")
        yield [unit, *key, len(costs), *(f"{x:.5g}" for x in figures)]
