"""`make noise`: what vanishing noise selects at the two-fold of `chaos` and at
h = g = 0, docs/NOISE.md.

Each sample is one cycle, so samples are independent. Each size is followed at
three steps at h = g = 0: FINE. Of the largest size, whose wheels rest longest
next to it, there are a tenth of the cycles, at longer steps, and two fifths at
N = 128. Shares have Wilson's interval. The distance of two laws lies within the
band of that of their samples. Times of return are a staircase, of a round each:
a median does not see how many wheels go a second one, the share below SECOND
does.
"""
import os
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import stats

import cycles
import pictures
import table
from pictures import pyplot

PAGE = "docs/NOISE.md"
CYCLES = int(os.environ.get("CYCLES") or 1000)
# In the order of their seeds; 1e-4 at 8 would take an hour.
FINE = {"1e-6": (8, 32, 128), "1e-5": (8, 32, 128), "1e-7": (4, 8, 16),
        "1e-4": (2, 4, 1)}
TENTH, SLOW = "1e-4", 40  # times as long a cycle takes
SECOND = 3  # [s]: earliest return of a wheel that goes a second round
AT = "--section", "2e-3"
RANDOM = "--rate", "300", "--near", "100", "--patience", "0.25"
COLOURS = "#D55E00", "#E69F00", "#009E73", "#0072B2"


def samples_of(size: str, fine: int) -> int:
    return max(CYCLES // 10 if size == TENTH else
               CYCLES * 2 // 5 if fine == 128 else CYCLES, 1)


def follow(work: Path, twofold: str) -> None:
    """NAME-exits.csv and NAME-returns.csv of all runs, each with a seed."""
    runs = [("random", [*RANDOM, "--samples", str(20 * CYCLES)])]
    runs += [(f"{size}-{fine}",
              ["--by", "noise", "--size", size, "--fine", str(fine),
               "--patience", "100", "--samples", str(samples_of(size, fine))])
             for size, fines in FINE.items() for fine in fines]
    begin, done = time.time(), 0.0
    cost = [0.0] + [
        fine * samples_of(size, fine) * (SLOW if size == TENTH else 1)
        for size, fines in FINE.items() for fine in fines]
    for seed, (name, words) in enumerate(runs, 1):
        took = time.time() - begin
        left = took * (sum(cost) / done - 1) if done > 0 else float("nan")
        print(f"  {seed} of {len(runs)} after {took:.0f} s, {left:.0f} s left: "
              f"{name}", file=sys.stderr)
        cycles.shards(work / name, twofold,
                      ["chaos", *words, *AT, "--seed", str(seed)])
        done += cost[seed - 1]


def distance(first: pd.Series, second: pd.Series) -> table.Estimate:
    """Kolmogorov and Smirnov's, with its interval."""
    n, m = len(first), len(second)
    if not n or not m:
        return table.Estimate(*3 * [float("nan")])
    found = float(stats.ks_2samp(first, second).statistic)
    band = table.band(n, m)
    return table.Estimate(found, max(0.0, found - band), found + band)


def estimates(prefix: str, found: table.Estimate) -> dict[str, str]:
    return {f"{prefix}{end}": f"{value:.4g}"
            for end, value in zip(("", "_low", "_high"), found)}


def count(work: Path, kept: Path, build: str) -> None:
    """What the page is made of, and its picture."""
    del build

    def phase(name: str) -> pd.Series:
        rows = table.read(work / f"{name}-exits.csv", counted=True)
        return rows["phase"].dropna()

    def returns(name: str) -> pd.Series:
        rows = table.read(work / f"{name}-returns.csv", counted=True)
        return rows["time"][rows["outcome"] == "returned"]

    found, times = [], {}
    for size in sorted(FINE, key=float, reverse=True):
        fines = sorted(FINE[size])
        for fine, finer in zip(fines, (*fines[1:], None)):
            name = f"{size}-{fine}"
            exits = table.read(work / f"{name}-exits.csv", counted=True)
            back = table.read(work / f"{name}-returns.csv", counted=True)
            here = exits["phase"].dropna()
            times[size] = returns(name)
            found.append({
                "size": size, "fine": fine, "cycles": len(back),
                "exits": len(exits), "up": (exits["side"] == "slip+").sum(),
                "wound": len(here), "returned": len(times[size]),
                **estimates("random", distance(here, phase("random"))),
                **estimates("finer", distance(
                    here, phase(f"{size}-{finer}") if finer else here[:0])),
                "early": (times[size] < SECOND).sum(),
                **estimates("later", distance(times[size], returns(
                    f"{size}-{finer}") if finer else here[:0]))})
    pd.DataFrame(found).to_csv(kept / "noise.csv", index=False)
    draw(kept, times)


def read(kept: Path) -> pd.DataFrame:
    return table.read(kept / "noise.csv", ["size", "fine"])


def kept_estimate(row: pd.Series, name: str) -> table.Estimate:
    return table.Estimate(*row[[name, f"{name}_low", f"{name}_high"]])


def draw(kept: Path, times: dict[str, pd.Series]) -> None:
    """Distance and side over the size, at all steps; times of return."""
    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(12, 3.8))
    for step, colour in enumerate(COLOURS[:3]):
        rows = read(kept)
        rows = rows[rows.groupby("size").cumcount() == step]
        for axes, found in (
                (left, [kept_estimate(row, "random")
                        for _, row in rows.iterrows()]),
                (middle, [table.share(row.up, row.exits)
                          for _, row in rows.iterrows()])):
            axes.errorbar(rows["size"] * 1.12 ** (step - 1),
                          [one.value for one in found],
                          [[one.value - one.low for one in found],
                           [one.high - one.value for one in found]],
                          fmt="o", ms=4, lw=1, color=colour,
                          label=("first N", "second", "third")[step])
            axes.set(xscale="log", xlabel="size of the noise [m/s^1.5]")
    left.set(ylabel="distance of the phases from random exits", ylim=(0, None))
    middle.set(ylabel="share of the exits by slip+")
    middle.axhline(0.5, color="#999999", lw=0.7)
    left.legend(fontsize=8)
    for (size, found), colour in zip(times.items(), COLOURS):
        right.step([0, *sorted(found)], np.linspace(0, 1, len(found) + 1),
                   where="post", color=colour, label=f"{size}, finest step")
    right.set(xscale="log", xlabel="time of return [s]",
              ylabel="share of those that return")
    right.legend(fontsize=8)
    pictures.save_drawing(figure, kept / "noise.svg")


def parts(kept: Path) -> dict[str, str]:
    """What the page has of the counts."""
    rows = read(kept)
    return {
        "exits": table.markdown(
            ["size", "N", "exits", "share with a phase", "share by slip+",
             "distance from random exits", "from the next finer step"],
            [[f"{row['size']:g}", f"{row.fine:.0f}", f"{row.exits:.0f}",
              table.share(row.wound, row.exits).text(3),
              table.share(row.up, row.exits).text(3),
              kept_estimate(row, "random").text(2),
              kept_estimate(row, "finer").text(2)]
             for _, row in rows.iterrows()]),
        "returns": table.markdown(
            ["size", "N", "cycles", "share that returned",
             f"of these within {SECOND} s", "times, from the next finer step"],
            [[f"{row['size']:g}", f"{row.fine:.0f}", f"{row.cycles:.0f}",
              table.share(row.returned, row.cycles).text(3),
              table.share(row.early, row.returned).text(3),
              kept_estimate(row, "later").text(2)]
             for _, row in rows.iterrows()])}
