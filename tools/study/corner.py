"""`make corner`: what small noise selects at h = g = 0 of `chaos`, where slip+
arrives: slip- or stick-, by r, for three directions of the noise (corner.c).

Length and time in units of the noise on h leave only the covariance of that on
g with it: no probability depends on its size. "v and omega" have independent
noises, of 1 m/s^1.5 and 1 rad/s^1.5. Above r_c stick- does not leave, and there
is nothing to compute.
"""
import math
import os
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import optimize

import driven
import pictures
import table
from halfrange import COS, SIN, field_at, stick
from pictures import LINE, SERIES, pyplot

SAMPLES = int(os.environ.get("SAMPLES") or 10000)
EPS = 0.2, 0.1, 0.05
PLACES = 0.176, 0.178, 0.18, 0.182, 0.183
DIRECTIONS = "v", "omega", "v and omega"

# Cycles of each sample, by 1/eps. The rate of exits from the two-fold, which is
# as the noise^(-2/3), hardly matters.
CYCLES = {10: 10, 20: 2, 40: 1}
RATE = "1e4"  # [1/s]
SOON = 3  # [s]
COLUMNS = ["P0", "P0 error", "q", "q error", "e", "P", "P error", "b"]


def direction(kind: str, r: float) -> tuple[float, float]:
    """n_g and n_2: noise on g with that on h, and beside it, where h has 1."""
    of = {"v": (-SIN, -COS), "omega": (SIN - r * COS, r * SIN + COS)}
    h, g = np.array([of[word] for word in kind.split(" and ")]).T
    n_g = h @ g / (h @ h)
    return float(n_g), math.sqrt(sum((g - n_g * h) ** 2) / (h @ h))


def critical() -> float:
    """r_c, below which stick- leaves."""
    return float(optimize.brentq(lambda r: stick(field_at(r)).b, 0.17, 0.2))


def probability(program: Path, kind: str, r: float, eps: float,
                samples: int, seed: int) -> list[float]:
    """What corner.c prints."""
    return [float(x) for x in driven.output(
        program, r, *map(repr, direction(kind, r)), eps, samples,
        seed).split(",")]


def follow(work: Path, twofold: str) -> None:
    """corner.csv: a row for each direction, r and eps, from the longest on; and
    returns to the two-fold where noise selects, for three times of the exit."""
    runs = [(kind, r, eps) for eps in sorted(EPS) for r in PLACES
            for kind in DIRECTIONS]
    program = work.parent / "corner-program"
    found = driven.side_by_side(lambda n: probability(
        program, *runs[n], SAMPLES, seed=n), range(len(runs)))
    pd.DataFrame([[*run, *row] for run, row in zip(runs, found)],
                 columns=["noise", "r", "eps", *COLUMNS]).to_csv(
                     work / "corner.csv", index=False)
    table.followed(work, twofold, {
        f"fine-{fine}": f"--codim2 noise --fine {fine} --rate {RATE} "
        f"--samples {SAMPLES} --cycles {n}" for fine, n in CYCLES.items()},
        [n * fine ** 2 for fine, n in CYCLES.items()])


def at_zero(rows: pd.DataFrame) -> table.Estimate:
    """The line through P over eps, by weights, at eps = 0; twice its error."""
    P, error, eps = (rows[name].to_numpy() for name in ("P", "P error", "eps"))
    error = np.maximum(error, 1e-4)
    fit, spread = np.polyfit(eps, P, 1, w=1 / error, cov="unscaled")
    return table.Estimate(*np.clip(
        fit[1] + 2 * math.sqrt(spread[1, 1]) * np.array([0, -1, 1]), 0, 1))


def count(work: Path, kept: Path) -> dict[str, object]:
    """The tables, and the picture."""
    rows, found, drawn = table.read(work / "corner.csv"), [], []
    for (kind, r), some in rows.groupby(["noise", "r"], sort=False):
        limit = at_zero(some)
        drawn.append((kind, r, limit))
        found.append({"r": r, "noise on": kind.replace("v and omega", "both"),
                      "P, eps " + ", ".join(f"{eps:g}" for eps in some.eps):
                      ", ".join(f"{P:.3f}" for P in some.P),
                      "P, eps -> 0": limit.text(3)})
    draw(kept, drawn)
    return {
        "selected": pd.DataFrame(found).sort_values("r", kind="stable"),
        "returns": returns(work)}


def returns(work: Path) -> pd.DataFrame:
    """How soon motions return, by the eps of the walk, and as it goes to 0."""
    found, shares = [], []
    for fine in CYCLES:
        rows = table.read(work / f"fine-{fine}-returns.csv")
        soon = (rows.time < SOON).mean()
        error = math.sqrt(soon * (1 - soon) / len(rows))
        shares.append((1 / fine, soon, error))
        found.append({
            "eps": f"{1 / fine:g}", "cycles": f"{len(rows)}",
            "returned": f'{(rows.outcome == "returned").sum()}',
            f"within {SOON} s": table.share(
                (rows.time < SOON).sum(), len(rows)).text(3),
            **{f"{n} %": table.quantile(rows.time, n / 100).text(3)
               for n in (25, 50, 75)}})
    limit = at_zero(pd.DataFrame(shares, columns=["eps", "P", "P error"]))
    found.append({"eps": "-> 0", f"within {SOON} s": limit.text(3)})
    return pd.DataFrame(found).fillna("-")


def draw(kept: Path, found: list[tuple[str, float, table.Estimate]]) -> None:
    """P over r, by the direction of the noise."""
    figure, axes = pyplot.subplots(figsize=(6, 3.8))
    for colour, kind in zip(SERIES, DIRECTIONS):
        some = sorted((r, *limit) for of, r, limit in found if of == kind)
        r, P, low, high = np.array(some).T
        axes.errorbar(r, P, [P - low, high - P], fmt="o", ms=4, color=colour,
                      label=f"noise on {kind}")
    axes.axvline(critical(), color=LINE, zorder=0,
                 label="r_c: stick\u2212 leaves to the left")
    axes.set(xlabel="r of h = g = 0 [m]", ylabel="probability of slip\u2212",
             ylim=(0, 1.02))
    axes.legend()
    pictures.save(figure, kept / "corner.svg")
