"""Counts instructions of a function by callgrind (valgrind)."""
from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple


class Failed(Exception):
    """A program that fails under valgrind, or leaves no count."""


class Sample(NamedTuple):
    """One call: what the program printed of it, and its instructions."""
    said: str
    instructions: int


def have() -> bool:
    """Whether valgrind is there."""
    return shutil.which("valgrind") is not None


def _summary(dump: Path) -> int:
    """The sum of a dump."""
    found = re.search(r"^summary: (\d+)", dump.read_text(encoding="utf-8"),
                      re.MULTILINE)
    if not found:
        raise Failed(f"{dump}: callgrind left no summary")
    return int(found[1])


def _callgrind(out: Path, command: list[str], *options: str) -> list[str]:
    """Runs a program. Returns: the lines that it printed."""
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
         *options, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, check=False)
    if done.returncode != 0:
        raise Failed(done.stderr + f"{command[0]} fails under valgrind")
    return done.stdout.splitlines()


def total(work: Path, function: str, command: list[str]) -> int:
    """Instructions of all calls of a function."""
    out = work / "total"
    _callgrind(out, command, f"--toggle-collect={function}")
    return _summary(out)


def samples(work: Path, function: str, sampler: str,
            command: list[str]) -> list[Sample]:
    """Each call of a function inside `sampler`, one printed line each."""
    place = work / "dumps"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    lines = _callgrind(place / "out", command, f"--toggle-collect={function}",
                       f"--zero-before={sampler}", f"--dump-after={sampler}")
    found = [Sample(line, _summary(place / f"out.{i}"))
             for i, line in enumerate(lines, start=1)]
    shutil.rmtree(place)
    return found
