"""`make cart`: the example cart.c of the packages, stepped by contacts.h alone,
against an event-driven solver that shares no code with it (scipy). A table: by
dt the error of the angle of the second castor after 0.06 s, which passes from
slip to slip, and of the energy. cart.c is compiled beside `work`, in C and C++.
"""
from __future__ import annotations

import re
from pathlib import Path

import driven
import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp

m, k, c, I, ka = 4.3367, 740.8, 5.655, 0.3, 50
J, cp, e, V, mu, kappa = 0.000492, 0.0223, 0.00445, 0.22395, 13.24, 0.02724
place = np.array([0.3, -0.2])
A = 2 / np.pi * np.arctan(6 * kappa)
SLIPS = "slip+", "slip-"


def start() -> np.ndarray:
    """y, a, psi, psi, and their rates."""
    psi = np.array([2.9, 2.6])
    return np.r_[0.03, 0.05, psi, 0, 0, -V * np.sin(psi) / e]


def energy(z):
    return (np.array([k, ka, 0, 0, m, I, J, J]) * z ** 2).sum() / 2


def slips(z):
    u = z[4] + place * z[5]
    return (u * np.cos(z[2:4]) - V * np.sin(z[2:4]) - e * z[6:8],
            V * np.cos(z[2:4]) + u * np.sin(z[2:4]))


def law(side, h, g):
    """F and M of slip, of the paper."""
    T = np.tan(A * np.arctan2(abs(g), max(side * h, 0)))
    return (side * mu * (4 / 3 - T / (18 * kappa)),
            side * np.sign(g) * mu * T / 6)


def rates(z, F, M):
    side = F * np.cos(z[2:4])
    v = (-k * z[0] - c * z[4] - side.sum()) / m
    va = (-ka * z[1] - (place * side).sum()) / I
    return np.r_[z[4:8], v, va, (e * F + M - cp * z[6:8]) / J]


def change(z, F, M):
    """h' of both, by a difference along the motion."""
    d = rates(z, F, M)
    return (slips(z + 1e-7 * d)[0] - slips(z - 1e-7 * d)[0]) / 2e-7


def forces(z, modes):
    """F and M of slip and of stick, whose h' is 0."""
    h, g = slips(z)
    F, M = np.zeros(2), np.zeros(2)
    for i, mode in enumerate(modes):
        if mode in SLIPS:
            F[i], M[i] = law(1 if mode == "slip+" else -1, h[i], g[i])
    stick = [i for i, mode in enumerate(modes) if mode not in SLIPS]
    free = change(z, F, M)
    by = np.zeros((2, 2))
    for i in stick:
        one = np.zeros(2)
        one[i] = 1
        by[:, i] = change(z, F + one, M + one * np.sign(g[i]) * kappa) - free
    if stick:
        at = np.ix_(stick, stick)
        F[stick] = np.linalg.solve(by[at], -free[stick])
        M[stick] = np.sign(g[stick]) * kappa * F[stick]
    return F, M


def futures(z, modes, i):
    """The modes of contact i at h_i = 0 whose fields agree with them."""
    found = []
    g = slips(z)[1][i]
    for mode in ("slip+", "slip-", "stick+" if g > 0 else "stick-"):
        now = [mode if j == i else was for j, was in enumerate(modes)]
        F, M = forces(z, now)
        rate = change(z, F, M)[i]
        if abs(F[i]) <= mu if mode not in SLIPS else \
                (rate > 0) == (mode == "slip+"):
            found.append(now)
    return found


def motion(z, t, modes, until):
    """Modes where they change, time and state at the end: where a contact has
    several futures, or at `until`."""
    changes = [tuple(modes)]
    for _ in range(9):
        def left(i):
            def event(_, z):
                if modes[i] in SLIPS:
                    return slips(z)[0][i]
                return mu - abs(forces(z, modes)[0][i])
            event.terminal = True
            event.direction = {"slip+": -1, "slip-": 1}.get(modes[i], -1)
            return event
        done = solve_ivp(lambda _, z: rates(z, *forces(z, modes)), (t, until),
                         z, events=[left(0), left(1)], method="LSODA",
                         rtol=1e-9, atol=1e-11, max_step=1e-3)
        t, z = done.t[-1], done.y[:, -1]
        hit = [i for i in (0, 1) if len(done.t_events[i])]
        if not hit or t >= until:
            break
        found = futures(z, modes, hit[0])
        if modes[hit[0]] not in SLIPS:
            found = [now for now in found if now != modes]
        if len(found) != 1:
            break
        modes = found[0]
        changes.append(tuple(modes))
    return changes, t, z


def stepped(program, dt, until, *index):
    """Times of changes of modes, these, how many; y, a, psi, psi, energy."""
    *rows, end = driven.output(program, *map(str, (dt, until, *index))
                               ).splitlines()
    found = [re.fullmatch(r"(\S+) s (\S+) (\S+), of (\d+)", row).groups()
             for row in rows]
    return ([(float(t), of) for t, *of in found],
            np.array([float(x) for x in end.split()]))


def rows_of(program, plus) -> pd.DataFrame:
    rows = []
    first = ["stick-", "slip-"]
    changes, _, exact = motion(start(), 0, first, 0.06)
    for dt in 4e-4, 1e-4, 2.5e-5, 6.25e-6:
        found, end = stepped(program, dt, 0.06)
        same = [tuple(of[:2]) for _, of in found] == changes
        rows.append((f"error at dt = {dt:g} s",
                     f"{abs(end[:4] - exact[:4])[3]:.2g}" + " *" * (not same),
                     f"{end[4] - energy(exact):.2g}"))
    same = driven.output(program) == driven.output(plus)
    rows += [("energy then", "", f"{energy(exact):.3g}"),
             ("C and C++ alike", str(same), "")]
    return pd.DataFrame(rows, columns=["what", "of an angle [rad]",
                                       "of the energy [J]"])


def count(work: Path, _: Path) -> dict[str, pd.DataFrame]:
    """The table."""
    place = work.parent
    return {"motions": rows_of(place / "cart-program", place / "cart-plus")}
