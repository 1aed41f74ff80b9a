"""`make noise`: what vanishing noise selects at the two-fold of `chaos` and at
h = g = 0. Each sample is one cycle, so samples are independent."""
import os
from pathlib import Path

import pandas as pd

import table

CYCLES = int(os.environ.get("CYCLES") or 1000)
COSTS = {"1e-5": 1, "1e-6": 2, "1e-7": 6}  # of a cycle of a size
SOON = 3  # [s]


def follow(work: Path, twofold: str) -> None:
    """NAME-exits.csv and NAME-returns.csv of all runs."""
    runs = {"random": f"--rate 300 --patience 0.25 --samples {20 * CYCLES}"}
    runs |= {size: f"--by noise --size {size} --patience 100 --samples {CYCLES}"
             for size in COSTS}
    table.followed(work, twofold, runs, [0.01, *COSTS.values()])


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The table: exits, and how soon motions return."""
    random, found = table.read(work / "random-exits.csv").phase.dropna(), []
    for size in COSTS:
        exits, returns = (table.read(work / f"{size}-{kind}.csv")
                          for kind in ("exits", "returns"))
        back = returns.time[returns.outcome == "returned"]
        found.append({
            "size": size, "share by slip+": table.share(
                (exits.side == "slip+").sum(), len(exits)).brief(),
            "distance from random exits": table.distance(
                exits.phase.dropna(), random).text(2),
            "returned": f"{len(back)}", f"within {SOON} s":
            table.share((back < SOON).sum(), len(returns)).brief()})
    return {"exits": pd.DataFrame(found)}
