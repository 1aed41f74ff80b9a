#!/usr/bin/python3
"""Worst stack: no function of the core calls itself, through others or through
a pointer, and each public one needs what tools/verify/cost/worst.stack keeps,
on x86-64 and the 32-bit boards as they compile: the larger of both real types.
More is a broken promise; less by a quarter and 32 bytes a figure that no longer
holds. What is found is in BUILD/worst.stack (`make keep-bounds` keeps it).
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pandas

from findings import (BUILD, DEFINES, MAKE, ROOT, checked, need,
                      public_functions, wrong)
from frames import Code

sys.path[:0] = [str(ROOT / "tools/bench"), str(ROOT / "tools/verify/cost")]
import bounds  # noqa: E402
from callgraph import Graph  # noqa: E402

BOARDS = ["microbit", "stm32f405", "mps2-an500", "hifive1", "rv32fd"]
CORE = sorted(str(ROOT / f) for f in Path(".").glob("src/*/*.c"))
COMMON = ["-std=c99", "-ffreestanding", f"-I{ROOT}/include", f"-I{ROOT}/src",
          "-fcallgraph-info=su", "-S"]

# A function that calls itself in its last place, so that a compiler which
# optimises such calls makes a jump of it that no call graph has.
SEED = """unsigned hail(unsigned n, unsigned steps);
unsigned hail(unsigned n, unsigned steps) {
  return n == 1 ? steps : hail(n % 2 ? 3 * n + 1 : n / 2, steps + 1);
}
"""


def fact(board, name):
    return subprocess.run(
        [MAKE, "-s", "--no-print-directory", f"board-{name}", f"BOARD={board}"],
        stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def output(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True,
                          check=True).stdout


def emptied(place):
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    return place


def compiles(place, *command):
    if subprocess.run(command, cwd=place).returncode != 0:
        wrong(f"{place}: does not compile: {' '.join(command[:2])} ...")


def graph_in(place, **about):
    return Graph(sorted(place.glob("*.ci")) + sorted(place.glob("*.s")),
                 **about)


def recursion(place, sources):
    """What is refused of sources that are compiled without tail calls."""
    compiles(place, "gcc", "-O1", "-fno-optimize-sibling-calls", "-fno-inline",
             *COMMON, *sources)
    return Graph(sorted(place.glob("*.ci"))).refused


def compile_core(place, command):
    """The core, and a file that holds all its inline functions."""
    (place / "inline.c").write_text('#include "twofold.h"\n')
    compiles(place, *command, "-ffp-contract=off", "-fno-math-errno", *COMMON,
             *CORE)
    compiles(place, *command, "-fkeep-inline-functions", *COMMON, "inline.c")


def library(place, board, command):
    """Bytes that functions of the C library and of soft float take, from their
    instructions. The linker script of the board has no room for all at once."""
    compiles(place, *command, "-std=c99", "-S", "-fcallgraph-info=su",
             f"{ROOT}/port/arch/memory.c")
    wanted = set()
    for file in place.glob("*.ci"):
        wanted.update(re.findall(r'^edge:.* targetname: "([^":]*)"',
                                 file.read_text(), re.M))
    linked = [f for f in fact(board, "LINK").split() if not f.startswith("-T")]
    program = place / "library.elf"
    if subprocess.run(
            [*command, *(f"-Wl,-u,{name}" for name in sorted(wanted)
                         if not name.startswith(("tf_", "mem"))),
             *linked, "-Wl,-e,0", "-Wl,--no-gc-sections", "-o",
             program]).returncode != 0:
        wrong(f"{board}: its libraries do not link")
        return {}
    tools = fact(board, "TOOLS")
    code = Code(output(tools + "nm", program),
                output(tools + "objdump", "-d", "--no-show-raw-insn", program))
    functions = code.functions()
    for text in code.refused:
        wrong(f"{board}: the stack of its libraries has no bound: {text}")
    return functions


def depths(target, real, graph, names):
    """(name, target), bytes of the public functions."""
    for text in graph.refused:
        wrong(f"{target}: no bound of the stack: {text}")
    suffix = "_f64" if real == "double" else "_f32"
    return {(name, target): depth for name, depth, _ in
            ((one[0].removesuffix(suffix), *one[1:]) for one in graph.depths)
            if name in names}


def judge_recursion():
    place = emptied(BUILD / "recursion-seed")
    (place / "seed.c").write_text(SEED)
    if not any("recursion" in text for text in recursion(place, ["seed.c"])):
        wrong("a planted recursion is not found")
    for text in recursion(emptied(BUILD / "recursion"), CORE):
        wrong(f"the core calls itself: {text}")


def targets():
    """(target, real, command, board or None) of all that is compiled."""
    for real in DEFINES:
        yield "x86-64", real, ["gcc", "-O2", DEFINES[real]], None
    for board in BOARDS:
        compiler = fact(board, "CC") or fact(board, "TOOLS") + "gcc"
        need(compiler, fact(board, "PACKAGES"))
        for real in fact(board, "REALS").split():
            yield board, real, [compiler, fact(board, "OPT") or "-Os",
                                *shlex.split(fact(board, "FLAGS")),
                                DEFINES[real]], board


need("gcc", "gcc")
os.environ["CCACHE_DISABLE"] = "1"  # it has no call graphs
judge_recursion()
public, found = public_functions(), {}
for target, real, command, board in targets():
    place = emptied(BUILD / f"stack-{target}-{real}")
    compile_core(place, command)
    about = {"library": library(place, board, command),
             "flat": None} if board else {}
    for key, depth in depths(target, real, graph_in(place, **about),
                             public).items():
        found[key] = max(depth, found.get(key, 0))
pandas.Series(found).unstack().rename_axis("function").to_csv(
    BUILD / "worst.stack", sep=" ")

kept = bounds.stacks(bounds.HERE / "worst.stack").stack().to_dict()
for key in sorted(found.keys() | kept.keys()):
    now, was = found.get(key, 0), kept.get(key, 0)
    if now > was or was > bounds.STALE * now + 32:
        wrong(f"{key[0]} on {key[1]} needs {now} B, kept are {was} B: make "
              "bounds && make keep-bounds")
checked(f"{len(public)} functions need what is kept, no recursion; x86-64 and "
        f"{len(BOARDS)} boards, both real types")
