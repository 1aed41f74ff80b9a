#!/usr/bin/python3 -B
"""The passes of an ensemble are vectors: each loop of them is named here with
the bytes of its vectors under AVX2, and gcc says whether it made them. One &&
too many and a pass is scalar, with the same bits at three times the cost."""
import re
import subprocess

from findings import BUILD, DEFINES, ROOT, checked, need, wrong

SOURCES = ("src/ensemble/ensemble.c", "src/ensemble/lanes_solve.h")
# The loops of each function in their order; bytes of modes go 16 at a time.
VECTORS = dict.fromkeys(
    "linearise_all forms_all enumerate_all shares_of slips_of sticks_of "
    "kinds_all near_codim2_all all_continue none_of stick_all ends_all "
    "balance_lanes".split(), [32])
VECTORS |= dict(slip_all=[32] * 3, finish_all=[32] * 2, modes_all=[16] * 2,
                record_all=[16] * 3)
FLAGS = ("-std=c99 -O3 -ffp-contract=off -fno-math-errno -ffreestanding "
         "-Iinclude -fopt-info-vec-optimized -c src/ensemble/ensemble.c -o")
FUNCTION = re.compile(r"^(?:static|TF_\w+) (?:__a\S+ )?[^;{(]*?(\w+)\(", re.M)
MADE = re.compile(r"(\S+?):(\d+):\d+: optimized: loop vectorized using (\d+)")


def loops():
    """(file, line, function, its nth loop) of each loop."""
    for file in SOURCES:
        text = (ROOT / file).read_text()
        heads = [(m.start(), m[1]) for m in FUNCTION.finditer(text)]
        count = {}
        for loop in re.finditer(r"^ +for \(", text, re.M):
            name = [name for at, name in heads if at < loop.start()][-1]
            count[name] = count.get(name, -1) + 1
            yield file, text[:loop.end()].count("\n") + 1, name, count[name]


def scalar(real, options):
    """The named loops that are no vectors of their size."""
    said = subprocess.run(
        ["gcc", DEFINES[real], *options, *FLAGS.split(), BUILD / "vectors.o"],
        text=True, stderr=subprocess.PIPE, check=True).stderr
    made = {}
    for file, line, size in MADE.findall(said):
        made.setdefault((file, int(line)), []).append(int(size))
    for file, line, name, nth in loops():
        if name in VECTORS:
            least = min(VECTORS[name][nth], 32 if "-mavx2" in options else 16)
            if max(made.get((file, line), [0])) < least:
                yield f"{file}:{line}, loop {nth + 1} of {name}"


need("gcc", "gcc")
total = sum(map(len, VECTORS.values()))
names = [name for _, _, name, _ in loops()]
for name in {*re.findall(r"\w+_(?:all|of|lanes)\b", " ".join(names)), *VECTORS}:
    if names.count(name) != len(VECTORS.get(name, ())):
        wrong(f"{name}: {names.count(name)} loops, not as they are named here")
for real in DEFINES:
    for options in (["-msse4.2"], ["-mavx2"]):
        for loop in scalar(real, options):
            wrong(f"{loop}: scalar in {real}, {options[0]}")
    if len([*scalar(real, ["-fno-tree-vectorize"])]) != total:
        wrong("loops without vectors are not found")
checked(f"{total} loops of an ensemble are vectors with SSE4.2 and AVX2, in "
        "both real types")
