#!/usr/bin/python3 -B
"""Whether the excused changes of src/ really make no difference.

Each change that tools/verify/mutation/equivalent excuses is compiled with the address
and undefined-behaviour sanitizers, and tools/verify/mutation/outputs.c runs every part
of the core on random machines: what it prints has to be what the unchanged core
prints. A reason that begins with "Other bits:" says that it is not, and why
that is as good; there only the sanitizers are asked. Exits with code 1 where an
excuse is false. Environment: CC, JOBS, BUILD, SEED, MACHINES.
"""
from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[3]
CC = os.environ.get("CC", "gcc")
PLACE = Path(os.environ.get("BUILD", ROOT / "build")).resolve() / "excused"
REALS = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
FLAGS = ("-std=c99 -O1 -w -ffp-contract=off -fno-math-errno "
         "-fsanitize=address,undefined -fno-sanitize-recover=all "
         "-ftrivial-auto-var-init=pattern").split()
RUN = [os.environ.get("SEED", "1"), os.environ.get("MACHINES", "3000")]
OTHER = "Other bits:"


class Excuse(NamedTuple):
    """A change, and whether it may change what is computed."""
    file: str
    text: str
    other: bool

    def __str__(self) -> str:
        return f"{self.file}: {self.text}"


def excuses_of(path: Path) -> list[Excuse]:
    """The changes of tools/verify/mutation/equivalent."""
    found, waiting, reason = [], [], ""
    for line in path.read_text(encoding="utf-8").splitlines() + ["src/: "]:
        if line.startswith("  "):
            reason += line.strip() + " "
        elif line.startswith("src/"):
            if reason:
                found += [Excuse(file, text, reason.startswith(OTHER))
                          for file, text in waiting]
                waiting, reason = [], ""
            file, _, text = line.partition(": ")
            waiting.append((file, text))
    return found


def mutants() -> Path:
    """The program that makes changes."""
    program = PLACE / "mutants"
    subprocess.run([CC, "-std=c99", "-O2", "tools/verify/mutation/mutants.c", "-o",
                    program], cwd=ROOT, check=True)
    return program


def numbers(program: Path) -> dict[tuple[str, str], str]:
    """The number of each change of the sources, by file and text."""
    files = sorted(str(path.relative_to(ROOT))
                   for path in ROOT.glob("src/*/*.[ch]"))
    lines = subprocess.run([program, "list", "1", *files], cwd=ROOT, check=True,
                           text=True, stdout=subprocess.PIPE).stdout
    fields = (line.split(" ", 5) for line in lines.splitlines())
    return {(file, text): number for _, file, number, _, _, text in fields}


def compile_to(target: Path, source: Path, root: Path, real: str) -> None:
    """One object of the core, or of a changed copy of it."""
    subprocess.run([CC, *FLAGS, REALS[real], f"-I{root}/include",
                    f"-I{root}/src", f"-I{ROOT}/tests", "-MMD", "-c", source,
                    "-o", target], check=True, stderr=subprocess.PIPE)


def outputs(objects: list[Path], program: Path) -> str:
    """What a core computes, or why it stopped."""
    subprocess.run([CC, *FLAGS, *objects, "-lm", "-o", program], check=True)
    run = subprocess.run([program, *RUN], check=False, text=True, timeout=600,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if run.returncode != 0:
        report = re.findall(r"runtime error:.*|ERROR: AddressSanitizer.*",
                            run.stderr)
        return "stopped: " + (report or [f"exit code {run.returncode}"])[0]
    return run.stdout


class Core:
    """The unchanged core in one real type: objects and what it computes."""

    def __init__(self, real: str) -> None:
        self.real = real
        self.place = PLACE / real
        self.place.mkdir(parents=True, exist_ok=True)
        self.sources = [*sorted(ROOT.glob("src/*/*.c")),
                        ROOT / "tools/verify/mutation/outputs.c"]
        with ThreadPoolExecutor() as pool:
            list(pool.map(lambda source: compile_to(
                self.object_of(source), source, ROOT, real), self.sources))
        self.expected = outputs([self.object_of(s) for s in self.sources],
                                self.place / "outputs")

    def object_of(self, source: Path) -> Path:
        """Where the object of a source is."""
        return self.place / f"{source.stem}.o"

    def needs(self, source: Path, file: str) -> bool:
        """Whether a source is or includes a file."""
        made_of = self.object_of(source).with_suffix(".d").read_text("utf-8")
        return any(os.path.realpath(ROOT / part) == str(ROOT / file)
                   for part in made_of.replace("\\\n", " ").split())

    def difference(self, excuse: Excuse, changed: str) -> str:
        """What a change makes different; empty where nothing is."""
        with tempfile.TemporaryDirectory(dir=self.place) as name:
            copy = Path(name)
            for part in ("src", "include"):
                subprocess.run(["cp", "-r", ROOT / part, copy], check=True)
            (copy / excuse.file).write_text(changed, encoding="utf-8")
            objects = []
            for source in self.sources:
                target = self.object_of(source)
                if self.needs(source, excuse.file):
                    target = copy / f"{source.stem}.o"
                    part = source.relative_to(ROOT)
                    twin = copy / part if part.parts[0] == "src" else source
                    try:
                        compile_to(target, twin, copy, self.real)
                    except subprocess.CalledProcessError:
                        return ""
                objects.append(target)
            got = outputs(objects, copy / "outputs")
        if got.startswith("stopped"):
            return got
        pairs = zip(got.split("\n"), self.expected.split("\n"))
        parts = [a.split()[0] for a, b in pairs if a != b]
        return f"other bits of {', '.join(parts)}" if parts else ""


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="*", help="changes of these files only")
    parser.add_argument("--real", choices=REALS, help="one real type only")
    given = parser.parse_args()
    PLACE.mkdir(parents=True, exist_ok=True)
    program = mutants()
    number = numbers(program)
    excuses = [excuse
               for excuse in excuses_of(ROOT / "tools/verify/mutation/equivalent")
               if not given.file or excuse.file in given.file]
    cores = [Core(real) for real in REALS if given.real in (None, real)]

    def differences(excuse: Excuse) -> list[str]:
        key = (excuse.file, excuse.text)
        if key not in number:
            return ["there is no such change"]
        changed = subprocess.run(
            [program, "make", excuse.file, number[key]], cwd=ROOT, check=True,
            text=True, stdout=subprocess.PIPE).stdout
        return [f"{core.real}: {what}" for core in cores
                if (what := core.difference(excuse, changed))]

    bad = others = 0
    jobs = int(os.environ.get("JOBS", os.cpu_count() or 2))
    with ThreadPoolExecutor(jobs) as pool:
        for excuse, found in zip(excuses, pool.map(differences, excuses)):
            false = [what for what in found
                     if not excuse.other or "other bits" not in what]
            others += bool(found) and not false
            bad += bool(false)
            for what in false:
                print(f"{excuse}\n    {what}", flush=True)
    print(f"{len(excuses)} excused changes, {others} of them give other bits "
          f"and say so, {bad} excuses are false")
    return int(bool(bad) or not excuses)


if __name__ == "__main__":
    sys.exit(main())
