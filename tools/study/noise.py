"""`make noise`: what vanishing noise selects at the two-fold of `chaos` and at
h = g = 0.

Each sample is one cycle, so samples are independent.
"""
import os
from pathlib import Path

import pandas as pd

import table

CYCLES = int(os.environ.get("CYCLES") or 1000)
COSTS = {"1e-5": 1, "1e-6": 2, "1e-7": 6}  # of a cycle of a size
SOON = 3  # [s]


def follow(work: Path, twofold: str) -> None:
    """NAME-exits.csv and NAME-returns.csv of all runs."""
    runs = {"random": f"--rate 300 --patience 0.25 --samples "
                      f"{20 * CYCLES}"}
    for size in COSTS:
        runs[size] = (f"--by noise --size {size} --patience 100 --samples "
                      f"{CYCLES}")
    table.followed(work, twofold, runs, [0.01, *COSTS.values()])


def row(work: Path, size: str, random: pd.Series) -> dict[str, object]:
    """Of one size: its exits, and how soon it returns."""
    exits, returns = (table.read(work / f"{size}-{kind}.csv")
                      for kind in ("exits", "returns"))
    phases = exits.phase.dropna()
    back = returns.time[returns.outcome == "returned"]
    return {"size": size, "cycles": len(returns), "share by slip+":
            table.share((exits.side == "slip+").sum(), len(exits)).text(3),
            "distance from random exits":
            table.distance(phases, random).text(2),
            "returned": len(back), f"within {SOON} s":
            table.share((back < SOON).sum(), len(returns)).text(3),
            "25 %, 50 %, 75 %": ", ".join(
                f"{back.quantile(n / 4):.3g}" for n in (1, 2, 3))}


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The table."""
    random = table.read(work / "random-exits.csv").phase.dropna()
    return {"exits": pd.DataFrame([row(work, size, random)
                                   for size in COSTS])}
