"""Laws of the motions of tools/study/trolley.c: they are those of an
event-driven solver, in vectors of the plane and with the paper's own formulas
of the slip angle. It follows random castors next to two-folds of case 1.

Environment: TROLLEY the program, by default that of `make`.
"""
import math
import os
import sys
from pathlib import Path
from types import SimpleNamespace

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from tap import ROOT, call, check, same  # noqa: E402
from test_finer import study  # noqa: E402

try:
    import numpy as np
    from scipy.integrate import solve_ivp
except ModuleNotFoundError:
    np = None  # study() says what is missing

TROLLEY = str(Path(os.environ.get("TROLLEY") or
                   ROOT / "build/study/trolley-program").resolve())
SIDES = {"slip+": 1, "slip-": -1, 1: 1, -1: -1}


def across(a):
    """A vector turned by a right angle."""
    return np.array([-a[1], a[0]])


class Castor(SimpleNamespace):
    """State z: y, psi, y', psi'. A slip is called by the sign of h, stick 0."""

    def contact(self, z):
        """Arm from the pin, velocity, direction and axle of the wheel."""
        along = np.array([math.cos(z[1]), math.sin(z[1])])
        arm = -self.e * along
        return (arm, np.array([self.V, z[2]]) + z[3] * across(arm), along,
                across(along))

    def slip(self, z):
        _, v, along, axle = self.contact(z)
        return v @ axle, v @ along

    def rate(self, z, force, moment):
        arm, _, _, axle = self.contact(z)
        push = -force * axle
        torque = arm[0] * push[1] - arm[1] * push[0] + moment
        return np.array([z[2], z[3],
                         (push[1] - self.k * z[0] - self.c * z[2]) / self.m,
                         (torque - self.cp * z[3]) / self.J])

    def slip_rate(self, z, force, moment):
        """h'"""
        arm, v, _, axle = self.contact(z)
        _, _, pull, spin = self.rate(z, force, moment)
        turning = z[3] * across(arm)
        a = np.array([0, pull]) + spin * across(arm) + z[3] * across(turning)
        return a @ axle + v @ (z[3] * across(axle))

    def limit(self, z, share):
        """Force and moment of stick, of slip where h comes to 0."""
        force = share * self.mu
        return force, math.copysign(self.kappa, self.slip(z)[1]) * force

    def law(self, z, side):
        h, g = self.slip(z)
        least = math.atan(1 / (6 * self.kappa))
        angle = least + abs(1 - 2 / math.pi * least) * math.atan2(abs(h),
                                                                  abs(g))
        cot = 1 / math.tan(angle)
        return (side * self.mu * (4 / 3 - cot / (18 * self.kappa)),
                side * math.copysign(self.mu / 6 * cot, g))

    def slopes(self, z):
        """h' of slip+ and slip- at h = 0."""
        return [self.slip_rate(z, *self.limit(z, side)) for side in (1, -1)]

    def stiffness(self, z):
        """2 mu A: by how much the slips approach; < 0 where they part."""
        plus, minus = self.slopes(z)
        return minus - plus

    def field(self, z, mode):
        if mode:
            return self.rate(z, *self.law(z, mode))
        plus, minus = self.slopes(z)
        share = (plus + minus) / (minus - plus)
        return self.rate(z, *self.limit(z, share))

    def with_h(self, y, psi, u, h=0):
        """The state with this h, which is affine in psi'."""
        at_0, at_1 = (self.slip([y, psi, u, w])[0] for w in (0, 1))
        return np.array([y, psi, u, (at_0 - h) / (at_0 - at_1)])

    def second(self, z, a, b):
        """The change of h' of slip a along the field of slip b."""
        f = 1e-4 * self.rate(z, *self.limit(z, b))
        return (self.slip_rate(z + f, *self.limit(z, a)) -
                self.slip_rate(z - f, *self.limit(z, a))) / 2e-4

    def near(self, fold, time):
        """A state with h = 0 and the lambda with which stick passes a two-fold,
        next to it; h' is affine in y."""
        plus, minus = (self.second(fold, a, a) for a in (1, -1))
        psi, share = fold[1] + time * fold[3], (minus + plus) / (minus - plus)
        at_0, at_1 = (self.slip_rate(z, *self.limit(z, share)) for z in (
            self.with_h(y, psi, fold[2]) for y in (0, 1)))
        return self.with_h(at_0 / (at_0 - at_1), psi, fold[2])

    def follow(self, z, mode, until, fold=False):
        """The state at `until`, or at the two-fold that a stick comes to, and
        the modes on the way. To a two-fold, where stick divides by `stiffness`,
        the time of integration is multiplied by it: without, steps that jump
        over the pole are taken for good (errors to 1e-4)."""
        t, modes, whole = 0.0, [mode], self.stiffness(z)
        while t < until:
            passes = fold and not mode

            def rate(_, at, mode=mode, passes=passes):
                z = at[:4]
                if not passes:
                    return [*self.field(z, mode), 1]
                free, full = (self.rate(z, *self.limit(z, n)) for n in (0, 1))
                slow = self.stiffness(z)
                return np.array([*slow * free + sum(self.slopes(z)) *
                                 (full - free), slow]) / whole

            def event(_, at, mode=mode, passes=passes):
                z = at[:4]
                if passes:
                    return self.stiffness(z) - 1e-8 * whole
                # slip begins at 0, up to rounding
                return (mode * self.slip(z)[0] + 1e-14 if mode else
                        -np.prod(self.slopes(z)))
            event.terminal, event.direction = True, -1
            done = solve_ivp(rate, (t, math.inf if passes else until), [*z, t],
                             "DOP853", rtol=1e-11, atol=1e-13,
                             max_step=math.inf if passes else until / 40,
                             events=event)
            z, t = done.y[:4, -1], done.y[4, -1]
            if done.status == 0:
                break
            if passes:  # a straight line meets A = 0
                f = self.field(z, 0)
                ahead = self.stiffness(z + 1e-8 * f)
                return z + f / (1 - ahead / (1e-8 * whole)) * 1e-8, modes
            z = self.with_h(*z[:3])
            plus, minus = self.slopes(z)
            if mode:
                mode = 0 if plus < 0 < minus else -mode
            else:  # one slip is tangent: out of sliding that one
                tangent = 1 if abs(plus) < abs(minus) else -1
                mode = tangent if plus < minus else -tangent
            modes.append(mode)
        return z, modes


