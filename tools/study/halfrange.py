"""`make halfrange`: `make corner` without samples, as boundary value problems;
beside them steps of one length (tests/study/euler.py).

Length and time are in units of the noise, n = (n_g, 1) (corner.py). No noise
acts on u = g - n_g h, so the backward equation has a diffusion over h alone:

    h' P_h + P_hh / 2 + u' P_u = 0 (or -1, for a mean time)

u' changes its sign, so each line of h has a limit where it leaves: a half-range
problem. Over h the scheme is that of Scharfetter and Gummel, exact where the
field does not change; over u there are differences of order 2 against the
motion. Near g > 0 all but the leading order in A drops out, and there are two
numbers left, the multiplier of stick+ and e/V.
"""
import math
from pathlib import Path
from typing import Callable, NamedTuple, Optional

import numpy as np
import pandas as pd
from scipy import optimize, sparse
from scipy.sparse import linalg

import driven
import pictures
import table
from pictures import INK, SERIES, pyplot

# `chaos`, at rest on the turntable, from its mass matrix.
K2, R0, C, BETA, OMEGA = 2.2270992253886014, 0.1, 1e-3, 0.05, -1
KAPPA, GAMMA = 0.27241153714062028, -3 * math.pi / 4
SIN, COS, SHARE = math.sin(GAMMA), math.cos(GAMMA), 2 / math.pi * math.atan(
    6 * KAPPA)
RATIOS, COARSE = (0.12, 0.085), (0.17, 0.12)  # the growth of a grid's steps
FINE = 0.06, 0.0425  # for rests
FIRST, REACH = 0.04, 1200  # its first step; h'^2 g where motions begin and end
LEAST = 1e-8  # g of the leading order, in V / A^2
PLACES = 0.176, 0.178, 0.18, 0.182, 0.183
RESTS = 0.1834, 0.1836, 0.1838, 0.184, 0.1845, 0.185
SIZE = 1e-4  # [m/s^1.5]
STEPPED = {"selected": ("P", "error"), "stick": (
    "b", "error", "s2", "s2 error", "c")}  # what tests/study/euler.py says
# r, and n_g: 1 by noise on v, -1 by one Wiener process on v and omega.
EULER = (0.18, 1), (0.182, 1), (0.183, 1), (0.18, -1)
STEPS = 80, 20, 5, 1.25
# The leading order over the multiplier and e/V, and the lines that are drawn.
MAP = np.linspace(-0.75, 0.75, 13), np.linspace(1.6, 4, 9)
LEVELS = 1e-3, 1e-2, 0.05, 0.2, 0.5, 0.8, 0.95
SHORT, START = (0.176, 0.04), (1e5, 0.02)  # of stick-; g, h/g where they begin

Field = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


def field_at(r: float) -> Field:
    """h' and g' of (h, g) next to 0."""
    mass = np.array([[1, -1], [-1, BETA ** 2 + r * r + 1]])
    forces = np.array([[K2 * (R0 - r) + r * OMEGA ** 2, SIN, 0],
                       [-C * OMEGA, r * COS - SIN, 1]])
    of_h, of_g = np.array([[-SIN, SIN - r * COS],
                           [-COS, COS + r * SIN]]) @ np.linalg.solve(mass,
                                                                     forces)

    def field(h, g):
        T = np.tan(SHARE * np.arctan2(abs(g), abs(h)))
        F = np.sign(h) * (4 / 3 - T / 18 / KAPPA)
        M = np.sign(h) * np.sign(g) * T / 6
        return tuple(of[0] + of[1] * F + of[2] * M for of in (of_h, of_g))

    return field


def leading(multiplier: float, slope: float) -> Field:
    """The field near g > 0; slope is e/V."""
    return lambda h, g: (np.sign(h) - multiplier - slope * h / g, -np.sign(h))


class Near(NamedTuple):
    """Beside h = 0 at g = +-1, [0] at h > 0 and [1] at h < 0: h' and g', and
    how they change with h/|g|."""
    h: np.ndarray
    g: np.ndarray
    of_h: np.ndarray
    of_g: np.ndarray


def near(field: Field, sign: int) -> Near:
    side, g = np.array([1e-9, -1e-9]), np.full(2, float(sign))
    here, off = np.array(field(side, g)), np.array(field(1e4 * side, g))
    return Near(*here, *((off - here) / (1e4 * side)))


