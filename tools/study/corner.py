"""`make corner`: what small noise selects at h = g = 0 of `chaos`, where slip+
arrives, by r and the direction of the noise (corner.c; one Wiener process by
the equation of halfrange.py), and how soon motions return then.

Length and time are in units of the noise on h. "v and omega" have independent
noises, of 1 m/s^1.5 and 1 rad/s^1.5. Above r_c only slip- leaves.
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
from halfrange import COS, SIN, field_at, refined, selected, stick
from pictures import LINE, SERIES, pyplot

SAMPLES = int(os.environ.get("SAMPLES") or 10000)
EPS = 0.2, 0.1, 0.05
PLACES = 0.176, 0.178, 0.18, 0.182, 0.183
DIRECTIONS = {"v": "on v", "omega": "on omega", "v and omega": "independent"}

# Cycles of a sample, by 1/eps and the mean time of exits, as noise^(2/3) [s].
USUAL = 1e-4
CYCLES = {(10, USUAL): 10, (20, USUAL): 2, (40, USUAL): 1, (10, 1e-3): 2,
          (10, 1e-5): 2}
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
    """corner.csv: a row for each direction, r and eps, from the longest on;
    one.csv; and returns to the two-fold where noise selects."""
    runs = [(kind, r, eps) for eps in sorted(EPS) for r in PLACES
            for kind in DIRECTIONS]
    program = work.parent / "corner-program"
    found = driven.side_by_side(lambda n: probability(
        program, *runs[n], SAMPLES, seed=n), range(len(runs)))
    pd.DataFrame([[*run, *row] for run, row in zip(runs, found)],
                 columns=["noise", "r", "eps", *COLUMNS]).to_csv(
                     work / "corner.csv", index=False)
    pd.DataFrame({"r": PLACES, "P": driven.side_by_side(
        lambda r: refined(selected, field_at(r), n_g=-1), PLACES)}).to_csv(
            work / "one.csv", index=False)
    table.followed(work, twofold, {
        f"fine-{fine}-{time:g}": f"--codim2 noise --fine {fine} --rate "
        f"{1 / time:g} --samples {SAMPLES} --cycles {n}"
        for (fine, time), n in CYCLES.items()},
        [n * fine ** 2 for (fine, _), n in CYCLES.items()])


def at_zero(rows: pd.DataFrame) -> table.Estimate:
    """The line through P over eps, by weights, at eps = 0; twice its error."""
    P, error, eps = (rows[name].to_numpy() for name in ("P", "P error", "eps"))
    fit, spread = np.polyfit(eps, P, 1, w=1 / np.maximum(error, 1e-4),
                             cov="unscaled")
    return table.Estimate(*np.clip(
        fit[1] + 2 * math.sqrt(spread[1, 1]) * np.array([0, -1, 1]), 0, 1))


def count(work: Path, kept: Path) -> dict[str, object]:
    """The tables, and the pictures."""
    rows = table.read(work / "corner.csv").sort_values("eps", ascending=False)
    one = table.read(work / "one.csv").set_index("r").P
    found, limits = [], {}
    for r, here in rows.groupby("r"):
        line = {"r": f"{r:g}"}
        for kind, name in DIRECTIONS.items():
            some = here[here.noise == kind]
            limit = limits[kind, r] = at_zero(some)
            line[name] = some.P.map("{:.3f}, ".format).sum() + limit.brief()
        found.append({**line, "one process": f"{one[r]:.4f}"})
    draw(kept, limits, one)
    return {"selected": pd.DataFrame(found), "returns": returns(work, kept)}


def returns(work: Path, kept: Path) -> pd.DataFrame:
    """How soon motions return, by eps and the mean time of exits; a picture."""
    found, shares, grid = [], [], np.linspace(0, 1, 401)
    figure, axes = pyplot.subplots(figsize=(6, 3))
    for (fine, time), colour in zip(CYCLES, SERIES):
        rows = table.read(work / f"fine-{fine}-{time:g}-returns.csv")
        back = rows.time[rows.outcome == "returned"]
        soon = table.share((back < SOON).sum(), len(rows))
        found.append({
            "eps": f"{1 / fine:g}", "exit after [ms]": f"{1e3 * time:g}",
            "returned": f"{len(back)}", f"within {SOON} s":
            soon.brief(), "quartiles [s]": ", ".join(
                table.quantile(back, n / 4).brief() for n in (1, 2, 3))})
        if time == USUAL:
            shares.append((1 / fine, soon.value, (soon.high - soon.low) / 4))
            axes.plot(np.quantile(back, grid), grid, color=colour,
                      label=f"eps {1 / fine:g}")
    found.insert(len(shares), {"eps": "-> 0", f"within {SOON} s": at_zero(
        pd.DataFrame(shares, columns=["eps", "P", "P error"])).brief()})
    axes.axvline(SOON, color=LINE, zorder=0, label=f"{SOON} s")
    axes.set(xlabel="time of return [s]", ylabel="share that has returned",
             xlim=(0, 30), ylim=(0, 1))
    axes.legend()
    pictures.save(figure, kept / "returns.svg")
    return pd.DataFrame(found).fillna("-")


def draw(kept: Path, limits: dict[tuple[str, float], table.Estimate],
         one: pd.Series) -> None:
    """P over r, by the direction of the noise."""
    figure, axes = pyplot.subplots(figsize=(6, 3.8))
    for colour, off, kind in zip(SERIES, (-6e-5, 0, 6e-5), DIRECTIONS):
        P, low, high = np.array([limits[kind, r] for r in one.index]).T
        axes.errorbar(one.index + off, P, [P - low, high - P], fmt="o", ms=4,
                      color=colour, label=DIRECTIONS[kind])
    axes.plot(one, "s-", ms=4, color=SERIES[3], label="one process")
    axes.axvline(critical(), color=LINE, zorder=0,
                 label=f"r_c = {critical():.6f}: stick\u2212 leaves below")
    axes.set(xlabel="r of h = g = 0 [m]", ylabel="probability of slip\u2212",
             ylim=(0, 1.02))
    axes.legend(title="noise")
    pictures.save(figure, kept / "corner.svg")
