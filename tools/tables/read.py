"""Reads tables of text: each row knows its columns by name.

What is missing or is not a number is an error that names file, line and
column, so that a changed header is noticed where it is read.
"""
from __future__ import annotations

import csv
import sys
from typing import Callable, Iterable, Optional, Sequence


class TableError(Exception):
    """What is wrong, and where: the file, and the line and column if known."""


class Row(dict):
    """The texts of one row, by the names of their columns."""

    def __init__(self, where: str, columns: Iterable[str],
                 fields: Iterable[str]) -> None:
        super().__init__(zip(columns, fields))
        self.where = where

    def __missing__(self, column: str) -> str:
        raise TableError(f"{self.where}: there is no column '{column}'")

    def number(self, column: str) -> float:
        """The number in a column; `inf` and `nan` are numbers, too."""
        try:
            return float(self[column])
        except ValueError:
            raise TableError(f"{self.where}: column '{column}' has "
                             f"'{self[column]}', which is no number") from None

    def count(self, column: str) -> int:
        """The whole number in a column."""
        try:
            return int(self[column])
        except ValueError:
            raise TableError(f"{self.where}: column '{column}' has "
                             f"'{self[column]}', which is no whole number"
                             ) from None


def _open(path: str) -> list[str]:
    """The lines of a file, or of standard input where the path is `-`."""
    try:
        if path == "-":
            return sys.stdin.read().splitlines()
        with open(path, encoding="utf-8") as file:
            return file.read().splitlines()
    except OSError as error:
        raise TableError(f"{path}: cannot be read: {error.strerror}") from None


def read_csv(path: str, needed: Sequence[str] = ()) -> list[Row]:
    """Rows of a CSV file. Its first line that is no comment names the columns.

    `needed` are columns that must be there even where there is no row.
    """
    lines = list(enumerate(_open(path), start=1))
    lines = [(i, line) for i, line in lines
             if line and not line.startswith("#")]
    if not lines:
        raise TableError(f"{path}: is empty and has no header")
    parsed = [(i, next(csv.reader([line]))) for i, line in lines]
    columns = parsed[0][1]
    for column in needed:
        if column not in columns:
            raise TableError(f"{path}: there is no column '{column}'")
    rows = []
    for i, fields in parsed[1:]:
        if len(fields) != len(columns):
            raise TableError(f"{path}:{i}: {len(fields)} fields under "
                             f"{len(columns)} columns")
        rows.append(Row(f"{path}:{i}", columns, fields))
    return rows


def read_words(path: str, columns: Sequence[str],
               separator: Optional[str] = None) -> list[Row]:
    """Rows of a file without a header, whose columns are named by the caller.

    Fields end at white space or at `separator`. The last column takes all
    that is left of its line.
    """
    rows = []
    for i, line in enumerate(_open(path), start=1):
        fields = line.split(separator, len(columns) - 1)
        if not fields:
            continue
        if len(fields) < len(columns):
            raise TableError(f"{path}:{i}: there is no column "
                             f"'{columns[len(fields)]}'")
        rows.append(Row(f"{path}:{i}", columns, fields))
    return rows


def numbers(rows: Iterable[Row], column: str) -> list[float]:
    """The numbers of a column; rows where it is empty are left out."""
    return [row.number(column) for row in rows if row[column] != ""]


def run_script(main: Callable[[], Optional[int]]) -> None:
    """Runs a script's main and ends with its code; 3 where a table is wrong."""
    try:
        code = main()
        sys.stdout.flush()
    except TableError as error:
        sys.exit(_complain(str(error)))
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(1)
    sys.exit(code)


def _complain(text: str) -> int:
    print(f"{sys.argv[0]}: {text}", file=sys.stderr)
    return 3
