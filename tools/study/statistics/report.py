#!/usr/bin/python3 -B
"""The tables of `make statistics`, from the files that study has made.

Intervals are of 95 %: shares by Wilson, quantiles by order statistics, which
assume nothing on the law; an end is - where the samples are too few to tell.
Cycles of --by random start afresh at the two-fold and are independent. Those
of one sample of another kind are not: theirs have the intervals of as many
independent ones as they are worth (tables/statistics.py).
"""
from __future__ import annotations

import argparse
import math
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Callable, Iterable, Sequence

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import markdown, read, statistics  # noqa: E402
from passages import Passage, passages  # noqa: E402
from summary import RETURNED, phase_bins  # noqa: E402
import texts  # noqa: E402

SIZES = "1e-5", "5e-6", "2.5e-6"
KINDS = "noise", "hysteresis", "delay"
# Two laws of the phase, or of a time in units of its spread, that differ by
# less than this anywhere in their shares are of no interest as two.
SMALLEST = 0.05
# Of fewer samples with the rarer outcome a correlation says nothing.
TELLING = 5
QUARTER = 0.25  # [s], of a histogram of times
PERTURBED = tuple(f"many-{kind}-{size}{half}"
                  for kind in ("noise", "smoothing")
                  for size in ("1e-6", "1e-5", "1e-4")
                  for half in (("", "-half", "-quarter") if kind == "noise"
                               else ("", "-half")))
FEW = "many-hysteresis-1e-4", "many-delay-1e-4"


WAITED = [(f"wait-{name}", patience) for name, _, patience in texts.WAITS_OF]


class Study:
    """The files of a study, by the names of its runs."""

    def __init__(self, work: Path) -> None:
        self.work = work

    def path(self, run: str, kind: str) -> str:
        """The file of a run; kind: exits or returns."""
        return str(self.work / f"{run}-{kind}.csv")

    def rows(self, run: str, kind: str) -> list[read.Row]:
        """Its rows."""
        return read.read_csv(self.path(run, kind), counted=True)

    def passages(self, run: str, arrival: float) -> list[Passage]:
        """Where the runs passed the section."""
        return list(passages(self.path(run, "exits"),
                             self.path(run, "returns"), arrival))

    def seconds(self, name: str) -> str:
        """How long something took, as study wrote it down."""
        return (self.work / name).read_text(encoding="ascii").strip()


def share(k: int, n: int, worth: float | None = None) -> str:
    """A share with its interval."""
    if n == 0:
        return "-"
    found = statistics.wilson(k, n) if worth is None else \
        statistics.wilson_worth(k, n, worth)
    return markdown.estimate(*found, 5)


def quantile(values: Sequence[float], p: float,
             worth: float = math.inf) -> str:
    """A quantile with its interval."""
    if len(values) == 0:
        return "-"
    return markdown.estimate(*statistics.quantile(values, p, worth), 4)


def worth_of(run: str, rows: Iterable[read.Row],
             value: Callable[[read.Row], float]) -> float:
    """How many independent cycles tell as much as these of a value."""
    groups: dict[str, list[float]] = {}
    for row in rows:
        groups.setdefault(row["sample"], []).append(value(row))
    if run not in PERTURBED + FEW:  # its cycles are independent
        return float(sum(map(len, groups.values())))
    telling = min(sum(any(group) for group in groups.values()),
                  sum(not all(group) for group in groups.values()))
    return statistics.worth(list(groups.values())) if telling >= TELLING \
        else float(len(groups))


def is_back(row: read.Row) -> bool:
    """Whether the cycle of a row came back."""
    return row["outcome"] == RETURNED


def outcome_row(study: Study, run: str) -> list[object]:
    """Who of a run returned, and when."""
    cycles = study.rows(run, "returns")
    back = [row for row in cycles if is_back(row)]
    times = read.numbers(back, "time")
    lost = Counter(row["outcome"] for row in cycles if not is_back(row))
    worth = worth_of(run, cycles, is_back)
    said = []
    for p in (0.5, 0.9):
        least = statistics.quantile(times, p).value
        said.append(quantile(times, p, worth_of(
            run, back, lambda row, at=least: row.number("time") <= at)
            if back else 0))
    return [run, len(cycles), share(len(back), len(cycles), worth),
            f"{worth:.0f}", ", ".join(f"{name} {n}" for name, n
                                      in sorted(lost.items())) or "none", *said]


