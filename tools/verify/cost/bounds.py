#!/usr/bin/python3 -B
"""The worst calls of the public functions: docs/bench/worst.csv has the
figures, worst.double and worst.float beside this script the calls.

    bounds.py    searches in both real types from the kept calls on, counts the
                 steps on boards, asks check `stack`, and makes BUILD/bounds/
                 (`make bounds`; `make keep-bounds` keeps it)

The calls are lines "name units instructions genes", which main.c counts again
and goes on from. Environment: BUILD EVALUATIONS.
"""
from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pandas

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/bench")]
from boards import Board, Firmware, plugin  # noqa: E402

REALS = "double", "float"
BOARDS = {"M4F float": "stm32f405", "M7 double": "mps2-an500",
          "M7 float": "mps2-an500"}
KEY = ["name", "units"]
ROW = ["function", "of"]
# The units of tf_step, see calls.c.
CLASSES = "one sign of g", "both signs of g", "near h = g = 0", "rest"
# What a call may take more, and a kept figure may be above it, without being
# wrong: compilers differ, and a search finds a little more each time.
SLACK, STALE = 1.1, 1.25


def most(path: Path) -> pandas.Series:
    """The count by name and units, in the order of a file of calls."""
    return pandas.read_csv(path, sep=" ", names=[*KEY, "count", "genes"],
                           index_col=KEY)["count"]


def named(found: pandas.DataFrame | pandas.Series):
    """With the rows of the table in the place of name and units."""
    of = [CLASSES[n] if name == "tf_step" else f"n = {n}" if n else ""
          for name, n in found.index]
    return found.set_axis(pandas.MultiIndex.from_arrays(
        [found.index.get_level_values(0), of], names=ROW))


def table(place: Path, depth: pandas.DataFrame,
          on_boards: pandas.DataFrame) -> pandas.DataFrame:
    """The table of the calls in a folder, of their steps on boards, and of the
    stack, functions by targets; functions without a call are plain."""
    found = pandas.DataFrame({f"x86-64 {real}": most(place / f"worst.{real}")
                              for real in REALS})
    found = named(found.join(on_boards)).astype("Int64").reset_index("of")
    found = pandas.concat(
        [found, pandas.DataFrame(index=depth.index.difference(found.index))])
    for target in sorted(depth, reverse=True):
        found[f"stack {target}"] = depth[target]
    return found.rename_axis("function")


def kept() -> pandas.DataFrame:
    """The table that is kept."""
    return pandas.read_csv(ROOT / "docs/bench/worst.csv", comment="#").fillna(
        {"of": ""}).set_index(ROW)


def cost(build: Path, real: str, what: object, calls: Path) -> str:
    """What a search from the calls on finds, or else the constants of steps."""
    # What is expensive in one real type may be in the other.
    return subprocess.run(
        [build / real / "cost", str(what)], text=True, check=True,
        input="".join((calls / f"worst.{real}").read_text("utf-8")
                      for real in REALS), stdout=subprocess.PIPE).stdout


def emulate(build: Path, calls: Path) -> pandas.DataFrame:
    """Instructions of steps, by boards: the dearest of all kept calls as a step
    of that class, or within that budget."""
    counter, found = plugin(), {}
    for column, board in BOARDS.items():
        real = column.split()[-1]
        one = Firmware(Board(board), real, "generic")
        constants = cost(build, real, "constants", calls)
        one.place.mkdir(parents=True, exist_ok=True)
        (one.place / "calls.inc").write_text(constants, "utf-8")
        (one.place / "calls.elf").unlink(missing_ok=True)
        names = re.findall(r"^{ // (\w+) (\d+)$", constants, re.M)
        counts = one.counted(counter, "calls", "SCHEME=located")
        if counts is None or len(counts[0]) != len(names):
            sys.exit(f"{one}: a call does not what it does on x86-64, or "
                     "nothing was counted")
        rows = pandas.DataFrame(names, columns=KEY).astype({"units": int})
        found[column] = rows.assign(count=counts[0]).groupby(KEY)["count"].max()
    return pandas.DataFrame(found)


def search(build: Path, evaluations: int) -> None:
    """Makes BUILD/bounds/."""
    place = build / "bounds"
    place.mkdir(parents=True, exist_ok=True)
    for real in REALS:
        print(f"{real}: {evaluations} calls of each function ...",
              file=sys.stderr)
        (place / f"worst.{real}").write_text(
            cost(build, real, evaluations, HERE), "utf-8")
    print("boards ...", file=sys.stderr)
    on_boards = emulate(build, place)
    print("stack ...", file=sys.stderr)
    # What is kept may be out of date, which is what this is for.
    subprocess.run([ROOT / "tools/verify/check/stack.py"], check=False,
                   stdout=subprocess.DEVNULL,
                   env={**os.environ, "BUILD": str(build / "check")})
    depth = pandas.read_csv(build / "check/worst.stack", index_col="function")
    core = subprocess.run([ROOT / "tools/stamp", "core"], text=True,
                          stdout=subprocess.PIPE, check=True).stdout.strip()
    (place / "worst.csv").write_text(
        f"# {core}\n{table(place, depth, on_boards).to_csv()}", "utf-8")
    print(f"The table is {place}/worst.csv.")


def main() -> None:
    text = os.environ.get("EVALUATIONS") or "100000"
    if not text.isdigit() or int(text) == 0:
        print(f"make bounds: EVALUATIONS={text}: a whole number > 0",
              file=sys.stderr)
        sys.exit(2)
    search(Path(os.environ.get("BUILD") or "build"), int(text))


if __name__ == "__main__":
    main()
