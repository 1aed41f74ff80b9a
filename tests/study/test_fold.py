"""Noise at a two-fold: both sides are equally likely where N keeps the rate of
stick, and slip+ is the likelier one in `chaos`."""
import math

from tap import TWOFOLD, check
from test_finer import study


def sides(_):
    """Four standard deviations."""
    fold = study("fold")
    chaos = fold.of_chaos(TWOFOLD)
    for rates, share in ((fold.Fold(1, -0.5, -0.5), 0.5), (chaos, 0.575)):
        found = fold.exits(rates, 4e-3, 4000, seed=1).iloc[-1]
        check(abs(found.up / found.n - share) < 2 / math.sqrt(found.n), found)
    check(abs(chaos.growth() - 3.0023) < 1e-4, chaos)


TESTS = [("fold: sides, and the growth of a winding", sides)]