class Stick(NamedTuple):
    """Stick-, averaged over h: d|g| = (b + c/|g|) dt + s dW."""
    K: float
    b: float
    s2: float
    c: float


def stick(field: Field, n_g: float = 1) -> Stick:
    """h is exponential on either side: |g| + K h has the drift b, and c from
    the means of h."""
    x = near(field, -1)
    K = (x.g[0] - x.g[1]) / (x.h[0] - x.h[1])
    share = np.array([-x.h[1], x.h[0]]) / (x.h[0] - x.h[1])
    mean = share * (1, -1) / (2 * abs(x.h))
    return Stick(K, -share @ x.g, (n_g - K) ** 2, mean @ (K * x.of_h - x.of_g))


def grid(low: float, high: float, first: float, ratio: float) -> np.ndarray:
    """Steps from 0 on that begin with `first` and come to grow by `ratio`."""
    def half(end):
        n = math.ceil(math.asinh(end / first * ratio) / ratio)
        return first / ratio * np.sinh(ratio * np.arange(n + 1))
    return np.r_[-half(-low)[:0:-1], half(high)]


def bernoulli(x: np.ndarray) -> np.ndarray:
    """x / (exp(x) - 1)."""
    safe = np.where(abs(x) < 1e-5, 1, np.clip(x, -700, 700))
    return np.where(abs(x) < 1e-5, 1 - x / 2, safe / np.expm1(safe))


def solve(field: Field, u: np.ndarray, h: np.ndarray, n_g: float, left: float,
          beyond: Callable[[float], tuple[float, float]],
          source: float = 0) -> np.ndarray:
    """P over (u, h), or a mean time where source is 1. `left` beyond the last
    u; before the first u by a distance it is `beyond` of that distance, a share
    of that at the first u, and a sum."""
    d = np.diff(h)
    middle, across = (h[1:] + h[:-1]) / 2, u[:, None]
    rate, along = field(middle + 0 * across, across + n_g * middle)
    x, along = 2 * rate * d, along - n_g * rate
    wide = np.r_[d, 0] + np.r_[0, d]
    index = np.arange(len(u) * len(h)).reshape(len(u), len(h))
    entries: list[tuple] = []
    right = np.zeros(index.shape)
    plus, minus = np.zeros(index.shape), np.zeros(index.shape)
    # Each half of a cell: the rate of its step, and the time spent there.
    for here, there, sign in ((slice(-1), slice(1, None), 1),
                              (slice(1, None), slice(-1), -1)):
        step = bernoulli(-sign * x) / d / wide[here]
        time = 2 * d / wide[here] * np.where(
            abs(x) < 1e-4, 0.5, (bernoulli(-sign * x) - 1) * sign
            / np.where(abs(x) < 1e-4, 1, x))
        at = index[:, here]
        entries += [(at, index[:, there], step), (at, at, -step)]
        right[:, here] -= source * time
        plus[:, here] += time * np.maximum(along, 0)
        minus[:, here] += time * np.minimum(along, 0)
    more = np.r_[u[0] + (u[0] - u[1]) * np.array([2, 1]), u,
                 u[-1] + (u[-1] - u[-2]) * np.array([1, 2])]
    for i, at in enumerate(index):
        for sign, speed in ((1, plus[i]), (-1, minus[i])):
            a, b = more[i + 2 + sign] - u[i], more[i + 2 + 2 * sign] - u[i]
            for n, by in ((1, b / a / (b - a)), (2, -a / b / (b - a))):
                to, by = i + sign * n, speed * by
                entries.append((at, at, -by))
                if to >= len(u):
                    right[i] -= by * left
                elif to < 0:
                    share, more_of = beyond(u[0] - more[to + 2])
                    entries.append((at, index[0], by * share))
                    right[i] -= by * more_of
                else:
                    entries.append((at, index[to], by))
    row, column, value = (np.concatenate([np.ravel(one[k]) for one in entries])
                          for k in range(3))
    matrix = sparse.csc_matrix((value, (row, column)), (index.size, index.size))
    return linalg.splu(matrix).solve(right.ravel()).reshape(index.shape)


def arrives(field: Field) -> float:
    """h/g of the ray along which slip+ arrives."""
    def turn(slope):
        h, g = field(np.array(slope), np.array(1.0))
        return h - slope * g
    return float(optimize.brentq(turn, 1e-9, 3))


