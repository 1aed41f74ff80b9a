#!/usr/bin/python3 -B
"""What is published still comes out: the pages of the studies are, to the byte,
what `tools/study/run SECTION page` makes of the counts that are kept, and first
exits are counted again with few samples and another seed: the side that they
leave by has the kept share, by Fisher's exact test. With 0.05 % for each run,
all of them fail by chance once in a hundred changes of the core, and not twice
with the same core, because the seeds are fixed.
"""
import os
import sys
from pathlib import Path

import pandas
from scipy import stats

from findings import (BUILD, FULL, ROOT, checked, in_common, need, place_of,
                      quietly, wrong)

sys.path.insert(0, str(ROOT / "tools/study"))
PLACE = place_of("gcc", "-O3")
TWOFOLD = PLACE / "double/twofold"
CHANCE = 5e-4
SAMPLES, SEED = "1000" if FULL else "60", 77  # of the first run


def judge_page(section, page):
    """The page that is made of the counts is the one in docs/."""
    made = PLACE / "study" / section / "kept" / Path(page).name
    if not quietly(ROOT / "tools/study/run", section, "page", env={
            **os.environ, "BUILD": str(PLACE), "TWOFOLD": str(TWOFOLD)}):
        wrong(f"tools/study/run {section} page fails")
    elif made.read_text() != Path(page).read_text():
        wrong(f"{page} is not what its counts make: tools/study/run {section} "
              "page")


def is_far(up, n, kept_up, kept_n):
    """Whether up of n are not the share that was kept."""
    return stats.fisher_exact([[up, n - up], [kept_up, kept_n - kept_up]])[
        1] < CHANCE


def judge_sides(run, options, kept, seed):
    """A run of first exits again."""
    words = options.split()
    words[words.index("--samples") + 1] = SAMPLES
    out = BUILD / "published.csv"
    if not quietly(TWOFOLD, "diverge", "chaos", *words, "--seed", seed,
                   "--exits", out):
        wrong(f"{run}: fails")
        return
    sides = pandas.read_csv(out, comment="#")["side"]
    up = int((sides == "slip+").sum())
    if is_far(up, len(sides), kept["up"], kept["exits"]):
        wrong(f"{run}: {up} of {len(sides)} by slip+, {kept['up']} of "
              f"{kept['exits']} are kept")


need("gcc", "gcc")
if not in_common("gcc", "-O3", TWOFOLD):
    wrong("the command line does not build")
    checked("nothing")
import exits  # noqa: E402
import finer  # noqa: E402
import noise  # noqa: E402
import recurrence  # noqa: E402
import sides  # noqa: E402

for name, module in (("exits", exits), ("finer", finer), ("noise", noise),
                     ("recurrence", recurrence), ("sides", sides)):
    judge_page(name, module.PAGE)
table = pandas.read_csv("docs/study/exits-sides.csv").set_index("run")
runs = {name: options for name, options in exits.first_cycles()
        if name in table.index}
if not runs:
    wrong("no run of first exits is kept")
for number, (name, options) in enumerate(runs.items(), SEED):
    judge_sides(name, options, table.loc[name], number)
checked(f"5 pages of the counts that are kept; {len(runs)} runs of first exits "
        f"again, {SAMPLES} samples each")
