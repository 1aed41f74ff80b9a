"""Intervals, quantiles, distances of distributions, survival.

Every interval is of 95 %. scipy computes what it has; quantiles and Kaplan
and Meier's estimate it has in versions after that of Debian 12.
"""
from __future__ import annotations

import math
from typing import NamedTuple, Sequence

import numpy as np
from scipy import stats

LEVEL = 0.95


class Estimate(NamedTuple):
    """A value with its interval; a bound that no sample gives is NaN."""
    value: float
    low: float
    high: float


class Distance(NamedTuple):
    """Kolmogorov and Smirnov's distance of two samples of n and m."""
    n: int
    m: int
    value: float
    band: float
    p: float

    def verdict(self, smallest: float) -> str:
        """What is known of the distance of the two distributions.

        It lies within `band` of that of the samples. Not to find a difference
        is not to find none: `alike` only where none is found and the distance
        cannot be as large as `smallest`; one that is found stays a difference,
        however small.
        """
        small = self.value + self.band < smallest
        if self.value > self.band:
            return f"different, by less than {smallest:g}" if small else \
                "different"
        return "alike" if small else "open"


def _share(k: int, n: int, method: str) -> Estimate:
    if n == 0:
        return Estimate(math.nan, math.nan, math.nan)
    found = stats.binomtest(k, n).proportion_ci(LEVEL, method)
    low = 0.0 if k == 0 else float(found.low)
    high = 1.0 if k == n else float(found.high)
    return Estimate(k / n, low, high)


def wilson(k: int, n: int) -> Estimate:
    """The share k of n with Wilson's score interval."""
    return _share(k, n, "wilson")


def clopper_pearson(k: int, n: int) -> Estimate:
    """The share k of n with the exact interval of Clopper and Pearson."""
    return _share(k, n, "exact")


def intraclass(groups: Sequence[Sequence[float]]) -> float:
    """How alike the values of a group are: the intraclass correlation, by the
    mean squares of an analysis of variance, at least 0. NaN where all values
    are the same or no group has two: then nothing tells.
    """
    n, k = sum(map(len, groups)), len(groups)
    if n <= k or k < 2:
        return math.nan
    centre = sum(map(sum, groups)) / n
    means = [sum(group) / len(group) for group in groups]
    between = sum(len(group) * (mean_of - centre) ** 2
                  for group, mean_of in zip(groups, means)) / (k - 1)
    within = sum((value - mean_of) ** 2 for group, mean_of in
                 zip(groups, means) for value in group) / (n - k)
    typical = (n - sum(len(group) ** 2 for group in groups) / n) / (k - 1)
    whole = between + (typical - 1) * within
    return max(0.0, (between - within) / whole) if whole > 0 else math.nan


def worth(groups: Sequence[Sequence[float]]) -> float:
    """As many independent values tell as much as these: their number by Kish's
    design effect. Where nothing tells how alike those of a group are, each
    group counts as one value.
    """
    n = sum(map(len, groups))
    alike = intraclass(groups)
    if alike != alike:
        return float(len(groups))
    size = sum(len(group) ** 2 for group in groups) / n
    return n / (1 + (size - 1) * alike)


def wilson_worth(k: int, n: int, worth_of: float) -> Estimate:
    """The share k of n, with Wilson's interval of so many independent ones."""
    if n == 0:
        return Estimate(math.nan, math.nan, math.nan)
    p, z = k / n, float(stats.norm.isf((1 - LEVEL) / 2))
    centre = p + z * z / (2 * worth_of)
    half = z * math.sqrt((p * (1 - p) + z * z / (4 * worth_of)) / worth_of)
    whole = 1 + z * z / worth_of
    return Estimate(p, 0.0 if k == 0 else (centre - half) / whole,
                    1.0 if k == n else (centre + half) / whole)


def quantile(values: Sequence[float], p: float,
             worth_of: float = math.inf) -> Estimate:
    """The least value that a share p of all does not exceed.

    The interval is between order statistics and assumes nothing of the
    distribution: how many values lie below the quantile is binomial. Of few
    values it has an open end. `worth_of`: how many independent values tell as
    much, where that is less.
    """
    n = len(values)
    if n == 0:
        return Estimate(math.nan, math.nan, math.nan)
    ordered = [math.nan, *sorted(values), math.nan]
    tail = (1 - LEVEL) / 2
    m = min(n, max(1, math.floor(worth_of))) if worth_of < n else n
    low = math.floor(stats.binom.ppf(tail, m, p) * n / m)
    high = math.ceil((stats.binom.isf(tail, m, p) + 1) * n / m)
    value = float(np.quantile(values, p, method="inverted_cdf"))
    return Estimate(value, ordered[low], ordered[min(high, n + 1)])


def median(values: Sequence[float]) -> float:
    """The lower median, so that it is one of the values."""
    return quantile(values, 0.5).value


def mean(values: Sequence[float]) -> Estimate:
    """The mean with Student's interval."""
    centre = float(np.mean(values))
    if len(values) < 2:
        return Estimate(centre, math.nan, math.nan)
    half = stats.sem(values) * stats.t.isf((1 - LEVEL) / 2, len(values) - 1)
    return Estimate(centre, centre - float(half), centre + float(half))


def kolmogorov_smirnov(a: Sequence[float], b: Sequence[float],
                       tests: int = 1) -> Distance:
    """The distance of two samples, one of so many tests (Bonferroni).

    `p` is the probability of a distance as large if both were of one
    distribution, exact up to 10000 values (`scipy.stats.ks_2samp`), times
    the number of tests. `band` is what the distance then stays below in 95 %
    of cases, in all tests together, by the distribution of one sample of
    n m / (n + m).
    """
    found = stats.ks_2samp(a, b)
    size = round(len(a) * len(b) / (len(a) + len(b)))
    band = float(stats.kstwo.isf((1 - LEVEL) / tests, max(1, size)))
    return Distance(len(a), len(b), float(found.statistic), band,
                    min(1.0, tests * float(found.pvalue)))


def kaplan_meier(at_risk: Sequence[int],
                 lost: Sequence[int]) -> list[Estimate]:
    """The share that survives the first, second, ... interval.

    at_risk and lost: how many began each interval, and were lost in it. The
    interval is Greenwood's on the scale log(-log), which keeps it in [0, 1];
    there is none where no sample or every sample was lost.
    """
    survival, variance, shares = 1.0, 0.0, []
    for risk, dead in zip(at_risk, lost):
        survival *= 1 - dead / risk
        if dead < risk:
            variance += dead / (risk * (risk - dead))
        if not 0 < survival < 1:
            shares.append(Estimate(survival, math.nan, math.nan))
            continue
        z = float(stats.norm.isf((1 - LEVEL) / 2))
        factor = math.exp(z * math.sqrt(variance) / -math.log(survival))
        shares.append(Estimate(survival, survival ** factor,
                               survival ** (1 / factor)))
    return shares


def chi_square_even(counts: Sequence[int]) -> float:
    """chi^2 of counts against equal ones."""
    return float(stats.chisquare(counts).statistic) if sum(counts) else 0.0


def chi_square_limit(degrees: int) -> float:
    """What chi^2 exceeds in 5 % of cases."""
    return float(stats.chi2.isf(1 - LEVEL, degrees))
