"""Machines and motions beside `chaos` itself, by the command line: gamma as a
family, the rolling circle, and the core's law `smooth` beside finer.c."""
import json
import math
from pathlib import Path
from typing import Callable, Optional

import pandas as pd

import table
from table import said

SCENE = {"m": 1, "d": 1, "beta": 0.05, "kappa": 0.27241153714062027818,
         "k2": 2.2270992253886014, "gamma": -3 * math.pi / 4, "omega0": -1,
         "mu": 1}
# The wheel's angle from the slider, gamma + pi: a half turn of the wheel
# changes the signs of h and g and nothing else, so 0 to pi/2 is all.
ANGLES = 0.01, 0.1, 0.3, 0.5, math.pi / 4, 1.1, 1.3, 1.54
PLACE = 0.1859, -1.037
CIRCLE = -1.45, -1.415, -1.2, 1.415, 1.6


def two_fold(twofold: str) -> dict[str, float]:
    """That of `chaos`."""
    return folded(json.loads(said(
        twofold, "singularities", "chaos"))["two_folds"][0])


def folded(fold: dict) -> dict[str, float]:
    """What finer.py asks of a two-fold."""
    weak, strong = fold["eigenvalues"]
    return {"r": fold["r"], "g": fold["g"], "ratio": strong / weak,
            "share": fold["directions"][0]["lambda"] / SCENE["mu"]}


def design(twofold: str, angle: float) -> Optional[dict]:
    """The machine that has its two-fold at PLACE."""
    text = said(twofold, "design", "chaos", "--set",
                f"gamma={angle - math.pi!r}", "--r", PLACE[0],
                f"--omega={PLACE[1]}")
    return json.loads(text) if text else None


def by_angle(twofold: str) -> list[dict]:
    """A row for each angle. The jump f+ - f- at A = 0 is 2 mu sin/m in p', 2
    mu sin^2/(m r cos) in w'."""
    rows = []
    for angle in ANGLES:
        found = design(twofold, angle)
        if found is not None:
            fold = found["two_fold"]
            weak, strong = fold["eigenvalues"]
            rows.append({
                "angle": angle, "kappa": found["kappa"], "k2": found["k2"],
                "type": fold["type"], "case": fold["case"], "weak": weak,
                "strong": strong, "jump_p": 2 * math.sin(angle), "jump_w":
                    2 * math.sin(angle) ** 2 / (fold["r"] * math.cos(angle)),
                "rest": rest(twofold, angle, found)})
    return rows


def rest(twofold: str, angle: float, found: dict) -> Optional[float]:
    """The r to which the stick behind the two-fold that is followed tends;
    None where it ends before 30 s, or none is followed."""
    text = said(twofold, "diverge", "chaos", "--set",
                f"gamma={angle - math.pi!r}", *found["set"].split(),
                "--rate", "1e-6", "--samples", 1, "--patience", 30,
                "--exits", "-", "--returns", "/dev/null")
    if text is None:
        return None
    rows = table.parsed(text)
    places = rows.r[rows.how != "released"]
    return float(places.iloc[0]) if len(places) else None


def bisect(holds: Callable[[float], bool], low: float, high: float) -> float:
    """The border between an angle where it holds and one where it does not."""
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def limits(twofold: str) -> dict[str, float]:
    """Where case 1 ends: with the two-fold held at PLACE, and with kappa and
    k2 held, to either side."""
    def designed(angle: float) -> bool:
        found = design(twofold, angle)
        return found is not None and found["two_fold"]["case"] == 1

    def held(angle: float) -> bool:
        text = said(twofold, "singularities", "chaos", "--set",
                    f"gamma={angle - math.pi!r}") or '{"two_folds": []}'
        return any(fold["case"] == 1 for fold in json.loads(text)["two_folds"])

    middle = math.pi / 4
    return {"designed": bisect(designed, middle, 0.1),
            "held_low": bisect(held, middle, 0.01),
            "held_high": bisect(held, middle, 1.5)}


def followed(twofold: str, folder: Path, *words: object) -> pd.DataFrame:
    """Rows of a located run that begins on h = 0."""
    path = folder / "circle.csv"
    said(twofold, "run", "chaos", "--scheme", "located", "--dt", "1e-3",
         "--every", 100, "--out", path, "--set", "h=0", *words)
    return table.read(path)


def circle(twofold: str, folder: Path) -> dict:
    """Motions that begin on r = d tan gamma = 1 m: omega, how far they come
    from it, and how they end; and next to it the rate of the distance."""
    motions, rates = [], []
    for omega in CIRCLE:
        rows = followed(twofold, folder, "--set", "r=1", "--set",
                        f"omega={omega}", "--t-end", 20)
        last = rows.iloc[-1]
        motions.append([omega, float((rows.r - 1).abs().max()), last.omega,
                        last["mode"], last.F])
    for omega in -1.415, 1.415:
        rows = followed(twofold, folder, "--set", "r=1.000001", "--set",
                        f"omega={omega}", "--t-end", 4)
        first, last = rows.iloc[10], rows.iloc[30]
        rates.append(math.log((last.r - 1) / (first.r - 1))
                     / (last.t - first.t))
    return {"motions": motions, "rates": rates}


def circle_roots() -> list[float]:
    """Where omega tends to on the circle, for positive and negative g: roots
    of m R omega^2 +- c1 omega sin(gamma)/kappa + k2 (r0 - R) = 0, R = 1 m."""
    Q = math.sin(SCENE["gamma"]) * 1e-3 / SCENE["kappa"]
    return [(-s * Q + sign * math.sqrt(Q * Q + 4 * SCENE["k2"] * 0.9)) / 2
            for s, sign in ((1, -1), (-1, 1))]


def core_agreement(twofold: str, finer: str) -> list[list[float]]:
    """dt and the largest difference of r, v, w between the core's law `smooth`
    and finer.c, at t = 0.15 s, width 1e-3."""
    text = said(finer, "width=1e-3", "until=0.15")
    exact = table.parsed(text).iloc[0, -3:]
    rows = []
    for dt in 1e-3, 5e-4, 2.5e-4, 1.25e-4:
        text = said(twofold, "run", "smooth", "--set", "epsilon=1e-3", "--set",
                    "r=0.191960972", "--set", "omega=-1.053244828", "--set",
                    "h=0", "--t-end", 0.15, "--dt", dt)
        state = table.parsed(text).iloc[-1, 1:4]
        rows.append([dt, max(abs(a - b) for a, b in zip(state, exact))])
    return rows
