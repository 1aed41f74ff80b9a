#!/usr/bin/python3 -B
"""The worst calls of the public functions: what is kept of them, beside this
script, and docs/bench/worst.csv, the table of it.

    bounds.py    searches in both real types from the kept calls on, asks check
                 `stack`, and makes BUILD/bounds/ (`make bounds`; `make
                 keep-bounds` keeps it)

worst.double and worst.float have lines "name units instructions genes", which
main.c counts again and goes on from; worst.stack is a table of bytes, functions
by targets. Environment: BUILD, EVALUATIONS.
"""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pandas

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
REALS = "double", "float"
# What a call may take more, and a kept figure may be above it, without being
# wrong: compilers differ, and a search finds a little more each time.
SLACK, STALE = 1.1, 1.25


def worst(path: Path) -> pandas.DataFrame:
    """Lines of a file of calls."""
    return pandas.read_csv(path, sep=" ", dtype={"genes": str},
                           names=["name", "units", "count", "genes"])


def most(path: Path) -> pandas.Series:
    """The largest count by name and units, in the order of the file."""
    return worst(path).groupby(["name", "units"], sort=False)["count"].max()


def stacks(path: Path) -> pandas.DataFrame:
    """Bytes, functions by targets."""
    return pandas.read_csv(path, sep=" ", index_col="function")


def table(place: Path) -> pandas.DataFrame:
    """The table of the files in a folder: of the most units; functions without
    a call are plain."""
    depth = stacks(place / "worst.stack")
    counts = pandas.DataFrame({real: most(place / f"worst.{real}")
                               for real in REALS}).reset_index()
    found = counts.groupby("name", sort=False).last()
    of = found.pop("units").map(lambda n: f"n = {n}" if n else "")
    found = found.reindex([*found.index, *depth.index.difference(found.index)])
    found.insert(0, "of", of)
    found["stack x86-64"] = depth["x86-64"]
    found["stack of boards"] = depth.drop(columns="x86-64").max(axis=1)
    return found.rename_axis("function").astype(
        {real: "Int64" for real in REALS})


def cost(build: Path, real: str, evaluations: int, calls: Path) -> str:
    """What a search from the calls on finds."""
    # What is expensive in one real type may be in the other.
    return subprocess.run(
        [build / real / "cost", str(evaluations)], text=True, check=True,
        input="".join((calls / f"worst.{real}").read_text("utf-8")
                      for real in REALS), stdout=subprocess.PIPE).stdout


def search(build: Path, evaluations: int) -> None:
    """Makes BUILD/bounds/."""
    place = build / "bounds"
    place.mkdir(parents=True, exist_ok=True)
    for real in REALS:
        print(f"{real}: {evaluations} calls of each function ...",
              file=sys.stderr)
        (place / f"worst.{real}").write_text(
            cost(build, real, evaluations, HERE), "utf-8")
    print("stack ...", file=sys.stderr)
    # What is kept may be out of date, which is what this is for.
    subprocess.run([ROOT / "tools/verify/check/stack.py"], check=False,
                   stdout=subprocess.DEVNULL,
                   env={**os.environ, "BUILD": str(build / "check")})
    (place / "worst.stack").write_bytes(
        (build / "check/worst.stack").read_bytes())
    core = subprocess.run([ROOT / "tools/stamp", "core"], text=True,
                          stdout=subprocess.PIPE, check=True).stdout.strip()
    (place / "worst.csv").write_text(
        f"# {core}\n{table(place).to_csv()}", "utf-8")
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
