"""Machines and motions beside `chaos` itself, by the command line: gamma as a
family, the rolling circle, and the core's law `smooth` beside `finer`."""
from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path
from typing import Optional

# The wheel's angle from the slider, gamma + pi: a half turn of the wheel
# changes the signs of h and g and nothing else, so 0 to pi/2 is all.
ANGLES = 0.01, 0.1, 0.3, 0.5, math.pi / 4, 1.1, 1.3, 1.54
PLACE = 0.1859, -1.037
CIRCLE = -1.45, -1.415, -1.2, 1.415, 1.6


def said(*words: object) -> Optional[str]:
    """What the command line prints; None where it refuses."""
    done = subprocess.run([str(word) for word in words], check=False,
                          text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL)
    return done.stdout if done.returncode == 0 else None


def design(twofold: str, angle: float) -> Optional[dict]:
    """The machine that has its two-fold at PLACE."""
    text = said(twofold, "design", "chaos", "--set",
                f"gamma={angle - math.pi!r}", "--r", PLACE[0],
                f"--omega={PLACE[1]}")
    return json.loads(text) if text else None


def by_angle(twofold: str) -> list[dict]:
    """A row for each angle."""
    rows = []
    for angle in ANGLES:
        found = design(twofold, angle)
        if found is None:
            continue
        fold = found["two_fold"]
        weak, strong = fold["eigenvalues"]
        r = fold["r"]
        rows.append({
            "angle": angle, "kappa": found["kappa"], "k2": found["k2"],
            "type": fold["type"], "case": fold["case"], "weak": weak,
            "strong": strong, "share": fold["directions"][0]["lambda"],
            # f+ - f- at A = 0: 2 mu sin/m in p', 2 mu sin^2/(m r cos) in w'
            "jump_p": 2 * math.sin(angle),
            "jump_w": 2 * math.sin(angle) ** 2 / (r * math.cos(angle)),
            "behind": behind(twofold, angle, found)})
    return rows


def behind(twofold: str, angle: float, found: dict) -> Optional[float]:
    """How long stick may last behind the two-fold; None where it is not
    followed to its end."""
    text = said(twofold, "diverge", "chaos", "--set",
                f"gamma={angle - math.pi!r}", *found["set"].split(),
                "--rate", "1e-6", "--samples", 1, "--patience", 30,
                "--exits", "-", "--returns", "/dev/null")
    for line in (text or "").splitlines():
        if ",released," in line:
            return float(line.split(",")[2])
    return None


def bisect(holds, low: float, high: float) -> float:
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
                    f"gamma={angle - math.pi!r}")
        return any(fold["case"] == 1
                   for fold in json.loads(text or '{"two_folds": []}')[
                       "two_folds"])

    middle = math.pi / 4
    return {"designed": bisect(designed, middle, 0.1),
            "held_low": bisect(held, middle, 0.01),
            "held_high": bisect(held, middle, 1.5)}


def followed(twofold: str, folder: Path, *words: object) -> list[list[str]]:
    """Rows of a located run."""
    path = folder / "circle.csv"
    said(twofold, "run", "chaos", "--scheme", "located", "--dt", "1e-3",
         "--every", 100, "--out", path, *words)
    return [line.split(",") for line in path.read_text("ascii").splitlines()
            if line[0].isdigit()]


def circle(twofold: str, folder: Path) -> dict:
    """Motions that begin on r = d tan gamma = 1 m, and next to it."""
    rows = []
    for omega in CIRCLE:
        rows.append([omega, followed(
            twofold, folder, "--set", "r=1", "--set", f"omega={omega}",
            "--set", "h=0", "--t-end", 20)])
    drift = [max(abs(float(row[1]) - 1) for row in motion)
             for _, motion in rows]
    rates = []
    for omega in -1.415, 1.415:
        motion = followed(twofold, folder, "--set", "r=1.000001", "--set",
                          f"omega={omega}", "--set", "h=0", "--t-end", 4)
        first, last = motion[10], motion[30]
        rates.append(math.log((float(last[1]) - 1) / (float(first[1]) - 1))
                     / (float(last[0]) - float(first[0])))
    return {"motions": [[omega, gone, float(motion[-1][3]), motion[-1][8],
                         float(motion[-1][6])]
                        for (omega, motion), gone in zip(rows, drift)],
            "rates": rates}


def core_agreement(twofold: str, build: str) -> list[list[float]]:
    """dt and the largest difference of r, v, w between the core's law `smooth`
    and finer, at t = 0.15 s, width 1e-3."""
    text = said(f"{build}/finer/finer-64", "width=1e-3", "until=0.15")
    exact = [float(cell) for cell in text.splitlines()[1].split(",")[-3:]]
    rows = []
    for dt in 1e-3, 5e-4, 2.5e-4, 1.25e-4:
        text = said(twofold, "run", "smooth", "--set", "epsilon=1e-3", "--set",
                    "r=0.191960972", "--set", "omega=-1.053244828", "--set",
                    "h=0", "--t-end", 0.15, "--dt", dt)
        state = text.splitlines()[-1].split(",")[1:4]
        rows.append([dt, max(abs(float(a) - b)
                             for a, b in zip(state, exact))])
    return rows