def outcomes(study: Study, runs: Iterable[str]) -> str:
    """Who returned, and when."""
    return markdown.table(["run", "cycles", "share that returned", "worth",
                           "lost", "median of return [s]", "90 % [s]"],
                          [outcome_row(study, run) for run in runs])


def gathered(study: Study) -> str:
    """About which times of return most lie."""
    times = read.numbers(study.rows("long", "returns"), "time")
    count = Counter(int(time / QUARTER) for time in times)
    full = [i for i in sorted(count) if count[i] > len(times) / 100 and
            count[i] == max(count[j] for j in range(i - 4, i + 5))]
    return ("Times of return of `long` gather about 2 s apart: the fullest "
            f"quarters of a second\nare at "
            f"{', '.join(f'{QUARTER * (i + 0.5):.1f}' for i in full)} s.")


def waits(study: Study) -> str:
    """Who has returned for the first time after how long."""
    rows = []
    for run, patience in WAITED:
        times = read.numbers((row for row in study.rows(run, "returns")
                              if is_back(row)), "time")
        n = len(study.rows(run, "returns"))
        back = [sum(time <= mark for time in times) for mark in texts.MARKS]
        # Of one size there are few motions, of which no interval tells.
        rows.append([run, n] + [
            "-" if mark > patience else f"{k / n:.2g}"
            if run.endswith("-one") else share(k, n)
            for mark, k in zip(texts.MARKS, back)])
    return markdown.table(["run", "samples"] + [f"by {mark} s" for mark in
                                                texts.MARKS], rows)


def survival_row(study: Study, run: str) -> list[object]:
    """Kaplan and Meier's estimate of the share of samples in a cycle."""
    cycles = study.rows(run, "returns")
    risk = Counter(row.count("cycle") for row in cycles)
    dead = Counter(row.count("cycle") for row in cycles
                   if row["outcome"] != RETURNED)
    most = max(risk)
    order = range(1, most + 1)
    shares = statistics.kaplan_meier([risk[i] for i in order],
                                     [dead[i] for i in order])
    said = []
    for i in sorted({1, 2, 5, 10, 100, most} & set(order)):
        value, low, high = shares[i - 1]
        band = f"[{low:.3g}, {high:.3g}]"
        if value in (0, 1):
            band = "none was lost" if value else "all were lost"
        said.append(f"{i}: {value:.3g} {band}")
    return [run, risk[1],
            share(sum(dead.values()), len(cycles),
                  worth_of(run, cycles, lambda row: not is_back(row))),
            "; ".join(said)]


def survival(study: Study) -> str:
    """A table of survival."""
    runs = ("long", "long-half", "even", "attracting") + PERTURBED
    return markdown.table(["run", "samples", "loss per cycle", "N: share"],
                          [survival_row(study, run) for run in runs])


Comparison = tuple[str, str, str, str, str]


def distances(study: Study, pairs: Iterable[Comparison]) -> str:
    """Distances of a column of two runs: (run, run, kind, column, title).

    A pair of which one has no number is left out. The tests of all tables
    count as one family.
    """
    tests = len(step_pairs()) + len(kind_pairs())
    rows = []
    for a, b, kind, column, title in pairs:
        first, second = (read.numbers(study.rows(run, kind), column)
                         for run in (a, b))
        if not first or not second:
            continue
        found = statistics.kolmogorov_smirnov(first, second, tests)
        rows.append([a, b, title, f"{found.n}, {found.m}",
                     f"{found.value:.4f}", f"{found.band:.4f}",
                     f"{found.p:.3g}", found.verdict(SMALLEST)])
    return markdown.table(["run", "against", "of", "n, m", "distance",
                           "95 % band", "p", "so they are"], rows)


