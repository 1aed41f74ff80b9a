"""h = g = 0 by boundary value problems: a half-range problem has the chances of
an Euler-Maruyama step, whole paths those of `make corner`."""
import math

import euler
from tap import check
from test_finer import study

BEGIN, LOW, HIGH = -0.5, -1, 1


def near_zero(_):
    """Four standard deviations, and a twentieth for the step's error."""
    half = study("halfrange")
    field = half.field_at(0.1836)
    u, h = half.grid(LOW, HIGH, 0.025, 0.04), half.grid(-60, 60, 0.025, 0.06)
    u[u < 0] *= LOW / u[0]
    u[u > 0] *= HIGH / u[-1]
    P = half.value(half.solve(field, u, h, 1, 1, lambda _: (0, 0)), u, h,
                   (BEGIN, 0))
    found = euler.crosses(0.1836, 0.01, BEGIN, LOW, HIGH)
    check(abs(P - found) < 4 * math.sqrt(P / euler.SAMPLES) + P / 20,
          (P, found))


def whole(_):
    """Against 0.343 (0.005) of `make corner`; and a rest grows as 1/b."""
    half = study("halfrange")
    check(abs(half.selected(half.field_at(0.182), 0.16) - 0.346) < 0.015,
          "chance of slip-")
    times = [half.rests(half.field_at(r), 0.12) * half.stick(half.field_at(r)).b
             for r in (0.1834, 0.1836)]
    check(-2e6 < times[0] < times[1] < -1e6, times)


TESTS = [("halfrange: near h = g = 0 as by Euler-Maruyama", near_zero),
         ("halfrange: chance of slip- and rest of chaos", whole)]
