"""`make mechanisms`: how common two-folds are among random planar mechanisms
with a wheel.

A mechanism is an open chain of bodies on revolute (R) or prismatic (P) joints;
the wheel is on the last one. Its heading is t, its axle n = t turned by +90
degrees; over the ground its speed is h along n, g along t. Friction is -F n at
the wheel and +M on its body; stick: M = s kappa F, s = sign(g). So h' = N - A
F. Rates are taken by a complex step, which rounds but does not truncate.
"""
from __future__ import annotations

import concurrent.futures
import os
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

import driven
import pictures
import table
from pictures import SERIES, SOFT, pyplot

MECHANISMS = int(os.environ.get("MECHANISMS") or 10000)  # of each kind
SEED, PART = 1, 100  # mechanisms of a part
KINDS = "RR", "RP", "PR", "RRR", "RRP", "RPR", "RPP", "PRR", "PRP", "PPR"
STARTS, ROUNDS, EXACT = 64, 8, 1e-8  # of Newton's method
STEP, APART = 1e-40, 1e-5  # complex step [s]; states of a difference
TRAVEL, ENERGY = np.pi, 2.0  # of a joint to either side [rad or m]; [m V^2]
EDGES = 10 ** np.arange(-2, 1.01, 0.25)  # of kappa/arm
ARMS = {"below 0.1": (0, 4), "0.1 to 0.32": (5, 6), "0.32 to 1": (7, 8),
        "above 1": (9, 13)}  # bins
FOUND = {"negative": "A < 0", "two_fold": "two-fold", "visible": "visible",
         "mixed": "one visible", "invisible": "invisible", "case_1": "case 1",
         "case_1_half": "case 1, half the starts"}
COLOURS = {"negative": SOFT, "two_fold": SERIES[0], "case_1": SERIES[3]}


def perp(a: np.ndarray) -> np.ndarray:
    """A vector turned by +90 degrees."""
    return np.stack([-a[..., 1], a[..., 0]], axis=-1)


def turned(a: np.ndarray, by: np.ndarray) -> np.ndarray:
    return a * np.cos(by)[:, None] + perp(a) * np.sin(by)[:, None]


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a * b).sum(axis=-1)