def castors(count):
    """Castors by turns forward and backward, a two-fold of case 1 of each, and
    the time in which it rolls its trail. No motion of these comes to h = g = 0,
    where another future would be as right."""
    two_folds = study("trolley").two_folds
    for n in range(count):
        s, f, tries = 1 - n % 2 * 2, None, 0
        while not (f and f.there and f.kind == 1 and f.J1 * f.J2 > 1.2 and
                   abs(f.y) < 1 and abs(f.g) > 0.05):
            draw, tries = np.random.default_rng([4, n, tries]), tries + 1
            low = dict(m=1, kappa=0.02, mu=1, k=3, c=0.01, cp=1e-4, V=0.2)
            q = Castor(**{name: value * 10 ** draw.uniform(0, 1)
                          for name, value in low.items()})
            q.e = -s * q.kappa * draw.uniform(0.1, 0.95)
            q.J = -q.m * q.e * (q.e + s * q.kappa) * draw.uniform(1.02, 2)
            f = two_folds(q, q.V * draw.uniform(-1, 1), s, n % 2 == 1)
        yield q, f, np.array([f.y, f.psi, f.u, f.w]), abs(q.e / f.g)


def motion(castor, z, **more):
    """The columns of a motion of the program that starts at z."""
    return study("trolley").motion(TROLLEY, **vars(castor), y=z[0], psi=z[1],
                                   u=z[2], **more)


def states(rows):
    return np.array([rows[name] for name in ("y", "psi", "u", "w")]).T


def slips(modes):
    """The sides by turns. Stick between is left out: where A > 0, slip of the
    program crosses h = 0 by a step of it."""
    sides = [SIDES[mode] for mode in modes if mode in SIDES]
    return [b for a, b in zip([0, *sides], sides) if a != b]


