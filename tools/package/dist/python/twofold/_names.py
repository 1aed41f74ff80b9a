"""The core's numbered names as enumerations. `str` gives the name on the
command line; a member can be made from that name, and equals it."""
from __future__ import annotations

from enum import IntEnum


class _Named(IntEnum):
    def __str__(self):
        return (self.name.lower().replace("_plus", "+")
                .replace("_minus", "-"))

    def __format__(self, form):
        return format(str(self), form)

    def __repr__(self):
        return f"{type(self).__name__}({str(self)!r})"

    def __eq__(self, other):
        return other in (str(self), self.name) if isinstance(other, str) \
            else int(self) == other

    def __ne__(self, other):
        return not self == other

    __hash__ = int.__hash__

    @classmethod
    def _missing_(cls, value):
        return next((one for one in cls if one == value), None)


class Mode(_Named):
    """Modes of contact. + and - are the sign of h in slip, of g in stick."""
    SLIP_PLUS, SLIP_MINUS, STICK_PLUS, STICK_MINUS, PINNED = range(5)


class Law(_Named):
    """Friction laws."""
    JUMP, COULOMB, TWO_PIECE, STRING, SMOOTH, NONE = range(6)


class Rule(_Named):
    """Rules that choose one of several modes of a step."""
    PERSIST, SLIP_PLUS, SLIP_MINUS, RANDOM = range(4)


class Rest(_Named):
    """Laws at h = g = 0."""
    HULL, SQUARE, BOW_TIE = range(3)


class Scheme(_Named):
    """Time steps. COMPENSATED carries the rounding errors of the state
    along."""
    MOREAU, LOCATED, COMPENSATED = range(3)


class Status(_Named):
    """Results of a step: < 0 refused, > 0 taken with a reservation."""
    STEP_TOO_LONG, DIVERGED, BAD_STATE, BAD_PARAMETER = range(-4, 0)
    OK, DEGRADED, FELL_BACK, COARSE, STALLED = range(5)


class Region(_Named):
    """Regions of h = 0."""
    SLIDING, ESCAPING, CROSSING_UP, CROSSING_DOWN, CODIM2 = range(5)


class Folds(_Named):
    """Which way the slips curve at a two-fold."""
    INVISIBLE, VISIBLE, VISIBLE_INVISIBLE, DEGENERATE, CONTINUOUS = range(5)

    def __str__(self):
        return self.name.lower().replace("_", "-")
