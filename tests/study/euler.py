#!/usr/bin/python3 -B
"""Noise of size 1 on v at h = g = 0 of `chaos`, by explicit steps of Euler and
Maruyama of one length. It shares nothing with tools but the paper's equations.

usage: tests/study/euler.py selected R DT N_G   the share that leaves in slip-
       tests/study/euler.py stick R DT          of stick-: b, s^2 (errors), c
"""
import math
import sys

import numpy as np

KAPPA, BETA, GAMMA = 0.27241153714062028, 0.05, -3 * math.pi / 4
SAMPLES, BEGIN, END = 2000, 1e5, 3e5
LONG, FROM = 2000, -1500  # time of stick-, and where it begins


class Motion:
    """Many of them: h and g, with slider and disc at rest on the turntable."""

    def __init__(self, r, dt, h, g, n_g=1):
        self.r, self.J, self.dt, self.n_g = r, BETA ** 2 + r * r, dt, n_g
        self.spring = 2.2270992253886014 * (0.1 - r) + r
        self.h, self.g = h + np.zeros(SAMPLES), g + np.zeros(SAMPLES)
        self.random = np.random.default_rng(1)

    def rates(self):
        """h' and g', from p' = (v - d w)' and r w'."""
        T = np.tan(2 / math.pi * math.atan(6 * KAPPA)
                   * np.arctan2(abs(self.g), abs(self.h)))
        F = np.sign(self.h) * (4 / 3 - T / (18 * KAPPA))
        M = np.sign(self.h * self.g) * T / 6
        s, c = math.sin(GAMMA), math.cos(GAMMA)
        p = self.spring + F * s
        q = self.r / self.J * (self.spring + 1e-3 + F * self.r * c + M)
        return -p * s - q * c, q * s - p * c

    def step(self):
        h, g = self.rates()
        noise = math.sqrt(self.dt) * self.random.normal(size=len(self.h))
        self.h, self.g = (self.h + h * self.dt + noise,
                          self.g + g * self.dt + self.n_g * noise)

    def keep(self, which):
        self.h, self.g = self.h[which], self.g[which]


def selected(r, dt, n_g=1):
    """Of motions that arrive in slip+. n_g: -1 where dv = domega 1 m."""
    motion, left = Motion(r, dt, 0.02 * BEGIN, BEGIN, n_g), 0
    while len(motion.g):
        motion.step()
        leaves = (motion.g > END) & (motion.h < 0)
        left += leaves.sum()
        motion.keep(~leaves & (motion.g > -20 * dt - 300 * (n_g < 0)))
    return left / SAMPLES, math.sqrt(left * (SAMPLES - left) / SAMPLES ** 3)


def crosses(r, dt, begin, low, high):
    """The share that comes from u = g - h = begin to high before low."""
    motion, up = Motion(r, dt, 0, begin), 0
    while len(motion.g):
        motion.step()
        u = motion.g - motion.h
        up += (u >= high).sum()
        motion.keep((u > low) & (u < high))
    return up / SAMPLES


def stick(r, dt):
    """b and s^2 of |g|; c is what |g| adds to the mean rate, by |g|."""
    far = [Motion(r, dt, h, -1e9).rates() for h in (1e-9, -1e-9)]
    (h_up, g_up), (h_down, g_down) = ((h[0], g[0]) for h, g in far)
    K = (g_up - g_down) / (h_up - h_down)
    motion, added, steps = Motion(r, dt, 0, FROM), 0, round(LONG / dt)
    for _ in range(steps):
        h, g = motion.rates()
        added += np.mean((K * (h - h_up) - g + g_up) * -motion.g)
        motion.step()
    went = FROM - motion.g
    b, s2 = went.mean() / LONG, went.var() / LONG
    return (b, math.sqrt(s2 / LONG / SAMPLES), s2, s2 * math.sqrt(2 / SAMPLES),
            added / steps)


if __name__ == "__main__":
    print(*{"selected": selected, "stick": stick}[sys.argv[1]](
        *map(float, sys.argv[2:])))
