"""`make trolley`: two-folds of castors, motions through them by trolley.c
(which has the equations), and real castors."""
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd

import driven
import pictures
import table
from pictures import MODES, REGIONS, pyplot

# A castor, (u, s, behind) of a two-fold, and a time of its motion [s].
FORWARD = {"m": 2.0677, "J": 0.0056545, "kappa": 0.17152, "mu": 3.4405,
           "e": -0.15594, "k": 4.068, "c": 0.0609, "cp": 0.00178,
           "V": 0.77967}, (0.09193, 1, False), 0.05
BACKWARD = {"m": 4.3367, "J": 0.000492, "kappa": 0.02724, "mu": 13.24,
            "e": 0.00445, "k": 740.8, "c": 5.655, "cp": 0.0223,
            "V": 0.22395}, (-0.0531, -1, True), 0.004
# Name and source, trail [m], what kappa is below [m], J about the pin [kg m^2],
# m [kg]. kappa is a third of half the contact, which is shorter than the radius
# of a castor's wheel; of a bicycle's tyre the largest that was measured at 300
# to 500 N (Dell'Orto et al., Zenodo 7866646; fits in
# github.com/mechmotum/bicycle-kickplate-model, tire_data.py).
REAL = [("castor of a MiR 100 (github.com/DFKI-NI/mir_robot, mir_100_v1)",
         0.0382, 0.0625 / 3, 0.0027, 58),
        ("castor of a PMB2 (github.com/pal-robotics/pmb2_robot, caster_v2)",
         0.016, 0.025 / 3, 4.664e-5, 24.7),
        ("drive of a robot, motors off (kelo-drive-kd-100x of its maker; "
         "github.com/secorolab/eddie_description)",
         0.01, 0.0535 / 3, 0.01225, 76.8),
        ("benchmark bicycle (Meijaard et al., Proc. R. Soc. A 463, 2007)",
         0.08, 0.021, 0.29784, 94),
        ("bicycle Yellow, no rider (Moore, PhD, UC Davis 2012)",
         0.047, 0.021, 0.1656, 10.3)]
RANGES = {"m": (0.3, 30), "J": (1e-4, 0.1), "kappa": (0.005, 0.2),
          "mu": (0.1, 100), "k": (1, 1e4), "c": (0.01, 10), "cp": (1e-4, 0.1),
          "V": (0.1, 3)}
COUNT = 400000


def two_folds(q, u, s, behind):
    """The two-folds of castors at y' = u and what they are; the mirror image
    has -y, -psi, -u. s: sign of g; behind: psi > pi/2. Where `there` is False
    there is none."""
    square = -q.m * q.e * (q.e + s * q.kappa) / q.J
    C = np.sqrt(np.clip(square, 1e-12, 1)) * np.where(behind, -1, 1)
    S = np.sqrt(1 - C**2)
    w, g = (u * C - q.V * S) / q.e, q.V * C + u * S
    y = (q.m / C * w * (q.e * q.cp / q.J - g) - q.c * u) / q.k
    du, dw = -(q.k * y + q.c * u) / q.m, -q.cp * w / q.J
    free = (-(q.k * u + q.c * du) * C / q.m - du * S * w - dw * g -
            w * (q.e * w**2 + S * du) + q.e * q.cp * dw / q.J)
    dA = -2 * C * S * w / q.m
    D = C**2 / q.m * (q.c / q.m - q.cp / q.J + g / q.e + w * S / C)
    K = {(a, b): free + q.mu * (b * D - a * dA) for a in (1, -1)
         for b in (1, -1)}
    plus, minus = K[1, 1], K[-1, -1]
    invisible, visible = (plus < 0) & (minus > 0), (plus > 0) & (minus < 0)
    size = np.sqrt(np.abs(plus * minus))
    case = np.where(dA * D < 0, 3, np.where(dA < 0, 1, 2))
    return SimpleNamespace(
        there=(square > 0) & (square < 1) & (s * g > 0), y=y, psi=np.arccos(C),
        u=u, w=w, g=g, du=du, J1=K[-1, 1] / size, J2=-K[1, -1] / size,
        kind=np.where(invisible, case, np.where(visible, 4, 5)), plus=plus,
        minus=minus, share=-s * q.e / q.kappa, square=square)


KINDS = {1: "invisible, case 1", 2: "invisible, case 2", 3: "invisible, case 3",
         4: "visible", 5: "visible-invisible"}


def family(seed=1):
    """The two-folds within |y| < 1 m of random castors, each at one u."""
    draw = np.random.default_rng(seed)
    q = SimpleNamespace(e=draw.uniform(-0.3, 0.3, COUNT), **{
        name: low * (high / low) ** draw.random(COUNT)
        for name, (low, high) in RANGES.items()})
    u = q.V * draw.uniform(-1, 1, COUNT)
    found = [two_folds(q, u, s, behind) for s in (1, -1)
             for behind in (False, True)]
    return [np.concatenate([getattr(f, name)[f.there & (np.abs(f.y) < 1)]
                            for f in found])
            for name in ("kind", "share", "square", "g")]


