"""`make recurrence`: where in the space of machines the motion returns to its
two-fold.

A machine follows from its number alone. Of each eight, four are designs of
the paper's figure 4, (r*, omega*) on a grid over all of it, all else as in
`chaos`; two are on a finer grid around `chaos`; two are drawn at random: r*,
omega0 - omega*, beta, mu and both dampings, all log-uniform, and gamma. kappa
and k2 follow from the place of the two-fold (`twofold design`).

A machine is *lasting* where every cycle that was followed returned, in the
first pass and in the long one, *partly* where some did, *never* where none did;
where some did not, the pass that waits decides.

Slips are steps of 50 ms at a tolerance of 1e-8, those of `diverge`. `make
statistics` prints how far exits and returns are then from those of finer ones
(Kolmogorov and Smirnov), and the band of 1e5 cycles.
"""
import json
import math
import os
import zlib
from collections import Counter
from pathlib import Path
from typing import Iterator, NamedTuple, Optional

import numpy as np
import pandas as pd
from scipy import ndimage

import driven
import pictures
import table
from pictures import SERIES, SOFT, colors, pyplot

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
REASONS = "no design", "not case 1", "not followed"
RATIOS = 1, 2, 3, 4, 6, 8, 16, 32, 2048
FEWEST = 3  # machines of a region that is listed
PART = 100  # machines


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
COLUMNS = ("machine", "space", "r", "omega", "kappa", "k2", *SETTINGS, "ratio",
           *(f"{name}_{end}" for name in PASSES for end in ENDINGS), "reason")
COLOURS = dict(zip(CLASSES, (SERIES[0], SERIES[1], SOFT)))
HORIZON = {"never": f" by {PASSES['first'].patience} s",
           "partly": f" by {PASSES[WAIT].patience} s"}


# Machines.

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


# Following.

def words_of(number: int, name: str, settings: dict[str, float]) -> list[str]:
    """`twofold diverge` of a pass; settings hold kappa and k2 as well. No two
    runs share a seed."""
    run = PASSES[name]
    seed = WAITING_SEEDS + number if run.after == WAITS else \
        4 * number + list(PASSES).index(name) + 1
    return ["diverge", "chaos", *set_words(settings), "--samples",
            str(run.samples), "--cycles", str(run.cycles), "--patience",
            str(run.patience), "--seed", str(seed)]


def is_followed(name: str, found: dict[str, object]) -> bool:
    """Whether a machine is followed in a pass, by what came before it."""
    after = PASSES[name].after
    before = [[found.get(f"{other}_{end}", 0) for end in ENDINGS]
              for other in USUAL]
    if after == WAITS:
        return any(ends[0] for ends in before) and any(
            any(ends[1:]) for ends in before)
    return after is None or not any(before[USUAL.index(after)][1:])


def cycles(twofold: str, words: list[str]) -> Optional[Counter[str]]:
    """The number of cycles by how they ended; None where the two-fold cannot be
    followed. What came before it says which ending a `timeout` is."""
    text = table.said(twofold, *words, "--returns", "-")
    if text is None:
        return None
    rows = table.parsed(text)
    return Counter(rows.outcome.mask(rows.outcome == "timeout", np.select(
        [rows.landings > 0, rows.exit_r.isna()], ["landed", "sticking"],
        "slipping")))


def row(number: int, twofold: str) -> dict[str, object]:
    """What becomes of a machine; what is not known is left out."""
    name, r, omega, settings = drawn(number)
    found = {"machine": number, "space": name, "r": r, "omega": omega,
             **settings}
    text = table.said(twofold, "design", "chaos", *set_words(settings), "--r",
                      repr(r), f"--omega={omega!r}")
    if text is None:
        return {**found, "reason": "no design"}
    design = json.loads(text)
    fold = design["two_fold"]
    settings.update(kappa=design["kappa"], k2=design["k2"])
    found.update(settings)
    if fold["case"] != 1 or not fold["directions"][0]["sticks"]:
        return {**found, "reason": "not case 1"}
    found["ratio"] = fold["eigenvalues"][1] / fold["eigenvalues"][0]
    for name in PASSES:
        count: Optional[Counter[str]] = Counter()
        if is_followed(name, found):
            count = cycles(twofold, words_of(number, name, settings))
        if count is None:
            return {**found, "reason": "not followed"}
        found.update((f"{name}_{end}", count[end]) for end in ENDINGS)
    return found