def value(P: np.ndarray, u: np.ndarray, h: np.ndarray, at: tuple) -> float:
    """Between the nodes; at is (u, h)."""
    i = min(np.searchsorted(u, at[0]), len(u) - 1)
    rows = [np.interp(at[1], h, P[k]) for k in (i - 1, i)]
    return float(np.interp(at[0], u[i - 1:i + 1], rows))


def selected(field: Field, ratio: float, n_g: float = 1, low: float = 0,
             start: Optional[tuple[float, float]] = None) -> float:
    """P of slip-. low: of a field that is that near g > 0, its least g. start:
    g and h/g, where it is not far out on the ray of slip+."""
    of, slope = near(field, 1), arrives(field)
    begin = REACH / 4 / of.h[0] ** 2
    top = 4 * max(begin, REACH / 4 / of.h[1] ** 2)
    wide = grid(-0.1 * top, 3 * slope * top, FIRST if not low else
                0.3 * math.sqrt(low), ratio)
    if low:
        u = low * np.exp(np.arange(0, math.log(top / low), ratio))
        P = solve(field, u, wide, 0, 1, lambda _: (0, 0))
        return value(P, u, wide, (begin, slope * begin))
    x = stick(field, n_g)  # which is short where s2 is small
    u = np.r_[grid(-100, 0, FIRST, ratio / 4)[:-1],
              grid(0, top, FIRST, ratio)]
    P = solve(field, u, wide, n_g, 1, lambda far: (
        math.exp(-2 * x.b / x.s2 * far), 0))
    begin, slope = start or (begin, slope)
    return value(P, u, wide, (begin * (1 - n_g * slope), slope * begin))


def rests(field: Field, ratio: float) -> float:
    """The mean time of a rest above r_c, in units of the noise."""
    x, top = stick(field), REACH / near(field, 1).h[1] ** 2
    u = grid(-1000, top, FIRST, ratio)
    h = grid(-0.1 * top, 0.1 * top, FIRST, ratio)
    T = solve(field, u, h, 1, 0, lambda far: (1, -far / x.b), 1)
    return value(T, u, h, (-1, 0))


def refined(what: Callable, field: Field, ratios: tuple = RATIOS, **more
            ) -> float:
    """Its value for steps to 0, of order 2."""
    coarse, fine = (what(field, ratio, **more) for ratio in ratios)
    return fine + (fine - coarse) / ((ratios[0] / ratios[1]) ** 2 - 1)


def drifting(begin: float, size: float, rows: pd.DataFrame,
             dt: float = 4e5, samples: int = 200) -> float:
    """The mean time [s] of a rest, where r rises by v meanwhile: |g| is a
    Brownian motion with drift b, reflected at 0, and ends by its pushes."""
    random = np.random.default_rng(1)
    time, rate = dt * size ** 2, -1 / (rows.rest * rows.b) / size ** 2
    (r, g, times), left = (np.outer((begin, 0, 0), np.ones(samples)),
                           random.exponential(size=samples))
    sd = size * math.sqrt(rows.s2.mean() * time)
    while (left > 0).any():
        g += np.interp(r, rows.r, rows.b) * time + random.normal(0, sd, samples)
        left -= np.maximum(-g, 0) * np.interp(r, rows.r, rate)
        g = np.maximum(g, 0)
        r += (1 / r - 1) / math.sqrt(2) * g * time
        times += time * (left > 0)
    return float(times.mean())


def row(task: tuple) -> dict[str, object]:
    """What the rows of halfrange.csv have, of one kind."""
    kind, *of = task
    if kind == "map":
        return {"kind": kind, "multiplier": of[0], "slope": of[1], "first":
                refined(selected, leading(*of), COARSE, low=LEAST)}
    found = {"kind": kind, "r": of[0], "n_g": of[-1]}
    if kind in STEPPED:
        said = driven.output("tests/study/euler.py", kind, *of).split()
        return {**found, "dt": of[1], **dict(zip(STEPPED[kind],
                                                 map(float, said)))}
    field = field_at(of[0])
    if kind == "start":
        return {**found, "P": refined(selected, field, n_g=of[1], start=START)}
    x = stick(field)
    found.update(x._asdict())
    if kind == "rest":
        return {**found, "rest": refined(rests, field, FINE)}
    by = near(field, 1)
    A, V = (by.h[0] - by.h[1]) / 2, (by.g[1] - by.g[0]) / 2
    multiplier, slope = -by.h.mean() / A, -by.of_h.mean() / V
    return {**found, "A": A, "multiplier": multiplier, "slope": slope,
            "P": refined(selected, field), "first": refined(
                selected, leading(multiplier, slope), COARSE, low=LEAST)}


