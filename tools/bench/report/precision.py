"""Tables of work and precision, a section a part.

Slopes are least squares of log(error) over log(dial) on settings that are
neither another branch nor flagged, coarser than the one of least error, 30
times above that error, which rounding or the other dial sets, and below a
tenth of the part's border. `Error for T`: the least error that a setting of at
most that time has, its two neighbours on the grid included, so that no lucky
setting counts. `Time to E`: the least time of a setting that has it, the next
two included.
"""
from __future__ import annotations

import math
from typing import Callable, Iterable, Sequence

import numpy as np

from series import Series, Setting, least_time, read_sweep, timed
from tables import markdown, read

PART_COLUMNS = ("name", "title", "problem", "begin", "end", "border",
                "uncertainty", "source")
BUDGETS = {"3 us": 3e3, "10 us": 1e4, "100 us": 1e5, "1 ms": 1e6}
LEVELS = 1e-3, 1e-6, 1e-9
MARKS = "ok", "flagged", "branch", "refused"


def read_parts(path: str) -> list[read.Row]:
    """The parts of the motion, as `sweep parts` prints them."""
    return read.read_words(path, PART_COLUMNS, ",")


def usable(settings: Sequence[Setting], border: float) -> list[Setting]:
    """The settings that tell a slope."""
    good = [i for i, s in enumerate(settings)
            if s.mark == "ok" and s.error > 0]
    if not good:
        return []
    last = min(good, key=lambda i: settings[i].error)
    low = settings[last].error
    return [s for s in settings[:last]
            if s.mark == "ok" and 30 * low <= s.error <= 0.1 * border]


def slope(settings: Sequence[Setting], border: float) -> str:
    """The order that a series has, where four settings or more tell it."""
    kept = usable(settings, border)
    dials = [s.dial for s in kept]
    if len(kept) < 4 or max(dials) < 4 * min(dials):
        return "-"
    fit = np.polyfit(np.log10(dials), np.log10([s.error for s in kept]), 1)
    return f"{fit[0]:.1f}"


def expected(series: Series) -> str:
    """What theory says: theta = 1/2; a series of order 8, 6 in float.

    Where slip falls into h = g = 0 the tolerance says how near is there,
    whatever the step.
    """
    smooth = series.part in ("smooth", "approach")
    if series.scheme != "located":
        return "2" if smooth else "1"
    if series.dial == "dt":
        return "none: the tolerance holds the error"
    if series.dial != "order":
        return "1"
    if series.part in ("codim2", "cycle"):
        return "none: the tolerance holds the fall into h = g = 0"
    if not smooth:
        return ">= 3"
    return "8" if series.real == "double" else "6"


def bought(settings: Sequence[Setting], budget: float) -> float:
    """The least error within a time, infinity where there is none."""
    best = math.inf
    for i, setting in enumerate(settings):
        if setting.ns > budget:
            continue
        worst = max(math.inf if s.mark == "refused" else s.error
                    for s in settings[max(0, i - 1):i + 2])
        best = min(best, worst)
    return best


def finite(number: float, write: Callable[[float], str]) -> str:
    """A number as it is written, `-` where it is infinite."""
    return write(number) if number < math.inf else "-"


def error_text(error: float) -> str:
    """One digit."""
    return finite(error, lambda e: f"{e:.0e}")


def event_text(series: Series) -> str:
    """Largest ratio of the error of an event's time to the step.

    Of `located`, whose events are inside the step, the largest error.
    """
    located = series.scheme == "located"
    errors = [s.event if located else s.event / s.step
              for s in series.settings
              if s.mark == "ok" and not math.isnan(s.event)]
    if not errors:
        return "-"
    largest = max(0.0, *errors)
    return f"{largest:.0e} s" if located else f"{largest:.2f} dt"


def inside(settings: Sequence[Setting]) -> str:
    """The worst error over time by that at the end, the largest ratio."""
    return f"""{max([1.0] + [s.worst / s.error for s in settings
                             if s.mark == 'ok' and s.error > 0]):.3g}"""


def series_row(series: Series, border: float) -> list[str]:
    """One series in the table of its part."""
    settings = series.settings
    drift = max(0.0, *(s.drift for s in settings))
    return [series.real, f"{series.scheme}, {series.dial}",
            slope(settings, border), expected(series),
            *(error_text(bought(settings, budget))
              for budget in BUDGETS.values()),
            *(finite(least_time(timed(settings), level),
                     lambda ns: f"{ns / 1000:.3g}") for level in LEVELS),
            inside(settings), event_text(series),
            f"{drift:.0e}" if drift > 0 else "-",
            ", ".join(str(sum(s.mark == mark for s in settings))
                      for mark in MARKS)]


def best_table(parts: list[read.Row], sweep: list[Series]) -> str:
    """The error that a scheme buys, its best dial."""
    schemes = "moreau", "compensated", "located"
    rows = []
    for part in parts:
        row = [part["title"]]
        for scheme in schemes:
            mine = [series.settings for series in sweep
                    if (series.part, series.real, series.scheme)
                    == (part["name"], "double", scheme)]
            row += [error_text(min((bought(settings, budget)
                                    for settings in mine), default=math.inf))
                    for budget in BUDGETS.values()]
        rows.append(row)
    first, *others = BUDGETS
    columns = ["part"]
    for scheme in schemes:
        columns += [f"{scheme}: {first}", *others]
    return markdown.table(columns, rows)


def part_columns() -> list[str]:
    """The head of the table of a part."""
    first, *others = BUDGETS
    return ["real", "scheme, dial", "slope", "expected", f"error for {first}",
            *others, "us to 1e-3", "to 1e-6", "to 1e-9",
            "worst over time / final", "event time",
            "\\|h\\| in stick [m/s]", "ok, flagged, other branch, refused"]


def tables(parts_path: str, sweep_path: str) -> Iterable[str]:
    """All sections."""
    parts, sweep = read_parts(parts_path), read_sweep(sweep_path)
    yield "\nError that a scheme buys, in double, its best dial:\n"
    yield best_table(parts, sweep)
    for part in parts:
        yield f"\n### {part['title']}\n"
        yield (f"Problem `{part['problem']}`, {part['begin']} s to "
               f"{part['end']} s. Reference: {part['source']}, uncertainty "
               f"{part['uncertainty']}.\n")
        yield markdown.table(part_columns(), [
            series_row(series, part.number("border"))
            for series in sweep if series.part == part["name"]])
