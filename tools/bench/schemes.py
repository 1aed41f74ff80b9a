"""The sections of the bench that run on this machine: each returns its rows."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import stats

import driven
from measure import (BUILD, CC, COLUMNS, KEY, REALS, bench, counted, csv,
                     have_valgrind, say, swept, timed)

HERE = Path("tools/bench/peers")
WORK = BUILD / "peers"
SICONOS = [f"-I/usr/include/siconos{part}"
           for part in ("", "/kernel", "/numerics")]
# Chaos is open from 2 s on: it is left out of ten seconds.
LONG = ("gamma_zero gamma_right coulomb frictionless smooth rolling string "
        "driven").split()


def left_out(what: str, package: str) -> None:
    say(f"left out: {what} (apt-get install {package})")


def precision() -> pd.DataFrame:
    """The project's own schemes; instructions of those in double."""
    rows = pd.concat([timed(bench(real, "sweep", "time")) for real in REALS])
    return rows.merge(swept(BUILD / "double/bench", "sweep"), "left", KEY)


def built(name: str, compiler: str, *arguments: object) -> Path:
    """A peer whose library is installed must build; as bench.mk builds hand.c,
    and only where a source is newer, for Siconos' headers take long."""
    program = WORK / name
    sources = [file for room in (HERE, Path("include"))
               for file in room.rglob("*.[ch]*")]
    if program.exists() and program.stat().st_mtime > max(
            file.stat().st_mtime for file in sources):
        return program
    done = subprocess.run(
        [compiler, "-O3", "-march=native", "-ffp-contract=fast",
         *["-mno-avx512f"] * (os.uname().machine == "x86_64"), "-Iinclude",
         "-Itools", WORK / "bench-harness.o", WORK / "bench-problem.o",
         BUILD / "double/libtwofold.a", *arguments, "-lm", "-o", program],
        text=True, stderr=subprocess.PIPE, check=False)
    if done.returncode:
        sys.exit(f"{done.stderr}{name} does not build")
    return program


