"""`make statistics`: exits and returns of `chaos`, docs/statistics.md.

Intervals are of 95 %: shares by Wilson, quantiles by order statistics, which
assume nothing on the law; an end is - where the samples are too few to tell.
Cycles of --by random start afresh at the two-fold and are independent. Those
of one sample of another kind are not: theirs have the intervals of as many
independent ones as they are worth (table.py).
"""
from __future__ import annotations

import os
import subprocess
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
STEPS = {"noise": "1e-3", "smoothing": "1e-4", "hysteresis": "1e-3",
         "delay": "1e-3", "random": "1e-2"}  # of `diverge`, without --dt
SIZES = "1e-5", "5e-6", "2.5e-6"
KINDS = "noise", "hysteresis", "delay"
ENDS = "returned", "pinned", "refused", "small_cycle", "timeout"  # of a cycle
MARKS = 10, 30, 100, 300, 1000  # of the waits [s]
# Two laws of the phase, or of a time in units of its spread, that differ by
# less than this anywhere in their shares are of no interest as two.
SMALLEST = 0.05
# Of fewer samples with the rarer outcome a correlation says nothing.
TELLING = 5
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
    costs most, so that few of these are followed, and not for long."""
    many = "--samples 20 --cycles 20 --patience 100"
    for half, steps in (("", {"noise": "", "smoothing": ""}),
                        ("-half", {"noise": " --dt 5e-4",
                                   "smoothing": " --dt 5e-5"}),
                        ("-quarter", {"noise": " --dt 2.5e-4"})):
        for size in ("1e-6", "1e-5", "1e-4"):
            for kind, step in steps.items():
                yield (f"many-{kind}-{size}{half}",
                       f"--by {kind} --size {size} {many}{step}")
    for kind in ("hysteresis", "delay"):
        yield f"many-{kind}-1e-4", (
            f"--by {kind} --size 1e-4 --samples 20 --cycles 20 --patience 10")


def waits() -> Iterator[Run]:
    """First returns that are waited for long."""
    for half, step in (("", ""), ("-half", " --dt 5e-4"),
                       ("-quarter", " --dt 2.5e-4")):
        yield (f"wait-noise-1e-4{half}", "--by noise --size 1e-4 --samples 100 "
               f"--patience 1000{step}")
    for size in ("1e-5", "1e-6"):
        yield (f"wait-noise-{size}",
               f"--by noise --size {size} --samples 50 --patience 1000")
    for one, spread in (("", ""), ("-one", " --spread 1")):
        for kind in ("hysteresis", "delay"):
            for size in ("1e-3", "1e-4"):
                yield (f"wait-{kind}-{size}{one}", f"--by {kind} --size {size} "
                       f"--samples 50 --patience 300{spread}")


def first_cycles() -> Iterator[Run]:
    """Exits, and the winding at a section 2 mm past the two-fold; of smoothing,
    which leaves earlier, at 1 mm. Of random exits and noise enough to tell a
    difference of 0.05 from none."""
    one = "--patience 0.25 --section 2e-3"
    near = "--patience 0.25 --section 1e-3"
    for rate in (30, 300, 3000):
        rest = f"--samples 7000 --near 100 --rate {rate}"
        yield f"family-{rate}", f"{one} {rest}"
        yield f"near-{rate}", f"{near} {rest}"
    for rate in (300, 150):
        yield f"exit-random-{rate}", (f"{one} --samples 20000 --near 100 "
                                      f"--rate {rate}")
    for size in SIZES:
        yield (f"exit-noise-{size}",
               f"{one} --samples 10000 --by noise --size {size}")
        for kind in ("hysteresis", "delay"):
            yield (f"exit-{kind}-{size}",
                   f"{one} --samples 1000 --by {kind} --size {size}")
    for size in ("5e-7", "2.5e-7", "1.25e-7"):
        yield f"exit-smoothing-{size}", (
            f"{near} --samples 1000 --by smoothing --size {size} --dt 5e-5")
    yield "exit-noise-2.5e-6-half", (
        f"{one} --samples 10000 --by noise --size 2.5e-6 --dt 5e-4")
    yield "exit-smoothing-2.5e-7-half", (
        f"{near} --samples 1000 --by smoothing --size 2.5e-7 --dt 2.5e-5")
    for kind in ("hysteresis", "delay"):
        yield f"exit-{kind}-5e-6-half", (
            f"{one} --samples 1000 --by {kind} --size 5e-6 --dt 5e-4")


def all_runs() -> list[Run]:
    """Those that came last come last: a seed is the number of its run."""
    return [*returns(), *perturbed(), *first_cycles(), *waits()]


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
        if name == "long":
            long = time.time() - begin
    pd.DataFrame([{"seconds": round(time.time() - begin), "long": round(long),
                   "processors": driven.processors(), **cost(twofold)}]
                 ).to_csv(work / "made.csv", index=False)


def cost(twofold: str) -> dict[str, object]:
    """Time of a cycle and memory of one process."""
    with subprocess.Popen(
            [twofold, "diverge", "chaos", "--samples", "400", "--cycles", "10",
             "--patience", "300"], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL) as job:
        _, code, used = os.wait4(job.pid, 0)
        job.returncode = code
    return {"us_a_cycle": round(1e6 * used.ru_utime / 4000),
            "kB": used.ru_maxrss}


# What is counted.

def worth_of(run: str, rows: pd.DataFrame, hit: pd.Series) -> float:
    """How many independent cycles tell as much as these of a value."""
    if not run.startswith("many-"):  # its cycles are independent
        return len(rows)
    groups = [group for _, group in hit.groupby(rows["sample"])]
    telling = min(sum(group.any() for group in groups),
                  sum(not group.all() for group in groups))
    return table.worth(groups) if telling >= TELLING else len(groups)


def count_returns(run: str, rows: pd.DataFrame) -> dict[str, object]:
    """Who of a run returned, and when."""
    hit = rows["outcome"] == "returned"
    back = rows[hit]
    ends = Counter(rows["outcome"])
    found = {"run": run, "samples": rows["sample"].nunique(),
             "cycles": len(rows), **{end: ends[end] for end in ENDS},
             "worth": f"{worth_of(run, rows, hit):.6g}"}
    for name, p in (("median", 0.5), ("p90", 0.9)):
        at = table.quantile(back["time"], p).value
        worth = worth_of(run, back, back["time"] <= at) if len(back) else 0
        one = table.quantile(back["time"], p, worth)
        found.update(zip((name, f"{name}_low", f"{name}_high"),
                         (f"{x:.4g}" for x in one)))
    return found


def count_lost(run: str, rows: pd.DataFrame) -> list[dict[str, object]]:
    """How many samples began each cycle in which some were lost."""
    began = rows["cycle"].value_counts()
    lost = rows["cycle"][rows["outcome"] != "returned"].value_counts()
    return [{"run": run, "cycle": cycle, "began": began[cycle], "lost": k}
            for cycle, k in sorted(lost.items())]


def count_waits(run: str, options: str,
                rows: pd.DataFrame) -> dict[str, object]:
    """How many have returned for the first time after how long."""
    times = rows["time"][rows["outcome"] == "returned"]
    patience = float(option(options, "--patience", ""))
    return {"run": run, "samples": len(rows),
            **{f"by_{mark}": (times <= mark).sum() for mark in MARKS
               if mark <= patience}}


def count_exits(run: str, rows: pd.DataFrame) -> dict[str, object]:
    """The sides and phases of the exits of a run."""
    return {"run": run, "exits": len(rows),
            "up": (rows["side"] == "slip+").sum(),
            **{f"bin{i}": k for i, k in enumerate(cycles.phase_bins(rows))}}


Comparison = tuple[str, str, str, str, str]


def phases(a: str, b: str) -> Comparison:
    """The phases of the exits of two runs."""
    return f"exit-{a}", f"exit-{b}", "exits", "phase", "phase"


def comparisons() -> list[Comparison]:
    """Two runs, the file and the column, and what it is. First runs and what
    they are with half the step, then kinds of perturbation against each other,
    then sizes halved."""
    found = [("long", "long-half", *rest) for rest in (
        ("returns", "time", "time from exit to return"),
        ("returns", "landing_r", "place of landing"),
        ("exits", "phase", "phase"), ("exits", "r", "place of exit"))]
    found += [phases(run, run + "-half") for run in (
        "noise-2.5e-6", "smoothing-2.5e-7", "hysteresis-5e-6", "delay-5e-6")]
    kinds = ["random-300"] + [f"{kind}-2.5e-6" for kind in KINDS]
    found += [phases(a, b) for i, a in enumerate(kinds) for b in kinds[i + 1:]]
    found.append(("near-300", *phases("", "smoothing-2.5e-7")[1:]))
    found.append(phases("random-300", "random-150"))
    for kind in KINDS:
        found += [phases(f"{kind}-1e-5", f"{kind}-5e-6"),
                  phases(f"{kind}-5e-6", f"{kind}-2.5e-6")]
    return found + [phases("smoothing-5e-7", "smoothing-2.5e-7"),
                    phases("smoothing-2.5e-7", "smoothing-1.25e-7")]


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
    arrived = table.read(work / "exit-noise-2.5e-6-returns.csv",
                         counted=True)["arrived"]
    arrival = table.quantile(arrived[arrived > 0], 0.5).value
    for name in "family", "near":
        family = pd.concat([cycles.passages(
            work / f"{name}-{rate}-exits.csv",
            work / f"{name}-{rate}-returns.csv", 0)
            for rate in (30, 300, 3000)])
        for run, _ in first_cycles():
            if run.startswith("exit-") and run != "exit-random-150" and \
                    ("smoothing" in run) == (name == "near"):
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
    keep("lost", [one for run, _ in many
                  for one in count_lost(run, read(run, "returns"))])
    keep("waits", [count_waits(run, options, read(run, "returns"))
                   for run, options in waits()])
    keep("sides", [count_exits(run, read(run, "exits")) for run, _ in
                   first_cycles() if run.startswith("exit-") or
                   run == "near-300"])
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
                "m": len(second), "distance": f"{one.statistic:.4f}",
                "p": f"{min(1.0, len(tests) * one.pvalue):.3g}"})
    keep("distances", found)
    keep("nearest", list(all_nearest(work)))
    said = driven.output(f"{build}/study/machines", MACHINES).splitlines()
    keep("machines", [dict(zip(("two_folds", "machines", "of_case_1"),
                               map(int, line.split()))) for line in said[2:]])
    (kept / "exits-made.csv").write_bytes((work / "made.csv").read_bytes())


# What the page shows.

def is_shown(run: str) -> bool:
    """Runs with half the step stand in the kept counts alone."""
    return not run.endswith(("-half", "-quarter"))


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


def waits_table(frame: pd.DataFrame) -> str:
    """Runs of which some returned. Of one size there are few motions, of which
    no interval tells."""
    shown = frame[frame.run.map(is_shown)]
    some = shown.filter(like="by_").max(axis=1) > 0
    return table.markdown(
        ["run", "samples", *(f"by {mark} s" for mark in MARKS)],
        [[row.run, row.samples, *(
            "-" if np.isnan(k) else f"{k / row.samples:.2g}"
            if row.run.endswith("-one") else
            table.share(k, row.samples).text(5)
            for k in (row[f"by_{mark}"] for mark in MARKS))]
         for _, row in shown[some].iterrows()])


def none_waited(frame: pd.DataFrame) -> str:
    """Runs of which none returned."""
    none = frame[frame.run.map(is_shown) &
                 (frame.filter(like="by_").max(axis=1) == 0)]
    return "None returned of " + ", ".join(
        f"`{run[5:]}`" for run in none.run) + "."


def distances_table(frame: pd.DataFrame) -> str:
    """What is known of the distance of two laws: it lies within the band of
    that of the samples. Not to find a difference is not to find none: `alike`
    only where none is found and the distance cannot be as large as SMALLEST.
    Sizes halved stand in the kept counts."""
    lines = []
    for _, row in frame.head(15).iterrows():
        band = table.band(row.n, row.m, len(comparisons()))
        small = row.distance + band < SMALLEST
        if row.distance > band:
            said = "different" + f", by less than {SMALLEST:g}" * small
        else:
            said = "alike" if small else "open"
        lines.append([row.run, row.against, row.of, f"{row.n}, {row.m}",
                      f"{row.distance:.4f}", f"{band:.4f}", f"{row.p:.3g}",
                      said])
    return table.markdown(["run", "against", "of", "n, m", "distance",
                           "95 % band", "p", "so they are"], lines)


def exits_table(sides: pd.DataFrame, close: pd.DataFrame) -> str:
    """Sides and phases, and the distance from the set-valued motion."""
    lines = []
    for _, row in sides.merge(close, how="left", on="run").iterrows():
        bins = row[[f"bin{i}" for i in range(10)]].to_numpy(float)
        n = bins.sum()
        if is_shown(row.run) and n > 0 and not row.run.endswith(
                ("-5e-6", "-150")):
            lines.append([
                row.run, row.exits, table.share(row.up, row.exits).text(5),
                f"{n:.0f}", " ".join(f"{k / n:.3f}" for k in bins),
                f"{stats.chisquare(bins).statistic:.0f}",
                interval(row, "median"),
                "-" if np.isnan(row.by_chance) else f"{row.by_chance:.3g}"])
    return table.markdown(
        ["run", "exits", "share by slip+", "wound there", "bins 0.0 to 1.0",
         "chi^2", "median distance", "by chance"], lines)


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
        "returns", "waits", "sides", "distances", "nearest",
        "machines", "times", "made")}
    made = of["made"].iloc[0]
    long = of["returns"].cycles[0]
    numbers = of["machines"].astype(str)
    return {
        "made": f"Made in {made.seconds} s on {made.processors} processors; "
                f"run `long`, {long} cycles, took {made.long} s. One\nprocess "
                f"takes {made.us_a_cycle / 1000:.2g} ms a cycle and "
                f"{made.kB} kB, of which a cycle takes none.",
        "returns": returns_table(of["returns"]),
        "gathered": gathered(of["times"]),
        "waits": waits_table(of["waits"]),
        "none": none_waited(of["waits"]),
        "distances": distances_table(of["distances"]),
        "exits": exits_table(of["sides"], of["nearest"]),
        "machines": table.markdown(
            ["two-folds", *numbers.two_folds],
            [["machines", *numbers.machines],
             ["of case 1", *numbers.of_case_1]])}
