"""The chains of tools/study/mechanisms.py: Lagrange's equations, and two-folds
that are known: of the paper's machine by the core, of two castors by hand."""
import json

import numpy as np

from tap import call, check
from test_finer import near, study

# e, m, J, k, c, cp, kappa, mu, V; s, y, psi, y', psi'; J1, J2.
CASTORS = (((-.15594, 2.0677, .0056545, 4.068, .0609, .00178, .17152, 3.4405,
             .77967), (1, .49064, -.34044, -.09193, -1.11379),
            (-1.327, -1.467)),
           ((.00445, 4.3367, .000492, 740.8, 5.655, .0223, .02724, 13.24,
             .22395), (-1, .01403, 2.80998, -.0531, -5.1086), (-.792, -1.491)))


def chain(*values):
    """One mechanism: its kinds, then what they have."""
    return study("mechanisms").Chains(values[0], *(
        np.array([value], float) for value in values[1:]))


def ratios(mechanism, s, *x):
    """J1 and J2 at a state."""
    Kpp, Kmp, Kpm, Kmm = (float(K[0]) for K in mechanism.second(
        np.array([x[:2]]), np.array([x[2:]]), np.array([float(s)])))
    return Kmp / abs(Kpp * Kmm) ** 0.5, -Kpm / abs(Kpp * Kmm) ** 0.5


def lagrange(_):
    """(M u)' - d(u M u / 2)/dq = Q, without friction, of every kind."""
    m = study("mechanisms")
    for kinds in m.KINDS:
        rng, ahead = np.random.default_rng(1), 1j * m.STEP
        some = m.drawn(kinds, 50, rng)
        q, u = rng.normal(size=(2, 50, len(kinds)))

        def momentum(q, u, some=some):
            return np.einsum("bij,bj->bi", some.masses(some.points(q)[1])[0], u)

        _, free, _ = some.field(q, u, np.ones(50))
        off = momentum(q + ahead * u, u + ahead * free) - np.stack(
            [m.dot(u, momentum(q + ahead * one, u)) / 2
             for one in np.eye(len(kinds))], axis=1)
        off = np.abs(off.imag / m.STEP + some.k * q + some.c * u).max()
        check(off < 1e-9, f"{kinds}: off by {off}")


def two_folds(_):
    """Those of `chaos` are where the core has them, and are found."""
    of = dict(line.split()[:2] for line in call("scene", "chaos")[0]
              .splitlines() if len(line.split()) > 1)
    chaos = chain("RP", [[0, 0], [of["r0"], of["d"]]], [0, 0], [[0, 0]] * 2,
                  [0, of["m"]], [float(of["beta"]) ** 2, 0], [0, of["k2"]],
                  [of["c1"], of["c2"]], [0, 0], np.pi - float(of["gamma"]),
                  of["kappa"], of["mu"], [0, 0], of["omega0"])
    for one in json.loads(call("singularities", "chaos")[0])["two_folds"]:
        J1, J2 = ratios(chaos, np.sign(one["g"]), 0, one["r"] - float(of["r0"]),
                        one["omega"], one["v"])
        near(J1, one["J1"], 1e-7, "J1")
        near(J2, one["J2"], 1e-7, "J2")
    m = study("mechanisms")
    found = m.search(chaos, np.random.default_rng(1)).iloc[0]
    check(found.visible and found.case_1 and not found.mixed, str(found))


def castors(_):
    for (e, m, J, k, c, cp, kappa, mu, V), state, want in CASTORS:
        one = chain("PR", [[0, 0]] * 2, [np.pi / 2, 0], [[0, 0]] * 2, [0, m],
                    [0, J], [k, 0], [c, cp], [-e, 0], 0, kappa, mu, [-V, 0], 0)
        for got, J_of in zip(ratios(one, *state), want):
            near(got, J_of, 1e-3, f"J of the castor with a trail of {e} m")


TESTS = [(f"mechanisms: {test.__name__}", test)
         for test in (lagrange, two_folds, castors)]
