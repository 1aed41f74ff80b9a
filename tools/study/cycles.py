"""What the files of `twofold diverge` say:

    run ks FIRST SECOND COLUMN           Kolmogorov-Smirnov distance of a column
    run shards OUT SCENE [OPTION]...     rows of one run, by all processors

Samples that follow one another from the two-fold are independent under --by
random, which starts afresh there; the perturbations without a draw are not, so
judge those by --cycles 1.
"""
import os
import subprocess
import tempfile
from pathlib import Path

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


def join(out: str, *words: str) -> None:
    """The rows of one run, by all processors."""
    shards(out, os.environ["TWOFOLD"], list(words))


TOOLS = {"ks": ks, "shards": join}