def numbers(_):
    """Place, J1 and J2 of two-folds in closed form."""
    for castor, f, z, _ in castors(12):
        off = max(map(abs, [castor.slip(z)[0], *castor.slopes(z)]))
        check(off < 1e-9, f"{castor}: no two-fold, {off}")
        K = {(a, b): castor.second(z, a, b) for a in (1, -1) for b in (1, -1)}
        check(K[1, 1] < 0 < K[-1, -1], f"{castor}: {K}")
        size = math.sqrt(-K[1, 1] * K[-1, -1])
        for got, want in (f.J1, K[-1, 1]), (f.J2, -K[1, -1]):
            check(abs(got * size / want - 1) < 1e-4, f"{castor}: {got}, {K}")


def arrivals(_):
    """Slip lands in stick, which passes its two-fold: where, to 1e-6, with an
    error of order 2. h of stick is 0 to the third
    order of the angle of a step."""
    orders = []
    for castor, _, fold, time in castors(12):
        start = castor.near(fold, -0.1 * time)
        rows = motion(castor, start, dt=time / 50, until=0.1 * time)
        turn = np.abs(np.diff(rows["psi"])).max()
        check(np.abs(rows["h"]).max() < castor.V * turn ** 3 + 1e-15,
              f"{castor}: {turn}, {rows}")
        slow = 2e-3 * time * castor.stiffness(start)
        for side in 1, -1:
            want, modes = castor.follow(castor.with_h(*start[:3], side * slow),
                                        side, time, True)
            errors = []
            for steps in 125, 2000, 8000:
                rows = motion(castor, start, dt=time / steps, h=side * slow,
                              until=0.3 * time)
                i = int(np.argmax((rows["psi"] - fold[1]) * fold[3] > 0))
                z, after = states(rows)[i - 1:i + 1]
                got = z + (fold[1] - z[1]) / (after[1] - z[1]) * (after - z)
                errors.append(np.abs(got - want).max())
            same(slips(rows["mode"][:i]), slips(modes))
            check(modes[-1] == 0 and errors[2] < 1e-6, f"{castor}: {errors}")
            orders.append(math.log(errors[0] / errors[1], 16))
    check(abs(np.median(orders) - 2) < 0.25, f"orders {orders}")


def exits(_):
    """Stick out of a two-fold that ends by slip to either side, and what
    follows: the same slips, to 1e-6, of order 2; 1 where no step is split."""
    orders = {0: [], 1: []}
    for castor, _, fold, time in castors(6):
        start = castor.near(fold, 0.1 * time)
        left, _ = castor.follow(start, 0, 0.01 * time)
        for side in 1, -1:
            want, modes = castor.follow(left, side, 0.3 * time)
            for split, orders_of in orders.items():
                errors = []
                for steps in 2000, 64000:
                    rows = motion(castor, start, dt=time / steps, split=split,
                                  leave=0.01 * time, side=side, every=1e9,
                                  until=0.31 * time)
                    same(slips(rows["mode"]), slips(modes))
                    errors.append(np.abs(states(rows)[-1] - want).max())
                check(not split or errors[1] < 1e-6,
                      f"{castor} side={side}: {errors}")
                if len(modes) > 1:
                    orders_of.append(math.log(errors[0] / errors[1], 32))
    got = [np.median(orders[split]) for split in (0, 1)]
    check(len(orders[1]) > 6 and abs(got[0] - 1) < 0.25 and
          abs(got[1] - 2) < 0.25, f"orders {got} of {orders}")


def names(_):
    """A name that is none, and values that are none, are told."""
    for word in ("colour=1", "dt=0", "dt=inf", "until=nan", "until=1e9",
                 "m=0", "J=-1"):
        said, error = call(word, code=2, program=TROLLEY)
        check(said == "" and word.split("=")[0] in error, f"{said}{error}")


TESTS = [("trolley: two-folds are those by differences", numbers),
         ("trolley: slip lands in stick, stick passes its two-fold", arrivals),
         ("trolley: both exits, and what follows", exits),
         ("trolley: what it refuses is told", names)]