TASKS = [*(("P", r) for r in PLACES), *(("rest", r) for r in RESTS),
         *(("start", *of) for of in EULER),
         *(("selected", r, dt, n_g) for dt in STEPS for r, n_g in EULER),
         ("stick", *SHORT), *(("map", x, y) for y in MAP[1] for x in MAP[0])]


def follow(work: Path, _: str) -> None:
    """halfrange.csv."""
    pd.DataFrame(driven.side_by_side(row, TASKS)).to_csv(
        work / "halfrange.csv", index=False)


def stepped(kinds: dict[str, pd.DataFrame]) -> dict[str, object]:
    """What steps of one length give, beside the equation or the formulas."""
    same = kinds["start"].set_index(["r", "n_g"]).P.map("{:.3f}".format)
    steps = [{"r": at[0], "n_g": f"{at[1]:g}", "P, steps " + ", ".join(
        map("{:g}".format, some.dt)): ", ".join(map("{:.3f}".format, some.P)),
        "equation": same[at]} for at, some in kinds["selected"].groupby(
            ["r", "n_g"], sort=False)]
    x, of = kinds["stick"].iloc[0], stick(field_at(SHORT[0]))
    return {"steps": pd.DataFrame(steps), "stick":
            f"For stick- at r = {x.r:g} m steps of {x['dt']:g} give\nb = "
            f"{x.b:.4f}({1e4 * 2 * x.error:.0f}), s^2 = {x.s2:.2f}"
            f"({200 * x['s2 error']:.0f}), c = {x.c:.4f}; the formulas give "
            f"{of.b:.5f}, {of.s2:.2f}, {of.c:.4f}."}


def draw(path: Path, rows: pd.DataFrame, places: pd.DataFrame) -> None:
    """P of slip- at leading order, and where `chaos` is."""
    figure, axes = pyplot.subplots(figsize=(6, 3.4))
    lines = axes.contour(*MAP, rows["first"].to_numpy().reshape(
        len(MAP[1]), len(MAP[0])), LEVELS, colors=SERIES[0])
    axes.clabel(lines, fmt="%g")
    axes.plot(places.multiplier, places.slope, "o", ms=4, color=INK,
              label="chaos, by r [m]")
    for n, place in enumerate(places.itertuples()):
        axes.annotate(f"{place.r:g}", (place.multiplier, place.slope),
                      (0, 6 if n % 2 else -13), ha="center",
                      textcoords="offset points")
    axes.legend()
    axes.set(xlabel="multiplier \u03bb/\u03bc of stick+", ylabel="e/V")
    pictures.save(figure, path)


def count(work: Path, kept: Path) -> dict[str, object]:
    """The tables and the picture."""
    rows = table.read(work / "halfrange.csv")
    kinds = {kind: some for kind, some in rows.groupby("kind", sort=False)}
    places, rest = kinds["P"], kinds["rest"].sort_values("r")
    chosen = pd.DataFrame({
        "r": places.r, "multiplier": places.multiplier.map("{:.3g}".format),
        **{name: places[of].map("{:.4f}".format) for name, of in (
            ("size of A", "A"), ("P, leading order", "first"), ("P", "P"))}})
    waits = pd.DataFrame({
        "r": rest.r, "T/size^2": rest.rest.map("{:.3g}".format),
        f"at {SIZE:g} [s]": (rest.rest * SIZE ** 2).map("{:.2g}".format)})
    draw(kept / "halfrange.svg", kinds["map"], places)
    rising = max(drifting(r, SIZE, rest) for r in rest.r)
    return {"selected": chosen, "rest": waits.iloc[[0, 1, 3, 5]], "rising":
            "Short sticks raise r meanwhile. In a reduced model no mean rest "
            f"at {SIZE:g}\nthen exceeds {rising:.2g} s.", **stepped(kinds)}
