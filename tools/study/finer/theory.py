"""What theory says about a motion in the layer next to the two-fold.

Across a layer of effective width eps (the width over the slope of phi where
the stick through the two-fold runs, phi = lambda/mu), at a time t from the
two-fold and with s = t sqrt(a/eps), a = |dA/dt| mu, a deviation xi (in units of
eps) obeys

    xi'' - s xi' + nu xi = 0,   nu = (ratio of the eigenvalues) - 1

Before the two-fold the part that decays slowest is |s|^nu; behind it all grows
like exp(s^2/2) s^(-nu - 1). A kick at s = 0 grows by M(-nu/2, 1/2, s^2/2),
Kummer's function, and s^2/2 is the integral of the layer's rate, the `behind`
of `finer`.
"""
from __future__ import annotations

import json
import math
import subprocess
from typing import Callable

from scipy import integrate, optimize, special

EXIT = 3  # a motion has left where |h| is that many widths
SCENE = {"m": 1, "d": 1, "beta": 0.05, "kappa": 0.27241153714062027818,
         "gamma": -3 * math.pi / 4, "omega0": -1, "mu": 1}

PHI: dict[str, Callable[[float], float]] = {
    "algebraic": lambda x: x / math.hypot(1, x),
    "tanh": math.tanh,
    "arctan": lambda x: math.atan(x) * 2 / math.pi,
    "cubic": lambda x: x * (3 - x * x) / 2,
    "skew": lambda x: (2 * x + math.hypot(1, x) - 1)
    / math.hypot(1, 2 * x + math.hypot(1, x) - 1),
    "corner": lambda x: x / math.hypot(1, x),
    "angle": lambda x: x}


def slope(form: str, share: float) -> float:
    """phi' where phi is `share`."""
    phi, by = PHI[form], 1e-5
    end = 1 - by if form in ("cubic", "angle") else 50
    x = optimize.brentq(lambda y: phi(y) - share, -end, end)
    return (phi(x + by) - phi(x - by)) / (2 * by)


class TwoFold:
    """The two-fold of `chaos`, by the command line."""

    def __init__(self, twofold: str):
        fold = json.loads(subprocess.run(
            [twofold, "singularities", "chaos"], check=True, text=True,
            stdout=subprocess.PIPE).stdout)["two_folds"][0]
        weak, strong = fold["eigenvalues"]
        self.r, self.g = fold["r"], fold["g"]
        self.share = fold["directions"][0]["lambda"] / SCENE["mu"]
        self.ratio = strong / weak
        self.nu = self.ratio - 1

    def width(self, form: str, effective: float) -> float:
        """The width of a form that has this effective one [m/s]."""
        scale = abs(self.g) if form == "angle" else 1
        return effective * slope(form, self.share) / scale

    def gain(self, exponent: float) -> float:
        """By how much a kick at the two-fold grows up to s^2/2 = exponent."""
        return abs(special.hyp1f1(-self.nu / 2, 0.5, exponent))

    def exponent(self, gain: float) -> float:
        """Where it has grown that much."""
        return optimize.brentq(
            lambda e: math.log(self.gain(e) / gain), 27, 300)

    def disturbance(self, width: float, exponent: float) -> float:
        """The kick of h at the two-fold that makes the exit [m/s]."""
        return EXIT * width / self.gain(exponent)


def contraction(twofold: str, form: str, folder: str) -> float:
    """C, the integral of A phi'(phi^-1(F/mu)) mu over the stick that leads to
    the two-fold, by the core's set-valued stick alone: the layer's contraction
    is exp(-C/width) as the width goes to 0."""
    path = f"{folder}/stick.csv"
    subprocess.run(
        [twofold, "run", "chaos", "--scheme", "located", "--dt", "1e-4",
         "--t-end", "0.1236", "--set", "r=0.191960972", "--set",
         "omega=-1.053244828", "--set", "h=0", "--every", "1", "--out", path],
        check=True, stderr=subprocess.DEVNULL)
    sine, cosine = math.sin(SCENE["gamma"]), math.cos(SCENE["gamma"])
    times, rates = [], []
    with open(path, encoding="ascii") as file:
        for line in file:
            cells = line.split(",")
            if cells[0] == "t":
                continue
            t, r, force = float(cells[0]), float(cells[1]), float(cells[6])
            inertia = SCENE["beta"] ** 2 + r * r
            delassus = (r * r + (SCENE["beta"] * sine) ** 2
                        + SCENE["kappa"] * r * cosine) / inertia
            times.append(t)
            rates.append(delassus * slope(form, force))
    # The last 0.07 ms, in which A goes to 0, are a share of 3e-7.
    return float(integrate.simpson(rates, x=times))
