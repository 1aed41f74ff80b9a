"""`make statistics`: exits and returns of `chaos`, docs/statistics.md.

Intervals are of 95 %: shares by Wilson, quantiles by order statistics, which
assume nothing on the law; an end is - where the samples are too few to tell.
Cycles of --by random start afresh at the two-fold and are independent. Those
of one sample of another kind are not, and have its size in common: a sample
counts as one.
"""
import os
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Iterator

import numpy as np
import pandas as pd
from scipy import stats

import cycles
import driven
import table

PAGE = "docs/statistics.md"
CYCLES = int(os.environ.get("CYCLES") or 1000)
MACHINES = os.environ.get("MACHINES") or "1000000"
STEPS = {"smoothing": "1e-4", "hysteresis": "1e-3", "delay": "1e-3",
         "random": "1e-2"}  # of `diverge`, without --dt
SIZES = "1e-5", "5e-6", "2.5e-6"
ENDS = "returned", "rest", "refused", "small_cycle", "timeout"  # of a cycle
# Two laws of the phase, or of a time in units of its spread, that differ by
# less than this anywhere in their shares are of no interest as two.
SMALLEST = 0.05
QUARTER = 0.25  # [s], of a histogram of times
GAP = 0.1  # in the family of exits: what no chord bridges
Run = tuple[str, str]  # name, options


# What is run.

def returns() -> Iterator[Run]:
    """Many returns: 100 samples of 1000 cycles, at two steps."""
    many = f"--samples 100 --cycles {CYCLES} --patience 300"
    few = f"--samples 100 --cycles {max(CYCLES // 10, 1)} --patience 300"
    yield "long", many
    yield "long-half", f"{many} --dt 5e-3"
    # What becomes of h = g = 0 decides whether it comes back.
    yield "even", f"--codim2 even {few}"
    yield "attracting", ("--codim2 attracting --samples 2000 --cycles 100 "
                         "--patience 20")
    for rate in (10, 250):
        yield f"rate-{rate}", f"--rate {rate} {few}"


def perturbed() -> Iterator[Run]:
    """Perturbations, over many cycles. Where they chatter at rest a second
    costs most, so that few of these are followed, and not for long. Below a
    width of some 2e-6 m/s rounding would decide (finer.py)."""
    for half, step in ("", ""), ("-half", " --dt 5e-5"):
        for size in ("5e-6", "1e-5", "1e-4"):
            yield f"many-smoothing-{size}{half}", (
                f"--by smoothing --size {size} --samples 20 --cycles 20 "
                f"--patience 100{step}")
    for kind in ("hysteresis", "delay"):
        yield f"many-{kind}-1e-4", (
            f"--by {kind} --size 1e-4 --samples 20 --cycles 20 --patience 10")


def first_cycles() -> Iterator[Run]:
    """Exits, and the winding at a section 2 mm past the two-fold. Of random
    exits enough to tell a difference of 0.05 from none."""
    one = "--patience 0.25 --section 2e-3"
    for rate in (30, 300, 3000):
        yield (f"family-{rate}",
               f"{one} --samples 7000 --near 100 --rate {rate}")
    for rate in (300, 150):
        yield f"exit-random-{rate}", (f"{one} --samples 20000 --near 100 "
                                      f"--rate {rate}")
    for size in SIZES:
        for kind in ("hysteresis", "delay"):
            yield (f"exit-{kind}-{size}",
                   f"{one} --samples 1000 --by {kind} --size {size}")


def all_runs() -> list[Run]:
    """Those that came last come last: a seed is the number of its run."""
    return [*returns(), *perturbed(), *first_cycles()]


def option(options: str, name: str, default: str) -> str:
    """The value of an option."""
    words = options.split()
    return dict(zip(words[::2], words[1::2])).get(name, default)


def steps_of(options: str) -> float:
    """About how many steps a run takes: a cycle is 10 s where several are
    asked for, else the patience."""
    cycles_of = float(option(options, "--cycles", "1"))
    length = 10 * cycles_of if cycles_of > 1 else \
        float(option(options, "--patience", ""))
    dt = option(options, "--dt", STEPS[option(options, "--by", "random")])
    return float(option(options, "--samples", "")) * length / float(dt)


def follow(work: Path, twofold: str) -> None:
    """All runs, each in shards: NAME-exits.csv and NAME-returns.csv."""
    begin, runs, done = time.time(), all_runs(), 0.0
    total = sum(steps_of(options) for _, options in runs)
    for i, (name, options) in enumerate(runs, 1):
        took = time.time() - begin
        left = (f", about {took * (total / done - 1):.0f} s left in all"
                if done > 0 else "")
        print(f"  {i} of {len(runs)} after {took:.0f} s{left}, {name}: "
              f"{options}", file=sys.stderr)
        # A seed of its own: no two runs have a draw in common.
        cycles.shards(work / name, twofold, ["chaos", *options.split(),
                                             "--seed", str(i)])
        done += steps_of(options)


