#!/usr/bin/python3 -B
"""Draws a map of verdicts for each real type and scheme.

A panel a sweep, step size to the right, the parameter upwards. Colours are
Okabe and Ito's for colour-blind readers, the failures darker than what is
stable. Prints the Markdown that shows them.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402
from report import Cells, Sweep, read_sweeps  # noqa: E402

matplotlib.use("Agg")
from matplotlib import colors, patches, pyplot  # noqa: E402

# Verdict, colour and meaning. The last two verdicts share a colour.
LEGEND = (
    ("ok", "#CFE8F5", "stable"),
    ("degraded", "#F0E442", "stable, some steps degraded"),
    ("physics", "#0072B2", "the motion leaves the range"),
    ("too_long", "#E69F00", "refused: step too long"),
    ("diverged", "#D55E00", "refused: scheme diverged"),
    ("told", "#999933", "energy created, and told"),
    ("created", "#000000", "energy created"),
    ("bad_parameter", "#BBBBBB", "law not taken"),
    ("touched", "#CC79A7", "promise broken"),
)
CODES = {verdict: i for i, (verdict, _, _) in enumerate(LEGEND)}
CODES["non_finite"] = CODES["touched"]
COLUMNS = 4


def verdicts(cells: Cells, sweep: Sweep, combo: str) -> np.ndarray:
    """The codes of a sweep: a line a value, a column a step size."""
    lines = [[CODES[row["verdict"]] for row in cells.line(sweep.name, combo, i)]
             for i in cells.values[sweep.name]]
    if not lines or any(len(line) != len(cells.sizes) for line in lines):
        raise read.TableError(f"{sweep.name}, {combo}: cells are missing")
    return np.array(lines)


def shorter(number: str) -> str:
    """The number without what an exponent does not need."""
    return number.replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def draw_panel(axes: pyplot.Axes, cells: Cells, sweep: Sweep,
               combo: str) -> None:
    """One sweep."""
    codes = verdicts(cells, sweep, combo)
    steps = np.log10([float(dt) for dt in cells.sizes])
    half = (steps[1] - steps[0]) / 2
    edges = np.append(steps - half, steps[-1] + half)
    axes.pcolormesh(edges, np.arange(len(codes) + 1) - 0.5, codes,
                    cmap=colors.ListedColormap([c for _, c, _ in LEGEND]),
                    vmin=-0.5, vmax=len(LEGEND) - 0.5, edgecolors="white",
                    linewidth=0.5)
    # At most nine labels, else they touch; names are few and need them all.
    last = len(codes) - 1
    every = 1 if last < 9 else -(-last // 7)
    ticks = range(0, last + 1, every)
    axes.set_yticks(ticks, [shorter(cells.value(sweep.name, i))
                            for i in ticks])
    axes.set_xticks([-6, -4, -2], ["$10^{-6}$", "$10^{-4}$", "$10^{-2}$"])
    axes.set_xlabel("step dt [s]", labelpad=1)
    axes.set_title(sweep.axis, fontsize="small")


def draw(cells: Cells, sweeps: list[Sweep], combo: str, out: Path) -> None:
    """All sweeps of one real type and scheme, the legend in the last panel."""
    real, scheme = combo.split()
    lines = -(-(len(sweeps) + 1) // COLUMNS)
    figure, panels = pyplot.subplots(lines, COLUMNS, figsize=(11, 17.5),
                                     layout="constrained")
    figure.suptitle(f"Stability of {scheme} in {real}: "
                    "verdict after 4000 steps")
    for axes, sweep in zip(panels.flat, sweeps):
        draw_panel(axes, cells, sweep, combo)
    for axes in panels.flat[len(sweeps):]:
        axes.axis("off")
    panels.flat[len(sweeps)].legend(
        handles=[patches.Patch(facecolor=colour, edgecolor="#666666",
                               label=meaning)
                 for _, colour, meaning in LEGEND],
        loc="center", frameon=False)
    figure.savefig(out, dpi=100)
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder of the maps")
    parser.add_argument("list", help="what sweep --list prints")
    parser.add_argument("cells", nargs="+", help="what sweep prints")
    given = parser.parse_args()
    cells = Cells(given.cells)
    # Those that were run: all, but where a few are looked at by hand.
    sweeps = [s for s in read_sweeps(given.list) if s.name in cells.values]
    print("## Maps\n")
    for combo in cells.combos:
        real, scheme = combo.split()
        out = given.out / f"map-{real}-{scheme}.png"
        draw(cells, sweeps, combo, out)
        print(f"![{scheme} in {real}]({out.parent.name}/{out.name})")


if __name__ == "__main__":
    read.run_script(main)
