"""`make statistics`: exits and returns of `chaos`, and two-folds of random
machines.

Intervals are of 95 %: shares by Wilson, quantiles by order statistics, which
assume nothing on the law; an end is - where the samples are too few to tell.
Cycles start afresh at the two-fold and are independent.
"""
import os
from pathlib import Path

import numpy as np
import pandas as pd

import table
from chaos import Field

CYCLES = int(os.environ.get("CYCLES") or 1000)
MACHINES = int(os.environ.get("MACHINES") or 1000000)
LOST = "rest", "refused", "small_cycle", "timeout"  # ends but `returned`
# Two laws of the phase, or of a time in units of its spread, that differ by
# less than this anywhere in their shares are of no interest as two.
SMALLEST = 0.05
QUARTER = 0.25  # [s], of a histogram of times
MANY = f"--samples 100 --cycles {CYCLES} --patience 300"
FEW = f"--samples 100 --cycles {max(CYCLES // 10, 1)} --patience 300"
FIRST = f"--patience 0.25 --samples {20 * CYCLES}"
# Many returns, as `make recurrence` follows them, and by finer steps; what
# becomes of h = g = 0 decides whether it comes back; and first exits, enough to
# tell a difference of 0.05 from none.
RUNS = {
    "long": MANY, "long-fine": f"{MANY} --dt 1e-2 --set tolerance=1e-11",
    "even": f"--codim2 even {FEW}",
    "attracting": f"--codim2 attracting --samples {2 * CYCLES} --cycles 100 "
                  "--patience 20",
    "rate-10": f"--rate 10 {FEW}", "rate-250": f"--rate 250 {FEW}",
    "exit-random-300": f"{FIRST} --rate 300",
    "exit-random-150": f"{FIRST} --rate 150"}
COSTS = 10, 20, 1, 2, 1, 1, 1, 1
# Two runs, a step or rate and a smaller one: rows and a column.
COMPARED = [
    *(("long", "long-fine", *rest) for rest in (
        ("returns", "time", "time from exit to return"),
        ("returns", "landing_r", "place of landing"),
        ("exits", "phase", "phase"), ("exits", "r", "place of exit"))),
    ("exit-random-300", "exit-random-150", "exits", "phase", "phase")]
# Of random machines with m = 1: log-uniform.
DRAWN = {"d": (0.01, 1), "beta": (0.01, 1), "r0": (0.01, 1), "kappa": (0.01, 1),
         "mu": (0.01, 1), "k2": (0.1, 10), "c1": (1e-4, 0.1), "c2": (1e-4, 0.1),
         "omega0": (0.1, 10)}


def follow(work: Path, twofold: str) -> None:
    """All runs: NAME-exits.csv and NAME-returns.csv."""
    table.followed(work, twofold, RUNS, COSTS)


def two_folds(count: int, seed: int = 1) -> pd.DataFrame:
    """How many machines have so many two-folds, and so many of case 1. At a
    two-fold A, of degree two in r, and the h' of no force, of degree two in z,
    are 0, for the sign of g that they have. gamma is even in all angles, omega0
    has either sign. Shares hang on these ranges; that a count occurs does
    not."""
    draw = np.random.default_rng(seed)
    of = {name: low * (high / low) ** draw.random(count)
          for name, (low, high) in DRAWN.items()}
    of["omega0"] *= draw.choice([-1, 1], count)
    field = Field({"m": 1, **of, "gamma": draw.uniform(-np.pi, np.pi, count)})
    found, of_case_1 = np.zeros((2, count), int)
    with np.errstate(invalid="ignore"):
        for s in 1, -1:
            half = -s * of["kappa"] * field.cosine / 2
            width = np.sqrt(half ** 2 - (of["beta"] * field.sine) ** 2)
            for r in half + width, half - width:
                def free(z, r=r):
                    p = -r * z * field.cosine / field.sine
                    return field.rates(r, p, z, 0, 0)[3]

                by_z = (free(1) - free(-1)) / 2
                by_zz = (free(1) + free(-1)) / 2 - free(0)
                root = np.sqrt(by_z ** 2 - 4 * by_zz * free(0))
                for z in (root - by_z, -root - by_z):
                    z = z / (2 * by_zz)
                    there = s * r * z / field.sine > 0
                    found += there
                    of_case_1 += there & field.is_case_1(r, z, s)
    folds = range(max(found.max(), 4) + 1)
    return pd.DataFrame({"two_folds": folds, **{
        name: np.bincount(one, minlength=len(folds)) for name, one in (
            ("machines", found), ("of_case_1", of_case_1))}})


def returns_of(run: str, rows: pd.DataFrame) -> dict[str, object]:
    """How many cycles of a run returned, and when."""
    ends = rows.outcome.value_counts()
    back = rows.time[rows.outcome == "returned"]
    return {"run": run, "cycles": len(rows), "share that returned":
            table.share(len(back), len(rows)).text(5), "lost": ", ".join(
                f"{end} {ends[end]}" for end in LOST if end in ends) or "none",
            "median of return [s]": table.quantile(back, 0.5).text(4),
            "90 % [s]": table.quantile(back, 0.9).text(4)}


def compared(a: pd.Series, b: pd.Series) -> dict[str, object]:
    """What is known of the distance of two laws. Not to find a difference is
    not to find none: `alike` only where none is found and the distance cannot
    be as large as SMALLEST."""
    found = table.distance(a, b, len(COMPARED))
    small = found.high < SMALLEST
    return {"n, m": f"{len(a)}, {len(b)}", "distance": f"{found.value:.4f}",
            "95 % band": f"{found.high - found.value:.4f}", "so they are":
            "different" + f", by less than {SMALLEST:g}" * small
            if found.low > 0 else "alike" if small else "open"}


def gathered(times: pd.Series) -> str:
    """About which times of return most lie."""
    found = (times // QUARTER).astype(int).value_counts()
    full = [i for i in sorted(found.index) if found[i] > len(times) / 100
            and found[i] == max(found.get(j, 0) for j in range(i - 4, i + 5))]
    return ("Times of return of `long` gather about 2 s apart; the "
            "centres of the fullest bins of 0.25 s:\n" + ", ".join(
                f"{QUARTER * (i + 0.5):.1f}" for i in full) + " s.")


def count(work: Path, kept: Path) -> dict[str, object]:
    """The tables."""
    def rows(run: str, kind: str) -> pd.DataFrame:
        return table.read(work / f"{run}-{kind}.csv")

    up = rows("exit-random-300", "exits").side == "slip+"
    return {
        "returns": pd.DataFrame([
            returns_of(run, table.whole(rows(run, "returns"), "sample", run))
            for run in RUNS if not run.startswith("exit-")]),
        "gathered": gathered(rows("long", "returns").query(
            "outcome == 'returned'").time),
        "distances": pd.DataFrame([
            {"run": a, "against": b, "of": title, **compared(*(
                rows(run, kind)[column].dropna() for run in (a, b)))}
            for a, b, kind, column, title in COMPARED]),
        "sides": f"slip+ takes {table.share(sum(up), len(up)).text(3)} of "
                 f"{len(up)} exits.",
        "machines": two_folds(MACHINES).rename(
            columns=lambda name: name.replace("two_", "two-")
            .replace("_", " "))}
