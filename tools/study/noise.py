"""`make noise`: what vanishing noise selects at the two-fold of `chaos` and at
h = g = 0.

Each sample is one cycle, so samples are independent. Each size is followed at
three steps at h = g = 0: FINE. Of the largest size, whose wheels rest longest
next to it, there are a tenth of the cycles, at longer steps, and two fifths at
N = 128.
"""
import os
from pathlib import Path

import pandas as pd

import table

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
        self.up = table.share((self.exits.side == "slip+").sum(),
                              len(self.exits))


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The table."""
    random = table.read(work / "random-exits.csv").phase.dropna()
    nothing = pd.Series(dtype=float)
    exits = []
    for size in sorted(FINE, key=float, reverse=True):
        runs = [Runs(work, size, fine) for fine in sorted(FINE[size])]
        for one, finer in zip(runs, (*runs[1:], None)):
            off = table.distance(one.phases, random)
            exits.append({
                "size": size, "N": one.fine, "exits": len(one.exits),
                "share with a phase":
                table.share(len(one.phases), len(one.exits)).text(3),
                "share by slip+": one.up.text(3), "distance from random exits":
                off.text(2), "from the next finer step": table.distance(
                    one.phases, finer.phases if finer else nothing).text(2)})
    return {"exits": pd.DataFrame(exits)}