def has(language: str, compiler: str, header: str, *flags: str) -> bool:
    return subprocess.run(
        [compiler, "-x", language, "-E", *flags, "-"],
        input=f"#include <{header}>\n", text=True, check=False,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def rivals() -> list[Path]:
    """The programs of the peers, of libraries where they are installed."""
    found = [WORK / "hand"]
    if has("c", CC, "cvode/cvode.h") and \
            has("c", CC, "arkode/arkode_erkstep.h"):
        found.append(built(
            "sundials", CC, "-std=c99", HERE / "sundials.c",
            "-lsundials_cvode", "-lsundials_arkode", "-lsundials_nvecserial",
            "-lsundials_sunmatrixdense", "-lsundials_sunlinsoldense",
            "-lsundials_sunnonlinsolfixedpoint"))
    else:
        left_out("CVODE, ARKODE", "libsundials-dev")
    cxx = os.environ.get("CXX") or "g++"
    if has("c++", cxx, "SiconosKernel.hpp", *SICONOS):
        found.append(built("siconos", cxx, "-w", *SICONOS, HERE / "siconos.cpp",
                           "-lsiconos_kernel", "-lsiconos_numerics"))
    else:
        left_out("Siconos", "libsiconos-kernel-dev")
    return found


def peers() -> pd.DataFrame:
    """Other tools, and the project's own schemes, in turns: a machine that
    slows down slows all."""
    programs = rivals()
    driven.output(WORK / "check", WORK / "problems", WORK / "problems.states")
    octave = shutil.which("octave-cli")
    if not octave:
        left_out("Octave", "octave")
    text, rounds = "", int(os.environ.get("ROUNDS") or 5)
    for turn in range(rounds):
        say(f"round {turn + 1} of {rounds} ...")
        text += bench("double", "sweep", "time")
        for program in programs:
            text += driven.output(program, "time",
                                  stderr=subprocess.DEVNULL)
        # It takes as long as all others together: every other round.
        if octave and turn % 2 == 0:
            text += driven.output(octave, "--quiet", HERE / "octave.m",
                                  WORK / "problems", stderr=subprocess.DEVNULL)
    counts = pd.concat([swept(BUILD / "double/bench", "sweep"),
                        *(swept(program) for program in programs)])
    return timed(text).merge(counts, "left", KEY)


def one_step(real: str, scheme: str, problem: str, steps: int, every: int,
             ) -> list[list[object]]:
    """Median, 99 % and most of single steps, of all and by phase."""
    command = "single", scheme, problem, steps, every
    figures = {"ns": csv(bench(real, command[0], "time", *command[1:]),
                         ["before", "after", "cost"])}
    if have_valgrind():
        lines = counted("sample", BUILD / real / "bench", command[0], "count",
                        *command[1:])
        modes = pd.DataFrame([line.split(",")[:2] for line, _ in lines],
                             columns=["before", "after"])
        figures["instructions"] = modes.assign(cost=[n for _, n in lines])
    costs = {}
    for unit, steps_of in figures.items():
        stays = steps_of.before == steps_of.after
        kind = steps_of.before.str.replace("[+-]", "", regex=True)
        for phase, of in [("all", steps_of.cost),
                          *steps_of.cost.groupby(kind.where(stays, "changes"))]:
            for name, share in ("median", 0.5), ("99 %", 0.99), ("most", 1):
                costs[phase, name, unit] = of.quantile(
                    share, interpolation="lower")
    solver = scheme + ("" if real == "double" else " float")
    return [[problem, solver, f"{steps} steps, {phase}: {name}", None,
             costs[phase, name, "ns"], costs.get((phase, name, "instructions")),
             ""] for phase, name in dict.fromkeys(key[:2] for key in costs)]


def steps() -> pd.DataFrame:
    """Single steps: 0.1 ms of `cycle`, and 5 and 20 ms of two problems."""
    rows: list[list[object]] = []
    for real in REALS:
        rows += one_step(real, "moreau", "cycle", 20000, 200)
        for problem in "cycle", "crossings":
            for scheme in "moreau", "compensated", "located":
                rows += one_step(real, scheme, problem, 400, 1)
            rows += one_step(real, "located", problem, 100, 1)
    return pd.DataFrame(rows, columns=COLUMNS)


def after() -> pd.DataFrame:
    """Distributions after the two-fold, against that of the finest setting:
    Kolmogorov and Smirnov's distance, `same` where it may be chance (0.1 %: a
    grid has many settings)."""
    rows: list[list[object]] = []

    def draw(real: str, scheme: str, n: int, tolerance: float, runs: int,
             seed: int) -> tuple[np.ndarray, float]:
        *sample, ns = map(float, bench(real, "after", seconds, scheme, n,
                                       tolerance, runs, seed).split())
        return np.array(sample), ns

    for seconds in 0.08, 0.15:
        reference, _ = draw("double", "located", 2000, 1e-12, 8000, 1)
        grid = [("moreau", round(6 * 2 ** i), 1e-8) for i in range(11)]
        grid += [("located", round(3 * 1.9 ** i), 1e-8) for i in range(9)]
        grid += [("located", round(1e3 * seconds), 10.0 ** (-3 - 2 * i))
                 for i in range(4)]
        for real, runs in ("double", 4000), ("float", 2000):
            for i, (scheme, n, tolerance) in enumerate(grid):
                sample, ns = draw(real, scheme, n, tolerance, runs,
                                  1000000 + 8000 * i)
                kept = sample[~np.isnan(sample)]
                test = stats.ks_2samp(reference, kept)
                rows.append([
                    f"after-{seconds}", scheme + " float" * (real == "float"),
                    f"dt={seconds / n:.3e} tol={tolerance:.0e}",
                    test.statistic, ns, None,
                    "same" if test.pvalue > 0.001 else "apart"])
    return pd.DataFrame(rows, columns=COLUMNS)


def rounded() -> pd.DataFrame:
    """What float keeps: ends of runs against the located step in double. The
    verdict is on the compensated step in float: within 3 times the error of the
    same in double, or below one unit in the last place of a float."""
    names = ["problem", "dt", "real", "scheme", "r", "v", "w"]
    text = "".join(
        bench(real, "rounded", 0, "crossings", "chaos", "stickslip") +
        bench(real, "rounded", 10**6, "chaos", *LONG) +
        bench(real, "rounded", 10**7, *LONG) for real in REALS)
    ends = csv(text, names)
    state = ends[["r", "v", "w"]].to_numpy()
    truth = ends[ends.scheme == "reference"].set_index("problem")
    wanted = truth.loc[ends.problem, ["r", "v", "w"]].to_numpy()
    ends["error"] = np.abs(state - wanted).max(axis=1)
    largest = np.abs(wanted).max(axis=1)
    ends["ulp"] = np.ldexp(1.0, np.frexp(largest)[1] - 24)
    ends = ends[ends.scheme != "reference"].assign(verdict="")
    key = ["problem", "dt"]
    scheme = ends[(ends.real == "double") & (ends.scheme == "compensated")]
    kept = ends.merge(scheme[[*key, "error"]], on=key, suffixes=("", "_double"))
    judged = (kept.real == "float") & (kept.scheme == "compensated")
    kept.loc[judged, "verdict"] = np.select(
        [kept.error <= 3 * kept.error_double, kept.error <= kept.ulp],
        ["within 3", "below one ulp"], "not reached")[judged]
    return pd.DataFrame({
        "problem": "rounded " + kept.problem,
        "solver": kept.scheme + np.where(kept.real == "float", " float", ""),
        "dial": kept.dt.map("dt={:.3e}".format), "error": kept.error,
        "verdict": kept.verdict})


def ensemble() -> pd.DataFrame:
    """The ensemble step beside single steps, both compiled for AVX2 in a build
    directory of their own."""
    cpu = Path("/proc/cpuinfo")
    if not cpu.exists() or not re.search(r"^flags.*\bavx2\b", cpu.read_text(),
                                         re.MULTILINE):
        say("left out: this processor has no AVX2")
        return pd.DataFrame(columns=COLUMNS)
    place, rows = BUILD / "avx2", []
    driven.output("make", "-s", f"CC={CC}", f"BUILD={place}",
                  f"OPT={os.environ.get('OPT') or '-O3'}",
                  f"EXTRA={os.environ.get('EXTRA') or ''} -mavx2",
                  *(f"{place}/{real}/bench" for real in REALS))
    for real in REALS:
        said = driven.output(place / real / "bench", "ensemble")
        for line in said.splitlines():
            name, step, lanes, *ratio, alone = line.split(",")
            tail = " float" * (real == "float")
            rows += [[name, "moreau" + tail, "256 states", None, step],
                     [name, "ensemble" + tail, "256 states", None, lanes, None,
                      f"ratio {ratio[0]} ({ratio[1]} to {ratio[2]}), "
                      f"alone {alone}"]]
    return pd.DataFrame(rows, columns=COLUMNS)


def stability() -> pd.DataFrame:
    """Every cell: the error is the largest energy in units of what the machine
    was given. Ends the program where a promise of the core is broken."""
    texts = driven.side_by_side(lambda real: bench(real, "stability"), REALS)
    cells = csv("".join(texts), [*KEY, "error", "verdict"])
    broken = cells.verdict.isin(["non_finite", "touched"])
    if broken.any():
        sys.exit(f"a promise is broken:\n{cells[broken]}")
    return cells
