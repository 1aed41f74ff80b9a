"""Connected regions of the maps over the designs: cells of the grid whose
machines are lasting and that touch, by a side or a corner.
"""
from __future__ import annotations

from typing import Callable, Sequence

import numpy as np
from scipy import ndimage

import machines
from tables import markdown, read

FEWEST = 3  # machines of a region that is listed
CHAOS = 0.1859, -1.037  # r* [m], omega* [rad/s]


def regions(cells: Sequence[tuple[int, int]]) -> list[list[int]]:
    """Numbers of the cells of each region, the largest one first."""
    if not cells:
        return []
    grid = np.zeros(np.max(cells, axis=0) + 1, dtype=bool)
    grid[tuple(np.transpose(cells))] = True
    labels, count = ndimage.label(grid, np.ones((3, 3)))
    found: list[list[int]] = [[] for _ in range(count)]
    for i, (row, column) in enumerate(cells):
        found[labels[row, column] - 1].append(i)
    return sorted(found, key=len, reverse=True)


def lines(rows: Sequence[read.Row], of: tuple[str, str],
          total: int) -> list[list[object]]:
    """Of the table: the regions of lasting machines of a space."""
    name, kind = of
    (low, high), (slow, fast) = machines.SPACES[name].window or ((0, 0),) * 2
    side = machines.side(name, total)
    half = np.array([(high - low), (fast - slow)]) / side / 2
    cells = [machines.cell(row.count("machine"), name, total) for row in rows]
    found = []
    for region in regions(cells):
        at = np.array([(rows[i].number("r"), rows[i].number("omega"))
                       for i in region])
        holds = (np.abs(at - CHAOS) <= half).all(axis=1).any()
        if len(region) >= FEWEST or holds:
            (r, omega), (r_end, omega_end) = at.min(axis=0), at.max(axis=0)
            found.append([machines.SPACES[name].title, kind, len(region),
                          f"{r:.3f} to {r_end:.3f}",
                          f"{omega:.3f} to {omega_end:.3f}",
                          "yes" if holds else "no"])
    return found


def section(rows: Sequence[read.Row],
            class_of: Callable[[read.Row, str], str], total: int) -> str:
    """Of the page: where lasting machines lie. rows: those followed."""
    found = []
    for name, space in machines.SPACES.items():
        for kind in machines.KINDS if space.window else ():
            found += lines([row for row in rows if row["space"] == name and
                            class_of(row, kind) == "lasting"],
                           (name, kind), total)
    return "\n".join([
        "## Where it is lasting\n",
        f"Regions of {FEWEST} machines or more of the maps that touch by a "
        "side or a corner, and that\nof `chaos`, from the middle of the first "
        "cell to that of the last one. Where the cells\nof the two maps differ "
        "the smaller one decides:\n",
        markdown.table(["machines", "exits by", "lasting", "r* [m]",
                        "omega* [rad/s]", "has the cell of `chaos`"],
                       found, [2]), ""])
