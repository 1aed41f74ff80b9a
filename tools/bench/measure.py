"""Rows of measurements, and instructions counted by callgrind.

Every row is of one problem, solver and setting of its dial: error, time [ns],
instructions and a verdict; what was not measured is empty.
"""
from __future__ import annotations

import io
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import driven  # noqa: E402

BUILD = Path(os.environ.get("BUILD") or "build")
CC = os.environ.get("CC") or "gcc"
REALS = "double", "float"
OUT = BUILD / "bench"          # what was measured
KEPT = Path("docs/bench")      # tables and pictures of the page
KEY = ["problem", "solver", "dial"]
COLUMNS = [*KEY, "error", "ns", "instructions", "verdict"]


def say(text: object) -> None:
    """Progress, to standard error."""
    print(text, file=sys.stderr, flush=True)


def bench(real: str, *arguments: object) -> str:
    """What the program of a real type prints."""
    return driven.output(BUILD / real / "bench", *arguments)


def csv(text: str, names: list[str] | None = None) -> pd.DataFrame:
    """A table of lines, without a header where the columns have names here."""
    return pd.read_csv(io.StringIO(text), names=names, keep_default_na=False,
                       na_values=["nan", "-nan"])


def timed(text: str) -> pd.DataFrame:
    """Rows as harness.c prints them; settings that were met several times have
    the median of their times."""
    rows = csv(text, [*KEY, "error", "ns", "verdict"])
    whole = rows.groupby(KEY, sort=False).agg(
        {"error": "first", "ns": "median", "verdict": "first"})
    return whole.reset_index()


def have_valgrind() -> bool:
    """Whether instructions can be counted."""
    return shutil.which("valgrind") is not None


def counted(function: str, *command: object) -> list[tuple[str, int]]:
    """Each line that a program printed, with the instructions of the call of
    the function before it."""
    place = BUILD / f"dumps-{os.getpid()}"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    done = subprocess.run(
        ["valgrind", "--tool=callgrind",
         f"--callgrind-out-file={place / 'out'}",
         f"--toggle-collect={function}", f"--zero-before={function}",
         f"--dump-after={function}", *map(str, command)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        sys.exit(f"{done.stderr}{command[0]} fails under valgrind")
    found = []
    for i, line in enumerate(done.stdout.splitlines(), start=1):
        dump = (place / f"out.{i}").read_text("utf-8")
        total = re.search(r"^summary: (\d+)", dump, re.MULTILINE)
        if not total:
            sys.exit(f"{command[0]}: callgrind left no summary")
        found.append((line, int(total[1])))
    shutil.rmtree(place)
    return found


def swept(program: Path, *command: str) -> pd.DataFrame:
    """The instructions of every setting of a program with harness_main."""
    if not have_valgrind():
        say("instructions left out: valgrind (apt-get install valgrind)")
        return pd.DataFrame(columns=[*KEY, "instructions"])
    lines = counted("solve_counted", program, *command, "count")
    return pd.DataFrame([[*line.split(","), count] for line, count in lines],
                        columns=[*KEY, "instructions"]).drop_duplicates(KEY)