def follow(work: Path, twofold: str) -> None:
    """All machines, in parts; one that is there is not done again. Parts of
    other machines, or of another program, have another folder."""
    run = zlib.crc32(repr((MACHINES, SEED, SPACES, DRAWN, GAMMA, PASSES,
                           table.said(twofold, "--version"))).encode())
    folder = work / f"{run:08x}"
    folder.mkdir(exist_ok=True)

    def part(i: int) -> pd.DataFrame:
        path = folder / f"{i}.csv"
        if not path.exists():
            rows = pd.DataFrame(
                [row(number, twofold) for number in range(
                    PART * i, min(PART * (i + 1), MACHINES))], columns=COLUMNS)
            rows.to_csv(path.with_suffix(".part"), index=False)
            path.with_suffix(".part").rename(path)
        return table.read(path)

    pd.concat(driven.side_by_side(part, range(math.ceil(MACHINES / PART)))
              ).to_csv(work / "recurrence.csv", index=False)


def show(number: int, twofold: str) -> None:
    """A machine, as a row and as commands."""
    found = row(number, twofold)
    print(pd.DataFrame([found], columns=COLUMNS).to_csv(index=False), end="")
    if "reason" not in found:
        settings = {name: found[name] for name in (*SETTINGS, "kappa", "k2")
                    if name in found}
        for name in PASSES:
            print(twofold, *words_of(number, name, settings))


# Counting.

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


def most(rows: pd.DataFrame) -> np.ndarray:
    """How most of the cycles that did not return ended."""
    return np.array(LOST)[np.argmax(ends(rows, "first")[:, 1:], axis=1)]


def share(k: int, n: int) -> str:
    """A share with its interval."""
    return table.share(k, n).text(3)


def machines_of(name: str, rows: pd.DataFrame, here: pd.DataFrame
                ) -> dict[str, object]:
    """What became of the machines of a space, and of how many the long pass
    loses cycles of which the first one loses none."""
    first, second = (ends(here, one) for one in USUAL)
    kept = first[:, 1:].sum(1) == 0
    return {"machines": SPACES[name].title, "drawn": len(rows),
            **{one: (rows.reason == one).sum() for one in REASONS},
            "followed": len(here),
            **{one: share((here.became == one).sum(), len(here))
               for one in CLASSES}, "lost in the long pass alone":
            f"{(second[kept, 1:].sum(1) > 0).sum()} of {kept.sum()}"}


def waited(followed: pd.DataFrame) -> str:
    """What waiting brings back."""
    here = followed[ends(followed, WAIT).sum(1) > 0]
    lasting = (here.became == "lasting").groupby(here.space)
    return ("Machines that lose some cycles, but none when given "
            f"{PASSES[WAIT].patience} s:\n" + ", ".join(
                f"{lasting.sum().get(name, 0)} of "
                f"{lasting.size().get(name, 0)} ({one.title})"
                for name, one in SPACES.items()) + ".")


def ratios_of(low: float, high: float, followed: pd.DataFrame
              ) -> dict[str, object]:
    """The share that is lasting, of each space, in a bin of the ratio."""
    here = followed[(followed.ratio >= low) & (followed.ratio < high)]
    line = {"ratio of eigenvalues": f"{low:.3g} to {high:.3g}"}
    for name, one in SPACES.items():
        became = here.became[here.space == name]
        line[f"{one.title}, lasting"] = share(
            (became == "lasting").sum(), len(became)) + f" of {len(became)}"
    return line


