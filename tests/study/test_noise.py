"""Exits by noise: `twofold diverge` leaves as an explicit Euler-Maruyama step
does that shares nothing with it but the equations of the paper."""
import csv

import numpy as np
from scipy import stats
from tap import call, check

SIZE, SAMPLES, SECTION, LENGTH = 1e-5, 300, 1e-3, 0.37
KAPPA, K2, R0, C, BETA, GAMMA = (0.27241153714062028, 2.2270992253886014, 0.1,
                                 1e-3, 0.05, -3 * np.pi / 4)
FOLD = 0.1859, -0.037, -10.244253  # r, omega - omega0 and the slope there
BAND = 2e-6  # |h| of stick


def euler_maruyama(rng):
    """Phases of the winding at the section; NaN where there is none."""
    s, c, share = np.sin(GAMMA), np.cos(GAMMA), 2 / np.pi * np.arctan(6 * KAPPA)
    r = np.full(SAMPLES, FOLD[0] + 4e-3)
    z = FOLD[1] + FOLD[2] * (r - FOLD[0])
    p, t, peak = -r * z * c / s, 0 * r, 0 * r
    up, passed, phase = (np.full(SAMPLES, np.nan) for _ in range(3))
    h, g = -p * s - r * z * c, -p * c + r * z * s
    for _ in range(60000):
        if (~np.isnan(phase) | (t > LENGTH)).all():
            break
        dt = np.clip(0.05 * np.hypot(h, g), 1e-8, 1e-5)
        T = np.tan(share * np.arctan2(np.abs(g), np.abs(h)))
        F = np.sign(h) * (4 / 3 - T / (18 * KAPPA))
        w, v, J = z - 1, p + z, BETA ** 2 + r ** 2
        Q = K2 * (R0 - r) - C * v + r * w * w
        spin = (-C * w - 2 * r * v * w + Q + F * r * c
                + T / 6 * np.sign(g) * np.sign(h)) / J
        r, z, t, before = r + dt * v, z + dt * spin, t + dt, h
        p = p + dt * (Q + F * s) - SIZE / s * np.sqrt(dt) * rng.normal(
            size=SAMPLES)
        h, g = -p * s - r * z * c, -p * c + r * z * s
        passed = np.where(np.isnan(passed) & (r < FOLD[0] - SECTION), t, passed)
        peak = np.maximum(peak, np.abs(h))
        rises = (before < 0) & (h >= 0) & (peak > BAND)
        whole = rises & np.isnan(phase) & (up <= passed)
        phase = np.where(whole, (passed - up) / (t - up), phase)
        up, peak = np.where(rises, t, up), np.where(rises, 0, peak)
    return phase


def exits(folder):
    """As many have a phase, and of one law."""
    mine = euler_maruyama(np.random.default_rng(7))
    call("diverge", "chaos", "--by", "noise", "--size", SIZE,
         "--samples", SAMPLES, "--patience", "0.25",
         "--exits", folder / "exits", "--returns", folder / "returns")
    lines = [line for line in (folder / "exits").read_text().splitlines()
             if not line.startswith("#")]
    theirs = [float(row["phase"] or "nan") for row in csv.DictReader(lines)]
    for found in mine, theirs:
        check(np.isnan(found).mean() < 0.03, "some rest at h = g = 0")
    found = stats.ks_2samp(*(np.array(one)[~np.isnan(one)]
                             for one in (mine, theirs)))
    check(found.pvalue > 1e-3, found)


def returns(_):
    """0.345 come back within 3 s, by the law of return; four deviations. By
    steps that are shares of the distance to h = g = 0 it was 0.5 to 0.6."""
    out = call("diverge", "chaos", "--by", "noise", "--size", SIZE,
               "--samples", SAMPLES)[0]
    times = [float(row["time"]) for row in csv.DictReader(out.splitlines())]
    soon = np.mean(np.array(times) < 3)
    check(len(times) == SAMPLES and abs(soon - 0.345) < 0.11, soon)


TESTS = [("noise: exits as by Euler-Maruyama", exits),
         ("noise: returns as by the law of return", returns)]
