"""`make noise`: what vanishing noise selects at the two-fold of `chaos` and at
h = g = 0.

Each sample is one cycle, so samples are independent. Each size is followed at
three steps at h = g = 0: FINE. Of the largest size, whose wheels rest longest
next to it, there are a tenth of the cycles, at longer steps, and two fifths at
N = 128.
"""
import os
from pathlib import Path

import numpy as np
import pandas as pd

import pictures
import table
from pictures import LINE, SERIES, pyplot

CYCLES = int(os.environ.get("CYCLES") or 1000)
# In the order of their seeds; 1e-4 at 8 would take an hour.
FINE = {"1e-6": (8, 32, 128), "1e-5": (8, 32, 128), "1e-7": (4, 8, 16),
        "1e-4": (2, 4, 1)}
TENTH, SLOW = "1e-4", 40  # times as long a cycle takes


def samples_of(size: str, fine: int) -> int:
    return max(CYCLES // 10 if size == TENTH else
               CYCLES * 2 // 5 if fine == 128 else CYCLES, 1)


def follow(work: Path, twofold: str) -> None:
    """NAME-exits.csv and NAME-returns.csv of all runs."""
    runs = {"random": f"--rate 300 --patience 0.25 --samples "
                      f"{20 * CYCLES}"}
    costs = [0.01]
    for size, fines in FINE.items():
        for fine in fines:
            samples = samples_of(size, fine)
            runs[f"{size}-{fine}"] = (f"--by noise --size {size} --fine {fine} "
                                      f"--patience 100 --samples {samples}")
            costs.append(fine * samples * (SLOW if size == TENTH else 1))
    table.followed(work, twofold, runs, costs)


class Runs:
    """One size at one step, and the next finer one: exits and returns."""

    def __init__(self, work: Path, size: str, fine: int) -> None:
        self.size, self.fine = size, fine
        self.exits, self.returns = (
            table.read(work / f"{size}-{fine}-{kind}.csv")
            for kind in ("exits", "returns"))
        self.phases = self.exits.phase.dropna()
        self.times = self.returns.time[self.returns.outcome == "returned"]
        self.up = table.share((self.exits.side == "slip+").sum(),
                              len(self.exits))


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The tables, and the picture."""
    random = table.read(work / "random-exits.csv").phase.dropna()
    nothing = pd.Series(dtype=float)
    exits, drawn = [], []
    for size in sorted(FINE, key=float, reverse=True):
        runs = [Runs(work, size, fine) for fine in sorted(FINE[size])]
        for step, (one, finer) in enumerate(zip(runs, (*runs[1:], None))):
            off = table.distance(one.phases, random)
            drawn.append((step, one, off))
            exits.append({
                "size": size, "N": one.fine, "exits": len(one.exits),
                "share with a phase":
                table.share(len(one.phases), len(one.exits)).text(3),
                "share by slip+": one.up.text(3), "distance from random exits":
                off.text(2), "from the next finer step": table.distance(
                    one.phases, finer.phases if finer else nothing).text(2)})
    draw(kept, drawn)
    return {"exits": pd.DataFrame(exits)}


def draw(kept: Path, drawn: list[tuple[int, Runs, table.Estimate]]) -> None:
    """Distance and side over the size, at all steps; times of return."""
    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(12, 3.8))
    for step, one, off in drawn:
        colour, at = SERIES[step], float(one.size) * 1.12 ** (step - 1)
        label = ("first N", "second", "third")[step]
        for axes, found in (left, off), (middle, one.up):
            axes.errorbar([at], [found.value],
                          [[found.value - found.low],
                           [found.high - found.value]],
                          fmt="o", ms=4, color=colour,
                          label=label * (one is drawn[step][1]))
        if step == 2:
            right.step([0, *sorted(one.times)],
                       np.linspace(0, 1, len(one.times) + 1), where="post",
                       color=SERIES[list(FINE).index(one.size)],
                       label=f"{one.size}, finest step")
    for axes in left, middle:
        axes.set(xscale="log", xlabel="size of the noise [m/s^1.5]")
    left.set(ylabel="distance of the phases from random exits", ylim=(0, None))
    middle.set(ylabel="share of the exits by slip+")
    middle.axhline(0.5, color=LINE, zorder=0)
    right.set(xscale="log", xlabel="time of return [s]",
              ylabel="share of those that return")
    for axes in left, right:
        axes.legend()
    pictures.save(figure, kept / "noise.svg")
