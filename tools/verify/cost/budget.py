"""What a step costs on a board within a budget: the rows of docs/BUDGETS.md."""
from __future__ import annotations

import sys
from pathlib import Path
from typing import Iterable, NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import markdown  # noqa: E402

CLOCKS = 168e6, 600e6
COLUMNS = ("board", "real", "segments", "least", "median", "worst found",
           "bound", "found at 168 MHz", "at 600 MHz", "bound at 168 MHz",
           "at 600 MHz")


def rate(steps: float) -> str:
    """Steps a second, with one digit behind the point where they are few."""
    return f"{steps:.0f}" if steps >= 10 else f"{steps:.1f}"


class Budget(NamedTuple):
    """Instructions of a step; 0 segments: a plain one."""
    board: str
    real: str
    segments: int
    least: int
    median: int
    found: int
    bound: int

    def is_held(self) -> bool:
        """Whether no step that was found takes more than the bound."""
        return self.least <= self.median <= self.found <= self.bound

    def cells(self) -> list[object]:
        """Its line of the table."""
        return [self.board, self.real, self.segments or "plain", *self[3:],
                *(rate(clock / most) for most in (self.found, self.bound)
                  for clock in CLOCKS)]


def header() -> str:
    """The first lines of the table."""
    return markdown.header(COLUMNS, range(2, len(COLUMNS)))


def read_budgets(document: str) -> list[Budget]:
    """The rows of a document."""
    found = []
    inside = False
    for line in document.splitlines():
        inside = line.startswith("|") and (
            inside or line == markdown.row(COLUMNS))
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if inside and len(cells) == len(COLUMNS) and cells[3].isdigit():
            segments = 0 if cells[2] == "plain" else int(cells[2])
            found.append(Budget(*cells[:2], segments, *map(int, cells[3:7])))
    return found


def line_above(budgets: Iterable[Budget]) -> tuple[int, int]:
    """A and B such that each bound is at most A + B n, n the segments, and both
    ends are met if those between allow it."""
    bounds = {one.segments: one.bound for one in budgets if one.segments}
    least, most = min(bounds), max(bounds)
    slope = -(-(bounds[most] - bounds[least]) // max(most - least, 1))
    return max(bound - slope * n for n, bound in bounds.items()), slope


def verdict(wanted: int, plain: Budget, without: int) -> str:
    """Whether a plain step takes at most so much, and if not, why."""
    said = f"{plain.board} {plain.real}: at most {wanted} instructions of a " \
        f"plain step at worst: {{}}. The worst found takes {plain.found}; no " \
        f"step takes more than {plain.bound}."
    if plain.bound <= wanted:
        return said.format("reached")
    if plain.found <= wanted:
        return said.format("of what was found, but not by the bound")
    half = f" Half of the steps take {plain.median} or more." \
        if plain.median > wanted else \
        f" Half of the steps take no more than {plain.median}."
    return said.format("not reached") + half + (
        f" Of the bound {plain.bound - without} are the search for limit "
        "directions at h = g = 0 (`tf_search_quadrant`); the longest way "
        f"without it is {without}.")