def passing(values, place, time):
    """A start on the stick that passes a two-fold, `time` [s] after it: psi
    and u in first approximation, y so that lambda is that of passing."""
    (u, s, behind), q = place, SimpleNamespace(**values)
    f = two_folds(q, u, s, behind)
    stick = q.mu * (f.minus + f.plus) / (f.minus - f.plus)
    psi = f.psi + time * f.w
    u += time * (f.du - stick * np.cos(f.psi) / q.m)
    C, S = np.cos(psi), np.sin(psi)
    w, g = (u * C - q.V * S) / q.e, q.V * C + u * S
    A = C**2 / q.m + q.e * (q.e + s * q.kappa) / q.J
    y = (q.m / C * (w * (q.e * q.cp / q.J - g) - A * stick) - q.c * u) / q.k
    return {**values, "y": y, "psi": psi, "u": u}


def motion(trolley, **values):
    """The rows of a motion."""
    return table.parsed(driven.output(trolley, *(
        f"{name}={float(value)!r}" for name, value in values.items())))


def lasting(trolley, castor, steps):
    """For how many steps stick goes on behind the two-fold."""
    values, place, time = castor
    f = two_folds(SimpleNamespace(**values), *place)
    for share in np.linspace(0.9, 1.1, 7):
        m = motion(trolley, **passing(values, place, -share * time),
                   dt=time / steps, until=5 * time)
        passed = ((m.psi > f.psi) == (f.w > 0)).argmax()
        left = m["mode"].str.startswith("slip").argmax()
        if not 0 < passed < left:
            sys.exit("a stick does not pass its two-fold")
        yield round((m.t[left] - m.t[passed]) / time * steps)


def rows_of(trolley) -> pd.DataFrame:
    rows = []
    for name, castor in ("forward", FORWARD), ("backward", BACKWARD):
        values, (_, s, behind), time = castor
        f = two_folds(SimpleNamespace(**values),
                      np.linspace(-2, 2, 4001) * values["V"], s, behind)
        one = f.there & (f.kind == 1)
        rows += [(f"rolls {name}: case 1 along the curve of two-folds",
                  "y' %.3f to %.3f m/s, y %.3f to %.3f m" % (
                      *f.u[one][[0, -1]], *f.y[one][[0, -1]]))]
        rows += [(f"rolls {name}: stick behind the two-fold, dt = "
                  f"{1e6 * time / n:g} us", "%d to %d steps" % (min(steps),
                                                            max(steps)))
                 for n in (100, 1000, 10000)
                 for steps in [list(lasting(trolley, castor, n))]]
    kind, share, square, g = family()
    one = kind == 1
    rows += [(f"{COUNT} random castors, within 1 m of rest: {said}",
              np.sum(kind == n)) for n, said in KINDS.items()]
    rows += [("of case 1: roll forward", np.sum(g[one] > 0)),
             ("of case 1, 90 %: trail / kappa", "%.2g to %.2g" % tuple(
                 np.quantile(share[one], (0.05, 0.95)))),
             ("of case 1, 90 %: J over its least", "%.2f to %.2f" % tuple(
                 np.quantile(1 / square[one], (0.05, 0.95))))]
    rows += [(name, f"trail / kappa > {e / kappa:.2f}, two-folds take "
              f"{1 / (1 + J / (m * e**2)):.3f} to 1")
             for name, e, kappa, J, m in REAL]
    return pd.DataFrame(rows, columns=["what", "value"])


def picture(trolley, path: Path) -> None:
    """Left: regions of h = 0 and sticks through the two-fold, by the angle and
    h' without friction. Right: futures of one of them, by psi' and y."""
    values, place, time = FORWARD
    q = SimpleNamespace(**values)
    f = two_folds(q, *place)

    def inverse_mass(psi):
        return np.cos(psi)**2 / q.m + q.e * (q.e + q.kappa) / q.J
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.8))
    for name, low, high in ("sliding", -0.07, 0), ("escaping", 0, 0.13):
        psi = np.linspace(f.psi + low, f.psi + high)
        edge = q.mu * inverse_mass(psi)
        left.fill_between(np.degrees(psi), -edge, edge, lw=0, label=name,
                          color=REGIONS[name])
    start = {**passing(values, place, -time), "dt": 1e-3}
    for off in np.linspace(-0.02, 0.02, 5):
        m = motion(trolley, **{**start, "y": start["y"] + off, "until": 0.17})
        m = m[m["mode"] == "stick+"][1:]
        left.plot(np.degrees(m.psi), inverse_mass(m.psi) * m.F,
                  color=MODES["stick+"], lw=0.8)
    for leave in 0.06, 0.09, 0.12:
        for side in 1, -1:
            m = motion(trolley, **start, until=1.2, leave=leave, side=side,
                       every=4)
            for mode, colour in list(MODES.items())[:2]:
                right.plot(*np.where(m["mode"] == mode, (m.w, m.y),
                                     np.nan), color=colour, lw=0.8,
                           label=mode if (leave, side) == (0.06, 1) else None)
    for axes, x, y, across, up, place in (
            (left, np.degrees(f.psi), 0, "castor angle [degrees]",
             "h' without friction [m/s$^2$]", "upper left"),
            (right, f.w, f.y, "yaw rate of the castor [rad/s]",
             "displacement of the body [m]", "lower left")):
        axes.plot(x, y, "ko", ms=4, label="two-fold")
        axes.set(xlabel=across, ylabel=up)
        axes.legend(loc=place)
    pictures.save(figure, path)


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The table, and the picture. trolley.c is compiled beside `work`."""
    program = work.parent / "trolley-program"
    picture(program, kept / "trolley.svg")
    return {"castors": rows_of(program)}
