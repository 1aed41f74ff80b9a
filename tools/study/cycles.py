"""What the files of `twofold diverge` say, with 95 % intervals:

    run summary RETURNS [EXITS]    outcomes, survival, quantiles, phases
    run ks FIRST SECOND COLUMN     Kolmogorov-Smirnov distance of a column
    run passages EXITS RETURNS ARRIVAL   where each run passed the section
    run shards OUT SCENE [OPTION]...     rows of one run, by all processors

Shares have Wilson's interval. Samples that follow one another from the
two-fold are independent under --by random, which starts afresh there; the
perturbations without a draw are not, so judge those by --cycles 1. An end of
an interval is - where the samples are too few to tell.
"""
from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Optional

import numpy as np
import pandas as pd
from scipy import stats

import driven
import table


def shards(out: str | Path, twofold: str, words: list[str]) -> None:
    """Runs `twofold diverge` in shards on this machine: OUT-exits.csv and
    OUT-returns.csv have the rows of one run, however many processors, because
    a sample depends on the seed and its own number alone. Each shard keeps its
    last line, by which readers see that none is missing. Where one fails
    nothing is joined."""
    jobs = driven.processors()
    with tempfile.TemporaryDirectory() as folder:
        def part(i: int) -> None:
            done = subprocess.run(
                [twofold, "diverge", *words, "--shard", f"{i}/{jobs}",
                 "--exits", f"{folder}/exits.{i}", "--returns",
                 f"{folder}/returns.{i}"], check=False, text=True,
                stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
            if done.returncode:
                raise table.TableError(
                    f"a shard of {out} failed; nothing was joined: "
                    f"{done.stderr.splitlines()[-1:]}")

        driven.side_by_side(part, range(1, jobs + 1))
        for kind in "exits", "returns":
            Path(f"{out}-{kind}.csv").write_bytes(b"".join(
                Path(folder, f"{kind}.{i}").read_bytes()
                for i in range(1, jobs + 1)))


def passages(exits: str | Path, returns: str | Path,
             arrival: float) -> pd.DataFrame:
    """Where runs passed the section: side, and the times of the exit and of
    the passage since the unperturbed motion arrived at the two-fold (`arrival`,
    0 for runs that start there), phase there [windings]. Runs that did not
    wind at the section are left out."""
    left = table.read(exits, counted=True).dropna(subset="phase")
    came = table.read(returns, counted=True)[["sample", "cycle", "arrived"]]
    both = left.merge(came, how="left", on=["sample", "cycle"])
    if both["arrived"].isna().any():
        raise table.TableError(f"{exits}: has a cycle that is not in "
                               f"{returns}")
    begin = both["arrived"] - arrival
    return pd.DataFrame({
        "side": np.where(both["side"] == "slip+", 1, -1),
        "exit": begin + both["time"], "passed": begin + both["section_time"],
        "phase": both["phase"]})


def phase_bins(rows: pd.DataFrame) -> list[int]:
    """How many phases there are in each tenth of a winding."""
    found = Counter((rows["phase"].dropna() * 10).astype(int) % 10)
    return [found[i] for i in range(10)]


def share(k: int, n: int) -> str:
    """A share with its interval, `-` where nothing was counted."""
    return "{:.5f} [{:.5f}, {:.5f}]".format(*table.share(k, n)) if n else "-"


def print_outcomes(rows: pd.DataFrame) -> None:
    """Outcomes, and how many samples have come so far."""
    begun = Counter(rows["cycle"])
    lived = Counter(rows["cycle"][rows["outcome"] == "returned"])
    print(f"samples {begun[1]}, cycles {len(rows)}, "
          f"windings a cycle {rows['windings'].sum() / len(rows):.3f}")
    for name, n in sorted(Counter(rows["outcome"]).items()):
        print(f"outcome {name:<12} {n:8}  share {share(n, len(rows))}")
    print("survival: cycle, samples that began it, "
          "share of these that returned")
    cycle = 1
    while cycle <= max(begun):
        print(f"  {cycle:6} {begun[cycle]:8}  "
              f"{share(lived[cycle], begun[cycle])}")
        cycle *= 2


def print_quantiles(title: str, values: pd.Series) -> None:
    """Mean and quantiles of a column."""
    values = values.dropna()
    if len(values) < 2:
        return
    print(f"{title}: mean {table.mean(values).text(6)}")
    for p in 0.1, 0.5, 0.9, 0.99:
        print(f"  {100 * p:4.0f} %  {table.quantile(values, p).text(6)}")


def print_exits(rows: pd.DataFrame) -> None:
    """Sides, releases and the phases at the section."""
    n = len(rows)
    print(f"exits {n}, slip+ share {share((rows.side == 'slip+').sum(), n)}")
    print("released by |lambda| = mu: share "
          f"{share((rows.how == 'released').sum(), n)}")
    bins = phase_bins(rows)
    n = sum(bins)
    if n == 0:
        return
    print(f"phase at the section [windings], share of {n}")
    for i, k in enumerate(bins):
        print(f"  {i / 10:.1f}-{(i + 1) / 10:.1f}  {share(k, n)}")
    print(f"chi^2 against even: {stats.chisquare(bins).statistic:.2f} at 9 "
          f"degrees ({stats.chi2.isf(0.05, 9):.2f} at 5 %)")


def summary(returns: str, exits: Optional[str] = None) -> None:
    """What became of the cycles, and of the exits."""
    rows = table.read(returns, ["cycle", "outcome", "time", "landing_r",
                                "windings"], counted=True)
    if rows.empty:
        raise table.TableError(f"{returns}: no cycle")
    left = table.read(exits, ["side", "phase", "how"],
                      counted=True) if exits else None
    print_outcomes(rows)
    back = rows[rows["outcome"] == "returned"]
    print_quantiles("time from exit to return [s]", back["time"])
    print_quantiles("place of landing r [m]", back["landing_r"])
    if left is not None:
        print_exits(left)


def ks(first: str, second: str, column: str) -> None:
    """n, m, the distance D of the two distributions, the band that D stays
    below in 95 % of cases if both were one, and the probability p of a distance
    as large. Empty fields are left out."""
    a, b = (table.read(path, [column], counted=True)[column].dropna()
            for path in (first, second))
    if a.empty or b.empty:
        raise table.TableError(f"column '{column}' has no number")
    found = stats.ks_2samp(a, b)
    print(f"n {len(a)}  m {len(b)}  D {found.statistic:.4f}  "
          f"band {table.band(len(a), len(b)):.4f}  p {found.pvalue:.3g}")


def print_passages(exits: str, returns: str, arrival: str) -> None:
    """Side, times of exit and passage, phase: a run a line."""
    passages(exits, returns, float(arrival)).to_csv(
        sys.stdout, sep=" ", header=False, index=False)


def join(out: str, *words: str) -> None:
    """The rows of one run, by all processors."""
    shards(out, os.environ["TWOFOLD"], list(words))


TOOLS = {"summary": summary, "ks": ks, "passages": print_passages,
         "shards": join}
