#!/usr/bin/python3 -B
"""SciPy's solvers on the motions of shared.c: reads and prints lines as
harness.h says; timed inside, so that the start of the interpreter does not
count.

    solve_ivp.py LIBRARY time

solve_ivp takes the place of an event off the polynomial of its step. That is
not used: a step to it from the one before, and Newton's rule, go to the switch,
or no tolerance would reach 1e-6.
"""
import ctypes
import math
import os
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

CALLS = 60000  # of the rates, after which a run is given up


class Motion:
    """A problem of the library."""

    def __init__(self, path: str, name: str, tol: float) -> None:
        self.of, self.calls = ctypes.CDLL(path), 0
        self.of.peer_open.restype = ctypes.c_double
        self.of.peer_error.restype = ctypes.c_double
        self.start = np.zeros(4)
        self.length = self.of.peer_open(name.encode(), ctypes.c_double(tol),
                                        self.start.ctypes)
        self.events = [self.margin(i) for i in range(3)] \
            if self.of.peer_jumps() else []

    def rates(self, _: float, y: np.ndarray) -> np.ndarray:
        self.calls += 1
        if self.calls > CALLS:
            raise ArithmeticError
        y, dy = np.ascontiguousarray(y), np.empty(4)
        self.of.peer_rates(y.ctypes, dy.ctypes)
        return dy

    def margin(self, i: int):
        """A mode ends where one of these falls through 0."""
        def value(_: float, y: np.ndarray) -> float:
            y, roots = np.ascontiguousarray(y), np.empty(3)
            self.of.peer_margins(y.ctypes, roots.ctypes)
            return roots[i]
        value.terminal, value.direction = True, -1
        return value

    def onto(self, i: int, y: np.ndarray) -> tuple[np.ndarray, float]:
        """A step of Newton's rule to a switch."""
        dy, off = self.rates(0, y), self.events[i](0, y)
        t = -1e-7 * off / (self.events[i](0, y + 1e-7 * dy) - off)
        return y + t * dy, t

    def solve(self, method: str, tol: float) -> np.ndarray:
        """The state at the end."""
        y, t = self.start, 0.0
        given = {"method": method, "rtol": tol, "atol": tol}
        for _ in range(1000):
            run = solve_ivp(self.rates, (t, self.length), y,
                            events=self.events, **given)
            if run.status == 0:
                return np.ascontiguousarray(run.y[:, -1])
            if run.status < 0:
                raise ArithmeticError
            which = next(i for i, at in enumerate(run.t_events) if len(at))
            before, t = run.t[-2:]
            if t > before:
                y = solve_ivp(self.rates, (before, t), run.y[:, -2],
                              first_step=t - before, **given).y[:, -1]
            for _ in range(2):
                y, step = self.onto(which, y)
                t += step
            now = ctypes.c_double(t)
            if not self.of.peer_change(which, ctypes.byref(now), y.ctypes):
                raise ArithmeticError
            t = now.value
        raise ArithmeticError


def main() -> None:
    rows = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # LSODA's remarks go to standard output
    for line in sys.stdin:
        problem, method, tol = line.split()
        begin, error = time.process_time(), math.inf
        motion = Motion(sys.argv[1], problem, float(tol))
        try:
            end = motion.solve(method, float(tol))
            error = motion.of.peer_error(end.ctypes)
        except (ArithmeticError, ValueError):
            pass
        print(f"{error:.3e},{1e9 * (time.process_time() - begin):.0f},"
              f"{'ok' if error < math.inf else 'refused'}",
              file=rows, flush=True)


if __name__ == "__main__":
    main()