def regions(rows: pd.DataFrame, name: str,
            total: int) -> Iterator[dict[str, object]]:
    """Cells of the grid whose machines are lasting and that touch, by a side
    or a corner; the largest region first."""
    rows = rows[(rows.space == name) & (rows.became == "lasting")]
    if rows.empty:
        return
    (low, high), (slow, fast) = SPACES[name].window
    half = np.array([high - low, fast - slow]) / side(name, total) / 2
    cells = tuple(np.transpose([cell(number, name, total)
                                for number in rows.machine]))
    grid = np.zeros(np.max(cells, axis=1) + 1, bool)
    grid[cells] = True
    labels = ndimage.label(grid, np.ones((3, 3)))[0][cells]
    for label, n in Counter(labels).most_common():
        at = rows[["r", "omega"]].to_numpy()[labels == label]
        holds = (np.abs(at - CHAOS) <= half).all(axis=1).any()
        if n >= FEWEST or holds:
            r, omega = (f"{one.min():.3f} to {one.max():.3f}" for one in at.T)
            yield {"machines": SPACES[name].title, "lasting": n, "r* [m]": r,
                   "omega* [rad/s]": omega,
                   "contains `chaos`": "yes" if holds else "no"}


def grid_of(axes: pyplot.Axes, name: str, labels: dict[str, str],
            numbers: pd.Series, of: np.ndarray, total: int) -> None:
    """A map over a grid: the label of each machine that has one."""
    window, cells = SPACES[name].window, side(name, total)
    shown = np.full((cells, cells), -1)
    for number, label in zip(numbers, of):
        shown[cell(number, name, total)] = list(labels).index(label)
    axes.imshow(np.ma.masked_less(shown, 0), origin="lower", aspect="auto",
                extent=(*window[0], *window[1]), interpolation="nearest",
                cmap=colors.ListedColormap(list(labels.values())), vmin=-0.5,
                vmax=len(labels) - 0.5)
    axes.plot(*CHAOS, "+", color="black", ms=9)
    axes.set(xlabel="r* [m]", ylabel="omega* [rad/s]",
             ylim=(window[1][0], min(window[1][1], -0.9)))
    axes.legend(handles=[
        pyplot.Line2D([], [], marker="s", ls="", color=colour,
                      label=f"{label}{HORIZON.get(label, '')} ({n})")
        for i, (label, colour) in enumerate(labels.items())
        if (n := (shown == i).sum())], loc="lower left", fontsize=7)


def draw(path: Path, rows: pd.DataFrame, total: int) -> None:
    """Maps over the designs by class, and by how the cycles end of those that
    never return."""
    figure, panels = pyplot.subplots(1, 3, figsize=(15, 4.5))
    for axes, name in zip(panels, ("designs", "near")):
        here = rows[rows.space == name]
        grid_of(axes, name, COLOURS, here.machine, here.became, total)
        axes.set(title=SPACES[name].title.replace("`", ""))
    never = rows[(rows.space == "near") & (rows.became == "never")]
    grid_of(panels[2], "near", dict(zip(LOST, SERIES[2:])), never.machine,
            most(never), total)
    panels[2].set(title="around chaos, never: most cycles end so")
    pictures.save(figure, path)


def count(work: Path, kept: Path) -> dict[str, object]:
    """The tables, and the picture."""
    rows = table.read(work / "recurrence.csv", COLUMNS)
    followed = rows[rows.reason.isna()]
    followed = followed.assign(became=classes(followed))
    draw(kept / "recurrence.png", followed, len(rows))
    of = {name: followed[followed.space == name] for name in SPACES}
    return {
        "machines": pd.DataFrame([machines_of(name, rows[rows.space == name],
                                              of[name]) for name in SPACES]),
        "waits": waited(followed),
        "regions": pd.DataFrame([
            one for name, space in SPACES.items() if space.window
            for one in regions(followed, name, len(rows))]),
        "ratios": pd.DataFrame([
            ratios_of(low, high, followed)
            for low, high in zip(RATIOS, RATIOS[1:])
            if followed.ratio.between(low, high).any()])}
