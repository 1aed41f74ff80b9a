"""`make corner`: what small noise selects at h = g = 0 of `chaos`, where slip+
arrives: slip- or stick-, by r, for two directions of the noise (corner.c).

Length and time in units of the noise leave only its direction: no probability
depends on its size. n = (n_g, n_h) is a unit of noise on v or on omega. That of
one Wiener process on both, "v and omega", is not resolved by these eps.
"""
import math
import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy import optimize

import driven
import pictures
import table
from pictures import LINE, SERIES, pyplot

# `chaos`, at rest on the turntable.
K2, R0, C, BETA, D, OMEGA = 2.2270992253886014, 0.1, 1e-3, 0.05, 1, -1
KAPPA, GAMMA = 0.27241153714062028, -3 * math.pi / 4
SAMPLES = int(os.environ.get("SAMPLES") or 10000)
EPS = 0.2, 0.1, 0.05
PLACES = {"v": (0.176, 0.178, 0.18, 0.182, 0.183, 0.185, 0.19, 0.195),
          "omega": (0.178, 0.18, 0.182, 0.183, 0.19)}

# Cycles of each sample, by the rate of exits from the two-fold [1/s], which is
# as the noise^(-2/3).
CYCLES = {"1e3": 1, "1e4": 10, "1e5": 1}
SOON = 3  # [s]
COLUMNS = ["P0", "P0 error", "q", "q error", "e", "P", "P error", "b"]


class Corner(NamedTuple):
    """h' and g' at h = g = 0: without friction, of F and of M, both in mu."""
    h: np.ndarray
    g: np.ndarray

    def near(self, sign_h: int, sign_g: int) -> tuple[float, float]:
        """Both at h -> 0, where |F| = mu and |M| = kappa mu."""
        law = np.array([1, sign_h, sign_h * sign_g * KAPPA])
        return float(self.h @ law), float(self.g @ law)

    def stick(self, n_g: float = 1) -> tuple[float, float]:
        """Of stick-, averaged over h: the rate b of |g|, and s^2."""
        (h_up, g_up), (h_down, g_down) = self.near(1, -1), self.near(-1, -1)
        up = h_down / (h_down - h_up)
        jump = (g_up - g_down) / (h_up - h_down)
        return -up * g_up - (1 - up) * g_down, (n_g - jump) ** 2


def at(r: float) -> Corner:
    """From (2) and (3), with p = v - d z and q = r z."""
    s, c, J = math.sin(GAMMA), math.cos(GAMMA), BETA ** 2 + r * r
    force = K2 * (R0 - r) + r * OMEGA ** 2
    p = np.array([force, s, 0])
    q = r / J * np.array([D * force - C * OMEGA, r * c, 1])
    return Corner(-p * s - q * c, q * s - p * c)


def direction(kind: str, r: float) -> float:
    """n_g of n_h = 1."""
    s, c = math.sin(GAMMA), math.cos(GAMMA)
    of = {"v": np.array([-s, -c]),
          "omega": np.array([D * s - r * c, r * s + D * c])}
    h, g = sum(of[word] for word in kind.split(" and "))
    return float(g / h)


def critical() -> float:
    """r_c, below which stick- leaves."""
    return float(optimize.brentq(lambda r: at(r).stick()[0], 0.17, 0.2))


def probability(program: Path, kind: str, r: float, eps: float,
                samples: int, seed: int) -> list[float]:
    """What corner.c prints."""
    return [float(x) for x in driven.output(
        program, r, repr(direction(kind, r)), eps, samples, seed).split(",")]


def follow(work: Path, twofold: str) -> None:
    """corner.csv: a row for each direction, r and eps, from the longest on; and
    returns to the two-fold where noise selects, for three times of the exit."""
    runs = sorted(((kind, r, eps) for kind, places in PLACES.items()
                   for r in places for eps in EPS),
                  key=lambda run: run[2])
    program = work.parent / "corner-program"
    found = driven.side_by_side(lambda n: probability(
        program, *runs[n], SAMPLES, seed=n), range(len(runs)))
    pd.DataFrame([[*run, *row] for run, row in zip(runs, found)],
                 columns=["noise", "r", "eps", *COLUMNS]).to_csv(
                     work / "corner.csv", index=False)
    table.followed(work, twofold, {
        rate: f"--codim2 noise --rate {rate} --samples {SAMPLES} --cycles {n}"
        for rate, n in CYCLES.items()}, [*CYCLES.values()])


def at_zero(rows: pd.DataFrame) -> table.Estimate:
    """The line through P over eps, by weights, at eps = 0; twice its error."""
    P, error, eps = (rows[name].to_numpy() for name in ("P", "P error", "eps"))
    error = np.maximum(error, 1e-4)
    fit, spread = np.polyfit(eps, P, 1, w=1 / error, cov="unscaled")
    return table.Estimate(*np.clip(
        fit[1] + 2 * math.sqrt(spread[1, 1]) * np.array([0, -1, 1]), 0, 1))


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The tables, and the picture."""
    rows, found, drawn = table.read(work / "corner.csv"), [], []
    for (kind, r), some in rows.groupby(["noise", "r"], sort=False):
        limit = at_zero(some)
        drawn.append((kind, r, limit))
        b, s2 = at(r).stick(direction(kind, r))
        found.append({"noise on": kind, "r": r, "b": f"{b:.3g}",
                      "s^2": f"{s2:.3g}", **{
                          f"P, eps {one.eps:g}": f"{one.P:.3f}({one[9]:.3f})"
                          for one in some.itertuples(index=False)},
                      "P, eps -> 0": limit.text(3)})
    draw(kept, drawn)
    return {
        "selected": pd.DataFrame(found).fillna("").sort_values(
            ["noise on", "r"], ascending=[False, True]),
        "returns": pd.DataFrame([returned(work, rate) for rate in CYCLES])}


def returned(work: Path, rate: str) -> dict[str, object]:
    """How soon, of one rate of exits."""
    rows = table.read(work / f"{rate}-returns.csv")
    return {"exits after": f"{1 / float(rate):g} s", "cycles": len(rows),
            "returned": int((rows.outcome == "returned").sum()),
            f"within {SOON} s": table.share(
                (rows.time < SOON).sum(), len(rows)).text(3),
            **{f"{n} %": table.quantile(rows.time, n / 100).text(3)
               for n in (25, 50, 75)}}


def draw(kept: Path, found: list[tuple[str, float, table.Estimate]]) -> None:
    """P over r, by the direction of the noise."""
    figure, axes = pyplot.subplots(figsize=(6, 3.8))
    for colour, kind in zip(SERIES, PLACES):
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