class Chains(NamedTuple):
    """Mechanisms with the same kinds of joints, from the ground up; at rest
    where q = 0."""
    kinds: str
    offset: np.ndarray  # of a body's origin, in the frame before
    slide: np.ndarray  # angle of a P, in the frame before
    centre: np.ndarray  # of mass, in the body's frame
    mass: np.ndarray
    inertia: np.ndarray  # about the centre of mass
    k: np.ndarray
    c: np.ndarray
    contact: np.ndarray  # the wheel's place, in the last frame
    heading: np.ndarray
    kappa: np.ndarray
    mu: np.ndarray
    belt: np.ndarray  # velocity of the ground at the origin
    spin: np.ndarray  # of the ground

    def take(self, which: np.ndarray) -> Chains:
        return Chains(self.kinds, *(values[which] for values in self[1:]))

    def points(self, q: np.ndarray) -> tuple:
        """The wheel's place; velocities of the centres of mass and of the
        wheel by those of the joints; the axle."""
        angle, none = 0 * q[:, 0], np.zeros((len(q), 2))
        origin, columns = none, []
        joints: list[np.ndarray] = []  # a pin, or the direction of a P
        for i, kind in enumerate(self.kinds):
            origin = origin + turned(self.offset[:, i], angle)
            if kind == "R":
                angle = angle + q[:, i]
                joints.append(origin)
            else:
                joints.append(turned(none + [1, 0], angle + self.slide[:, i]))
                origin = origin + q[:, i, None] * joints[i]
            last = [self.contact] if i + 1 == len(self.kinds) else []
            for inside in [self.centre[:, i], *last]:
                at = origin + turned(inside, angle)
                columns.append(np.stack(
                    [perp(at - joint) if of == "R" else joint
                     for of, joint in zip(self.kinds, joints)]
                    + [none] * (len(self.kinds) - i - 1), axis=1))
        axle = turned(none + [0, 1], angle + self.heading)
        return at, np.stack(columns, axis=1), axle

    def slip(self, q: np.ndarray, u: np.ndarray) -> tuple:
        """h and g."""
        at, columns, axle = self.points(q)
        over = (np.einsum("bix,bi->bx", columns[:, -1], u) - self.belt
                - self.spin[:, None] * perp(at))
        return dot(axle, over), dot(-perp(axle), over)

    def masses(self, columns: np.ndarray) -> tuple:
        """The mass matrix, and which joint turns which body."""
        turns = np.tril([[kind == "R" for kind in self.kinds]]
                        * len(self.kinds)).astype(float)
        J = columns[:, :-1]
        return (np.einsum("bpix,bpjx,bp->bij", J, J, self.mass)
                + np.einsum("pi,pj,bp->bij", turns, turns, self.inertia)), turns

    def energy(self, q: np.ndarray, u: np.ndarray) -> np.ndarray:
        mass, _ = self.masses(self.points(q)[1])
        return (dot(self.k, q * q)
                + np.einsum("bi,bij,bj->b", u, mass, u)) / 2

    def field(self, q: np.ndarray, u: np.ndarray, s: np.ndarray) -> tuple:
        """A, N and h; u' without friction, and by a unit of F in stick."""
        _, columns, axle = self.points(q)
        mass, turns = self.masses(columns)
        along = np.einsum("bix,bx->bi", columns[:, -1], axle)
        ahead = q + 1j * STEP * u
        J_rate = self.points(ahead)[1][:, :-1].imag / STEP
        Q = -self.k * q - self.c * u - np.einsum(
            "bpix,bpjx,bj,bp->bi", columns[:, :-1], J_rate, u, self.mass)
        stick = (s * self.kappa)[:, None] * turns[-1] - along
        free, by_force = np.moveaxis(np.linalg.solve(
            mass, np.stack([Q, stick], axis=-1)), 2, 0)
        h = self.slip(ahead, u + 1j * STEP * free)[0]
        return (np.stack([-dot(along, by_force), h.imag / STEP, h.real]), free,
                by_force)

    def second(self, q: np.ndarray, u: np.ndarray, s: np.ndarray) -> list:
        """K++, K-+, K+- and K-- of the paper: how h' under the force of the
        first sign changes along the slip of the second."""
        _, free, by_force = self.field(q, u, s)
        K = []
        for slip in self.mu, -self.mu:
            rate = free + slip[:, None] * by_force
            dt = APART / np.maximum(1, np.abs(rate).max(axis=1))[:, None]
            behind, ahead = (self.field(q + way * u, u + way * rate, s)[0]
                             for way in (-dt, dt))
            A, N, _ = (ahead - behind) / (2 * dt[:, 0])
            K += [N - self.mu * A, N + self.mu * A]
        return K


def drawn(kinds: str, count: int, rng: np.random.Generator) -> Chains:
    """Random mechanisms, every second one on a belt."""
    each = count, len(kinds)

    def log(low: float, high: float, *shape: int) -> np.ndarray:
        return 10 ** rng.uniform(low, high, shape)

    mass, offset = log(-1, 1, *each), rng.normal(0, 0.5, (*each, 2))
    mass /= mass.sum(axis=1)[:, None]
    offset[:, 0] = 0
    belt, spin = rng.normal(0, 0.5, (count, 2)), np.arange(count) % 2 * 1.0
    belt[::2] = 1, 0
    return Chains(
        kinds, offset, rng.uniform(0, 2 * np.pi, each),
        rng.normal(0, 0.25, (*each, 2)), mass,
        mass * log(-1.3, -0.3, *each) ** 2, log(-2, 2, *each),
        log(-3, 0, *each), rng.normal(0, 0.5, (count, 2)),
        rng.uniform(0, 2 * np.pi, count), log(-2, 0, count),
        log(-2, 2, count), belt, spin)


def arm_of(chains: Chains) -> np.ndarray:
    """At rest, from the last pin to the wheel: its speed by that of the pin."""
    columns = chains.points(np.zeros(chains.k.shape))[1]
    return np.hypot(*columns[:, -1, chains.kinds.rindex("R")].T)


