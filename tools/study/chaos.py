"""Scene `chaos` for its figures: motions and samples by the command line, and
what the surface h = 0 is, from the paper's equations (a test holds them to the
core).
"""
import json
import math
import os
import re
import subprocess
import tempfile
from functools import lru_cache

import numpy as np
import pandas as pd

import table

TWOFOLD = os.environ.get("TWOFOLD") or "build/double/twofold"
QUICK = bool(os.environ.get("QUICK"))
UNIT = 0.02  # [rad/s] of omega: 1 of the normal form's axis
OFF = 1e-12  # so far beside the surface a slip begins [m/s]
# From h = g = 0: omega and h next to it, of slip- along its limit direction.
AWAY = {"slip-": (-1.0000001, -1e-10), "stick-": (-0.9999999, 0)}


# Data of the command line.

def said(*words: object) -> subprocess.CompletedProcess:
    """What it prints."""
    done = subprocess.run([TWOFOLD, *map(str, words)], text=True, check=False,
                          capture_output=True)
    if done.returncode:
        raise table.TableError(done.stderr.strip())
    return done


@lru_cache(maxsize=None)
def rows_of(*words: object) -> pd.DataFrame:
    """Rows that it prints."""
    return table.parsed(said(*words).stdout)


def thinned(n: int) -> int:
    """How many samples or lines of a grid there are."""
    return max(n // 10, 2) if QUICK else n


def branches() -> pd.DataFrame:
    """The first branches from the two-fold, to the next choice."""
    return rows_of("diverge", "chaos", "--exhaustive", "--depth", 1, "--grid",
                   0.005, "--patience", 2.4, "--branches", "-")


def stick_out() -> pd.DataFrame:
    """The stick from the two-fold, where branches leave it."""
    rows = branches()
    return rows[rows["mode"] == "slip+"]


@lru_cache(maxsize=None)
def samples() -> tuple[pd.DataFrame, pd.DataFrame]:
    """Exits and returns where the exit is drawn at 10 1/s."""
    with tempfile.NamedTemporaryFile() as exits:
        returns = rows_of("diverge", "chaos", "--rate", 10, "--samples",
                          thinned(2000), "--patience", 300, "--exits",
                          exits.name, "--returns", "-")
        return table.read(exits.name), returns


def trajectory(r: float, omega: float, h: float, end: float,
               dt: float) -> pd.DataFrame:
    """One motion. Where it has reached the two-fold again it ends: behind it
    all is open."""
    done = said("run", "chaos", "--scheme", "located", "--dt", dt, "--set",
                f"r={r!r}", "--set", f"omega={omega!r}", "--set", f"h={h!r}",
                "--events", 1000000, "--t-end", f"{end:.6g}", "--out", "-")
    again = [float(t) for t in re.findall(
        r"^ *(\d\S*) .*two-fold reached", done.stderr, re.M) if float(t) > 0]
    rows = table.parsed(done.stdout)
    return rows[rows.t <= min(again, default=math.inf) + 1e-9]


def departure(row: pd.Series) -> tuple[float, float, float]:
    """What a branch begins with: a slip, or a motion away from h = g = 0."""
    omega, h = AWAY[row["mode"]] if row.kind == "codim2" else (
        row.exit_omega, OFF if row["mode"] == "slip+" else -OFF)
    return row.exit_r, omega, h


def futures_back() -> list[tuple[tuple[float, float, float], float]]:
    """Starts and lengths of the branches that lead back to the two-fold, each
    once, because they join: exits 60 ms apart, six to either side, and from
    each the fewest choices at h = g = 0 that lead back."""
    rows = rows_of("diverge", "chaos", "--exhaustive", "--depth", 8, "--grid",
                   0.06, "--patience", 2.4, "--count", 5000, "--branches", "-")
    inner, level, back = rows[(rows.node != 0) & rows.to.notna()], {0}, {}
    while level:  # nodes from which so many branches lead back
        found = inner[inner.to.isin(level) & ~inner.node.isin(back)]
        found = found.drop_duplicates("node")
        back.update((row.node, row) for _, row in found.iterrows())
        level = set(found.node)
    drawn, starts = set(), []
    for _, row in rows[(rows.node == 0) & rows.to.notna()][:12].iterrows():
        while row is not None and row.node not in drawn:
            starts.append((departure(row), row.time))
            drawn |= {row.node} - {0}
            row = back.get(row.to)
    return starts


# The machine, by the paper's equations.

class Field:
    """Rates over arrays of states (r, p, z): p = v - d z, z = w - omega0."""

    def __init__(self, of: dict) -> None:
        self.of, self.mu, self.kappa = of, of["mu"], of["kappa"]
        self.sine, self.cosine = np.sin(of["gamma"]), np.cos(of["gamma"])

    def rates(self, r, p, z, F, M):
        """r', p', z' under a force and a moment, and h', g'."""
        q, m = self.of, self.of["m"]
        w, v = z + q["omega0"], p + q["d"] * z
        Q_r = q["k2"] * (q["r0"] - r) - q["c2"] * v + m * r * w ** 2
        Q_phi = -q["c1"] * w - 2 * m * r * w * v
        dp = (Q_r + F * self.sine) / m
        dz = (Q_phi + q["d"] * Q_r + F * r * self.cosine + M) / (
            m * (q["beta"] ** 2 + r ** 2))
        dq = r * dz + v * z
        return (v, dp, dz, -self.sine * dp - self.cosine * dq,
                self.sine * dq - self.cosine * dp)

    def surface(self, r, omega):
        """On h = 0: h' of slip+ and of slip-, and r', omega' of stick."""
        z = omega - self.of["omega0"]
        p, roll = -r * z * self.cosine / self.sine, np.sign(z / self.sine)
        M = roll * self.kappa

        def h_rate(share):
            return self.rates(r, p, z, share * self.mu, share * self.mu * M)[3]

        plus, minus = h_rate(1), h_rate(-1)
        force = self.mu * (plus + minus) / (minus - plus)
        v, _, dz, _, _ = self.rates(r, p, z, force, force * M)
        return plus, minus, v, dz

    def is_case_1(self, r, z, s):
        """Whether a two-fold is one of Teixeira's, case 1: how h' under the
        force of one slip changes along the other, by differences."""
        p, K = -r * z * self.cosine / self.sine, {}
        for b in 1, -1:
            v, dp, dz, _, _ = self.rates(r, p, z, b * self.mu,
                                         b * s * self.mu * self.kappa)
            e = 1e-6 * np.minimum(np.abs(r / v), np.abs(z / dz))
            for a in 1, -1:
                ahead, behind = (self.rates(
                    r + t * v, p + t * dp, z + t * dz, a * self.mu,
                    a * s * self.mu * self.kappa)[3] for t in (e, -e))
                K[a, b] = (ahead - behind) / (2 * e)
        return ((K[1, 1] < 0) & (K[-1, -1] > 0) & (K[-1, 1] < 0)
                & (K[1, -1] > 0) & (K[-1, 1] * K[1, -1] < K[1, 1] * K[-1, -1]))

    def corner(self, r, phi):
        """Next to h = g = 0, in the direction phi = atan2(h, g): how fast the
        distance rho grows, and rho phi'."""
        h, g = np.sin(phi), np.cos(phi)
        T = np.tan(2 / math.pi * math.atan(6 * self.kappa)
                   * np.arctan2(np.abs(g), np.abs(h)))
        side = np.where(h < 0, -1, 1)
        _, _, _, dh, dg = self.rates(
            r, 0, 0, side * self.mu * (4 / 3 - T / (18 * self.kappa)),
            side * self.mu * T / 6 * np.sign(g))
        return dg * g + dh * h, dh * g - dg * h


@lru_cache(maxsize=None)
def field() -> Field:
    """That of `chaos`."""
    lines = map(str.split, said("scene", "chaos").stdout.splitlines())
    return Field({words[0]: float(words[1]) for words in lines
                  if len(words) > 1 and re.match(r"[-\d]", words[1])})


@lru_cache(maxsize=None)
def fold() -> dict:
    """The two-fold of case 1."""
    return next(one for one in json.loads(said(
        "singularities", "chaos").stdout)["two_folds"] if one["case"] == 1)


def fold_place() -> tuple[float, float]:
    """Its r and omega."""
    return fold()["r"], fold()["omega"]


class Chart:
    """The coordinates of the normal form: xi = L- / (S sqrt(K--)), eta = -L+ /
    (S sqrt(-K++)), where L+ and L- are h' of both slips. Sliding is xi, eta >
    0, the axes are the tangencies, and stick is (J1 xi + eta, xi + J2 eta) to
    first order, times a positive number. xi = 1 lies UNIT from the two-fold in
    omega."""

    def __init__(self) -> None:
        self.size, self.at = 1.0, np.array(fold_place())
        e, none = 1e-6, np.eye(2)
        by = np.transpose([(self.of(self.at + e * one)
                            - self.of(self.at - e * one)) / (2 * e)
                           for one in none])
        self.size = UNIT / abs(np.linalg.inv(by)[1, 0])
        self.inverse = self.size * np.linalg.inv(by)

    def of(self, place: np.ndarray) -> np.ndarray:
        """xi, eta of r, omega: the last axis."""
        plus, minus, _, _ = field().surface(place[..., 0], place[..., 1])
        return np.stack([minus / math.sqrt(fold()["K--"]),
                         -plus / math.sqrt(-fold()["K++"])], -1) / self.size

    def stick(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """How stick moves there."""
        want = np.stack([xi, eta], -1)
        place = self.at + want @ self.inverse.T
        for _ in range(12):
            place = place + (want - self.of(place)) @ self.inverse.T
        way = np.stack(field().surface(place[..., 0], place[..., 1])[2:], -1)
        way *= 1e-7 / np.linalg.norm(way, axis=-1)[..., None]
        return np.moveaxis(self.of(place + way) - self.of(place - way), -1, 0)
