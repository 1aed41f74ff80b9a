#!/usr/bin/python3 -B
"""What `make recurrence` found, as Markdown, and its picture.

A machine is *lasting* where every cycle that was followed returned, *partly*
where some did, *never* where none did. Shares have Wilson's 95 % interval.
"""
from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path
from typing import Iterable, Optional, Sequence

import matplotlib
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from tables import markdown, read, statistics  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SPACES = {"designs": "the designs of figure 4", "random": "machines at random"}
KINDS = "random", "noise"
CLASSES = "lasting", "partly", "never"
COLOURS = {"lasting": "#0072B2", "partly": "#E69F00", "never": "#BBBBBB"}
REASONS = "no design", "not case 1", "not followed"
RATIOS = 1, 2, 3, 4, 6, 8, 16, 32, 2048
DRAWN = "r", "omega", "beta", "mu", "c1", "c2", "gamma", "kappa", "k2"

HEAD = """\
# Where the motion returns

Made by `make recurrence`. {machines} machines: half of them designs of the
paper's figure 4, (r\\*, omega\\*) on a grid over its window and all else as in
`chaos`; half at random (beta, mu, dampings, gamma and the place of the
two-fold; ranges in `tools/recurrence/recurrence`). kappa and k2 follow from the
place. A machine whose two-fold is of case 1 is followed from there: by exits at
random, 10 samples of up to 5 cycles of at most 60 s, and by noise of 1e-5
m/s^1.5, 4 samples of up to 2 cycles of at most 20 s. It is *lasting* where
every cycle returned to the two-fold (of 50: fewer than 7 % are lost), *partly*
where some did, *never* where none did. The window is 0.01 < r\\* < 0.5 m and
-1.5 < omega\\* < -1.005 rad/s, a fifth of figure 4. The draws of all machines
have one seed; intervals are those of independent ones.

![Map over the designs, shares over the ratio of eigenvalues and over the
parameters](recurrence.png)
"""


def class_of(row: read.Row, kind: str) -> str:
    """What became of a machine that was followed."""
    back = row.count(f"{kind}_returned")
    return ("never" if back == 0 else "partly" if row[f"{kind}_lost"]
            else "lasting")


def share(k: int, n: int) -> str:
    """A share with its interval."""
    return markdown.estimate(*statistics.wilson(k, n), 3) if n else "-"


def overview(rows: Sequence[read.Row]) -> str:
    """Each space: what could be followed, and what became of it."""
    lines = []
    for space, name in SPACES.items():
        here = [row for row in rows if row["space"] == space]
        followed = [row for row in here if not row["reason"]]
        why = Counter(row["reason"] for row in here)
        for kind in KINDS:
            classes = Counter(class_of(row, kind) for row in followed)
            lines.append([name, kind, len(here),
                          *(why[reason] for reason in REASONS), len(followed),
                          *(share(classes[one], len(followed))
                            for one in CLASSES)])
    return markdown.table(["machines", "exits by", "drawn", *REASONS,
                           "followed", *CLASSES], lines, range(2, 7))


def by_bins(rows: Sequence[read.Row], column: str,
            edges: Sequence[float]) -> Iterable[list[object]]:
    """Lines: a bin of a column and the shares in it."""
    for low, high in zip(edges, edges[1:]):
        here = [row for row in rows if low <= row.number(column) < high]
        classes = Counter(class_of(row, "random") for row in here)
        yield [f"{low:.3g} to {high:.3g}", len(here),
               *(share(classes[one], len(here)) for one in CLASSES)]


def ratios(rows: Sequence[read.Row]) -> str:
    """Shares by the ratio of the eigenvalues."""
    lines = [[SPACES[space], *line] for space in SPACES
             for line in by_bins([row for row in rows
                                  if row["space"] == space], "ratio", RATIOS)]
    return markdown.table(["machines", "ratio of eigenvalues", "followed",
                           *CLASSES], lines, [2])


def quarters(rows: Sequence[read.Row], column: str) -> list[float]:
    """The edges of four bins with as many machines each."""
    values = [row.number(column) for row in rows]
    edges = list(np.quantile(values, [0, 0.25, 0.5, 0.75, 1]))
    edges[-1] = float(np.nextafter(edges[-1], np.inf))
    return edges


