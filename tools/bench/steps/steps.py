#!/usr/bin/python3 -B
"""What one step costs, beside the figure that it should reach.

`make bench-steps`, and a part of `make bench`. It reports and never fails on a
figure; it fails where a tool is missing. Instructions come from callgrind
(x86-64 under valgrind), stack from gcc's call graph, time from a race in turns
(race.c).
"""
from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Callable

import valgrind

STEPS = 100000  # that `steps all` takes
DEFINES = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}


def output(*command: str) -> str:
    """What a program prints; ends where it fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{command[0]} fails")
    return done.stdout


def phase(text: str, samples: list[valgrind.Sample],
          belongs: Callable[[list[str]], bool]) -> str:
    """Samples, min, median and max of the steps whose modes fit.

    belongs: asked with the modes before and after.
    """
    counts = sorted(sample.instructions for sample in samples
                    if belongs(sample.said.split()))
    figures: list[object] = ["-", "-", "-"]
    if counts:
        figures = [counts[0], counts[(len(counts) - 1) // 2], counts[-1]]
    return f"  {text:<26} {len(counts):9}" + "".join(f" {one:>9}"
                                                     for one in figures)


def row(text: str, figure: object, target: str = "") -> str:
    """One figure."""
    return f"  {text:<46} {figure:>18}{'  ' if target else ''}{target}"


class Bench:
    """One real type."""

    def __init__(self, build: Path, work: Path, compiler: str,
                 real: str) -> None:
        self.work, self.compiler, self.real = work, compiler, real
        self.tools = build / real / "tools/bench/steps/steps"
        self.step = "tf_step_f64" if real == "double" else "tf_step_f32"

    def steps(self, run: str) -> list[str]:
        """The program and its run."""
        return [str(self.tools / "steps"), run]

    def mean(self, run: str, function: str) -> int:
        """Mean instructions of a function."""
        return round(valgrind.total(self.work, function, self.steps(run))
                     / STEPS)

    def stack(self) -> tuple[str, str]:
        """Worst stack of tf_step and the functions that it is of."""
        place = self.work / f"{self.real}-stack"
        place.mkdir(exist_ok=True)
        for source in sorted(Path("src").glob("*/*.c")):
            if subprocess.run(
                    [self.compiler, "-std=c99", "-O2", "-ffp-contract=off",
                     "-fno-math-errno", "-ffreestanding", "-Iinclude",
                     DEFINES[self.real], "-fcallgraph-info=su", str(source),
                     "-S", "-o", str(place / f"{source.stem}.s")],
                    stderr=subprocess.DEVNULL, check=False).returncode:
                return "?", "needs gcc 10 or later"
        files = [str(path) for end in ("ci", "s")
                 for path in sorted(place.glob(f"*.{end}"))]
        for line in output("tools/bench/callgraph.py",
                           *files).splitlines():
            name, most, *by = line.split()
            if name == self.step:
                return most, " ".join(by)
        return "?", "has no row of it"

    def race(self) -> dict[str, list[str]]:
        """The lines of the race, by their names."""
        lines = output(str(self.tools / "race")).splitlines()
        return {name: values for name, *values in map(str.split, lines)}

    def phases(self) -> str:
        """A table of the instructions of each phase."""
        some = valgrind.samples(self.work, self.step, "sample",
                                self.steps("some"))
        rk4 = valgrind.samples(self.work, "rk4_smooth_step", "sample_rk4",
                               self.steps("rk4-some"))

        def goes_on(kind: str) -> Callable[[list[str]], bool]:
            return lambda modes: (modes[0] == modes[1] and
                                  re.fullmatch(kind, modes[0]) is not None)

        return "\n".join([
            f"  {'instructions':<26} {'samples':>9} {'min':>9} {'median':>9} "
            f"{'max':>9}",
            phase("slip goes on", some, goes_on("slip.")),
            phase("stick goes on", some, goes_on("stick.")),
            phase("pinned goes on", some, goes_on("pinned")),
            phase("the mode changes", some,
                  lambda modes: modes[0] != modes[1]),
            phase("smoothed RK4 with libm", rk4, lambda modes: True),
            "", self.at_codim2(some)])

    def at_codim2(self, some: list[valgrind.Sample]) -> str:
        """What of the dearest sample is spent on h = g = 0."""
        inside = valgrind.samples(
            self.work, self.step.replace("tf_step", "tf_codim2_end"), "sample",
            self.steps("some"))
        most = max(range(len(some)), key=lambda i: some[i].instructions)
        return row("of the dearest step, at h = g = 0",
                   inside[most].instructions)

    def kinds(self) -> list[str]:
        """What the instructions of a step do."""
        return [row(f"of them {kind}", round(count / STEPS)) for kind, count
                in valgrind.kinds(self.work, self.step, self.steps("all"))]

    def figures(self) -> str:
        """The figures that the step should reach."""
        step = self.mean("all", self.step)
        rk4 = self.mean("rk4-all", "rk4_smooth_step")
        race = self.race()
        target: Callable[[str], str] = (
            lambda text: f"target {text}" if self.real == "double" else "")
        low, high = race["ratio"][1:3]
        deepest, by = self.stack()
        return "\n".join([
            row("instructions a step, mean over 10 s", step, target("<= 450")),
            *self.kinds(),
            row("the same, smoothed RK4 with libm", rk4),
            row("RK4 / step in instructions", f"{rk4 / step:.2f}",
                target(">= 4")),
            row("ns a step, median", race["step"][0]),
            row("the same, smoothed RK4 with libm", race["rk4"][0]),
            row("RK4 / step in time, median (10 %, 90 %)",
                f"{race['ratio'][0]} ({low}, {high})", target(">= 4")),
            row("stack of tf_step, worst, B", deepest, "target <= 512"),
            f"    by {by}",
            row("state, B", race["state"][0], "target <= 64"),
            row(f"apart from RK4 at t = {race['apart'][0]} s, m",
                race["apart"][1])])


def first_line(compiler: str) -> str:
    """The name and version of a compiler."""
    return output(compiler, "--version").splitlines()[0]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build")
    parser.add_argument("--cc", default="gcc", help="compiler")
    given = parser.parse_args()
    for tool in ("valgrind", "objdump", given.cc):
        if not shutil.which(tool):
            package = "binutils" if tool == "objdump" else tool
            sys.exit(f"make bench-steps needs {tool}: apt-get install "
                     f"{package}")
    work = given.build / "bench"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for real in DEFINES:
        print(f"{real}: counting, then racing ...", file=sys.stderr)
        bench = Bench(given.build, work, given.cc, real)
        print(f"\n== Moreau step of scene chaos in {real}, "
              f"{first_line(given.cc)}")
        print(bench.phases(), bench.figures(), sep="\n\n", flush=True)


if __name__ == "__main__":
    try:
        main()
    except valgrind.Failed as failure:
        sys.exit(str(failure))
