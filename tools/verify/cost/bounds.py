#!/usr/bin/python3 -B
"""The worst calls of the public functions: what is kept of them, beside this
script, and docs/BOUNDS.md, the page of it.

    bounds.py search   searches in both real types from the kept calls on, asks
                       check `stack`, and makes BUILD/bounds/ (`make bounds`;
                       `make keep-bounds` keeps it)
    bounds.py page     the page of what is kept, on standard output

worst.double and worst.float have lines "name units instructions genes", which
main.c reads and counts again; worst.stack is a table of bytes, functions by
targets. Environment: BUILD, EVALUATIONS.
"""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pandas
from tabulate import tabulate

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
REALS = "double", "float"
# What a call may take more, and a kept figure may be above it, without being
# wrong: compilers differ, and a search finds a little more each time.
SLACK, STALE = 1.1, 1.25
PREFACE = """# Worst cost and stack

{core}

Made by `make bounds`, kept by `make keep-bounds`; checks `cost` and `stack`
hold it.

Instructions of one call on x86-64, gcc -O2: the most that a search over
machines, states and inputs found (tools/verify/cost), no bound. A repeated
string instruction counts as one. The calls are kept, and each can be made
again: `build/double/cost replay <tools/verify/cost/worst.double`. Of functions
that take n bytes, states or segments the figure is that of the largest n tried,
and of n = 0. Functions without one are plain: they take the same few hundred
instructions at most whatever they are given. Check `cost` fails where a kept
call, or a new one of a short search, takes more than {slack} times its figure.

Stack: the worst path of the call graph in bytes, the larger of both real types,
on x86-64 (gcc -O2) and as the boards compile (port/*/board.mk), what soft float
and the C library take included, without interrupts; not on wasm32 and the 8-bit
uno. On x86-64 a function of the C library counts 32.

"""


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


def page(place: Path, core: str) -> str:
    """The page of the files in a folder."""
    counts = {real: most(place / f"worst.{real}") for real in REALS}
    depth = stacks(place / "worst.stack")
    known, rows = counts["double"].index.unique("name"), []
    for name in [*known, *depth.index.difference(known)]:
        units = counts["double"][name].index.max() if name in known else 0
        cells = [f"{of[name][units]}" + (f" ({of[name][0]})" if units else "")
                 for of in counts.values()] if name in known else ["", ""]
        rows.append([f"`{name}`", f"n = {units}" if units else "", *cells,
                     *depth.loc[name]])
    head = ["function", "of", *REALS, *depth.columns]
    return PREFACE.format(core=core, slack=SLACK) + tabulate(
        rows, head, "pipe", colalign=["left", "left"] + ["right"] * (
            len(head) - 2), disable_numparse=True) + "\n"


def cost(build: Path, real: str, evaluations: int, calls: Path) -> str:
    """What a search from the calls on finds; 0 evaluations count them again."""
    what = ["search", str(evaluations)] if evaluations else ["replay"]
    # What is expensive in one real type may be in the other.
    return subprocess.run(
        [build / real / "cost", *what], text=True, check=True,
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
    (place / "BOUNDS.md").write_text(page(place, core), "utf-8")
    print(f"The page is {place}/BOUNDS.md.")


def main() -> None:
    text = os.environ.get("EVALUATIONS") or "100000"
    if sys.argv[1:] == ["search"] and text.isdigit() and int(text) > 0:
        search(Path(os.environ.get("BUILD") or "build"), int(text))
    elif sys.argv[1:] == ["page"]:
        print(page(HERE, (ROOT / "docs/BOUNDS.md").read_text("utf-8")
                   .splitlines()[2]), end="")
    else:
        print(f"EVALUATIONS={text}: a whole number > 0; bounds.py search|page",
              file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
