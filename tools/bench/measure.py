"""Rows of measurements, where they are kept, and instructions counted by
callgrind.

Every row is of one problem, solver and setting of its dial: error, time [ns],
instructions and a verdict; what was not measured is empty. An error is the
largest of r [m], v [m/s] and w [rad/s]. The rows of all sections are in one
results.csv, at the head of which a line a section says of which core it is.
"""
import io
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Iterable

import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import driven  # noqa: E402

BUILD = Path(os.environ.get("BUILD") or "build")
CC = os.environ.get("CC") or "gcc"
QUICK = bool(os.environ.get("QUICK"))
REALS = "double", "float"
OUT = BUILD / "bench"      # what was measured in this build
KEPT = Path("docs/bench")  # what is kept: tables and pictures
# Problems with switches, and stiff ones, two of them of laws without a jump.
SWITCHED = ["chaos", "crossings", "stickslip", "driven"]
ONE_FIELD = ["stiff-smooth", "stiff-string"]
STIFF = ["stiff-spring", *ONE_FIELD]
KEY = ["problem", "solver", "dial"]
COLUMNS = [*KEY, "error", "ns", "instructions", "verdict"]
RESULTS = OUT / "results.csv"


def say(text: object) -> None:
    """Progress, to standard error."""
    wide = f"\r{text}".ljust(80) if sys.stderr.isatty() else text
    print(wide, file=sys.stderr, flush=True)


def csv(text: str, names: list[str] | None = None) -> pd.DataFrame:
    """A table of lines, without a header where the columns have names here."""
    return pd.read_csv(io.StringIO(text), names=names, keep_default_na=False,
                       na_values=["nan", "-nan"])


def load(path: Path) -> tuple[list[str], pd.DataFrame]:
    """The lines at the head of a table, without their mark, and the table."""
    head = [line[2:] for line in path.read_text("utf-8").splitlines()
            if line.startswith("# ")]
    return head, pd.read_csv(path, comment="#", keep_default_na=False,
                             na_values=[""])


def save(path: Path, head: list[str], table: pd.DataFrame) -> None:
    """As `load` reads it."""
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in head)
        table.to_csv(file, index=False, float_format="%.6g")


def results() -> tuple[dict[str, str], pd.DataFrame]:
    """Of which core each section is, and all rows."""
    if not RESULTS.exists():
        return {}, pd.DataFrame(columns=[*COLUMNS, "section"])
    head, rows = load(RESULTS)
    return dict(line.split(": ", 1) for line in head), rows


def put(name: str, of: str, rows: pd.DataFrame) -> None:
    """Puts a section in the place of what was there."""
    was, others = results()
    rows = pd.concat([others[others.section != name],
                      rows.assign(section=name)])
    for number in "error", "ns", "instructions":
        rows[number] = pd.to_numeric(rows[number])
    # Counts keep all digits.
    rows["instructions"] = rows.instructions.round().astype("Int64")
    save(RESULTS, [f"{section}: {core}"
                   for section, core in {**was, name: of}.items()],
         rows.sort_values("section", kind="stable"))


def problems() -> pd.DataFrame:
    """Of each problem the length, and where it ends."""
    return csv(driven.output(BUILD / "double/bench", "problems"),
               ["problem", "length", "r", "v", "w"]).set_index("problem")


def counts_here(what: str) -> bool:
    """Whether instructions can be counted; says what is left out."""
    if shutil.which("valgrind"):
        return True
    say(f"left out: {what} (apt-get install valgrind)")
    return False


def counted(function: str, *command: object, lines: Iterable[str] = ()
            ) -> list[tuple[str, int]]:
    """Each line that a program printed, with the instructions of the call of
    the function before it. The program reads lines."""
    place = BUILD / f"dumps-{os.getpid()}"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    done = subprocess.run(
        ["valgrind", "--tool=callgrind",
         f"--callgrind-out-file={place / 'out'}",
         f"--toggle-collect={function}", f"--zero-before={function}",
         f"--dump-after={function}", *map(str, command)],
        input="\n".join(lines), capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{done.stderr}{command[0]} fails under valgrind")
    found = []
    for i, line in enumerate(done.stdout.splitlines(), start=1):
        dump = (place / f"out.{i}").read_text("utf-8")
        total, = re.findall(r"^summary: (\d+)", dump, re.MULTILINE)
        found.append((line, int(total)))
    shutil.rmtree(place)
    return found
