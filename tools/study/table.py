"""What sections of the study and of the bench share: rows of the command line,
intervals of 95 %, and the tables of documents.
"""
from __future__ import annotations

import io
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Optional, Sequence

import numpy as np
import pandas as pd
from scipy import stats
from statsmodels.stats.proportion import proportion_confint

import driven

LEVEL = 0.95
DOCUMENTS = "docs/STUDIES.md", "docs/NOISE.md", "docs/BENCH.md"


class TableError(Exception):
    """What is wrong, and where."""


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


def read(source: str | Path | io.StringIO, columns: Sequence[str] = (),
         **how: object) -> pd.DataFrame:
    """Rows of a CSV file (`-`: standard input), whose numbers keep their bits.
    `columns` have to be there."""
    try:
        found = pd.read_csv(sys.stdin if source == "-" else source,
                            comment="#", float_precision="round_trip", **how)
    except (OSError, UnicodeDecodeError, pd.errors.EmptyDataError,
            pd.errors.ParserError) as error:
        raise TableError(f"{source}: {error}") from None
    for column in columns:
        if column not in found:
            raise TableError(f"{source}: there is no column '{column}'")
    return found


def parsed(text: str) -> pd.DataFrame:
    """Rows that a program printed."""
    return read(io.StringIO(text))


def whole(rows: pd.DataFrame, column: str, path: object) -> pd.DataFrame:
    """The rows of a run, whose numbers in a column are 0, 1, 2, ...: a shard
    that is missing, doubled or not in its place is an error."""
    found = pd.to_numeric(rows[column], errors="coerce")  # no second header
    numbers = found.drop_duplicates().to_numpy()
    off = np.nonzero(numbers != np.arange(len(numbers)))[0]
    if len(off) or not found.is_monotonic_increasing:
        at = off[0] if len(off) else "one"
        raise TableError(f"{path}: {column} {at} is missing or not in its "
                         "place: a shard is missing, or is there twice")
    return rows


def sharded(work: Path, name: str, twofold: str,
            words: Sequence[str]) -> None:
    """Runs `twofold diverge` in shards on this machine: NAME-exits.csv and
    NAME-returns.csv have the rows of one run, however many processors, because
    a sample depends on the seed and its own number alone. Where a shard fails
    nothing is joined."""
    jobs = driven.processors()
    with tempfile.TemporaryDirectory() as folder:
        def part(i: int) -> None:
            if said(twofold, "diverge", "chaos", *words, "--shard",
                    f"{i}/{jobs}", "--exits", f"{folder}/exits.{i}",
                    "--returns", f"{folder}/returns.{i}") is None:
                raise TableError(f"a shard of {name} failed; nothing was "
                                 "joined")

        driven.side_by_side(part, range(1, jobs + 1), shows=False)
        for kind in "exits", "returns":
            (work / f"{name}-{kind}.csv").write_bytes(b"".join(
                Path(folder, f"{kind}.{i}").read_bytes()
                for i in range(1, jobs + 1)))


def followed(work: Path, twofold: str, runs: dict[str, str],
             costs: Sequence[float]) -> None:
    """All runs, by their options, each with a seed of its own: no two have a
    draw in common. `costs` are about in proportion to their times."""
    for seed, name in driven.shown([*enumerate(runs, 1)], costs,
                                   lambda item: item[1]):
        sharded(work, name, twofold, [*runs[name].split(), "--seed", str(seed)])


# Statistics.

class Estimate(NamedTuple):
    """A value with its interval; a bound that no sample gives is NaN."""
    value: float
    low: float
    high: float

    def text(self, n: int) -> str:
        """With n significant digits; `-` is what is not known."""
        value, low, high = ("-" if math.isnan(x) else f"{x:.{n}g}"
                            for x in self)
        return value if value == "-" else f"{value} [{low}, {high}]"

    def brief(self) -> str:
        """As 0.053(12): 12 is the half-width in units of the last digit."""
        half = max(self.high - self.value, self.value - self.low)
        if not half > 0:
            return f"{self.value:.3g}"
        n = max(0, 1 - math.floor(math.log10(half)))
        return f"{self.value:.{n}f}({half * 10 ** n:.0f})"


UNKNOWN = Estimate(math.nan, math.nan, math.nan)


def share(k: float, n: float) -> Estimate:
    """The share k of n with Wilson's interval."""
    if not n:
        return UNKNOWN
    low, high = proportion_confint(k, n, 1 - LEVEL, "wilson")
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
        return UNKNOWN
    tail = (1 - LEVEL) / 2
    low = int(stats.binom.ppf(tail, n, p))
    high = int(stats.binom.isf(tail, n, p)) + 1
    value = np.quantile(ordered[1:-1], p, method="inverted_cdf")
    return Estimate(float(value), ordered[low], ordered[min(high, n + 1)])


def distance(first: pd.Series, second: pd.Series, tests: int = 1) -> Estimate:
    """Kolmogorov's and Smirnov's distance of two laws, by samples of them. What
    it stays below in 95 % of cases where both are one law, in all of so many
    tests together (Bonferroni), is that of one sample of n m / (n + m)."""
    n, m = len(first), len(second)
    if not n or not m:
        return UNKNOWN
    found = float(stats.ks_2samp(first, second).statistic)
    band = float(stats.kstwo.isf((1 - LEVEL) / tests,
                                 max(1, round(n * m / (n + m)))))
    return Estimate(found, max(0.0, found - band), found + band)


# Documents. A program fills what stands behind a line <!-- NAME --> and before
# an empty one; all other words are the document's.

def markdown(rows: pd.DataFrame) -> str:
    """A table, of texts as they are."""
    text = rows.astype(str).to_markdown(index=False, disable_numparse=True,
                                        tablefmt="github")
    return re.sub(r"-{3,}", "--", re.sub(r" +\|", " |", text))


def filled(page: str, parts: dict[str, str]) -> str:
    """A document with those parts that it has a place for."""
    for name, text in parts.items():
        page = re.sub(rf"(<!-- {name} -->\n)(?:.+\n)*",
                      lambda found, text=text: found[1] + text + "\n", page)
    return page


def write(path: Path, parts: dict[str, object]) -> None:
    """Writes parts, tables or texts, each behind its name."""
    path.write_text("".join(
        f"<!-- {name} -->\n"
        f"{what if isinstance(what, str) else markdown(what)}\n\n"
        for name, what in parts.items()), "utf-8")


def publish(tables: Path) -> None:
    """Puts parts that were written into the documents that have a place for
    them."""
    text = tables.read_text("utf-8")
    parts = dict(part.rstrip("\n").split(" -->\n", 1)
                 for part in text.split("<!-- ")[1:])
    for path in map(Path, DOCUMENTS):
        if path.exists():
            page = path.read_text("utf-8")
            path.write_text(filled(page, parts), "utf-8")
