"""The picture of `make recurrence`: maps over the designs by class and by how
the cycles end, shares over the ratio of eigenvalues and over the parameters."""
from __future__ import annotations

from typing import Sequence

import matplotlib
import numpy as np

import machines
import resonance
from machines import KINDS, LOST, SPACES
from report import QUARTERED, class_of, ends, most, quarters
from tables import read, statistics

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

COLOURS = {"lasting": "#0072B2", "partly": "#E69F00", "never": "#BBBBBB"}
ENDED = dict(zip(LOST, (
    "#56B4E9", "#D55E00", "#F0E442", "#009E73", "#CC79A7", "#000000")))
PAIRS = ("kappa", "k2"), ("beta", "mu"), ("c1", "c2")
CELLS, LEAST = 6, 5  # bins a side of a pair; machines that a bin needs
CHAOS = 0.1859, -1.037


def grid_of(axes: pyplot.Axes, rows: Sequence[read.Row], name: str,
            labels: dict[str, str], of: dict[int, str], total: int) -> None:
    """A map over a grid. of: the label of each machine that has one."""
    space = SPACES[name]
    cells = machines.side(name, total)
    shown = np.full((cells, cells), -1)
    for number, label in of.items():
        shown[machines.cell(number, name, total)] = list(labels).index(label)
    count = {label: int((shown == i).sum()) for i, label in enumerate(labels)}
    axes.imshow(np.ma.masked_less(shown, 0), origin="lower", aspect="auto",
                extent=(*space.window[0], *space.window[1]),
                cmap=colors.ListedColormap(list(labels.values())), vmin=-0.5,
                vmax=len(labels) - 0.5, interpolation="nearest")
    axes.plot(*CHAOS, "+", color="black", ms=9)
    axes.set(xlabel="r* [m]", ylabel="omega* [rad/s]",
             ylim=(space.window[1][0], min(space.window[1][1], -0.9)))
    axes.legend(handles=[pyplot.Line2D([], [], marker="s", ls="", color=colour,
                                       label=f"{label} ({count[label]})")
                         for label, colour in labels.items() if count[label]],
                loc="lower left", fontsize=7)


def draw_map(axes: pyplot.Axes, rows: Sequence[read.Row], name: str,
             kind: str, total: int) -> None:
    """What became of the designs of a grid."""
    grid_of(axes, rows, name, COLOURS,
            {row.count("machine"): class_of(row, kind) for row in rows
             if row["space"] == name}, total)
    axes.set(title=f"{SPACES[name].title.replace('`', '')}, exits by {kind}")


def draw_endings(axes: pyplot.Axes, rows: Sequence[read.Row], name: str,
                 kind: str, total: int) -> None:
    """How most cycles end of the designs that never return."""
    grid_of(axes, rows, name, ENDED,
            {row.count("machine"): most(ends(row, kind)) for row in rows
             if row["space"] == name and class_of(row, kind) == "never"},
            total)
    axes.set(title=f"never, {SPACES[name].title.replace('`', '')}, "
             f"exits by {kind}: it ends")


def lasting(rows: Sequence[read.Row]) -> statistics.Estimate:
    return statistics.wilson(sum(class_of(row, "random") == "lasting"
                                 for row in rows), len(rows))


def draw_ratios(axes: pyplot.Axes, rows: Sequence[read.Row],
                name: str) -> None:
    """The share of lasting machines over bins of the ratio."""
    here = [row for row in rows if row["space"] == name]
    at, found = [], []
    for a, b in zip(resonance.BINS, resonance.BINS[1:]):
        inside = [row for row in here if a <= row.number("ratio") < b]
        if len(inside) >= LEAST:
            at.append((a + b) / 2)
            found.append(lasting(inside))
    axes.errorbar(at, [one.value for one in found],
                  [[one.value - one.low for one in found],
                   [one.high - one.value for one in found]],
                  fmt=".", lw=0.7, ms=4)
    for whole in resonance.WHOLE:
        axes.axvline(whole, color="#CCCCCC", lw=0.7, zorder=0)
    axes.set(title=f"{SPACES[name].title.replace('`', '')}, exits at random",
             xlabel="ratio of the eigenvalues", ylim=(0, None),
             ylabel="share of lasting machines",
             xlim=(resonance.BINS[0], resonance.BINS[-1]))


def draw_quarters(axes: pyplot.Axes, rows: Sequence[read.Row]) -> None:
    for column in QUARTERED:
        edges = quarters(rows, column)
        axes.plot(range(1, 5), [
            lasting([row for row in rows
                     if a <= row.number(column) < b]).value
            for a, b in zip(edges, edges[1:])], ".-", lw=1, label=column)
    axes.set(title="at random, exits at random",
             xlabel="quarter of the parameter's values", xticks=range(1, 5),
             ylabel="share of lasting machines", ylim=(0, None))
    axes.legend(fontsize=7, ncol=3)


def draw_pair(figure: pyplot.Figure, axes: pyplot.Axes,
              rows: Sequence[read.Row], x: str, y: str) -> None:
    """The share of lasting machines over two parameters."""
    across, up = quarters(rows, x, CELLS), quarters(rows, y, CELLS)
    shown = np.full((CELLS, CELLS), np.nan)
    column = np.searchsorted(across, [row.number(x) for row in rows], "right")
    line = np.searchsorted(up, [row.number(y) for row in rows], "right")
    for i in range(CELLS):
        for j in range(CELLS):
            inside = [row for row, a, b in zip(rows, column, line)
                      if (a - 1, b - 1) == (j, i)]
            if len(inside) >= LEAST:
                shown[i, j] = lasting(inside).value
    mesh = axes.pcolormesh(across, up, shown, cmap="viridis", vmin=0)
    axes.set(xscale="log", yscale="log", xlabel=x, ylabel=y,
             title="at random, exits at random")
    figure.colorbar(mesh, ax=axes, label="share of lasting machines")


def draw(path: str, rows: Sequence[read.Row]) -> None:
    """All panels."""
    figure, panels = pyplot.subplots(4, 3, figsize=(15, 17))
    followed = [row for row in rows if not row["reason"]]
    others = [row for row in followed if row["space"] == "random"]
    for line, name in zip(panels, ("designs", "near")):
        for axes, kind in zip(line, KINDS):
            draw_map(axes, followed, name, kind, len(rows))
        draw_endings(line[2], followed, name, "random", len(rows))
    draw_ratios(panels[2][0], followed, "near")
    draw_ratios(panels[2][1], followed, "random")
    draw_quarters(panels[2][2], others)
    for axes, pair in zip(panels[3], PAIRS):
        draw_pair(figure, axes, others, *pair)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
