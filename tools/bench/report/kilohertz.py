#!/usr/bin/python3 -B
"""Instructions and errors of a step of 1 ms: of tf_step, of three of a third,
and of the located step within budgets; and where those of the located step go.

    kilohertz.py BUILD   prints what `make bench` keeps of it

Leaves lines "run PROBLEM RUN steps instructions error", instructions for a
millisecond, and lines "profile PROBLEM STEP:TOLERANCE part instructions error",
in which a part is what a run spends in one function and what that calls.
"""
from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Iterable, Optional

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from bench import valgrind  # noqa: E402
from tables import markdown, read  # noqa: E402
from tables.markdown import row  # noqa: E402

WANTED = 2  # times the instructions of tf_step
PROBLEMS = "chaos", "crossings", "stickslip", "driven", "rolling"
TOLERANCE = 1e-9
# What is run, by name: the scheme, its step [s] and its budget.
RUNS = {"plain": ("plain", "1e-3", 0), "plain/3": ("plain", "0.3333333e-3", 0),
        "located:1": ("located", "1e-3", 1),
        "located:2": ("located", "1e-3", 2),
        "located:8": ("located", "1e-3", 8), "located": ("located", "1e-3", 0)}
HEADS = ("a plain step", "three plain steps of a third", "located, 1 segment",
         "2 segments", "8 segments", "the default")
COLUMNS = "problem", "run", "steps", "instructions", "error"
# Profiles: problems, settings (step [s], tolerance), and functions, each with
# all that it calls.
PROFILED = "chaos", "crossings", "stickslip", "driven"
SETTINGS = ("0.1", "1e-3"), ("0.1", "1e-6"), ("0.1", "1e-9"), ("1e-3", "1e-9")
PARTS = {"whole": "tf_step_located_f64", "series": "tf_begin_series_f64",
         "events": "tf_next_event_f64", "choice": "tf_next_segment_f64"}


def measure(build: Path, work: Path) -> Iterable[str]:
    """The lines."""
    program = str(build / "double/tools/bench/report/profile")

    def count(name: str, *arguments: str) -> tuple[int, list[str]]:
        total, lines = valgrind.total_and_lines(work, name,
                                                [program, *arguments])
        return total, lines[0].split()

    for problem in PROBLEMS:
        for name, (scheme, dt, segments) in RUNS.items():
            function = ("tf_step_f64" if scheme == "plain"
                        else "tf_step_located_f64")
            total, said = count(function, problem, scheme, dt,
                                str(TOLERANCE), str(segments))
            each = total / int(said[0]) * (3 if name == "plain/3" else 1)
            yield f"run {problem} {name} {said[0]} {each:.0f} {said[1]}"
    for problem in PROFILED:
        for dt, level in SETTINGS:
            for part, function in PARTS.items():
                total, said = count(function, problem, "located", dt, level,
                                    "0")
                yield (f"profile {problem} {dt}:{level} {part} {total} "
                       f"{said[1]}")


class Kilohertz:
    """What the report tells of it."""

    def __init__(self, path: str) -> None:
        self.runs: dict[tuple[str, str], tuple[float, str]] = {}
        self.parts: dict[tuple[str, str], dict[str, float]] = {}
        self.errors: dict[tuple[str, str], str] = {}
        lines = Path(path).read_text("utf-8").splitlines()
        for kind, problem, name, *values in map(str.split, lines):
            if kind == "run":
                self.runs[problem, name] = float(values[1]), values[2]
            else:
                self.parts.setdefault((problem, name), {})[values[0]] = \
                    float(values[1])
                self.errors[problem, name] = values[2]

    def times(self, problem: str) -> Optional[float]:
        """A located step in units of a plain one."""
        if (problem, "located") not in self.runs:
            return None
        return self.runs[problem, "located"][0] / self.runs[problem, "plain"][0]

    def rows(self) -> Iterable[str]:
        """Rows of the table of figures."""
        for problem in PROBLEMS:
            what = ("`located` at 1 kHz and the tolerance 1e-9, in "
                    f"instructions of `tf_step`, on `{problem}`")
            times = self.times(problem)
            if times is None:
                yield row([what, "-", WANTED, "not known: needs valgrind"])
                continue
            yield row([what, f"{times:.2f}", WANTED, "reached"
                       if times <= WANTED else "not reached: "
                       f"{times / WANTED:.3f} times too many"])

    def why(self) -> Iterable[str]:
        """Where the instructions of the located step go."""
        for problem in PROFILED:
            texts = []
            for dt, level in SETTINGS:
                parts = self.parts.get((problem, f"{dt}:{level}"))
                if not parts:
                    continue
                error = self.errors[problem, f"{dt}:{level}"]
                share = {name: 100 * parts[name] / parts["whole"]
                         for name in PARTS}
                texts.append(f"in steps of {dt} s at the tolerance {level} "
                             f"(error {error}) "
                             f"{parts['whole'] / 1e3:.0f}, "
                             f"{share['series']:.0f} % of them in the terms of "
                             f"the series, {share['events']:.0f} % in the "
                             "search for the first event and "
                             f"{share['choice']:.0f} % in what follows events")
            if texts:
                yield (f"* `located` on `{problem}`, thousands of instructions "
                       "and where they go: " + "; ".join(texts) + ".")

    def table(self) -> str:
        """Instructions of a millisecond, and errors."""
        if not self.runs:
            return "Left out: it needs valgrind (apt-get install valgrind)."
        return markdown.table(
            ["problem", *HEADS],
            [[f"`{problem}`", *("{:.0f}, {}".format(*self.runs[problem, name])
                                for name in RUNS)] for problem in PROBLEMS])


def main() -> None:
    build = Path(sys.argv[1])
    work = build / "kilohertz"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    for line in measure(build, work):
        print(line, flush=True)


if __name__ == "__main__":
    read.run_script(main)