# What is counted.

def count_returns(run: str, rows: pd.DataFrame) -> dict[str, object]:
    """Who of a run returned, and when."""
    hit = rows["outcome"] == "returned"
    back = rows[hit]
    ends = Counter(rows["outcome"])
    samples = rows["sample"].nunique()
    alike = run.startswith("many-")  # the cycles of a sample
    found = {"run": run, "samples": samples, "cycles": len(rows),
             **{end: ends[end] for end in ENDS},
             "worth": samples if alike else len(rows)}
    for name, p in (("median", 0.5), ("p90", 0.9)):
        one = table.quantile(back["time"], p)
        if alike:  # of their times no interval is known
            one = table.Estimate(one.value, np.nan, np.nan)
        found.update(zip((name, f"{name}_low", f"{name}_high"),
                         (f"{x:.4g}" for x in one)))
    return found


def count_exits(run: str, rows: pd.DataFrame) -> dict[str, object]:
    """The sides and phases of the exits of a run."""
    return {"run": run, "exits": len(rows),
            "up": (rows["side"] == "slip+").sum(),
            "wound": rows["phase"].notna().sum()}


Comparison = tuple[str, str, str, str, str]


def comparisons() -> list[Comparison]:
    """Two runs of random exits, the file and the column, and what it is: the
    step and its half, a rate and its half. What draws a width has an image of
    that for a distribution, which says nothing of its own."""
    found = [("long", "long-half", *rest) for rest in (
        ("returns", "time", "time from exit to return"),
        ("returns", "landing_r", "place of landing"),
        ("exits", "phase", "phase"), ("exits", "r", "place of exit"))]
    return found + [("exit-random-300", "exit-random-150", "exits", "phase",
                     "phase")]


def nearest(family: pd.DataFrame, runs: pd.DataFrame) -> np.ndarray:
    """How far runs are from what the set-valued law allows. From the two-fold
    the law without a perturbation allows a family of runs: stick along one
    curve for any time, then slip to either side. Where such a run passes a
    section r = const, in the plane of (time since the two-fold, phase of the
    winding), is a curve. A perturbed run that is not of the family has no
    reason to pass on it. The curve is the chords between members that follow
    one another in the time of exit, to the same side; a gap is none, and a
    member that ends a curve is a curve of its own. 1 is the spread of the
    family: standard deviations of time and of phase."""
    family = family.sort_values(["side", "exit"])
    plane = ["passed", "phase"]
    spread = family[plane].std(ddof=0).to_numpy()
    at, of = family[plane].to_numpy() / spread, runs[plane].to_numpy() / spread
    side = family["side"].to_numpy()
    a, chord = at[:-1], at[1:] - at[:-1]
    chord[(side[1:] != side[:-1]) | (np.hypot(*chord.T) >= GAP)] = 0
    length = np.maximum((chord ** 2).sum(1), np.finfo(float).tiny)
    found = []
    for one in of:
        way = one - a
        part = np.clip((way * chord).sum(1) / length, 0, 1)
        off = way - part[:, None] * chord
        found.append(np.sqrt((off ** 2).sum(1).min()))
    return np.array(found)


