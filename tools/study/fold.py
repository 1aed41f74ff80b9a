"""`make fold`: to which side noise leaves a two-fold that stick passes, in the
layer where noise and the rates of h are of one size.

Near the two-fold h' = N - mu A sgn(h), mu A' = -a, and N' is a nu+ or a nu-
in slip of either sign. White noise sigma dW on h leaves only nu+ and nu- in
units of t_c = (sigma/a)^(2/3) and h_c = sigma sqrt(t_c):

    dh = (N + t sgn(h)) dt + dW,   dN = nu(sgn(h)) dt

Steps are of Euler and Maruyama, EPS max(1, t) long, before the two-fold
EPS / max(1, -t). The share is read where |h| first is a number of h_c.
"""
import json
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy import stats

import driven
import table

BANDS = 1.5, 15, 150, 900  # [h_c]
STEPS = {1.6e-3: 4, 4e-4: 4, 1e-4: 1}  # EPS, and the share of the samples
SAMPLES = 25000
SLAVED = 0.09, 0.5, 0.8  # multipliers of the stick
BEFORE = 6  # [t_c], to the two-fold from the start, in the layer of stick
PHASE = 30  # [t_c], when the phase of the spiral is read


class Fold(NamedTuple):
    """A two-fold: a [1/s], the rates of N; that of a slaved N is the same in
    both slips."""
    a: float
    up: float
    down: float

    @property
    def stick(self) -> float:
        """The multiplier of stick into the two-fold, where N = stick A."""
        return (self.up + self.down) / (self.down - self.up - 2)

    def growth(self) -> float:
        """Of the times of a winding, from one change to slip+ to the next: the
        larger eigenvalue of the map of time and speed."""
        turn = np.eye(2)
        for rate in self.up + 1, self.down - 1:
            time = 2 / abs(rate)
            turn = np.array([[1, time], [2, 1 + 2 * time]]) @ turn
        return float(max(abs(np.linalg.eigvals(turn))))


def of_chaos(twofold: str) -> Fold:
    """From second Lie derivatives, as `singularities` gives them [m/s^3]."""
    k = json.loads(table.said(twofold, "singularities", "chaos") or "")[
        "two_folds"][0]["physical"]
    a = (k["K++"] - k["K-+"]) / 2
    return Fold(a, (k["K++"] + k["K-+"]) / (2 * a),
                (k["K+-"] + k["K--"]) / (2 * a))


def exits(fold: Fold, eps: float, samples: int, seed: int) -> pd.DataFrame:
    """A row for each band: samples, those that leave to h > 0; and how far the
    phase of the spiral is from a uniform one."""
    random = np.random.default_rng(seed)
    t, stick = -float(BEFORE), fold.stick
    speed = np.full(samples, stick * BEFORE)
    side_of = np.where(random.random(samples) < (1 + stick) / 2, 1, -1)
    h = side_of * random.exponential(1 / (2 * BEFORE * (1 - stick * side_of)))
    side = np.zeros((len(BANDS), samples), np.int8)
    rose, up = np.full(samples, math.nan), h >= 0
    while not side[-1].all() or t < PHASE:
        dt = eps * max(1, t) if t > 0 else eps / max(1, -t)
        h += (speed + np.where(up, t + dt / 2, -t - dt / 2)) * dt
        h += math.sqrt(dt) * random.standard_normal(samples)
        speed += np.where(up, fold.up, fold.down) * dt
        t += dt
        was, up = up, h >= 0
        if t < PHASE:
            rose[up & ~was] = t
        for i, band in enumerate(BANDS if t > 0 else ()):
            new = (side[i] == 0) & (abs(h) > band)
            side[i][new] = np.sign(h[new])
    phase = (np.log(PHASE / rose[rose > 0]) / math.log(fold.growth())) % 1
    return pd.DataFrame({
        "eps": eps, "band": BANDS, "n": samples, "up": (side > 0).sum(1),
        "phase": stats.kstest(phase, "uniform").statistic, "rose": len(phase)})


def follow(work: Path, twofold: str) -> None:
    """fold.csv: what `exits` gives, of `chaos` and of slaved rates."""
    fold = of_chaos(twofold)
    runs = [("chaos", fold, eps, n * SAMPLES) for eps, n in STEPS.items()]
    runs += [(f"slaved {x}", Fold(1, -x, -x), 4e-4, SAMPLES) for x in SLAVED]
    pd.concat(driven.side_by_side(
        lambda n: exits(*runs[n][1:], seed=n).assign(of=runs[n][0]),
        range(len(runs)))).to_csv(work / "fold.csv", index=False)


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The tables."""
    rows = table.read(work / "fold.csv")
    rows["share"] = [table.share(*of).brief() for of in zip(rows.up, rows.n)]
    chaos = rows[rows.of == "chaos"].sort_values("eps")
    shares = chaos.pivot(index="band", columns="eps", values="share")
    shares.columns = [f"step {eps:g}" for eps in shares.columns]
    slaved = rows[(rows.of != "chaos") & (rows.band == BANDS[-1])]
    one = chaos.iloc[-1]
    return {"shares": shares.rename_axis("band/h_c").reset_index(),
            "phase": f"{one.rose:.0f} phases of the spiral at {PHASE} t_c "
            f"are uniform but for a\nKolmogorov distance of {one.phase:.4f} +- "
            f"{stats.kstwo.isf(1 - table.LEVEL, int(one.rose)):.4f}.",
            "slaved": "Multipliers of stick of " + ", ".join(
                slaved.of.str.split().str[1]) + " give\n" + ", ".join(
                    slaved.share) + "."}
