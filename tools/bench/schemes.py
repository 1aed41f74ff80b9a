"""The sections of the bench that run on this machine: each returns its rows."""
import math
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

import driven
from measure import (BUILD, CC, COLUMNS, KEY, ONE_FIELD, QUICK, REALS, STIFF,
                     SWITCHED, counted, counts_here, csv, problems, say)

WORK = BUILD / "peers"
# What the sections of this run did without.
missing: list[str] = []

SEED = 20240607
TOO_LONG = 2e7  # [ns]: under callgrind a second
OFF = 1e-6      # an error that a peer of the same equations goes below
MILD = [*SWITCHED, "cycle", "rolling"]
JUMPING = [*SWITCHED, "stiff-spring"]
HELD = [*MILD, "stiff-spring"]
EVERY = HELD + ONE_FIELD


class Solver(NamedTuple):
    """What is swept of a solver."""
    name: str
    dial: str           # what a setting is: "dt" [s] or "tol"
    coarse: float       # first and last setting, about
    fine: float
    factor: float       # between neighbours
    problems: list[str]
    line: str           # for its program: the setting's place is {}

    def settings(self, number: int) -> np.ndarray:
        """Neighbours differ by a constant factor and a random shift, the same
        in every run, so that no grid is lucky: a fixed step may end on a switch
        by chance, and then looks better than it is."""
        if self.coarse == self.fine:
            return np.array([self.coarse])
        count = 1 + int(math.log(self.coarse / self.fine, self.factor))
        shift = np.random.default_rng([SEED, number]).random(count) - 0.5
        return (self.coarse * self.factor ** -(np.arange(count) + shift)
                )[::4 if QUICK else 1]


# By their programs. The project's own schemes: the located step takes part with
# its tolerance as the dial at several lengths of the step, with its step as the
# dial at the tolerance 1e-8 and, `order`, at one that never splits it; and
# within budgets of segments. Numbers of a line: dt, tolerance, segments, theta.
# The second number of SUNDIALS is the width of a smoothed law.
FIXED = "moreau {} 0 0 0.5"
SOLVERS = {
    "own": [
        Solver("moreau", "dt", 0.1, 1e-6, 1.3, EVERY, FIXED),
        Solver("compensated", "dt", 0.1, 3e-6, 1.8, MILD,
               "compensated {} 0 0 0.5"),
        Solver("moreau-1", "dt", 0.1, 1e-6, 1.3, STIFF,
               "moreau {} 0 0 1"),
        Solver("located", "dt", 0.5, 1e-4, 1.25, HELD, "located {} 1e-8 0 0.5"),
        Solver("located order", "dt", 0.1, 3e-4, 1.25, HELD,
               "located {} 0.1 0 0.5"),
        *(Solver(f"located step={dt}", "tol", 1e-3, 2e-14, 1.8, HELD,
                 f"located {dt} {{}} 0 0.5")
          for dt in (1, 0.2, 0.1, 0.05, 0.02, 0.005)),
        *(Solver("moreau", "dt", dt, dt, 1, EVERY, FIXED)
          for dt in (1e-3, 1e-3 / 3, 1e-4)),
        *(Solver(f"located {name}", "dt", 1e-3, 1e-3, 1, HELD,
                 f"located {{}} 1e-9 {segments} 0.5")
          for name, segments in (("segments=1", 1), ("segments=2", 2),
                                 ("segments=8", 8), ("1 kHz", 0)))],
    "hand": [
        Solver("events-rk4", "dt", 0.1, 3e-5, 1.3, JUMPING, "rk4 {}"),
        Solver("events-dp5", "tol", 1e-4, 4e-13, 1.8, JUMPING, "dp5 {}")],
    "sundials": [
        *(Solver(name, "tol", 1e-3, 1e-13, 1.8, JUMPING, f"{name} {{}}")
          for name in ("cvode-adams", "cvode-bdf", "arkode-erk5")),
        *(Solver(name, "tol", 1e-3, 1e-12, 6, ONE_FIELD, f"{name} {{}}")
          for name in ("cvode-bdf", "arkode-erk5")),
        *(Solver(f"cvode-smooth eps=1e-{n}", "tol", 1e-3, 1e-12, 3, SWITCHED,
                 f"cvode-bdf {{}} 1e-{n}") for n in range(3, 11))],
    "siconos": [
        Solver("siconos", "dt", 1e-2, 3e-5, 1.6, SWITCHED, "moreau {}")],
    "scipy": [
        Solver(f"scipy-{name.lower()}", "tol", 1e-3, 2e-12, 6,
               JUMPING + ONE_FIELD, f"{name} {{}}")
        for name in ("Radau", "LSODA", "RK45")]}


