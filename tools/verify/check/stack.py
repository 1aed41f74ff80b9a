#!/usr/bin/python3
"""Worst stack: no function of the core calls itself, through others or through
a pointer, and each public one needs what docs/bench/worst.csv keeps,
on x86-64 and the 32-bit boards as they compile: the larger of both real types.
More is a broken promise; less by a quarter and 32 bytes a figure that no longer
holds. What is found is in BUILD/worst.stack (`make keep-bounds` keeps it).
"""
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pandas

from findings import (BUILD, DEFINES, ROOT, checked, need, public_functions,
                      wrong)

sys.path[:0] = [str(ROOT / "tools/bench"), str(ROOT / "tools/verify/cost")]
import bounds  # noqa: E402
from boards import Board  # noqa: E402
from callgraph import FLAT, Graph  # noqa: E402

BOARDS = ["microbit", "stm32f405", "mps2-an500", "hifive1", "rv32fd"]
CORE = sorted(str(ROOT / f) for f in Path(".").glob("src/*/*.c"))
COMMON = ["-std=c99", "-ffreestanding", f"-I{ROOT}/include", f"-I{ROOT}/src",
          "-fcallgraph-info=su", "-S"]

# What soft float and sqrt take at most [B], by the instructions of libgcc and
# newlib in Debian 12 that are linked; it counts for each of them.
SOFT_FLOAT = 112


def emptied(place):
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    return place


def compiles(place, *command):
    if subprocess.run(command, cwd=place).returncode != 0:
        wrong(f"{place}: does not compile: {' '.join(command[:2])} ...")


def compile_core(place, command, *others):
    """The core, and a file that holds all its inline functions."""
    (place / "inline.c").write_text('#include "twofold.h"\n')
    compiles(place, *command, "-ffp-contract=off", "-fno-math-errno", *COMMON,
             *CORE, *others)
    compiles(place, *command, "-fkeep-inline-functions", *COMMON, "inline.c")


def depths(target, real, graph, names):
    """(name, target), bytes of the public functions."""
    for text in graph.refused:
        wrong(f"{target}: no bound of the stack: {text}")
    suffix = "_f64" if real == "double" else "_f32"
    return {(name, target): depth for name, depth, _ in
            ((one[0].removesuffix(suffix), *one[1:]) for one in graph.depths)
            if name in names}


def judge_recursion():
    """Without tail calls, of which a compiler makes jumps that no call graph
    has."""
    place = emptied(BUILD / "recursion")
    compiles(place, "gcc", "-O1", "-fno-optimize-sibling-calls", "-fno-inline",
             *COMMON, *CORE)
    for text in Graph(sorted(place.glob("*.ci"))).refused:
        wrong(f"the core calls itself: {text}")


def targets():
    """(target, real, command, board or None) of all that is compiled."""
    for real in DEFINES:
        yield "x86-64", real, ["gcc", "-O2", DEFINES[real]], None
    for board in BOARDS:
        fact = Board(board).fact
        compiler = fact("CC") or fact("TOOLS") + "gcc"
        need(compiler, fact("PACKAGES"))
        for real in fact("REALS").split():
            yield board, real, [compiler, *shlex.split(fact("OPT")),
                                *shlex.split(fact("FLAGS")),
                                DEFINES[real]], board


need("gcc", "gcc")
os.environ["CCACHE_DISABLE"] = "1"  # it has no call graphs
judge_recursion()
public, found = public_functions(), {}
for target, real, command, board in targets():
    place = emptied(BUILD / f"stack-{target}-{real}")
    compile_core(place, command, *[f"{ROOT}/port/arch/memory.c"] * bool(board))
    graph = Graph(sorted(place.glob("*.ci")) + sorted(place.glob("*.s")),
                  SOFT_FLOAT if board else FLAT)
    for key, depth in depths(target, real, graph, public).items():
        found[key] = max(depth, found.get(key, 0))
pandas.Series(found).unstack().rename_axis("function").to_csv(
    BUILD / "worst.stack")

kept = bounds.kept().filter(like="stack ").groupby("function").first()
kept = kept.rename(columns=lambda name: name[6:])[["x86-64", *BOARDS]]
kept = kept.stack().to_dict()
for key in sorted(found.keys() | kept.keys()):
    now, was = found.get(key, 0), kept.get(key, 0)
    if now > was or was > bounds.STALE * now + 32:
        wrong(f"{key[0]} on {key[1]} needs {now} B, kept are {was} B: make "
              "bounds && make keep-bounds")
checked(f"{len(public)} functions need what is kept, no recursion; x86-64, "
        f"{', '.join(BOARDS)}, both real types")
