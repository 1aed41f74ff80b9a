"""What the sections of the study share: reading what the command line wrote,
intervals of 95 %, and pages whose tables are made from counts that are kept.
"""
from __future__ import annotations

import csv
import io
import math
import re
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Optional, Sequence

import numpy as np
import pandas as pd
from scipy import stats
from statsmodels.stats.proportion import proportion_confint
from tabulate import tabulate

LEVEL = 0.95
Z = float(stats.norm.isf((1 - LEVEL) / 2))
TRAILER = re.compile(
    rb"# shard (\d+)/(\d+): (\d+) rows, crc32 ([0-9a-f]{8}), "
    rb"run ([0-9a-f]{8})\n")


class TableError(Exception):
    """What is wrong, and where: the file, and the line if known."""


def run_script(main: Callable[[], Optional[int]]) -> None:
    """Runs a script's main and ends with its code; 3 where a table is wrong."""
    try:
        code = main()
        sys.stdout.flush()
    except TableError as error:
        print(f"{sys.argv[0]}: {error}", file=sys.stderr)
        sys.exit(3)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(1)
    sys.exit(code)


def said(*words: object) -> Optional[str]:
    """What the command line prints; None where it refuses."""
    done = subprocess.run([str(word) for word in words], check=False,
                          text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL)
    return done.stdout if done.returncode == 0 else None


def _check_shards(path: str, lines: list[bytes], needed: bool) -> None:
    """All shards of one run are there, in their order and whole: each ends
    with a line that counts its rows and names its run. A file without such a
    line passes unless one is `needed`."""
    header = next((line for line in lines if not line.startswith(b"#")), b"")
    before, past, last, of, run = [], 0, 0, 0, b""
    for i, line in enumerate(lines, start=1):
        trailer = TRAILER.fullmatch(line)
        if trailer:
            shard, shards, rows = (int(trailer[j]) for j in (1, 2, 3))
            if shard != last + 1 or of not in (0, shards):
                raise TableError(f"{path}:{i}: shard {last + 1} is missing, "
                                 f"here is {shard}/{shards}")
            if run not in (b"", trailer[5]):
                raise TableError(f"{path}:{i}: shard {shard}/{shards} is of "
                                 "another run than those before it")
            found = len(before) - (before[:1] == [header])
            if (found, zlib.crc32(b"".join(before))) != (
                    rows, int(trailer[4], 16)):
                raise TableError(
                    f"{path}:{i}: shard {shard}/{shards} is damaged: its "
                    f"{rows} rows are not the {found} lines before it")
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


def read(path: str | Path, columns: Sequence[str] = (), counted: bool = False,
         text: bool = False) -> pd.DataFrame:
    """Rows of a CSV file, `-` is standard input; the rest as `parsed`."""
    try:
        raw = sys.stdin.buffer.read() if str(path) == "-" else \
            Path(path).read_bytes()
    except OSError as error:
        raise TableError(f"{path}: cannot be read: {error.strerror}") from None
    return parsed(raw, str(path), columns, counted, text)


def parsed(raw: bytes, path: str = "output", columns: Sequence[str] = (),
           counted: bool = False, text: bool = False,
           tabs: bool = False) -> pd.DataFrame:
    """Rows of CSV, `path` is where they are from. `columns` have to be there.
    `counted`: the rows have to be those of whole shards. `text`: fields as
    they are written, and empty ones empty, not NaN. `tabs`: between tabs, and
    quotes are their own."""
    lines = raw.splitlines(keepends=True)
    _check_shards(path, lines, counted)
    lines = [line for line in lines if not line.startswith(b"#")]
    # A shard may have a header of its own.
    lines = lines[:1] + [line for line in lines[1:] if line != lines[0]]
    try:
        found = pd.read_csv(
            io.BytesIO(b"".join(lines)), float_precision="round_trip",
            sep="\t" if tabs else ",",
            quoting=csv.QUOTE_NONE if tabs else csv.QUOTE_MINIMAL,
            dtype=str if text else None, keep_default_na=not text)
    except (pd.errors.EmptyDataError, pd.errors.ParserError) as error:
        raise TableError(f"{path}: {error}") from None
    for column in columns:
        if column not in found:
            raise TableError(f"{path}: there is no column '{column}'")
    return found


# Statistics.

class Estimate(NamedTuple):
    """A value with its interval; a bound that no sample gives is NaN."""
    value: float
    low: float
    high: float

    def text(self, n: int) -> str:
        """With n significant digits; `-` is what is not known."""
        if math.isnan(self.value):
            return "-"
        value, low, high = ("-" if math.isnan(x) else f"{x:.{n}g}"
                            for x in self)
        return f"{value} [{low}, {high}]"


def share(k: float, n: float, worth: Optional[float] = None) -> Estimate:
    """The share k of n with Wilson's interval, of so many independent ones as
    they are `worth`, by default all."""
    if not n:
        return Estimate(math.nan, math.nan, math.nan)
    size = n if worth is None else worth
    low, high = proportion_confint(k / n * size, size, 1 - LEVEL, "wilson")
    return Estimate(k / n, 0 if k == 0 else float(low),
                    1 if k == n else float(high))


def quantile(values: Iterable[float], p: float) -> Estimate:
    """The least value that a share p of all does not exceed. The interval is
    between order statistics and assumes nothing of the distribution: how many
    values lie below the quantile is binomial. Of few values it has an open
    end."""
    ordered = [math.nan, *sorted(values), math.nan]
    n = len(ordered) - 2
    if n == 0:
        return Estimate(math.nan, math.nan, math.nan)
    tail = (1 - LEVEL) / 2
    low = int(stats.binom.ppf(tail, n, p))
    high = int(stats.binom.isf(tail, n, p)) + 1
    value = np.quantile(ordered[1:-1], p, method="inverted_cdf")
    return Estimate(float(value), ordered[low], ordered[min(high, n + 1)])


def band(n: int, m: int, tests: int = 1) -> float:
    """What the Kolmogorov-Smirnov distance of samples of n and m of one law
    stays below in 95 % of cases, in all of so many tests together (Bonferroni):
    by the distribution of one sample of n m / (n + m)."""
    return float(stats.kstwo.isf((1 - LEVEL) / tests,
                                 max(1, round(n * m / (n + m)))))


# Pages. A page is its own template: what the program fills stands behind a line
# <!-- NAME --> and before an empty one; all other words are the page's.

def markdown(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table, of texts as they are."""
    return tabulate([[str(cell) for cell in row] for row in rows], columns,
                    "github", disable_numparse=True)


def filled(page: str, parts: dict[str, str], commit: str) -> str:
    """A page with its parts and the line of the commit that they are of."""
    for name, text in parts.items():
        page, count = re.subn(rf"(<!-- {name} -->\n)(?:.+\n)*",
                              lambda found, text=text: found[1] + text + "\n",
                              page)
        if count != 1:
            raise TableError(f"the page has {count} places for {name}")
    return re.sub(r"^Of commit .*$", lambda _: commit, page, flags=re.M)
