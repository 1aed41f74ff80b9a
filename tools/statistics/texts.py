"""What stands between the tables of `make statistics`."""

HEAD = """\
# Exits and returns of `chaos`

Made by `make statistics` in {seconds} s on {jobs} processors;
run `long`, {cycles} cycles, took {long} s. A cycle goes from one
arrival at the two-fold to the next. The options of each run stand in
`tools/statistics/study`; what the intervals are, in
`tools/statistics/report.py`. Runs `-half` have half the step and another seed.

## Who returns

`long`, `rate-*`: rule random, a wheel rests at h = g = 0 until its draw.
`even`: one of the modes there is drawn. `attracting`: it takes the attracting
stick there.
"""

PERTURBED = """\
Perturbed, 20 samples followed for 20 cycles; lost within the patience (100 s,
of hysteresis and delay 10 s).
"""

SURVIVAL = """\
## Survival

Share of samples that have returned N times (Kaplan-Meier), and losses for each
cycle begun.
"""

STEP = """\
## The step

Kolmogorov-Smirnov distance between a step and its half. All distances of this
file count as one family of tests: with 95 % none of them is further than its
band from that of the two laws (Bonferroni), and p is multiplied by their
number. Two laws are *different* where the distance is above the band: by less
than 0.05, the smallest difference of interest, where distance and band together
are below that. They are *alike* where no difference is seen and one of 0.05
would be. Else it is *open* whether they differ.
"""

EXITS = """\
## Exits

Phase of the winding at 2 mm past the two-fold (of smoothing, and of near-300,
which is random with the rate 300, at 1 mm): shares of ten equal bins, the
largest half-width of their intervals, chi^2 against even (16.9 at 5 %).
"""

KINDS = """\
Distances of these laws between kinds, and between sizes halved:
"""

SET_VALUED = """\
## Samples of the set-valued motion

Distance, in the plane of (time since the two-fold, phase) at the section, from
the curve of exits from the one stick that is followed: stick for any time,
then slip to either side. 1 is the spread of that family. The last column has
the phases dealt to other runs: what chance would give.
"""

COST = """\
## Cost

One process, 10 cycles a sample.
"""

MACHINES = """\
## Two-folds of random machines

`build/statistics/machines`; the ranges stand in `tools/statistics/machines.c`.
"""
