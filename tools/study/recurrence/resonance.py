"""Whether machines whose ratio of eigenvalues is near a whole number return
more or less often than those beside them.

The share of machines that are lasting, and of those that return at all, within
NEAR of each whole number against those between NEAR and BESIDE from it, on both
sides, so that a trend cancels: by Fisher's exact test, and for all whole
numbers together by that of Cochran, Mantel and Haenszel. All tests of the page
are corrected as one (Bonferroni).
"""
from __future__ import annotations

import math
from typing import Callable, NamedTuple, Sequence

import numpy as np
from scipy import stats

import machines
from tables import markdown, read, statistics

WHOLE = range(3, 11)
NEAR, BESIDE = 0.05, 0.25
LEVEL = 0.05
ENOUGH = 100  # machines near a whole number, to speak of a bound
BINS = np.arange(2, 10.001, 0.1)  # of the picture
WHAT = {"lasting": ("lasting",), "returns at all": ("lasting", "partly")}
ClassOf = Callable[[read.Row, str], str]


class Count(NamedTuple):
    """k of n near a whole number, and beside it."""
    near: int
    of_near: int
    beside: int
    of_beside: int


def count(rows: Sequence[tuple[float, bool]], whole: int) -> Count:
    """rows: ratio, and whether it is one of those that are counted."""
    near = [hit for ratio, hit in rows if abs(ratio - whole) < NEAR]
    beside = [hit for ratio, hit in rows
              if NEAR <= abs(ratio - whole) < BESIDE]
    return Count(sum(near), len(near), sum(beside), len(beside))


def fisher(one: Count) -> float:
    """The p-value of a table."""
    return float(stats.fisher_exact(
        [[one.near, one.of_near - one.near],
         [one.beside, one.of_beside - one.beside]])[1])


def together(found: Sequence[Count]) -> float:
    """The p-value of Cochran, Mantel and Haenszel over tables."""
    above, variance = 0.0, 0.0
    for one in found:
        n, k = one.of_near + one.of_beside, one.near + one.beside
        if n > 1:
            above += one.near - one.of_near * k / n
            variance += one.of_near * one.of_beside * k * (n - k) / (
                n * n * (n - 1))
    return float(stats.chi2.sf(above ** 2 / variance, 1)) if variance else 1.0


def spread(k: int, n: int) -> float:
    """The variance of a share, by Agresti and Caffo: as of one machine more of
    either kind. That of the share itself is 0 where none or all are counted."""
    p = (k + 1) / (n + 2)
    return p * (1 - p) / (n + 2)


def difference(found: Sequence[Count]) -> statistics.Estimate:
    """Share near less share beside, Mantel and Haenszel's weights, 95 %."""
    total, weights, variance = 0.0, 0.0, 0.0
    for one in found:
        if one.of_near and one.of_beside:
            weight = one.of_near * one.of_beside / (
                one.of_near + one.of_beside)
            p, q = one.near / one.of_near, one.beside / one.of_beside
            total += weight * (p - q)
            weights += weight
            variance += weight ** 2 * (spread(one.near, one.of_near) +
                                       spread(one.beside, one.of_beside))
    if not weights:
        return statistics.Estimate(math.nan, math.nan, math.nan)
    half = float(stats.norm.isf(0.025)) * math.sqrt(variance) / weights
    return statistics.Estimate(total / weights, total / weights - half,
                               total / weights + half)


def share(k: int, n: int) -> str:
    return f"{k / n:.3f} of {n}" if n else "-"


def section(rows: Sequence[read.Row], class_of: ClassOf) -> str:
    """Of the page: the tests, and what they say."""
    tables, pooled = [], []
    for name, space in machines.SPACES.items():
        here = [(row.number("ratio"), class_of(row, "random"))
                for row in rows if row["space"] == name]
        for what, classes in WHAT.items():
            found = {whole: count([(ratio, one in classes)
                                   for ratio, one in here], whole)
                     for whole in WHOLE}
            tables += [(space.title, what, str(whole), [one], fisher(one))
                       for whole, one in found.items()]
            pooled.append((space.title, what, "all", list(found.values()),
                           together(list(found.values()))))
    tests = tables + pooled
    lines = [[space, what, whole,
              share(sum(one.near for one in found),
                    sum(one.of_near for one in found)),
              share(sum(one.beside for one in found),
                    sum(one.of_beside for one in found)),
              markdown.estimate(*difference(found), 2),
              f"{min(1, len(tests) * p):.2g}"]
             for space, what, whole, found, p in
             [*pooled, *(test for test in tables
                         if test[4] * len(tests) < LEVEL)]]
    seen = [test for test in tests if test[4] * len(tests) < LEVEL]
    least = min(test[4] for test in tests) * len(tests)
    if seen:
        said = "A difference is seen at " + ", ".join(
            f"{whole} ({what}, {space})"
            for space, what, whole, _, _ in seen) + "."
    else:
        said = ("No resonance is seen: the least of the corrected p-values is "
                f"{min(1.0, least):.2g}.")
    widths = [max(abs(bound) for bound in difference(found)[1:])
              for _, _, _, found, _ in pooled
              if sum(one.of_near for one in found) >= ENOUGH]
    if widths:
        said += (" By the intervals of all whole numbers together (95 % each, "
                 "for which no correction is made), the shares near and beside "
                 f"differ by less than {max(widths):.2g} where {ENOUGH} "
                 "machines or more are near.")
    text = (f"Resonances: of machines within {NEAR:g} of a whole number, "
            f"{WHOLE[0]} to {WHOLE[-1]}, against those {NEAR:g} to {BESIDE:g} "
            "from it, the share that is lasting, and the share that returns "
            f"at all; {len(tests)} tests, corrected as one (Bonferroni). "
            "Listed are all whole numbers together, and each one where the "
            "corrected p is below "
            f"{LEVEL:g}. {said} The picture has the shares in bins of "
            f"{BINS[1] - BINS[0]:.2g}.")
    return "\n".join([*wrapped(text), "", markdown.table(
        ["machines", "share that", "whole number", "near", "beside",
         "difference", "corrected p"], lines), ""])


def wrapped(text: str) -> list[str]:
    """Lines of up to 80 columns."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + 1 + len(word) > 80:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines
