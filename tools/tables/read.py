"""Reads tables of text: each row knows its columns by name.

What is missing or is not a number is an error that names file, line and
column, so that a changed header is noticed where it is read.
"""
from __future__ import annotations

import csv
import re
import sys
import zlib
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
                             f"'{self[column]}', not a number") from None

    def count(self, column: str) -> int:
        """The whole number in a column."""
        try:
            return int(self[column])
        except ValueError:
            raise TableError(f"{self.where}: column '{column}' has "
                             f"'{self[column]}', which is no whole number"
                             ) from None


def _bytes(path: str) -> bytes:
    """What a file holds, or standard input where the path is `-`."""
    try:
        if path == "-":
            return sys.stdin.buffer.read()
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise TableError(f"{path}: cannot be read: {error.strerror}") from None


def _open(path: str) -> list[str]:
    """The lines of a file, or of standard input where the path is `-`."""
    return _bytes(path).decode("utf-8").splitlines()


TRAILER = re.compile(
    rb"# shard (\d+)/(\d+): (\d+) rows, crc32 ([0-9a-f]{8}), "
    rb"run ([0-9a-f]{8})\n")


def _check_shard(where: str, trailer: re.Match[bytes], lines: list[bytes],
                 header: bytes) -> None:
    """The rows and the checksum of one shard are those of its trailer."""
    shard, shards, rows = (int(trailer[i]) for i in (1, 2, 3))
    found = len(lines) - (lines[:1] == [header])
    if (found, zlib.crc32(b"".join(lines))) != (rows, int(trailer[4], 16)):
        raise TableError(f"{where}: shard {shard}/{shards} is damaged: its "
                         f"{rows} rows are not the {found} lines before it")


def _check_shards(path: str, lines: list[bytes], needed: bool) -> None:
    """All shards of one run are there, in their order and whole.

    `lines` keep their line ends. A file without any trailer passes unless one
    is `needed`.
    """
    header = next((line for line in lines if not line.startswith(b"#")), b"")
    before, past, last, of, run = [], 0, 0, 0, b""
    for i, line in enumerate(lines, start=1):
        trailer = TRAILER.fullmatch(line)
        if trailer:
            shard, shards = int(trailer[1]), int(trailer[2])
            if shard != last + 1 or of not in (0, shards):
                raise TableError(f"{path}:{i}: shard {last + 1} is missing, "
                                 f"here is {shard}/{shards}")
            if run not in (b"", trailer[5]):
                raise TableError(f"{path}:{i}: shard {shard}/{shards} is of "
                                 "another run than those before it")
            _check_shard(f"{path}:{i}", trailer, before, header)
            before, past, last, of, run = [], i, shard, shards, trailer[5]
        elif not line.startswith(b"#"):
            before.append(line)
    if last != of:
        raise TableError(f"{path}: shard {last + 1}/{of} is missing")
    if before and (past or needed):
        raise TableError(f"{path}: no line behind line {past} counts the rows "
                         "there: the run was stopped, or the file is cut off")
    if needed and not past:
        raise TableError(f"{path}: no line counts its rows")


def read_csv(path: str, needed: Sequence[str] = (),
             counted: bool = False) -> list[Row]:
    """Rows of a CSV file. Its first line that is no comment names the columns.

    `needed` are columns that must be there even where there is no row.
    `counted`: the rows have to be those of whole shards of `twofold diverge`,
    as the last line of each says; where there is such a line, it is checked.
    """
    raw = _bytes(path).splitlines(keepends=True)
    _check_shards(path, raw, counted)
    lines = [(i, line.decode("utf-8").rstrip("\r\n"))
             for i, line in enumerate(raw, start=1)]
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
        if counted and fields == columns:
            continue  # of a shard that has a header, too
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