def count_nearest(work: Path, run: str, family: pd.DataFrame,
                  arrival: float) -> dict[str, object]:
    """Quantiles of a run's distances, and what chance would give: with the
    phases of the runs dealt to other runs."""
    runs = cycles.passages(work / f"{run}-exits.csv",
                           work / f"{run}-returns.csv", arrival)
    if runs.empty:
        return {"run": run, "runs": 0}
    dealt = runs.assign(phase=np.roll(runs["phase"], -(len(runs) // 2 + 1)))
    chance = table.quantile(nearest(family, dealt), 0.5).value
    found = nearest(family, runs)
    return {"run": run, "runs": len(runs), "by_chance": f"{chance:.3g}",
            **{f"{name}{end}": f"{x:.4g}" for name, p in (("median", 0.5),
                                                          ("p90", 0.9))
               for end, x in zip(("", "_low", "_high"),
                                 table.quantile(found, p))}}


def all_nearest(work: Path) -> Iterator[dict[str, object]]:
    """Of the runs from the two-fold, and of those that come to it first."""
    arrived = table.read(work / "exit-delay-2.5e-6-returns.csv",
                         counted=True)["arrived"]
    arrival = table.quantile(arrived[arrived > 0], 0.5).value
    family = pd.concat([cycles.passages(
        work / f"family-{rate}-exits.csv", work / f"family-{rate}-returns.csv",
        0) for rate in (30, 300, 3000)])
    for run, _ in first_cycles():
        if run.startswith("exit-") and run != "exit-random-150":
            yield count_nearest(work, run, family,
                                0 if "random" in run else arrival)


def count(work: Path, kept: Path, build: str) -> None:
    """Writes what the page is made of."""
    def read(run: str, kind: str) -> pd.DataFrame:
        return table.read(work / f"{run}-{kind}.csv", counted=True)

    def keep(name: str, rows: list[dict[str, object]]) -> None:
        frame = pd.DataFrame(rows)
        whole = frame.columns[[frame[c].dtype.kind == "f" for c in frame]]
        frame[whole] = frame[whole].astype("Int64")
        frame.to_csv(kept / f"exits-{name}.csv", index=False)

    many = [*returns(), *perturbed()]
    keep("returns", [count_returns(run, read(run, "returns"))
                     for run, _ in many])
    keep("sides", [count_exits(run, read(run, "exits")) for run, _ in
                   first_cycles() if run.startswith("exit-")])
    times = (read("long", "returns")["time"].dropna() // QUARTER).astype(int)
    keep("times", [{"quarter": i, "returns": k}
                   for i, k in sorted(Counter(times).items())])
    tests, found = comparisons(), []
    for a, b, kind, column, title in tests:
        first, second = (read(run, kind)[column].dropna() for run in (a, b))
        if len(first) and len(second):
            one = stats.ks_2samp(first, second)
            found.append({
                "run": a, "against": b, "of": title, "n": len(first),
                "m": len(second), "distance": f"{one.statistic:.4f}"})
    keep("distances", found)
    keep("nearest", list(all_nearest(work)))
    said = driven.output(f"{build}/study/machines", MACHINES).splitlines()
    keep("machines", [dict(zip(("two_folds", "machines", "of_case_1"),
                               map(int, line.split()))) for line in said[2:]])


# What the page shows.

def is_shown(run: str) -> bool:
    """Runs with half the step stand in the kept counts alone."""
    return not run.endswith("-half")


def interval(row: pd.Series, name: str) -> str:
    """A quantile that was kept."""
    return table.Estimate(*row[[name, f"{name}_low", f"{name}_high"]]).text(4)


def returns_table(frame: pd.DataFrame) -> str:
    """Who returned, and when."""
    return table.markdown(
        ["run", "cycles", "share that returned", "worth", "lost",
         "median of return [s]", "90 % [s]"],
        [[row.run, row.cycles,
          table.share(row.returned, row.cycles, row.worth).text(5),
          f"{row.worth:.0f}", ", ".join(
              f"{end} {row[end]}" for end in ENDS[1:] if row[end])
          or "none", interval(row, "median"), interval(row, "p90")]
         for _, row in frame.iterrows()
         if is_shown(row.run)])


def distances_table(frame: pd.DataFrame) -> str:
    """What is known of the distance of two laws: it lies within the band of
    that of the samples. Not to find a difference is not to find none: `alike`
    only where none is found and the distance cannot be as large as SMALLEST."""
    lines = []
    for _, row in frame.iterrows():
        band = table.band(row.n, row.m, len(comparisons()))
        small = row.distance + band < SMALLEST
        if row.distance > band:
            said = "different" + f", by less than {SMALLEST:g}" * small
        else:
            said = "alike" if small else "open"
        lines.append([row.run, row.against, row.of, f"{row.n}, {row.m}",
                      f"{row.distance:.4f}", f"{band:.4f}", said])
    return table.markdown(["run", "against", "of", "n, m", "distance",
                           "95 % band", "so they are"], lines)


def exits_table(sides: pd.DataFrame, close: pd.DataFrame) -> str:
    """How far exits are from the set-valued motion."""
    rows = sides.merge(close, how="left", on="run")
    return table.markdown(
        ["run", "exits", "by slip+", "wound there", "median distance", "90 %",
         "by chance"],
        [[row.run, row.exits, table.share(row.up, row.exits).text(3),
          row.wound, interval(row, "median"),
          interval(row, "p90"), f"{row.by_chance:.3g}"]
         for _, row in rows.iterrows()
         if row.wound > 0 and not np.isnan(row.by_chance)])


def gathered(times: pd.DataFrame) -> str:
    """About which times of return most lie."""
    found = Counter(dict(zip(times.quarter, times.returns)))
    full = [i for i in sorted(found) if found[i] > times.returns.sum() / 100
            and found[i] == max(found[j] for j in range(i - 4, i + 5))]
    return ("Times of return of `long` gather about 2 s apart; the fullest "
            "quarters of a second:\n" + ", ".join(
                f"{QUARTER * (i + 0.5):.1f}" for i in full) + " s.")


def parts(kept: Path) -> dict[str, str]:
    """What the page has of the counts."""
    of = {name: table.read(kept / f"exits-{name}.csv") for name in (
        "returns", "sides", "distances", "nearest", "machines", "times")}
    numbers = of["machines"].astype(str)
    return {
        "returns": returns_table(of["returns"]),
        "gathered": gathered(of["times"]),
        "distances": distances_table(of["distances"]),
        "exits": exits_table(of["sides"], of["nearest"]),
        "machines": table.markdown(
            ["two-folds", *numbers.two_folds],
            [["machines", *numbers.machines],
             ["of case 1", *numbers.of_case_1]])}
