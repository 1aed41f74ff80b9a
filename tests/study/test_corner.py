"""Noise at h = g = 0: as many leave in slip- as by an Euler-Maruyama step of
one length, which shares nothing with corner.c, and stick- leaves below r_c.

Environment: CORNER the program, by default that of `make`.
"""
import math
import os
from pathlib import Path

import numpy as np
from tap import ROOT, check
from test_finer import study

CORNER = Path(os.environ.get("CORNER") or
              ROOT / "build/study/corner-program").resolve()
DT, SAMPLES, BEGIN, END = 5, 1000, 1e5, 1e6


def euler_maruyama(corner, r, of):
    """The share that leaves in slip- before it is in stick- for long. of: h and
    g of a unit of each noise."""
    of = np.array(of) / math.hypot(*(h for h, _ in of))
    field, random = corner.field_at(r), np.random.default_rng(3)
    g = np.full(SAMPLES, BEGIN)
    h, left = 0.02 * g, 0
    while len(g):
        noise = of.T @ random.normal(0, math.sqrt(DT), (len(of), len(g)))
        h, g = (x + rate * DT + by for x, rate, by in zip(
            (h, g), field(h, g), noise))
        leaves = (g > END) & (h < 0)
        left += leaves.sum()
        stays = ~leaves & (g > -20 * DT)
        h, g = h[stays], g[stays]
    return left / SAMPLES


def selected(_):
    """0.08 is four standard deviations of the difference."""
    corner = study("corner")
    r, s = 0.182, math.sqrt(0.5)
    on_v, on_omega = (s, s), ((r - 1) * s, -(r + 1) * s)
    for kind, of in ("v", [on_v]), ("v and omega", [on_v, on_omega]):
        found = corner.probability(CORNER, kind, r, 0.1, SAMPLES, 1)
        check(abs(found[0] - euler_maruyama(corner, r, of)) < 0.08, found)
    for off in -1e-5, 1e-5:
        r = corner.critical() + off
        b = corner.probability(CORNER, "v", r, 0.4, 1, 1)[-1]
        want = corner.stick(corner.field_at(r)).b
        check(b * off < 0 and abs(b - want) < 1e-8, b)


TESTS = [("corner: what noise selects", selected)]
