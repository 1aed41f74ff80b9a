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

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])

try:
    import matplotlib
    import numpy as np
    import pandas as pd
    import table
except ImportError as missing:
    sys.exit(f"map.py: {missing}: apt-get install python3-matplotlib "
             "python3-pandas python3-statsmodels python3-tabulate")

matplotlib.use("Agg")
from matplotlib import colors, patches, pyplot  # noqa: E402

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


def numbers(texts: np.ndarray) -> Optional[np.ndarray]:
    """An outcome in numbers, NaN where it did not happen; None of words."""
    try:
        return np.where(texts == "", "nan", texts).astype(float)
    except ValueError:
        return None


def grid_of(rows: pd.DataFrame, x: str, y: Optional[str]
            ) -> tuple[list[float], list[float], pd.DataFrame]:
    """The values of both axes, and the rows in the order of their points."""
    try:
        rows = rows.assign(_x=pd.to_numeric(rows[x]),
                           _y=pd.to_numeric(rows[y]) if y else 0.0)
    except ValueError as error:
        raise table.TableError(f"an axis has {error}, not a number") from None
    again = rows[rows.duplicated(["_x", "_y"])]
    if len(again):
        raise table.TableError(
            f"{len(again)} rows have the same {x}{' and ' + y if y else ''} "
            "as another one: another axis was swept, too")
    xs, ys = (sorted(set(rows[name])) for name in ("_x", "_y"))
    if len(rows) != len(xs) * len(ys):
        raise table.TableError(f"{len(xs) * len(ys) - len(rows)} points of "
                               "the grid have no row")
    return xs, ys, rows.sort_values(["_y", "_x"])


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


def draw_map(axes, texts: np.ndarray, refused: np.ndarray, extent,
             unit: str) -> list[patches.Patch]:
    """An outcome over two axes."""
    legend, values = [], numbers(texts)
    if values is not None:
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


def draw_line(axes, xs: np.ndarray, texts: np.ndarray) -> None:
    """An outcome over one axis; words in their order as levels."""
    values = numbers(texts)
    if values is not None:
        axes.plot(xs, values, ".-", color=PALETTE[0])
        return
    words, there = sorted(set(texts) - {""}), texts != ""
    axes.plot(xs[there], [words.index(text) for text in texts[there]], ".",
              color=PALETTE[0])
    axes.set_yticks(range(len(words)), words)


def main() -> int:
    if len(sys.argv) not in (5, 6):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    path, x, *middle, outcome, picture = sys.argv[1:]
    y = middle[0] if middle else None
    rows = table.read(path, [x, outcome, "status"] + middle, counted=True,
                      text=True)
    if rows.empty:
        raise table.TableError(f"{path}: has no row")
    xs, ys, rows = grid_of(rows, x, y)
    texts = rows[outcome].to_numpy(str).reshape(len(ys), len(xs))
    refused = rows.status.to_numpy(str).reshape(texts.shape) == REFUSED
    units = units_of(path)
    figure, axes = pyplot.subplots(figsize=(6.4, 4.8), layout="constrained")
    if y:
        legend = draw_map(axes, texts, refused, (edges(xs), edges(ys)),
                          label(outcome, units))
        axes.set(ylabel=label(y, units), title=outcome)
        if legend:
            axes.legend(handles=legend, loc="upper center", frameon=False,
                        bbox_to_anchor=(0.5, -0.11), ncols=3)
    else:
        draw_line(axes, np.asarray(xs), texts[0])
        axes.set(ylabel=label(outcome, units))
    axes.set(xlabel=label(x, units))
    try:
        figure.savefig(picture, dpi=150)
    except (OSError, ValueError) as error:
        raise table.TableError(f"{picture}: {error}") from None
    return 0


if __name__ == "__main__":
    table.run_script(main)