def phases(a: str, b: str) -> Comparison:
    """The phases of the exits of two runs."""
    return f"exit-{a}", f"exit-{b}", "exits", "phase", "phase"


def step_pairs() -> list[Comparison]:
    """Runs and what they are with half the step."""
    returns = "long", "long-half", "returns"
    exits = "long", "long-half", "exits"
    return [(*returns, "time", "time from exit to return"),
            (*returns, "landing_r", "place of landing"),
            (*exits, "phase", "phase"), (*exits, "r", "place of exit")
            ] + [phases(run, run + "-half") for run in
                 ("noise-2.5e-6", "smoothing-2.5e-7", "hysteresis-5e-6",
                  "delay-5e-6")]


def kind_pairs() -> list[Comparison]:
    """Kinds of perturbation against each other, and sizes halved."""
    kinds = ["random-300"] + [f"{kind}-2.5e-6" for kind in KINDS]
    pairs = [phases(a, b) for i, a in enumerate(kinds) for b in kinds[i + 1:]]
    pairs.append(("near-300", "exit-smoothing-2.5e-7", "exits", "phase",
                  "phase"))
    pairs.append(phases("random-300", "random-150"))
    for kind in KINDS:
        pairs.append(phases(f"{kind}-1e-5", f"{kind}-5e-6"))
        pairs.append(phases(f"{kind}-5e-6", f"{kind}-2.5e-6"))
    pairs.append(phases("smoothing-5e-7", "smoothing-2.5e-7"))
    pairs.append(phases("smoothing-2.5e-7", "smoothing-1.25e-7"))
    return pairs


def exit_row(study: Study, run: str) -> list[object]:
    """The sides and phases of the exits of a run."""
    rows = study.rows(run, "exits")
    up = sum(row["side"] == "slip+" for row in rows)
    bins = phase_bins(rows)
    n = sum(bins)
    if n == 0:
        return [run, len(rows), share(up, len(rows)), 0, "-", "-", "-"]
    half = 1.96 * (0.09 / n) ** 0.5
    return [run, len(rows), share(up, len(rows)), n,
            " ".join(f"{k / n:.3f}" for k in bins), f"{half:.3f}",
            f"{statistics.chi_square_even(bins):.0f}"]


def exits(study: Study) -> str:
    """A table of exits."""
    runs = ["exit-random-300", "exit-random-150"]
    for kind in KINDS:
        runs += [f"exit-{kind}-{size}" for size in SIZES]
        runs.append(f"exit-{kind}-{'2.5e-6' if kind == 'noise' else '5e-6'}"
                    "-half")
    runs += ["near-300"]
    runs += [f"exit-smoothing-{size}" for size in ("5e-7", "2.5e-7",
                                                   "2.5e-7-half", "1.25e-7")]
    return markdown.table(["run", "exits", "share by slip+", "wound there",
                           "bins 0.0 to 1.0", "-+", "chi^2"],
                          [exit_row(study, run) for run in runs])