def runs_of(solvers: list[Solver]) -> pd.DataFrame:
    """The runs of a program, the solvers in turns. A step that is longer than a
    problem is the same as one of its length."""
    lengths = problems().length
    runs = pd.DataFrame(
        [[problem, solver.name, f"{solver.dial}={setting:.3e}",
          f"{problem} {solver.line.format(setting)}", turn]
         for number, solver in enumerate(solvers)
         for turn, setting in enumerate(solver.settings(number))
         for problem in solver.problems],
        columns=[*KEY, "line", "turn"])
    step = runs.line.str.split().str[2].astype(float)
    return runs[step <= runs.problem.map(lengths)].sort_values(
        ["turn", "problem"], kind="stable").drop_duplicates(
        KEY, ignore_index=True)


def timed(program: list[object], runs: pd.DataFrame) -> pd.DataFrame:
    """Error, time and verdict of all runs."""
    text = driven.output(*program, "time", input="\n".join(runs.line),
                         stderr=subprocess.DEVNULL)
    return runs.join(csv(text, ["error", "ns", "verdict"]))


def with_counts(program: list[object], rows: pd.DataFrame) -> pd.DataFrame:
    """The instructions of those that do not take too long."""
    some = rows[rows.ns < TOO_LONG] if counts_here("instructions") else rows[:0]
    counts = [n for _, n in counted("solve_counted", *program, "count",
                                    lines=some.line)] if len(some) else []
    return rows.assign(instructions=pd.Series(counts, some.index, float))


def left_out(what: str, package: str) -> None:
    """Says so, here and on the page."""
    say(f"left out: {what} (apt-get install {package})")
    missing.append(what)


def rivals() -> dict[str, list[object]]:
    """The commands of the peers, of libraries where they are installed."""
    found: dict[str, list[object]] = {"hand": [WORK / "hand"]}
    for name, what, package in (
            ("sundials", "CVODE, ARKODE", "libsundials-dev"),
            ("siconos", "Siconos", "libsiconos-kernel-dev")):
        if (WORK / name).exists():
            found[name] = [WORK / name]
        else:
            left_out(what, package)
    if find_spec("scipy"):
        found["scipy"] = [sys.executable, "-B", "-W", "ignore",
                          "tools/bench/peers/solve_ivp.py", WORK / "shared.so"]
    else:
        left_out("SciPy", "python3-scipy")
    return found


def peers() -> pd.DataFrame:
    """Other tools, and the project's own schemes, in turns: a machine that
    slows down slows all. Ends the program where no peer comes to the end of a
    problem: their equations are not those of the reference."""
    programs = {"own": [BUILD / "double/bench"], **rivals()}
    runs = {name: runs_of(SOLVERS[name]) for name in programs}
    found, rounds = [], int(os.environ.get("ROUNDS") or (1 if QUICK else 5))
    # SciPy takes as long as all others together.
    turns = [*programs, *[one for one in programs if one != "scipy"] *
             (rounds - 1)]
    costs = [len(programs) - 1 if name == "scipy" else 1 for name in turns]
    for name in driven.shown(turns, costs, str):
        found.append(timed(programs[name], runs[name]).assign(program=name))
    rows = pd.concat(found).groupby(
        ["program", *KEY, "line"], sort=False).agg(
        {"error": "first", "ns": "min", "verdict": "first"}).reset_index()
    reached = rows[rows.program != "own"].groupby("problem").error.min()
    if (reached > OFF).any():
        sys.exit(f"no peer comes to the end:\n{reached}")
    return pd.concat(
        [with_counts(programs[name], of) if name != "scipy" else of
         for name, of in driven.shown(
             [*rows.groupby("program", sort=False)],
             text=lambda item: f"instructions, {item[0]}")],
        ignore_index=True)[COLUMNS]


