"""`make cart`: the example cart.c of the packages, stepped by contacts.h alone,
against an event-driven solver that shares no code with it (scipy): by dt errors
of angles and of the energy from START, where the second castor passes from slip
to slip, and from FAN on in each joint future; a picture of these."""
from __future__ import annotations

from pathlib import Path

import driven
import numpy as np
import pandas as pd
import pictures
from scipy.integrate import solve_ivp

m, k, c, I, ka = 4.3367, 740.8, 5.655, 0.3, 50
J, cp, e, V, mu, kappa = 0.000492, 0.0223, 0.00445, 0.22395, 13.24, 0.02724
place = np.array([0.3, -0.2])
A = 2 / np.pi * np.arctan(6 * kappa)
SLIPS = "slip+", "slip-"
# Index of the joint future, y, a, psi, psi.
START = 0, 0.03, 0.05, 2.9, 2.6
FAN = [(i, 0.206, -0.017, 1.976, 1.95) for i in range(9)]
TANGENT = 1e-4  # h' [m/s^2] of a slip into which a stick turns


def start(y: float, a: float, *psi: float) -> np.ndarray:
    """y, a, psi, psi, and their rates."""
    return np.r_[y, a, psi, 0, 0, -V * np.sin(psi) / e]


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
                rate * (1 if mode == "slip+" else -1) > TANGENT:
            found.append(now)
    return found


def motion(z, t, modes, until):
    """Modes where they change, time and state at the end: where a contact has
    several futures, or at `until`."""
    changes = [tuple(modes)]
    for _ in range(9):
        ends = [lambda _, z, i=i: slips(z)[0][i] if modes[i] in SLIPS else
                mu - abs(forces(z, modes)[0][i]) for i in (0, 1)]
        for end, mode in zip(ends, modes):
            end.terminal, end.direction = True, 1 if mode == "slip-" else -1
        done = solve_ivp(lambda _, z: rates(z, *forces(z, modes)), (t, until),
                         z, events=ends, method="LSODA",
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


def against(program, dt, until, *given):
    """Of a future: its first modes, angles and energy, the same by the other
    solver, whether all modes are the same."""
    *rows, end = driven.output(program, *map(str, (dt, until, *given))
                               ).splitlines()
    found = [tuple(row.replace(",", "").split()[2:4]) for row in rows]
    changes, _, exact = motion(start(*given[1:]), 0, list(found[0]), until)
    return (found[0], np.array(end.split()[2:], float),
            np.r_[exact[2:4], energy(exact)], found == changes)


def picture(program: Path, path: Path) -> None:
    """The futures of FAN by how far they turn from that in which both stick."""
    figure, axes = pictures.pyplot.subplots(figsize=(4.6, 4))
    times = np.arange(1e-5, 6.02e-3, 1e-4)
    psi = np.array([[against(program, 1e-5, t, *run)[1][:2] for t in times]
                    for run in FAN])
    for run, off in zip(FAN, np.degrees(psi - psi[-1])):
        modes, _, exact, _ = against(program, 1e-5, times[-1], *run)
        colour = pictures.MODES[modes[0]]
        axes.plot(*off.T, color=colour)
        axes.plot(*np.degrees(exact[:2] - psi[-1, -1]), ".", color=colour)
        below = -0.05 if off[-1, 1] < -0.1 else 0.02
        if off[-1].any():
            axes.annotate(", ".join(modes), off[-1] + (0, below), ha="center")
    said = "turn of castor %d past that where both stick [degrees]"
    axes.set(xlabel=said % 1, ylabel=said % 2, xlim=(-0.5, 0.4),
             ylim=(-0.45, 0.4))
    pictures.save(figure, path)


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The table, and the picture. cart.c is compiled beside `work`."""
    rows, program = [], work.parent / "cart-program"
    picture(program, kept / "cart.svg")
    for dt in 4e-4, 1e-4, 2.5e-5, 6.25e-6:
        for until, runs in (0.06, [START]), (0.01, FAN):
            of = [against(program, dt, until, *run) for run in runs]
            off = np.max([abs(end - exact) for _, end, exact, _ in of], axis=0)
            rows.append((f"{len(runs)} until {until} s, dt = {dt:g} s",
                         *map("{:.2g}".format, off),
                         all(same for *_, same in of)))
    plus = driven.output(work.parent / "cart-plus")
    rows.append(("C and C++", "", "", "", driven.output(program) == plus))
    return {"motions": pd.DataFrame(rows, columns=[
        "futures", "error of psi [rad]", "of psi [rad]", "of the energy [J]",
        "alike"])}