class Nearest:
    """Distances from a family of runs, by the program of that name."""

    def __init__(self, study: Study, program: str, name: str) -> None:
        self.study, self.program = study, program
        self.family = study.work / "family"
        self.runs = study.work / "runs"
        runs = [passage for rate in (30, 300, 3000)
                for passage in study.passages(f"{name}-{rate}", 0)]
        self._write(self.family, runs)

    @staticmethod
    def _write(path: Path, runs: Iterable[Passage]) -> None:
        path.write_text("".join(f"{run}\n" for run in runs), encoding="ascii")

    def _distances(self, runs: Iterable[Passage]) -> list[float]:
        self._write(self.runs, runs)
        said = subprocess.run([self.program, self.family, self.runs],
                              check=True, stdout=subprocess.PIPE, text=True)
        return [float(line) for line in said.stdout.split()]

    def row(self, run: str, arrival: float) -> list[object]:
        """A run's distances, and those that chance would give.

        By chance: with the phases of the runs dealt to other runs.
        """
        runs = self.study.passages(run, arrival)
        if not runs:
            return [run, 0, "-", "-", "-"]
        n = len(runs)
        dealt = [one._replace(phase=runs[(i + n // 2 + 1) % n].phase)
                 for i, one in enumerate(runs)]
        chance = statistics.median(self._distances(dealt))
        found = self._distances(runs)
        return [run, len(found), quantile(found, 0.5), quantile(found, 0.9),
                f"{chance:.3g}"]

    def close(self) -> None:
        """Takes its files away."""
        self.family.unlink()
        self.runs.unlink(missing_ok=True)


def set_valued(study: Study, program: str) -> str:
    """A table of the distances from what the law allows."""
    arrived = read.numbers(study.rows("exit-noise-2.5e-6", "returns"),
                           "arrived")
    arrival = statistics.median([t for t in arrived if t > 0])
    runs = ["noise-1e-5", "noise-5e-6", "noise-2.5e-6", "noise-2.5e-6-half"]
    for kind in ("hysteresis", "delay"):
        runs += [f"{kind}-{end}" for end in ("1e-5", "5e-6", "5e-6-half",
                                             "2.5e-6")]
    family = Nearest(study, program, "family")
    rows = [family.row("exit-random-300", 0)]
    rows += [family.row(f"exit-{run}", arrival) for run in runs]
    near = Nearest(study, program, "near")
    rows += [near.row(f"exit-smoothing-{end}", arrival)
             for end in ("5e-7", "2.5e-7", "2.5e-7-half", "1.25e-7")]
    near.close()
    return markdown.table(["run", "runs", "median", "90 %", "by chance"], rows)


def cost_row(twofold: str, samples: int) -> list[object]:
    """Time and memory of a run; memory only where GNU time is installed."""
    command = [twofold, "diverge", "chaos", "--samples", str(samples),
               "--cycles", "10", "--patience", "300"]
    timed = Path("/usr/bin/time").exists()
    if timed:
        command = ["/usr/bin/time", "-f", "%M"] + command
    begin = time.monotonic()
    said = subprocess.run(command, check=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True).stderr
    took = time.monotonic() - begin
    memory = said.split()[-1] if timed else "- (apt-get install time)"
    return [samples, 10 * samples, f"{took:.2f}", f"{1e2 * took / samples:.2f}",
            memory]


def cost(twofold: str) -> str:
    """A table of costs."""
    return markdown.table(["samples", "cycles", "time [s]", "ms a cycle",
                           "memory [kB]"],
                          [cost_row(twofold, n) for n in (50, 100, 200, 400)])


def machines(program: str) -> str:
    """Two-folds of random machines, by the program of that name."""
    said = subprocess.run([program], check=True, stdout=subprocess.PIPE,
                          text=True).stdout.splitlines()
    return markdown.table(["number", "machines with so many two-folds",
                           "of case 1"],
                          [line.split()[:3] for line in said[2:]])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=Path, help="folder with the files")
    parser.add_argument("--twofold", required=True, help="command line")
    parser.add_argument("--nearest", required=True,
                        help="program `nearest`, with `machines` beside it")
    parser.add_argument("--jobs", required=True, help="processors used")
    given = parser.parse_args()
    study = Study(given.work)
    print(texts.HEAD.format(seconds=study.seconds("seconds"), jobs=given.jobs,
                            cycles=len(study.rows("long", "returns")),
                            long=study.seconds("long.seconds")))
    print(outcomes(study, ["long", "long-half", "rate-10", "rate-250", "even",
                           "attracting"]), end="\n\n")
    print(gathered(study), end="\n\n")
    print(texts.PERTURBED)
    print(outcomes(study, PERTURBED + FEW), end="\n\n")
    for text, table in (
            (texts.WAITS, waits(study)),
            (texts.SURVIVAL, survival(study)),
            (texts.STEP, distances(study, step_pairs())),
            (texts.EXITS, exits(study)),
            (texts.KINDS, distances(study, kind_pairs())),
            (texts.SET_VALUED, set_valued(study, given.nearest)),
            (texts.COST, cost(given.twofold))):
        print(text)
        print(table, end="\n\n")
    print(texts.MACHINES)
    print(machines(str(Path(given.nearest).with_name("machines"))))


if __name__ == "__main__":
    read.run_script(main)
