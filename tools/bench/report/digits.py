"""Errors of runs with compensated and plain steps, in both real types.

They are against the reference run in double:
  scheme         the compensated step in double: its own error, no rounding
  double plain, float plain, float compensated
then ratio = float compensated / scheme, the ulp of float at the largest of r, v
and w at the end, and what that says. Where a float cannot tell the ends of the
two runs apart, the ratio says nothing.
"""
from __future__ import annotations

import math
from typing import Iterable, Sequence

from tables import read

COLUMNS = ("run", "dt", "scheme", "double plain", "float plain",
           "float compensated", "ratio", "ulp", "verdict")
State = tuple[float, ...]


def distance(a: State, b: State) -> float:
    """The largest difference of r, v and w."""
    return max(abs(x - y) for x, y in zip(a, b))


def float_ulp(state: State) -> float:
    """What a float resolves at the largest of the numbers."""
    largest = max(map(abs, state))
    return math.ldexp(1.0, math.frexp(largest)[1] - 24)


def judge(error: float, scheme: float, ulp: float) -> str:
    """What the error of the compensated step in float says."""
    if error <= 3 * scheme:
        return "within 3"
    return "below one ulp of a float" if error <= ulp else "not reached"


def line(ends: dict[tuple[str, str, str, str], State],
         references: dict[str, State], run: str, dt: str) -> list[str]:
    """One run with one step."""
    reference = references[run]
    scheme, *others = (distance(ends[run, dt, real, way], reference)
                       for real, way in (("double", "compensated"),
                                         ("double", "plain"),
                                         ("float", "plain"),
                                         ("float", "compensated")))
    kept, ulp = others[-1], float_ulp(reference)
    return [run, dt, *(f"{error:.2e}" for error in (scheme, *others)),
            f"{kept / scheme:.3g}" if scheme > 0 else "-", f"{ulp:.1e}",
            judge(kept, scheme, ulp)]


def rows(path: str) -> Iterable[Sequence[str]]:
    """The rows, from lines `run dt real scheme r v w`."""
    ends: dict[tuple[str, str, str, str], State] = {}
    references: dict[str, State] = {}
    for row in read.read_words(path, ["run", "dt", "real", "way", "r", "v",
                                      "w"]):
        state = tuple(row.number(name) for name in "rvw")
        if row["way"] == "reference":
            references[row["run"]] = state
        else:
            ends[row["run"], row["dt"], row["real"], row["way"]] = state
    for run, dt in dict.fromkeys(key[:2] for key in ends):
        yield line(ends, references, run, dt)
