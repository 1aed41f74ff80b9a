"""`make several`: how common several joint futures are among random planar
mechanisms with two wheels (those of `make mechanisms`, and chains of four
bodies), and what contact after contact reports there. One state of each, in
which neither wheel slips sideways."""
from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd

import table
from mechanisms import Chains, dot, drawn, perp

MECHANISMS = int(os.environ.get("MECHANISMS") or 2000)  # of each kind
KINDS = ("RRR", "RRP", "RPR", "RPP", "PRR", "PRP", "PPR",
         "RRRR", "PRRR", "RPRR", "PPRR")
SEED, DT, STEP = 1, 1e-3, 1e-40
SWEEPS = 200  # several.c ends with these
NAMES = "joint", "product", "same", "sweeps"


def other_wheel(chains: Chains, rng: np.random.Generator, body: int) -> Chains:
    """A second wheel, on a body."""
    count, own = len(chains.mu), slice(body + 1)
    return Chains(chains.kinds[own], *(part[:, own] for part in chains[1:8]),
                  rng.normal(0, 0.5, (count, 2)),
                  rng.uniform(0, 2 * np.pi, count), 10 ** rng.uniform(
                      -2, 0, count), chains.mu, chains.belt, chains.spin)


def padded(a: np.ndarray, n: int) -> np.ndarray:
    return np.pad(a, [(0, 0), (0, n - a.shape[1])])


def systems(kinds: str, rng: np.random.Generator, one_body: bool) -> np.ndarray:
    """What several.c reads, a row for each mechanism."""
    chains, n = drawn(kinds, MECHANISMS, rng), len(kinds)
    body = n - 1 if one_body else n - 2
    wheels = chains, other_wheel(chains, rng, body)
    q = rng.uniform(-1, 1, (MECHANISMS, n))
    u = rng.normal(size=q.shape)
    points = [wheel.points(q[:, :len(wheel.kinds)]) for wheel in wheels]
    rows = [[padded(np.einsum("bix,bx->bi", columns[:, -1], way), n)
             for way in (axle, -perp(axle))] for _, columns, axle in points]

    def slips(q: np.ndarray, u: np.ndarray) -> list[np.ndarray]:
        return [slip for wheel in wheels for slip in wheel.slip(
            q[:, :len(wheel.kinds)], u[:, :len(wheel.kinds)])]

    across = np.stack([rows[0][0], rows[1][0]], axis=1)
    h = np.stack(slips(q, u)[::2], axis=-1)
    u = u - np.einsum("bia,ba->bi", np.linalg.pinv(across), h)
    mass, turns = chains.masses(points[0][1])
    J_rate = chains.points(q + 1j * STEP * u)[1][:, :-1].imag / STEP
    Q = -chains.k * q - chains.c * u - np.einsum(
        "bpix,bpjx,bj,bp->bi", points[0][1][:, :-1], J_rate, u, chains.mass)
    forces = [Q]
    for wheel, (along, _), last in zip(wheels, rows, (n - 1, body)):
        forces += [-wheel.mu[:, None] * along,
                   (wheel.mu * wheel.kappa)[:, None] * turns[last]]
    free, *by = np.moveaxis(np.linalg.solve(
        mass, np.stack(forces, axis=-1)), 2, 0)
    ahead = slips(q + 1j * STEP * u, u + 1j * STEP * free)
    now, numbers = slips(q, u), [wheel.kappa for wheel in wheels]
    for f in range(4):
        numbers += [now[f] * (f % 2) + DT * ahead[f].imag / STEP,
                    *(DT * dot(rows[f // 2][f % 2], one) for one in by)]
    return np.stack([*numbers, now[1], now[3]], axis=-1)


def follow(work: Path, _: str) -> None:
    """Counts all."""
    rows = []
    for kinds in KINDS:
        for one_body in (True, False):
            rng = np.random.default_rng([SEED, KINDS.index(kinds), one_body])
            given = systems(kinds, rng, one_body)
            said = subprocess.run(
                [work.parent / "several-program"], text=True, check=True,
                input="\n".join(" ".join(map(repr, row)) for row
                                in given.tolist()) + "\n",
                stdout=subprocess.PIPE).stdout
            found = np.array(said.split(), int).reshape(-1, len(NAMES))
            rows.append(pd.DataFrame(found, columns=NAMES).assign(
                freedoms=len(kinds), one_body=one_body))
    pd.concat(rows).to_csv(work / "several.csv", index=False)


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The table."""
    rows = table.read(work / "several.csv")
    several = rows.joint > 1
    found = {"several futures": several,
             "\"unique\", wrongly": several & (rows["product"] == 1),
             "another set": rows.same == 0,
             "not settled": rows.sweeps == SWEEPS}
    groups = {"all": rows.joint >= 0,
              "3 bodies": rows.freedoms == 3, "4 bodies": rows.freedoms == 4,
              "wheels on one body": rows.one_body,
              "wheels on two bodies": ~rows.one_body}
    return {"shares": pd.DataFrame([
        {"mechanisms": name, "drawn": which.sum(), **{
            what: table.share((of & which).sum(), which.sum()).text(2)
            for what, of in found.items()}}
        for name, which in groups.items()])}
