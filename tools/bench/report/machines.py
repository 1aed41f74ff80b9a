"""What of the report depends on the processor: the cost of every single step of
some runs, and the throughput of the ensemble step. Leaves files in a folder:

    ns, instructions   lines "REAL SCHEME BUILD PART STEPS step cost"
    notes              the reason for what is left out
    ensemble           lines "REAL ENSEMBLE step-ns ensemble-ns ratio low high
                       alone", or after a '#' the reason why there are none

Environment: BUILD CC OPT EXTRA.
"""
from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import driven
from bench import valgrind

BUILD = Path(os.environ.get("BUILD") or "build")
CC = os.environ.get("CC") or "gcc"
OPT = os.environ.get("OPT") or "-O3"
HERE = "tools/bench/report"
# The core in one translation unit for one scheme. Not all of src/: names that
# files of it keep to themselves meet there.
SOURCES = {
    "moreau": "step friction select kernel machine tyre",
    "compensated": "compensated friction select kernel machine tyre",
    "located": "located trajectory event codim2 taylor polynomial"}
FUNCTIONS = {"moreau": "tf_step", "compensated": "tf_step_compensated",
             "located": "tf_step_located"}
REALS = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}


def first_error(text: str) -> str:
    return next((line for line in text.splitlines() if "error" in line), "")


class Costs:
    """The files of single steps."""

    def __init__(self, work: Path) -> None:
        self.work = work
        for name in ("ns", "instructions", "notes"):
            (work / name).write_text("", "utf-8")

    def append(self, name: str, lines: list[str]) -> None:
        with open(self.work / name, "a", encoding="utf-8") as file:
            file.writelines(f"{line}\n" for line in lines)

    def note(self, text: str) -> None:
        print(text, file=sys.stderr)
        self.append("notes", [text])

    def special(self, real: str, scheme: str, part: str,
                steps: str) -> Path | None:
        """The program of one scheme and machine; None where it is left out."""
        generic = BUILD / real / HERE
        out = self.work / f"special-{real}-{scheme}-{part}"
        lines = ['#include "twofold.h"', driven.output(
            generic / "cost", "machine", scheme, part, steps).rstrip("\n")]
        for stem in SOURCES[scheme].split():
            lines += [f'#include "{source}"'
                      for source in sorted(Path().glob(f"src/*/{stem}.c"))]
        lines.append('#include "tools/bench/report/cost.c"')
        out.with_suffix(".c").write_text("\n".join(lines) + "\n", "utf-8")
        # As the Makefile compiles its sources.
        flags = ["-fno-tree-vectorize"] if scheme == "located" else []
        done = subprocess.run(
            [CC, "-std=c99", *OPT.split(), "-ffp-contract=off",
             "-fno-math-errno", "-I.", "-Iinclude", "-Isrc", "-Itools",
             "-D_POSIX_C_SOURCE=200809L", REALS[real], *flags,
             f"-DREPORT_SPECIAL={FUNCTIONS[scheme]}", out.with_suffix(".c"),
             generic / "part.o", generic / "truth.o",
             BUILD / real / "tools/board/constants/constants.o",
             BUILD / real / "libsupport.a", BUILD / real / "libtwofold.a",
             "-lm", "-o", out], text=True, stderr=subprocess.PIPE, check=False)
        what = f"{scheme} in {real} on {part}, specialised: left out,"
        if done.returncode:
            self.note(f"{what} it does not build ({first_error(done.stderr)})")
            return None
        ends = [driven.output(program, "end", scheme, part, steps)
                for program in (out, generic / "cost")]
        if ends[0] != ends[1]:
            self.note(f"{what} it ends in other bits")
            return None
        return out

    def measure(self, program: Path, real: str, scheme: str, build: str,
                part: str, steps: str) -> None:
        what = f"{real} {scheme} {build} {part} {steps}"
        said = driven.output(program, "time", scheme, part, steps)
        self.append("ns", [f"{what} {i} {line.split()[0]}" for i, line
                           in enumerate(said.splitlines(), 1)])
        if not valgrind.have():
            return
        try:
            steps_of = valgrind.samples(self.work, "sample", "sample", [
                str(program), "count", scheme, part, steps])
        except valgrind.Failed as failure:
            self.note(f"instructions of {what}: left out, {failure}")
            return
        self.append("instructions", [
            f"{what} {i} {one.instructions}"
            for i, one in enumerate(steps_of, 1)])

    def of_type(self, real: str) -> None:
        program = BUILD / real / HERE / "cost"
        both = [(part, scheme) for part in ("cycle", "crossings")
                for scheme in SOURCES]
        for part, scheme in both:
            self.measure(program, real, scheme, "generic", part, "400")
        for part in ("cycle", "crossings"):
            self.measure(program, real, "located", "generic", part, "100")
        for part, scheme in both:
            special = self.special(real, scheme, part, "400")
            if special:
                self.measure(special, real, scheme, "specialised", part, "400")


def costs(work: Path) -> None:
    """Of every single step."""
    found = Costs(work)
    if not valgrind.have():
        found.note("instructions: left out, they need valgrind "
                   "(apt-get install valgrind)")
    for real in REALS:
        found.of_type(real)


def race(real: str, program: Path) -> list[str]:
    """Lines of one real type."""
    lines, name, value = [], "", {}
    for words in map(str.split, driven.output(program).splitlines()):
        if len(words) == 1:
            name = words[0]
        elif words:
            value[words[0]] = " ".join(words[1:4 if words[0] == "ratio" else 2])
            if words[0] == "alone":
                lines.append(f"{real} {name} {value['step']} "
                             f"{value['ensemble']} {value['ratio']} "
                             f"{value['alone']}\n")
    return lines


def ensembles(work: Path) -> None:
    """The ensemble step beside single steps, both compiled for AVX2 in a build
    directory of their own."""
    place, file = BUILD / "avx2", work / "ensemble"
    programs = {real: place / real / "tools/bench/steps/ensemble" for real in REALS}
    processor = Path("/proc/cpuinfo").read_text("utf-8") if os.path.exists(
        "/proc/cpuinfo") else ""
    if not re.search(r"^flags.*\bavx2\b", processor, re.M):
        file.write_text("# this processor has no AVX2\n", "utf-8")
        return
    extra = f"{os.environ.get('EXTRA') or ''} -mavx2"
    done = subprocess.run(
        ["make", "-s", f"CC={CC}", f"OPT={OPT}", f"BUILD={place}",
         f"EXTRA={extra}", *programs.values()], text=True, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        file.write_text("# it does not build for AVX2: "
                        f"{first_error(done.stdout)}\n", "utf-8")
        return
    file.write_text("".join(line for real in REALS
                            for line in race(real, programs[real])), "utf-8")
