"""The machines of `make recurrence`, and the commands that follow each.

A machine follows from its number alone. Of each eight, four are designs of
the paper's figure 4, (r*, omega*) on a grid over all of it, all else as in
`chaos`; two are on a finer grid around `chaos`; two are drawn at random: r*,
omega0 - omega*, beta, mu and both dampings, all log-uniform, and gamma. kappa
and k2 follow from the place of the two-fold (`twofold design`).
"""
import math
import os
from typing import Callable, NamedTuple, Optional, Sequence

import numpy as np
import pandas as pd

MACHINES = int(os.environ.get("MACHINES") or 20000)
SEED = 2026
OMEGA0 = -1.0  # of `chaos` [rad/s]
# Log-uniform; below is how far omega* is below omega0.
DRAWN = {"r": (0.05, 1), "below": (0.02, 1), "beta": (0.05, 1),
         "mu": (0.1, 3), "c1": (1e-4, 0.1), "c2": (1e-4, 0.1)}
GAMMA = -3 * math.pi / 4 - 0.5, -3 * math.pi / 4 + 0.5
SETTINGS = "beta", "mu", "c1", "c2", "gamma"
CHAOS = 0.1859, -1.037  # r* [m], omega* [rad/s]
CLASSES = "lasting", "partly", "never"


class Space(NamedTuple):
    """Machines first to last of each EIGHT; window: of a grid, r* [m] and
    omega* [rad/s]."""
    title: str
    first: int
    last: int
    window: Optional[tuple[tuple[float, float], tuple[float, float]]] = None


EIGHT = 8
SPACES = {
    "designs": Space("figure 4", 0, 3, ((0.0, 1.0), (-3.0, 1.0))),
    "near": Space("around `chaos`", 4, 5, ((0.1, 0.5), (-1.5, -1.005))),
    "random": Space("at random", 6, 7)}


class Pass(NamedTuple):
    """A run of `twofold diverge`. `after`: only where that one lost nothing;
    `WAITS`: only where the passes before it lost something, and not all."""
    samples: int
    cycles: int
    patience: int  # [s]
    after: Optional[str] = None


WAITS = "waits"
PASSES = {"first": Pass(10, 5, 60), "long": Pass(25, 20, 60, "first"),
          "wait": Pass(10, 50, 200, WAITS)}
USUAL = "first", "long"
WAIT = "wait"
WAITING_SEEDS = 1000000  # and after: of the pass that waits
# How a cycle ends; a `timeout` of diverge is told by what came before it.
ENDINGS = {
    "returned": "come back to the two-fold",
    "small_cycle": "landed on the sliding region beyond g = 0 three times or "
                   "more, without coming back",
    "rest": "come to rest on the turntable, and is there",
    "landed": "landed once or twice, without coming back",
    "slipping": "left the surface and not landed",
    "sticking": "not left the escaping stick",
    "refused": "met a step that the core refuses, before that"}
LOST = list(ENDINGS)[1:]
# late: of those that returned, after more than half of the longest cycle.
COLUMNS = ("machine", "space", "r", "omega", "kappa", "k2", *SETTINGS, "ratio",
           "seed", *(f"{name}_{what}" for name in PASSES
                     for what in (*ENDINGS, "late")), "reason")


def is_followed(name: str, ends_of: Callable[[str], Sequence[int]]) -> bool:
    """Whether a machine is followed in a pass. ends_of: of one before it, the
    cycles by how they ended; all 0 where it was not followed there."""
    after = PASSES[name].after
    if after is None:
        return True
    if after != WAITS:
        return not any(ends_of(after)[1:])
    found = [ends_of(other) for other in USUAL]
    return any(ends[0] for ends in found) and any(
        any(ends[1:]) for ends in found)


def seed_of(number: int, name: str) -> int:
    """The seed of a machine in a pass: no two runs share one."""
    if PASSES[name].after == WAITS:
        return WAITING_SEEDS + number
    return 4 * number + list(PASSES).index(name) + 1


def space_of(number: int) -> str:
    """To which of SPACES a machine belongs."""
    return next(name for name, space in SPACES.items()
                if space.first <= number % EIGHT <= space.last)


def rank(number: int, name: str) -> int:
    """How many machines of a space are before this one."""
    space = SPACES[name]
    each = space.last - space.first + 1
    return number // EIGHT * each + min(
        max(number % EIGHT - space.first, 0), each)


def side(name: str, machines: int) -> int:
    """How many machines lie along each side of a grid."""
    return math.ceil(math.sqrt(rank(machines, name)))


def cell(number: int, name: str, machines: int) -> tuple[int, int]:
    """Row (along omega*) and column (along r*) in a grid."""
    return divmod(rank(number, name), side(name, machines))


def drawn(number: int) -> tuple[str, float, float, dict[str, float]]:
    """Space, r*, omega* and settings of a machine."""
    name = space_of(number)
    if SPACES[name].window:
        (low, high), (slow, fast) = SPACES[name].window
        row, column = cell(number, name, MACHINES)
        cells = side(name, MACHINES)
        return (name, low + (high - low) * (column + 0.5) / cells,
                slow + (fast - slow) * (row + 0.5) / cells, {})
    u = np.random.default_rng([SEED, number]).random(len(DRAWN) + 1)
    settings = {name: float(a * (b / a) ** u[i])
                for i, (name, (a, b)) in enumerate(DRAWN.items())}
    r, below = settings.pop("r"), settings.pop("below")
    settings["gamma"] = float(GAMMA[0] + (GAMMA[1] - GAMMA[0]) * u[-1])
    return name, r, OMEGA0 - below, settings


def set_words(settings: dict[str, float]) -> list[str]:
    """Options of `twofold` that set these, to the bit."""
    return [word for name, value in settings.items()
            for word in ("--set", f"{name}={value!r}")]


def follow_words(name: str, settings: dict[str, float],
                 seed: int) -> list[str]:
    """`twofold diverge` of a pass; settings hold kappa and k2 as well."""
    run = PASSES[name]
    return ["diverge", "chaos", *set_words(settings), "--samples",
            str(run.samples), "--cycles", str(run.cycles), "--patience",
            str(run.patience), "--seed", str(seed)]


# What became of machines, of rows of recurrence.csv.

def ends(rows: pd.DataFrame, name: str) -> np.ndarray:
    """Cycles of a pass, by how they ended; 0 where it was not followed."""
    return rows[[f"{name}_{end}" for end in ENDINGS]].fillna(0).to_numpy(int)


def classes(rows: pd.DataFrame) -> np.ndarray:
    """What became of machines that were followed."""
    last = ends(rows, WAIT)
    waited = last.sum(1) > 0
    found = np.where(waited[:, None], last,
                     sum(ends(rows, name) for name in USUAL))
    back, lost = found[:, 0], found[:, 1:].sum(1)
    return np.where(back == 0, np.where(waited, "partly", "never"),
                    np.where(lost > 0, "partly", "lasting"))


def most(found: np.ndarray) -> np.ndarray:
    """How most of the cycles that did not return ended."""
    return np.array(LOST)[np.argmax(found[:, 1:], axis=1)]
