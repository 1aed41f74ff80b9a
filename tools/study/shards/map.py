#!/usr/bin/python3 -B
"""A map of what `twofold sweep` wrote: an outcome over one or two axes.

usage: map.py TABLE X [Y] OUTCOME PICTURE

TABLE is a file of all points, or its shards one after the other (`-` is
standard input); a shard that is missing or cut off is refused. X, Y and
OUTCOME are names of columns. PICTURE ends in .png, .svg or .pdf. An outcome
in words is drawn in a colour each. Points whose machine was refused are
hatched, points where the outcome did not happen are blank.
"""
from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Optional

sys.path.append(str(Path(__file__).resolve().parents[2]))

try:
    import matplotlib
    import numpy as np
except ImportError as missing:
    sys.exit(f"map.py: {missing}: apt-get install python3-matplotlib")

matplotlib.use("Agg")
from matplotlib import colors, patches, pyplot  # noqa: E402

from tables.read import Row, TableError, read_csv, run_script  # noqa: E402

REFUSED, ABSENT, NAMED = "refused", "did not happen", 12
# Colours that stay apart for all eyes (Okabe and Ito), then more of them.
PALETTE = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7",
           "#f0e442", "#000000", "#999999", "#8c510a", "#35978f", "#762a83"]
matplotlib.rcParams.update({"svg.hashsalt": "twofold", "font.size": 9})


def units_of(path: str) -> dict[str, str]:
    """The unit of each column, from the comment that lists them."""
    if path == "-":
        return {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# units:"):
                pairs = line[len("# units:"):].replace(",", " ")
                return dict(re.findall(r"(\S+) ((?:N m s|N s/m|\S+))", pairs))
    return {}


def label(column: str, units: dict[str, str]) -> str:
    unit = units.get(column, "1")
    return column if unit == "1" else f"{column} [{unit}]"


def is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def grid_of(rows: list[Row], x: str, y: Optional[str]
            ) -> tuple[list[float], list[float], list[list[Row]]]:
    """The values of both axes, and the row at each of their points."""
    places: dict[tuple[float, float], Row] = {}
    for row in rows:
        place = row.number(x), row.number(y) if y else 0.0
        if place in places:
            raise TableError(f"{row.where}: {places[place].where} has the "
                             f"same {x}{' and ' + y if y else ''}: another "
                             "axis was swept, too")
        places[place] = row
    xs, ys = (sorted({place[i] for place in places}) for i in (0, 1))
    for place in ((a, b) for b in ys for a in xs):
        if place not in places:
            raise TableError(f"no row has {x} = {place[0]:g}" +
                             (f", {y} = {place[1]:g}" if y else ""))
    return xs, ys, [[places[a, b] for a in xs] for b in ys]


def edges(values: list[float]) -> np.ndarray:
    """Borders of the cells around values, half way to the next ones."""
    at = np.asarray(values)
    if len(at) == 1:
        return np.array([at[0] - 0.5, at[0] + 0.5])
    middle = (at[1:] + at[:-1]) / 2
    return np.concatenate([[2 * at[0] - middle[0]], middle,
                           [2 * at[-1] - middle[-1]]])


def draw_words(axes, texts: np.ndarray, extent) -> list[patches.Patch]:
    """A colour for each word, by how often it is there."""
    words, counts = np.unique(texts[texts != ""], return_counts=True)
    order = [str(words[i]) for i in np.argsort(-counts, kind="stable")]
    number = {word: min(i, NAMED - 1) for i, word in enumerate(order)}
    cells = np.array([[number.get(text, np.nan) for text in line]
                      for line in texts], float)
    axes.pcolormesh(*extent, cells, vmin=-0.5, vmax=NAMED - 0.5,
                    cmap=colors.ListedColormap(PALETTE[:NAMED]))
    shown = order[:NAMED - 1] if len(order) > NAMED else order
    legend = [patches.Patch(color=PALETTE[i], label=word)
              for i, word in enumerate(shown)]
    if len(order) > NAMED:
        legend.append(patches.Patch(color=PALETTE[NAMED - 1],
                                    label=f"{len(order) - NAMED + 1} others"))
    return legend


def draw_map(axes, cells: list[list[Row]], outcome: str, extent,
             unit: str) -> list[patches.Patch]:
    texts = np.array([[row[outcome] for row in line] for line in cells])
    refused = np.array([[row["status"] == REFUSED for row in line]
                        for line in cells])
    legend = []
    if all(is_number(text) for text in texts.flat if text):
        values = np.array([[float(text or "nan") for text in line]
                           for line in texts])
        mesh = axes.pcolormesh(*extent, values, cmap="viridis")
        axes.figure.colorbar(mesh, ax=axes, label=unit)
    else:
        legend = draw_words(axes, texts, extent)
    if refused.any():
        axes.pcolor(*extent, np.where(refused, 1.0, np.nan), hatch="////",
                    cmap=colors.ListedColormap(["#dddddd"]), linewidth=0)
        legend.append(patches.Patch(facecolor="#dddddd", hatch="////",
                                    label=REFUSED))
    if ((texts == "") & ~refused).any():
        legend.append(patches.Patch(facecolor="white", edgecolor="#999999",
                                    label=ABSENT))
    return legend


def draw_line(axes, xs: list[float], cells: list[list[Row]],
              outcome: str) -> None:
    """An outcome over one axis; words in their order as levels."""
    texts = [row[outcome] for row in cells[0]]
    if all(is_number(text) for text in texts if text):
        axes.plot(xs, [float(text or "nan") for text in texts], ".-",
                  color=PALETTE[0])
        return
    words = sorted(set(texts) - {""})
    axes.plot([x for x, text in zip(xs, texts) if text],
              [words.index(text) for text in texts if text], ".",
              color=PALETTE[0])
    axes.set_yticks(range(len(words)), words)


def main() -> int:
    if len(sys.argv) not in (5, 6):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    path, x, *middle, outcome, picture = sys.argv[1:]
    y = middle[0] if middle else None
    columns = [x, outcome, "status"] + middle
    rows = read_csv(path, needed=columns, counted=True)
    if not rows:
        raise TableError(f"{path}: has no row")
    xs, ys, cells = grid_of(rows, x, y)
    units = units_of(path)
    figure, axes = pyplot.subplots(figsize=(6.4, 4.8), layout="constrained")
    if y:
        legend = draw_map(axes, cells, outcome, (edges(xs), edges(ys)),
                          label(outcome, units))
        axes.set(ylabel=label(y, units), title=outcome)
        if legend:
            axes.legend(handles=legend, loc="upper center", frameon=False,
                        bbox_to_anchor=(0.5, -0.11), ncols=3)
    else:
        draw_line(axes, xs, cells, outcome)
        axes.set(ylabel=label(outcome, units))
    axes.set(xlabel=label(x, units))
    try:
        figure.savefig(picture, dpi=150)
    except (OSError, ValueError) as error:
        raise TableError(f"{picture}: {error}") from None
    return 0


if __name__ == "__main__":
    run_script(main)
