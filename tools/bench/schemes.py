"""The sections of the bench that run on this machine: each returns its rows."""
import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pandas as pd

import driven
from measure import (BUILD, CC, COLUMNS, KEY, QUICK, REALS, bench, counted,
                     counts_here, say, swept, timed)

HERE = Path("tools/bench/peers")
WORK = BUILD / "peers"
SICONOS = [f"-I/usr/include/siconos{part}"
           for part in ("", "/kernel", "/numerics")]
# What the sections of this run did without.
missing: list[str] = []


def left_out(what: str, package: str) -> None:
    """Says so, here and on the page."""
    say(f"left out: {what} (apt-get install {package})")
    missing.append(what)


def precision() -> pd.DataFrame:
    """The project's own schemes; instructions of those in double."""
    rows = pd.concat([timed(bench(real, "sweep", "time")) for real in REALS])
    return rows.merge(swept(BUILD / "double/bench", "sweep"), "left", KEY)


def has(language: str, compiler: str, header: str, *flags: str) -> bool:
    return subprocess.run(
        [compiler, "-x", language, "-E", *flags, "-"],
        input=f"#include <{header}>\n", text=True, check=False,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def rivals() -> list[Path]:
    """The programs of the peers, of libraries where they are installed: then
    they must build."""
    found, cxx = [WORK / "hand"], os.environ.get("CXX") or "g++"
    for name, what, package, is_here in (
            ("sundials", "CVODE, ARKODE", "libsundials-dev",
             has("c", CC, "cvode/cvode.h")
             and has("c", CC, "arkode/arkode_erkstep.h")),
            ("siconos", "Siconos", "libsiconos-kernel-dev",
             has("c++", cxx, "SiconosKernel.hpp", *SICONOS))):
        if is_here:
            driven.output("make", "-s", f"BUILD={BUILD}", f"CC={CC}",
                          f"CXX={cxx}", WORK / name)
            found.append(WORK / name)
        else:
            left_out(what, package)
    return found


def peers() -> pd.DataFrame:
    """Other tools, and the project's own schemes, in turns: a machine that
    slows down slows all."""
    programs = rivals()
    driven.output(WORK / "check")
    if not find_spec("scipy"):
        left_out("SciPy", "python3-scipy")
    text, rounds = "", int(os.environ.get("ROUNDS") or (1 if QUICK else 5))
    for turn in range(rounds):
        say(f"round {turn + 1} of {rounds} ...")
        text += bench("double", "sweep", "time")
        for program in programs:
            text += driven.output(program, "time",
                                  stderr=subprocess.DEVNULL)
        # It takes as long as all others together.
        if find_spec("scipy") and turn == 0:
            text += driven.output(
                sys.executable, "-B", "-W", "ignore", HERE / "solve_ivp.py",
                WORK / "shared.so",
                6 if QUICK else 12, stderr=subprocess.DEVNULL)
    counts = pd.concat([swept(BUILD / "double/bench", "sweep"),
                        *(swept(program) for program in programs)])
    return timed(text).merge(counts, "left", KEY)


def one_step(real: str, scheme: str, problem: str, steps: int, every: int,
             ) -> list[list[object]]:
    """Median, 99 % and most instructions of single steps, of all and by
    phase."""
    lines = counted("sample", BUILD / real / "bench", "single", scheme,
                    problem, steps, every)
    found = pd.DataFrame([[*line.split(","), n] for line, n in lines],
                         columns=["before", "after", "cost"])
    kind = found.before.str.replace("[+-]", "", regex=True)
    kind = kind.where(found.before == found.after, "changes")
    solver = scheme + ("" if real == "double" else " float")
    return [[problem, solver, f"{steps} steps, {phase}: {name}", None, None,
             of.quantile(share, interpolation="lower"), ""]
            for phase, of in [("all", found.cost), *found.cost.groupby(kind)]
            for name, share in (("median", 0.5), ("99 %", 0.99), ("most", 1))]


def steps() -> pd.DataFrame:
    """Single steps: 0.1 ms of `cycle`, and 5 and 20 ms of two problems."""
    rows: list[list[object]] = []
    for real in REALS if counts_here("single steps") else ():
        rows += one_step(real, "moreau", "cycle", 20000, 200)
        for problem in "cycle", "crossings":
            for scheme in "moreau", "compensated", "located":
                rows += one_step(real, scheme, problem, 400, 1)
            rows += one_step(real, "located", problem, 100, 1)
    return pd.DataFrame(rows, columns=COLUMNS)


def machines() -> pd.DataFrame:
    """Instructions of a step of random machines: those of the golden hashes,
    and ordinary ones."""
    rows: list[list[object]] = []
    for name, count, steps_of, dt in (("golden", 1000, 12, 0),
                                      ("ordinary 1 ms", 100, 100, 1e-3),
                                      ("ordinary 0.1 ms", 100, 100, 1e-4)):
        if not counts_here("random machines"):
            break
        cost = pd.Series([n for _, n in counted(
            "sample", BUILD / "double/bench", "single", "moreau",
            "machines", count, steps_of, dt)])
        for what, value in (("mean", cost.mean()), ("median", cost.median()),
                            ("99 %", cost.quantile(0.99)),
                            ("most", cost.max())):
            rows.append([f"machines {name}", "moreau",
                         f"{steps_of} steps: {what}", None, None, value, ""])
    return pd.DataFrame(rows, columns=COLUMNS)


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
