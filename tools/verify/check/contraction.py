#!/usr/bin/python3 -B
"""Bits under foreign build systems: compiled in gnu mode with none of the
project's flags, the core has no fused operation on targets that have them, the
golden hashes hold, and each option that changes bits is refused: by a macro
where one shows it, else by tf_arithmetic when a program starts. A control shows
that each count can see one."""
import os
import re
import shutil
import subprocess
from pathlib import Path

from findings import (BUILD, DEFINES, FULL, ROOT, asked, build, checked,
                      files_in, in_common, need, place_of, wrong)

WORK = BUILD.absolute() / "contraction"
FUSED = re.compile(r"\s(?:vfn?m[as]\.|vfn?m(?:add|sub)|fn?m(?:add|sub)\.)")
CONTROL = """double f(double a, double b, double c) { return a * b + c; }
float g(float a, float b, float c) { return a * b + c; }
"""
# The types that a target computes in hardware, its compiler and options.
BOTH = tuple(DEFINES)
TARGETS = (
    (("float",), "arm-none-eabi-gcc -mcpu=cortex-m33 -mfloat-abi=hard"),
    (BOTH, "arm-none-eabi-gcc -mcpu=cortex-m7 -mfloat-abi=hard"),
    (("float",), "arm-none-eabi-gcc -mcpu=cortex-m4 -mfloat-abi=hard"),
    (("float",), "riscv64-unknown-elf-gcc -ffreestanding -march=rv32imafc "
                 "-mabi=ilp32f"),
    (BOTH, "gcc -march=haswell"),
    (("double",), "gcc -march=haswell -ffp-contract=fast"),
    (BOTH, "clang -march=haswell"))
REFUSED = (
    "gcc -Ofast", "gcc -ffast-math", "gcc -funsafe-math-optimizations",
    "gcc -fassociative-math -fno-signed-zeros -fno-trapping-math",
    "gcc -freciprocal-math", "gcc -ffinite-math-only", "gcc -fno-signed-zeros",
    "gcc -fsingle-precision-constant", "gcc -mfpmath=387", "clang -Ofast",
    "clang -ffast-math", "clang -ffinite-math-only")
# Options that no macro shows, and what tf_arithmetic finds.
UNSAFE = "clang -O2 -funsafe-math-optimizations"
FUSED_BY = "clang -O2 -mfma -ffp-contract=fast"
FOUND = ((0, "gcc -O3 -march=haswell -std=gnu17"),
         (0, "gcc -O2 -mfma -ffp-contract=fast"),
         (0, "clang -O3 -march=haswell"), (0, "gcc -O0"), (0, "clang -O0"),
         (3, FUSED_BY),
         (5, UNSAFE), (5, f"{UNSAFE} -mfma"),
         (5, "clang -O2 -freciprocal-math"),
         (7, "clang -O2 -fno-signed-zeros"))
TRIES = """#include <twofold/status.h>
int main(void) { return tf_arithmetic(); }
"""
# A library that sets another rounding mode before main.
UPWARD = """#include <fenv.h>
__attribute__((constructor)) static void up(void) { fesetround(FE_UPWARD); }
"""


def fused(compiler, *arguments):
    """How many fused operations a compiler makes; None where it fails."""
    for old in WORK.glob("*.s"):
        old.unlink()
    if subprocess.run([*compiler.split(), "-S", f"-I{ROOT}/include", "-O2",
                       "-std=gnu17", *arguments], cwd=WORK,
                      check=False).returncode:
        return None
    return sum(len(FUSED.findall(file.read_text()))
               for file in WORK.glob("*.s"))


for tool, package in (
        ("gcc", "gcc"), ("clang", "clang"),
        ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
        ("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf")):
    need(tool, package)
shutil.rmtree(WORK, ignore_errors=True)
WORK.mkdir(parents=True)
(WORK / "control.c").write_text(CONTROL)
sources = sorted((ROOT / "src").rglob("*.c"))
for reals, target in TARGETS:
    for real in reals:
        found = fused(target, DEFINES[real], *sources)
        if found != 0:
            wrong(f"{target}, {real}: {found} fused operations")
    if not fused(target, "-ffp-contract=fast", "control.c"):
        wrong(f"{target}: the control has none")

# The golden hashes, in gnu mode, on what this processor has. Those of gcc are
# also what test two-files of `make test-dist` looks at.
FLAGS = "-std=gnu17 -O2 -march=native -Iinclude"
for one in ("gcc", "clang") if FULL else ("clang",):
    if not build(f"CC={one}", f"BUILD={WORK}/{one}", "TWOFOLD=",
                 "TESTS=tests/golden/test_golden.c "
                 "tests/golden/test_population.c", f"CORE_FLAGS={FLAGS}",
                 f"TEST_FLAGS={FLAGS} -Itests -Itests/support "
                 "-Itests/reference -Isrc", "test"):
        wrong(f"{one}: other golden hashes in gnu mode")

for line in REFUSED:
    if subprocess.run([*line.split(), "-c", "-Iinclude", "src/moreau/step.c",
                       "-o", WORK / "step.o"], stderr=subprocess.DEVNULL,
                      check=False).returncode == 0:
        wrong(f"{line} is not refused")


def compiled(line, output):
    subprocess.run([*line.split(), "-Iinclude", "-o", output], check=True)


# clang links code that sets FTZ, which would be found first; gcc does not.
(WORK / "tries.c").write_text(TRIES)
for real, define in DEFINES.items():
    for code, line in FOUND:
        compiled(f"{line} {define} -c src/num/status.c", WORK / "status.o")
        compiled(f"gcc {define} {WORK}/tries.c {WORK}/status.o -lm",
                 WORK / "tries")
        _, found = asked(WORK / "tries")
        if found != code:
            wrong(f"{line}, {real}: tf_arithmetic() is {found}, not {code}")

# The command line: the usual one, and with the same file of the core fused.
home = place_of("gcc", "-O3") / "double"
if not in_common("gcc", "-O3", home / "twofold"):
    wrong("the command line does not compile")
compiled(f"{FUSED_BY} -c src/num/status.c", WORK / "status.o")
objects = [f"{home}/{file.with_suffix('.o')}"
           for file in [*files_in("tools/cli", pattern="*.c"),
                        *Path("tools").glob("*.c")]]
compiled(f"gcc {WORK}/status.o {' '.join(objects)} {home}/help.o "
         f"{home}/lanes/avx2.o {home}/libtwofold.a -lm", WORK / "twofold")
said, code = asked(WORK / "twofold", "scenes", stderr=subprocess.STDOUT)
if code != 4 or "-ffp-contract=fast" not in said:
    wrong(f"a fused command line ends with {code}: {said}")
(WORK / "upward.c").write_text(UPWARD)
compiled(f"gcc -shared -fPIC {WORK}/upward.c -lm", WORK / "upward.so")
usual, upward = (
    asked(home / "twofold", "run", "chaos", "--t-end", "0.1",
          stderr=subprocess.DEVNULL, env={**os.environ, **more})
    for more in ({}, {"LD_PRELOAD": str(WORK / "upward.so")}))
if usual != upward:
    wrong("the rounding mode of a library changes the bits of the command line")
checked("no fused operation in gnu mode on M33, M7, M4F, rv32imafc and x86, "
        f"golden hashes hold by {'gcc and ' if FULL else ''}clang, "
        f"{len(REFUSED)} options are refused by a macro, "
        f"{sum(code > 0 for code, _ in FOUND)} when a program starts")
