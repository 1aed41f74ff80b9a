"""What users wait for: rows, steps, sweeps, cycles and ensembles. Prints the
table (`make waits`). Times are of the processor, but for those of two jobs."""
import json
import os
import re
import subprocess
from statistics import median
from typing import Iterator

import driven
from measure import BUILD
from schemes import of_ensembles

COSTS = 3, 4, 13, 4, 13, 2, 4, 45  # about, of lines() [s]
STEPS, POINTS, CYCLES = 10000, 8192, 400  # STEPS of scene chaos are 1 s
RUN = "run", "chaos", "-o", "/dev/null", "--t-end"
ROWLESS = "--every", 10 ** 9
SWEEP = ("sweep", "chaos", "--over", f"h=-0.01:0.01:{POINTS}", "--t-end", 1,
         "-o", "/dev/null", "-j")
DIVERGE = ("diverge", "chaos", "--samples", CYCLES // 10, "--cycles", 10,
           "--returns", "/dev/null")


def said(before: list[str], *words: object) -> str:
    """What a run of the command line says."""
    command = [*before, BUILD / "double/twofold", *words, "--summary", "json"]
    return subprocess.run([str(word) for word in command], check=False,
                          text=True, stderr=subprocess.PIPE).stderr


def instructions(*words: object, of: str = "") -> int:
    """Of a run, or of one function and what it calls."""
    tool = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    return int(re.findall(r"Collected : (\d+)", said(
        tool + [f"--toggle-collect={of}"] * bool(of), *words))[0])


def seconds(*words: object) -> tuple[float, float]:
    """Of the processor, and of the clock."""
    begin = sum(os.times()[2:4])
    summary = json.loads(said([], *words, "-q"))
    return sum(os.times()[2:4]) - begin, summary["seconds"]


def lines() -> Iterator[str]:
    """What is measured, one by one."""
    rows, rowless = (instructions(*RUN, 1, *of) for of in ((), ROWLESS))
    yield f"instructions of a CSV row         {(rows - rowless) / STEPS:.0f}"
    step, whole = (instructions(*RUN, 10, *ROWLESS, of=of)
                   for of in ("tf_step_f64", ""))
    yield f"  of run without rows, not steps  {1 - step / whole:.1%}"
    yield ("  of a cycle of diverge           "
           f"{instructions(*DIVERGE) / CYCLES / 1e6:.2f} million")
    rows, rowless = (seconds(*RUN, 100, *of)[0] for of in ((), ROWLESS))
    yield f"1e6 steps with rows, without      {rows:.2f} s, {rowless:.2f} s"
    (alone, clock), (_, both) = seconds(*SWEEP, 1), seconds(*SWEEP, 2)
    yield ("a step of a point of a sweep      "
           f"{1e9 * alone / POINTS / STEPS:.1f} ns; -j 2: {clock / both:.2f} x")
    for many in 256, 65536, 10 ** 6:
        times = map(float, of_ensembles("double", many).split() or ["nan"])
        yield f"a step of one of {many:7} states    {median(times):.1f} ns"


def main() -> None:
    found = lines()
    print("\n".join(next(found) for _ in driven.shown(COSTS, COSTS)))