def parameters(rows: Sequence[read.Row]) -> str:
    """Shares by quarters of each parameter that was drawn."""
    lines = [[column, *line] for column in DRAWN
             for line in by_bins(rows, column, quarters(rows, column))]
    return markdown.table(["parameter", "quarter", "followed", *CLASSES],
                          lines, [2])


def draw_designs(axes: pyplot.Axes, rows: Sequence[read.Row],
                 kind: str) -> None:
    """The window of figure 4."""
    for one in CLASSES:
        here = [row for row in rows if class_of(row, kind) == one]
        axes.plot([row.number("r") for row in here],
                  [row.number("omega") for row in here], "s", ms=3.4,
                  mew=0, color=COLOURS[one], label=f"{one} ({len(here)})")
    axes.plot(0.1859, -1.037, "+", color="black", ms=9)
    axes.annotate("chaos", (0.1859, -1.037), (4, 4), fontsize=8,
                  textcoords="offset points")
    axes.set(title=f"designs, exits by {kind}", xlabel="r* [m]",
             ylabel="omega* [rad/s]")
    axes.legend(loc="lower left", fontsize=7, markerscale=2)


def draw_shares(axes: pyplot.Axes, rows: Sequence[read.Row],
                column: str, edges: Sequence[float], label: str) -> None:
    """The share of lasting machines over bins, with its interval."""
    at, middle, low, high = [], [], [], []
    for a, b in zip(edges, edges[1:]):
        here = [row for row in rows if a <= row.number(column) < b]
        if len(here) < 10:
            continue
        found = statistics.wilson(sum(class_of(row, "random") == "lasting"
                                      for row in here), len(here))
        at.append((a + b) / 2)
        middle.append(found.value)
        low.append(found.value - found.low)
        high.append(found.high - found.value)
    axes.errorbar(at, middle, [low, high], fmt=".-", lw=1, label=label)


def draw(path: str, rows: Sequence[read.Row]) -> None:
    """The picture."""
    figure, panels = pyplot.subplots(2, 2, figsize=(11, 8.5))
    designs = [row for row in rows if row["space"] == "designs"]
    others = [row for row in rows if row["space"] == "random"]
    for axes, kind in zip(panels[0], KINDS):
        draw_designs(axes, designs, kind)
    axes = panels[1][0]
    for here, label in (designs, "designs"), (others, "at random"):
        draw_shares(axes, here, "ratio", np.arange(1, 16.01, 0.5), label)
    axes.set(title="exits at random", xlabel="ratio of the eigenvalues",
             ylabel="share of lasting machines", ylim=(0, 1))
    axes.legend(fontsize=8)
    axes = panels[1][1]
    for column in DRAWN:
        edges = quarters(others, column)
        ranks = [statistics.wilson(sum(
            class_of(row, "random") == "lasting" for row in here),
            max(1, len(here))).value for here in (
                [row for row in others if a <= row.number(column) < b]
                for a, b in zip(edges, edges[1:]))]
        axes.plot(range(1, 5), ranks, ".-", lw=1, label=column)
    axes.set(title="machines at random, exits at random",
             xlabel="quarter of the parameter's values", xticks=range(1, 5),
             ylabel="share of lasting machines", ylim=(0, 1))
    axes.legend(fontsize=7, ncol=3)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(words: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", help="all parts, one after the other")
    parser.add_argument("picture", help="ends in .png or .svg")
    given = parser.parse_args(words)
    rows = read.read_csv(given.table, ["reason"], counted=True)
    followed = [row for row in rows if not row["reason"]]
    draw(given.picture, followed)
    print(HEAD.format(machines=len(rows)))
    print(overview(rows), end="\n\n## By the ratio of the eigenvalues\n\n")
    print("Exits at random.\n")
    print(ratios(followed), end="\n\n## By the parameters\n\n")
    print("Machines at random, exits at random, in quarters of each "
          "parameter.\n")
    print(parameters([row for row in followed if row["space"] == "random"]))


if __name__ == "__main__":
    read.run_script(main)