def spread(name: str, solver: str, cost: pd.Series) -> list[list[object]]:
    """Rows of the cost of single steps."""
    return [["steps", solver, f"{name}: {what}", None, None, value, ""]
            for what, value in (
                ("mean", cost.mean()), ("median", cost.median()),
                ("99 %", cost.quantile(0.99, interpolation="lower")),
                ("most", cost.max()))]


def steps() -> pd.DataFrame:
    """Instructions of single steps: 0.1 ms of `cycle` by phase, and 5 ms; and
    random machines, those of the golden hashes and ordinary ones."""
    rows: list[list[object]] = []
    if not counts_here("single steps"):
        return pd.DataFrame(columns=COLUMNS)

    def single(scheme: str, *words: object) -> pd.DataFrame:
        lines = counted("sample", BUILD / "double/bench", "single", scheme,
                        *words)
        return pd.DataFrame([[*line.split(","), n] for line, n in lines],
                            columns=["before", "after", "cost"])

    for name, *words in driven.shown([
            ["20000 steps, ", "moreau", "cycle", 20000, 200],
            *(["400 steps, all", scheme, "cycle", 400, 1]
              for scheme in ("moreau", "compensated", "located")),
            *([f"{length} steps, machines {kind}", "moreau", "machines", count,
               length, dt] for kind, count, length, dt in (
                ("golden", 1000, 12, 0), ("ordinary 1 ms", 100, 100, 1e-3),
                ("ordinary 0.1 ms", 100, 100, 1e-4)))], [*[1] * 4, 18, 27, 40]):
        found = single(*words)
        kind = found.before.str.replace("[+-]", "", regex=True).where(
            found.before == found.after, "changes")
        for phase, cost in found.cost.groupby(
                kind if name[-1] == " " else lambda _: ""):
            rows += spread(name + phase, words[0], cost)
    return pd.DataFrame(rows, columns=COLUMNS)


def of_ensembles(real: str, *words: object) -> str:
    """What the program of ensembles prints, compiled for AVX2 in a build
    directory of its own; nothing where the processor has none."""
    cpu = Path("/proc/cpuinfo")
    if not cpu.exists() or " avx2 " not in cpu.read_text():
        say("left out: this processor has no AVX2")
        return ""
    program = BUILD / "avx2" / real / "bench"
    driven.output("make", "-s", f"CC={CC}", f"BUILD={BUILD}/avx2",
                  f"OPT={os.environ.get('OPT') or '-O3'}",
                  f"EXTRA={os.environ.get('EXTRA') or ''} -mavx2", program)
    return driven.output(program, "ensemble", *words)


def ensemble() -> pd.DataFrame:
    """The ensemble step beside single steps."""
    rows = []
    for real in driven.shown(REALS):
        text = of_ensembles(real)
        if not text:
            break
        said = csv(text, ["name", "step", "lanes", "alone"])
        tail = " float" * (real == "float")
        for name, of in said.groupby("name", sort=False):
            low, ratio, high = (of.step / of.lanes).quantile([0.1, 0.5, 0.9])
            rows += [[name, "moreau" + tail, "256 states", None,
                      of.step.median()],
                     [name, "ensemble" + tail, "256 states", None,
                      of.lanes.median(), None,
                      f"{ratio:.2f} ({low:.2f} to {high:.2f}), "
                      f"{of.alone.iloc[0]:.2%}"]]
    return pd.DataFrame(rows, columns=COLUMNS)
