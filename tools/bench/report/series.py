"""Settings of a scheme over one dial, and what the tables ask of them."""
from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Iterable, NamedTuple, Sequence

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402


class Setting(NamedTuple):
    """One run: its dial, errors and time [ns]; `mark` as `sweep` writes it."""
    dial: float
    step: float
    error: float
    worst: float
    event: float
    drift: float
    ns: float
    mark: str


class Series(NamedTuple):
    """A scheme in one real type on a part, over one dial, coarse to fine."""
    part: str
    scheme: str
    real: str
    dial: str
    settings: list[Setting]


def read_sweep(path: str) -> list[Series]:
    """All series, in the order of the file."""
    found: dict[tuple[str, str, str, str], Series] = {}
    for row in read.read_csv(path):
        key = row["part"], row["scheme"], row["real"], row["dial"]
        series = found.setdefault(key, Series(*key, []))
        step = row.number("dt")
        dial = step
        if row["dial"].startswith("tolerance"):
            dial = row.number("tolerance")
        series.settings.append(Setting(
            dial, step, row.number("final"), row.number("worst"),
            row.number("event"), row.number("drift"), row.number("ns"),
            row["mark"]))
    return list(found.values())


def least_time(runs: Sequence[tuple[float, float]], error: float) -> float:
    """The least time of a run that keeps an error, infinity where none does.

    runs: (time, error), coarse to fine. The next two finer ones keep it too,
    one at least, so that no lucky setting counts.
    """
    best = math.inf
    for i, (time, _) in enumerate(runs[:-1]):
        if time < best and all(e <= error for _, e in runs[i:i + 3]):
            best = time
    return best


def timed(settings: Iterable[Setting]) -> list[tuple[float, float]]:
    """Times and errors of settings, for least_time."""
    return [(setting.ns, setting.error) for setting in settings]
