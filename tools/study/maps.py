"""The picture of `make recurrence`: maps over the designs by class and by how
the cycles end, shares over the ratio of eigenvalues and over the parameters."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib import colors

import pictures
import space
import table
from pictures import pyplot
from space import KINDS, LOST, QUARTERED, SPACES, ends, most, quarters

COLOURS = {"lasting": "#0072B2", "partly": "#E69F00", "never": "#BBBBBB"}
ENDED = dict(zip(LOST, (
    "#56B4E9", "#D55E00", "#F0E442", "#009E73", "#CC79A7", "#000000")))
PAIRS = ("kappa", "k2"), ("beta", "mu"), ("c1", "c2")
CELLS, LEAST = 6, 5  # bins a side of a pair; machines that a bin needs
BINS = np.arange(2, 10.001, 0.1)  # of the ratio


def title_of(name: str) -> str:
    return SPACES[name].title.replace("`", "")


def grid_of(axes: pyplot.Axes, name: str, labels: dict[str, str],
            numbers: pd.Series, of: np.ndarray, total: int) -> None:
    """A map over a grid: the label of each machine that has one."""
    window = SPACES[name].window
    cells = space.side(name, total)
    shown = np.full((cells, cells), -1)
    for number, label in zip(numbers, of):
        shown[space.cell(number, name, total)] = list(labels).index(label)
    count = {label: int((shown == i).sum()) for i, label in enumerate(labels)}
    axes.imshow(np.ma.masked_less(shown, 0), origin="lower", aspect="auto",
                extent=(*window[0], *window[1]),
                cmap=colors.ListedColormap(list(labels.values())), vmin=-0.5,
                vmax=len(labels) - 0.5, interpolation="nearest")
    axes.plot(*space.CHAOS, "+", color="black", ms=9)
    axes.set(xlabel="r* [m]", ylabel="omega* [rad/s]",
             ylim=(window[1][0], min(window[1][1], -0.9)))
    axes.legend(handles=[pyplot.Line2D([], [], marker="s", ls="", color=colour,
                                       label=f"{label} ({count[label]})")
                         for label, colour in labels.items() if count[label]],
                loc="lower left", fontsize=7)


def draw_maps(panels: list[pyplot.Axes], rows: pd.DataFrame, name: str,
              total: int) -> None:
    """What became of the designs of a grid; and how most cycles end of those
    that never return, exits at random."""
    here = rows[rows.space == name]
    for axes, kind in zip(panels, KINDS):
        grid_of(axes, name, COLOURS, here.machine, here[kind], total)
        axes.set(title=f"{title_of(name)}, exits by {kind}")
    never = here[here.random == "never"]
    grid_of(panels[2], name, ENDED, never.machine, most(ends(never, "random")),
            total)
    panels[2].set(title=f"never, {title_of(name)}, exits by random: it ends")


def lasting(rows: pd.DataFrame) -> table.Estimate:
    return table.share((rows.random == "lasting").sum(), len(rows))


def draw_ratios(axes: pyplot.Axes, rows: pd.DataFrame, name: str) -> None:
    """The share of lasting machines over bins of the ratio."""
    here = rows[rows.space == name]
    at, found = [], []
    for a, b in zip(BINS, BINS[1:]):
        inside = here[(here.ratio >= a) & (here.ratio < b)]
        if len(inside) >= LEAST:
            at.append((a + b) / 2)
            found.append(lasting(inside))
    axes.errorbar(at, [one.value for one in found],
                  [[one.value - one.low for one in found],
                   [one.high - one.value for one in found]],
                  fmt=".", lw=0.7, ms=4)
    for whole in range(3, 11):
        axes.axvline(whole, color="#CCCCCC", lw=0.7, zorder=0)
    axes.set(title=f"{title_of(name)}, exits at random",
             xlabel="ratio of the eigenvalues", ylim=(0, None),
             ylabel="share of lasting machines", xlim=(BINS[0], BINS[-1]))


def draw_quarters(axes: pyplot.Axes, rows: pd.DataFrame) -> None:
    for column in QUARTERED:
        edges = quarters(rows, column)
        axes.plot(range(1, 5), [
            lasting(rows[(rows[column] >= a) & (rows[column] < b)]).value
            for a, b in zip(edges, edges[1:])], ".-", lw=1, label=column)
    axes.set(title="at random, exits at random",
             xlabel="quarter of the parameter's values", xticks=range(1, 5),
             ylabel="share of lasting machines", ylim=(0, None))
    axes.legend(fontsize=7, ncol=3)


def draw_pair(figure: pyplot.Figure, axes: pyplot.Axes, rows: pd.DataFrame,
              x: str, y: str) -> None:
    """The share of lasting machines over two parameters."""
    across, up = quarters(rows, x, CELLS), quarters(rows, y, CELLS)
    shown = np.full((CELLS, CELLS), np.nan)
    where = [np.searchsorted(edges, rows[name], "right") - 1
             for edges, name in ((up, y), (across, x))]
    for cell, inside in rows.groupby(where):
        if len(inside) >= LEAST:
            shown[cell] = lasting(inside).value
    mesh = axes.pcolormesh(across, up, shown, cmap="viridis", vmin=0)
    axes.set(xscale="log", yscale="log", xlabel=x, ylabel=y,
             title="at random, exits at random")
    figure.colorbar(mesh, ax=axes, label="share of lasting machines")


def draw(path: Path, rows: pd.DataFrame, total: int) -> None:
    """All panels, of the machines that were followed."""
    figure, panels = pyplot.subplots(4, 3, figsize=(15, 17))
    others = rows[rows.space == "random"]
    draw_maps(panels[0], rows, "designs", total)
    draw_maps(panels[1], rows, "near", total)
    draw_ratios(panels[2][0], rows, "near")
    draw_ratios(panels[2][1], rows, "random")
    draw_quarters(panels[2][2], others)
    for axes, pair in zip(panels[3], PAIRS):
        draw_pair(figure, axes, others, *pair)
    pictures.save(figure, path, 90)
