"""What the core numbers, as enumerations; `str` is the name that the command
line has."""
from __future__ import annotations

from enum import IntEnum


class _Named(IntEnum):
    def __str__(self):
        return (self.name.lower().replace("_plus", "+")
                .replace("_minus", "-"))

    def __format__(self, form):
        return format(str(self), form)


class Mode(_Named):
    """Of contact; + and - are the sign of h in slip, of g in stick."""
    SLIP_PLUS = 0
    SLIP_MINUS = 1
    STICK_PLUS = 2
    STICK_MINUS = 3
    PINNED = 4


class Law(_Named):
    """Of friction."""
    JUMP = 0
    COULOMB = 1
    TWO_PIECE = 2
    STRING = 3
    SMOOTH = 4
    NONE = 5


class Rule(_Named):
    """Which of several modes a step takes."""
    PERSIST = 0
    SLIP_PLUS = 1
    SLIP_MINUS = 2
    RANDOM = 3


class Rest(_Named):
    """The law at h = g = 0."""
    HULL = 0
    SQUARE = 1
    BOW_TIE = 2


class Scheme(_Named):
    """Of the steps; COMPENSATED keeps what rounding leaves out of a state."""
    MOREAU = 0
    LOCATED = 1
    COMPENSATED = 2


class Status(_Named):
    """Of a step: < 0 was refused, > 0 has a reservation."""
    STEP_TOO_LONG = -4
    DIVERGED = -3
    BAD_STATE = -2
    BAD_PARAMETER = -1
    OK = 0
    DEGRADED = 1
    FELL_BACK = 2
    COARSE = 3
    STALLED = 4


class Region(_Named):
    """Of h = 0."""
    SLIDING = 0
    ESCAPING = 1
    CROSSING_UP = 2
    CROSSING_DOWN = 3
    CODIM2 = 4


class Folds(_Named):
    """Which way the slips curve at a two-fold."""
    INVISIBLE = 0
    VISIBLE = 1
    VISIBLE_INVISIBLE = 2
    DEGENERATE = 3
    CONTINUOUS = 4

    def __str__(self):
        return self.name.lower().replace("_", "-")
