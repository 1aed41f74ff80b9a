"""What stands between the tables of `make statistics`."""

HEAD = """\
# Exits and returns of `chaos`

Made by `make statistics` in {seconds} s on {jobs} processors;
run `long`, {cycles} cycles, took {long} s. A cycle goes from one
arrival at the two-fold to the next. The options of each run stand in
`tools/study/statistics/study`; what the intervals are, in
`tools/study/statistics/report.py`. Runs `-half` have half the step and another seed.

## Who returns

`long`, `rate-*`: rule random, a wheel rests at h = g = 0 until its draw.
`even`: one of the modes there is drawn. `attracting`: it takes the attracting
stick there. A cycle of random exits begins afresh at the two-fold, with draws
of its own, so each counts as one.
"""

PERTURBED = """\
Perturbed, 20 samples followed for 20 cycles; lost within the patience (100 s,
of hysteresis and delay 10 s). Noise draws at every step. Smoothing, hysteresis
and delay draw nothing but their size, once for each sample, log-uniformly from
half of what the run is named after to all of it (`--spread 2`): shares and
intervals, here and below, are of such sizes and not of one. The cycles of a
sample are alike: its intervals are those of as many independent cycles as
these are *worth*, by the correlation within a sample; of one a sample where
fewer than five of them tell of the rarer outcome.
"""

# First returns that are waited for long: name, options, patience [s].
MARKS = 10, 30, 100, 300, 1000
WAITS_OF = [
    *((f"noise-1e-4{half}", "--by noise --size 1e-4 --samples 100 "
       f"--patience 1000{step}", 1000)
      for half, step in (("", ""), ("-half", " --dt 5e-4"),
                         ("-quarter", " --dt 2.5e-4"))),
    *((f"noise-{size}", f"--by noise --size {size} --samples 50 "
       "--patience 1000", 1000) for size in ("1e-5", "1e-6")),
    *((f"{kind}-{size}{one}", f"--by {kind} --size {size} --samples 50 "
       f"--patience 300{spread}", 300)
      for one, spread in (("", ""), ("-one", " --spread 1"))
      for kind in ("hysteresis", "delay") for size in ("1e-3", "1e-4"))]

WAITS = """\
## Waits

First returns of perturbed samples that are waited for longer: to be at rest at
h = g = 0 after 100 s, *pinned* above, is to have waited, not to have ended. Of
runs `-one` all samples have the size that the run is named after: there are two
motions, by the side on which they begin.
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
largest half-width of their intervals, chi^2 against even (16.9 at 5 %). Sizes
of hysteresis, delay and smoothing are drawn, as above.
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

`build/statistics/machines`; the ranges stand in `tools/study/statistics/machines.c`.
"""
