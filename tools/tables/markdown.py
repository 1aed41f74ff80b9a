"""Tables in Markdown, and numbers as the reports write them."""
from __future__ import annotations

from typing import Iterable, Optional, Sequence


def header(columns: Sequence[str], right: Iterable[int] = ()) -> str:
    """The first two lines of a table. `right`: columns set to the right."""
    aligned = set(right)
    rule = ["--:" if i in aligned else "---" for i in range(len(columns))]
    return row(columns) + "\n|" + "|".join(rule) + "|"


def row(cells: Iterable[object]) -> str:
    """One line of a table."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(columns: Sequence[str], rows: Iterable[Iterable[object]],
          right: Iterable[int] = ()) -> str:
    """A whole table, without a line end behind its last line."""
    return "\n".join([header(columns, right)] + [row(cells) for cells in rows])


def digits(number: float, n: int) -> str:
    """A number with n significant digits, `-` where there is none."""
    return "-" if number != number else f"{number:.{n}g}"


def estimate(value: float, low: float, high: float, n: int) -> str:
    """A value and its interval; an end that is not known is `-`."""
    return f"{digits(value, n)} [{digits(low, n)}, {digits(high, n)}]"


def or_dash(text: Optional[str]) -> str:
    """The text, `-` where it is empty."""
    return text if text else "-"