def search(chains: Chains, rng: np.random.Generator) -> pd.DataFrame:
    """FOUND of each mechanism: random states, and from those of mechanisms
    with A < 0 Newton's method to a two-fold, by the shortest steps."""
    n, every = len(chains.kinds), np.repeat(np.arange(len(chains.mu)), STARTS)
    many = chains.take(every)
    reach = np.minimum(TRAVEL, np.sqrt(2 * ENERGY / np.fmax(many.k, 1e-9)))
    q, u = reach * rng.uniform(-1, 1, reach.shape), rng.normal(size=reach.shape)
    s = np.sign(many.slip(q, u)[1])
    A = np.minimum(*(many.field(q, u, sign)[0][0] for sign in (s, -s)))
    negative = np.bincount(every, A < 0) > 0
    start = np.nonzero(negative[every])[0]
    of, many, s, x = every[start], many.take(start), s[start], np.concatenate(
        [q, u], axis=1)[start]
    for _ in range(ROUNDS):
        error, *more = (many.field(*np.split(x + APART * one, 2, axis=1), s)[0]
                        for one in np.eye(2 * n + 1, 2 * n, -1))
        J = (np.stack(more, axis=-1) - error[..., None]) / APART
        x = x - np.clip(np.einsum("bxe,eb->bx", np.linalg.pinv(
            np.swapaxes(J, 0, 1)), error), -1, 1)
    q, u = x[:, :n], x[:, n:]
    there = ((np.abs(many.field(q, u, s)[0]) < EXACT).all(axis=0)
             & (many.slip(q, u)[1] * s > 0) & (np.abs(q) <= TRAVEL).all(axis=1)
             & (many.energy(q, u) <= ENERGY))
    Kpp, Kmp, Kpm, Kmm = many.second(q, u, s)
    invisible = there & (Kpp < 0) & (Kmm > 0)
    case_1 = invisible & (Kmp < 0) & (Kpm > 0) & (Kmp * Kpm < Kpp * Kmm)
    such = (there, there & (Kpp > 0) & (Kmm < 0), there & (Kpp * Kmm > 0),
            invisible, case_1, case_1 & (start % 2 == 0))
    return pd.DataFrame(dict(zip(FOUND, [negative, *(
        np.bincount(of, one, len(negative)) > 0 for one in such)])))


def part(kinds: str, number: int) -> pd.DataFrame:
    """Counts of one part of the mechanisms of a kind, by bins of kappa/arm."""
    rng = np.random.default_rng([SEED, KINDS.index(kinds), number])
    chains = drawn(kinds, PART, rng)
    found = search(chains, rng).assign(
        mechanisms=1, joints=kinds,
        ground=np.where(chains.spin, "turntable", "belt"),
        bin=np.searchsorted(EDGES, chains.kappa / arm_of(chains)))
    return found.groupby(["joints", "ground", "bin"]).sum()


def follow(work: Path, _: str) -> None:
    """Counts all, in parts."""
    jobs = [(kinds, number) for number in range(MECHANISMS // PART)
            for kinds in KINDS]
    with concurrent.futures.ProcessPoolExecutor(driven.processors()) as pool:
        found = driven.side_by_side(
            lambda job: pool.submit(part, *job).result(), jobs)
    pd.concat(found).groupby(level=[0, 1, 2]).sum().to_csv(
        work / "mechanisms.csv")


def share(rows: pd.DataFrame, name: str) -> table.Estimate:
    return table.share(rows[name].sum(), rows.mechanisms.sum())


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The table, and shares over kappa/arm in a picture."""
    rows = table.read(work / "mechanisms.csv")
    freedoms = rows.joints.str.len()
    figure, axes = pyplot.subplots(figsize=(7, 4))
    for name, colour in COLOURS.items():
        for freedom, line in (2, "-"), (3, "--"):
            here = rows[freedoms == freedom]
            value, low, high = np.transpose([
                share(here[here.bin == i], name) for i in range(1, len(EDGES))])
            axes.stairs(value, EDGES, baseline=None, color=colour, ls=line,
                        label=f"{FOUND[name]}, {freedom} degrees of freedom")
            axes.stairs(high, EDGES, baseline=low, color=colour, fill=True,
                        alpha=0.25)
    axes.set(xscale="log", yscale="log", xlabel="kappa / arm",
             ylabel="share of mechanisms")
    axes.legend(loc="lower right")
    pictures.save(figure, kept / "mechanisms.svg")
    groups = {
        **{f"{n} degrees of freedom": freedoms == n for n in (2, 3)},
        **{f"on a {ground}": rows.ground == ground
           for ground in ("belt", "turntable")},
        **{f"kappa/arm {name}": rows.bin.between(*bins)
           for name, bins in ARMS.items()}}
    return {"shares": pd.DataFrame([
        {"mechanisms": name, "drawn": rows[which].mechanisms.sum(), **{
            what: share(rows[which], one).text(2)
            for one, what in FOUND.items()}}
        for name, which in groups.items()])}
