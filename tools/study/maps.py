"""The picture of `make recurrence`: maps over the designs by class, and by how
the cycles end of those that never return."""
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib import colors

import pictures
import space
from pictures import pyplot
from space import LOST, PASSES, SPACES, WAIT, ends, most

COLOURS = {"lasting": "#0072B2", "partly": "#E69F00", "never": "#BBBBBB"}
ENDED = dict(zip(LOST, (
    "#56B4E9", "#D55E00", "#F0E442", "#009E73", "#CC79A7", "#000000")))
HORIZON = {"never": f" by {PASSES['first'].patience} s",
           "partly": f" by {PASSES[WAIT].patience} s"}


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
                                       label=label + HORIZON.get(label, "") +
                                       f" ({count[label]})")
                         for label, colour in labels.items() if count[label]],
                loc="lower left", fontsize=7)


def draw(path: Path, rows: pd.DataFrame, total: int) -> None:
    """All panels, of the machines that were followed."""
    figure, panels = pyplot.subplots(1, 3, figsize=(15, 4.5))
    for axes, name in zip(panels, ("designs", "near")):
        here = rows[rows.space == name]
        grid_of(axes, name, COLOURS, here.machine, here.became, total)
        axes.set(title=SPACES[name].title.replace("`", ""))
    never = rows[(rows.space == "near") & (rows.became == "never")]
    grid_of(panels[2], "near", ENDED, never.machine,
            most(ends(never, "first")), total)
    panels[2].set(title="around chaos, never: most cycles end so")
    figure.tight_layout()
    pictures.save(figure, path, 90)
