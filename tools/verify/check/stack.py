#!/usr/bin/python3
"""Worst stack: no function of the core calls itself, through others or through
a pointer, and each needs what its header says ("Stack: N B"): the worst over
x86-64 and the 32-bit boards as they compile, in both real types, rounded up to
a multiple of 16. Less is a broken promise, more a figure that no longer holds.
Every figure is in BUILD/stack.table, "function target real bytes", and in
BUILD/stack.worst, "function claimed worst rounded where".
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "bench"))
from callgraph import Graph  # noqa: E402
from findings import ROOT, checked, need, wrong  # noqa: E402
from frames import Code  # noqa: E402
from public import public_functions  # noqa: E402

BOARDS = ["microbit", "stm32f405", "mps2-an500", "hifive1", "rv32fd"]
BUILD = Path(os.environ.get("BUILD", "build/check"))
MAKE = os.environ.get("MAKE", "make")
CORE = sorted(str(ROOT / f) for f in Path(".").glob("src/*/*.c"))
DEFINE = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
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


def rows(target, real, graph, claims):
    """Rows of the table for one target and real type."""
    for text in graph.refused:
        wrong(f"{target}: no bound of the stack: {text}")
    suffix = "_f64" if real == "double" else "_f32"
    for name, depth, _ in graph.depths:
        name = name.removesuffix(suffix)
        if name in claims:
            yield name, target, real, depth


def judge_recursion():
    place = emptied(BUILD / "recursion-seed")
    (place / "seed.c").write_text(SEED)
    if not any("recursion" in text for text in recursion(place, ["seed.c"])):
        wrong("a planted recursion is not found")
    for text in recursion(emptied(BUILD / "recursion"), CORE):
        wrong(f"the core calls itself: {text}")


def targets():
    """(target, real, command, board or None) of all that is compiled."""
    for real in DEFINE:
        yield "x86-64", real, ["gcc", "-O2", DEFINE[real]], None
    for board in BOARDS:
        compiler = fact(board, "CC") or fact(board, "TOOLS") + "gcc"
        need(compiler, fact(board, "PACKAGES"))
        for real in fact(board, "REALS").split():
            yield board, real, [compiler, fact(board, "OPT") or "-Os",
                                *shlex.split(fact(board, "FLAGS")),
                                DEFINE[real]], board


need("gcc", "gcc")
BUILD.mkdir(parents=True, exist_ok=True)
judge_recursion()
claims = {f.name: int(f.row(r"Stack: +(\d+) B") or 0)
          for f in public_functions()}
if not claims:
    wrong("no header claims a stack")
table = []
for target, real, command, board in targets():
    place = emptied(BUILD / f"stack-{target}-{real}")
    compile_core(place, command)
    about = {"library": library(place, board, command),
             "flat": None} if board else {}
    table += rows(target, real, graph_in(place, **about), claims)
(BUILD / "stack.table").write_text(
    "".join(" ".join(map(str, row)) + "\n" for row in table))

with open(BUILD / "stack.worst", "w") as file:
    for name, claimed in sorted(claims.items()):
        mine = [row for row in table if row[0] == name]
        _, target, real, worst = max(mine, key=lambda row: row[3],
                                     default=(name, "no", "library", 0))
        rounded = (worst + 15) // 16 * 16
        print(name, claimed, worst, rounded, target, "in", real, file=file)
        if claimed != rounded:
            wrong(f"{name}: its header says {claimed} B, it needs {worst} B "
                  f"({target} in {real}), that is {rounded} B: make bounds && "
                  "make keep-bounds")
checked(f"{len(claims)} functions need what they claim, no recursion; x86-64 "
        f"and {len(BOARDS)} boards, both real types")
