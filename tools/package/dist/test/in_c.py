"""The two files and the prepared scene, in C and in C++."""
import platform
import re
import shutil

from harness import (BUILD, DIST, REALS, ROOT, STRICT, check, ends_at, equal,
                     folder, need, run)

C = DIST / "c"
TEST = ROOT / "tools/package/dist/test"
EXAMPLES = ROOT / "tools/package/dist/cmake/examples/demo"
COMPILERS = (("gcc", "gcc", ["-std=c99"]), ("gcc", "gcc", ["-std=gnu17"]),
             ("clang", "clang", ["-std=c99"]),
             *(("g++", "g++", ["-x", "c++", f"-std={standard}"])
               for standard in ("c++98", "gnu++11", "c++20")),
             *(("clang++", "clang", ["-x", "c++", f"-std={standard}"])
               for standard in ("c++98", "c++20")))
# A file that holds the code of two scenes, after the whole core's header.
TWO_SCENES = """\
#include "twofold.h"
#define TWOFOLD_CHAOS_CODE
#define TWOFOLD_SMOOTH_CODE
#include "twofold_chaos.h"
#include "twofold_smooth.h"
"""
# Words that headers of systems take, as windows.h does.
TAKEN = ("near", "far", "NEAR", "FAR", "IN", "OUT", "small char", "pascal",
         "cdecl", "interface struct", "ERROR 0",
         "min(a, b) ((a) < (b) ? (a) : (b))",
         "max(a, b) ((a) > (b) ? (a) : (b))")
# What the user writes behind them, and where it may contract.
BEHIND = """\
double behind(double a, double b, double c);
double behind(double a, double b, double c) { return a * b + c; }
"""
FUSED = ["-O2", "-march=haswell", "-S", "-o", "-"]
# Where nothing is said about contraction, on what this processor has.
PLAIN = ["-O2", "-march=native"]


def test_two_files():
    """Without a warning as C99, gnu17 and C++; the tests of the golden hashes
    pass with them, in both real types."""
    place = folder("two-files")
    for tool, package, options in COMPILERS:
        need(tool, package)
        for real, define in REALS.items():
            line = [tool, *options, *STRICT, *define, "-I", C, C / "twofold.c"]
            if options[-1] not in ("-std=gnu17", "-std=gnu++11"):
                run(*line, "-fsyntax-only")
                continue
            built = place / f"{real}.o"
            run(*line, *PLAIN, "-c", "-o", built)
            golden = place / "golden"
            run("gcc", "-std=gnu17", *PLAIN, *define, "-I", C, "-I",
                ROOT / "tests", "-I", ROOT / "tests/support", "-I",
                ROOT / "tests/reference",
                ROOT / "tests/golden/test_golden.c", built, "-lm", "-o",
                golden)
            run(golden)


def test_words_of_systems():
    """The two files compile where headers of systems have taken words."""
    place = folder("words")
    (place / "taken.h").write_text("".join(f"#define {one}\n" for one in TAKEN))
    for options in (["-include", place / "taken.h"],
                    ["-D_GNU_SOURCE", "-include", "errno.h"]):
        for tool, package, dialect in COMPILERS[1:4]:
            run(need(tool, package), *dialect, *STRICT, *options, "-I", C,
                "-fsyntax-only", C / "twofold.c")


def scene_hash(place, name, real, compiler, source=None):
    """What the header of a scene computes, its code by one compiler. source: a
    file that holds the code; None: one with nothing but the header."""
    tool, package, options = compiler
    need(tool, package)
    header, code = f"{place}/twofold_{name}.h", place / f"{name}-{real}.o"
    if source is None:
        source = place / f"{name}.c"
        source.write_text(f"#define TWOFOLD_{name.upper()}_CODE\n"
                          f'#include "{header}"\n')
    run(tool, *options, *STRICT, *PLAIN, *REALS[real], "-I", place, "-I", C,
        "-c", source, "-o", code)
    program = place / f"{name}-{real}"
    run("g++", "-std=c++11", *STRICT, *PLAIN, *REALS[real], f"-DSCENE={name}",
        f'-DHEADER="{header}"', TEST / "scene.cpp", code, "-lm", "-o", program)
    return run(program).split()[0]


def golden_hashes():
    """Of each scene in both real types."""
    golden = (ROOT / "tests/golden/golden.inc").read_text()
    return {name: hashes for name, *hashes in re.findall(
        r'"(\w+)", TF_RULE_PERSIST, MOREAU,\s*0x(\w+)u, 0x(\w+)u', golden)}


def test_scene():
    """The header of each scene: without a warning, the golden hash of the
    scene, called from C++; it stands beside twofold.h in one program."""
    place = folder("scene")
    need("g++", "g++")
    constants = [BUILD / real / "constants" for real in REALS]
    for name, hashes in golden_hashes().items():
        run(ROOT / "tools/package/dist/scene.py", name, *constants, place)
        compilers = COMPILERS if name == "chaos" else COMPILERS[:1]
        for compiler in compilers:
            for real, want in zip(REALS, hashes):
                equal(f"{name} by {' '.join(compiler[2])} in {real}",
                      scene_hash(place, name, real, compiler), want)
    both = place / "both.c"
    for order in (("twofold.h", "twofold_chaos.h"),
                  ("twofold_chaos.h", "twofold.h")):
        both.write_text("".join(f'#include "{name}"\n' for name in order)
                        + "int both(tf_state_t *x, tf_report_t *y);\n"
                        "int both(tf_state_t *x, tf_report_t *y) {\n"
                        "  tf_chaos_begin(x, y);\n  return TF_SCENES;\n}\n")
        run("gcc", "-std=c99", *STRICT, "-I", C, "-c", both, "-o",
            place / "both.o")


def test_two_scenes():
    """The code of two scenes in one file, in C and in C++: each has its own
    golden hash."""
    place = folder("two-scenes")
    source = place / "two_scenes.c"
    source.write_text(TWO_SCENES)
    golden = golden_hashes()
    for name in ("chaos", "smooth"):
        shutil.copy(C / f"twofold_{name}.h", place)
        for compiler in COMPILERS[0], COMPILERS[3]:
            for real, want in zip(REALS, golden[name]):
                equal(f"{name} of two by {' '.join(compiler[2])} in {real}",
                      scene_hash(place, name, real, compiler, source), want)
    if platform.machine() != "x86_64":
        return
    source.write_text(TWO_SCENES + BEHIND)
    for tool in "gcc", "clang":
        code = run(tool, "-std=gnu17", *STRICT, *FUSED, "-I", place, "-I", C,
                   source)
        equal(f"sums that {tool} fuses behind two scenes",
              code.count("vfmadd"), 1)


def test_cpp():
    """A program in C++ uses the library; each public header stands alone."""
    need("g++", "g++")
    place = folder("cpp")
    for real, define in REALS.items():
        code, program = place / f"{real}.o", place / real
        run("gcc", "-std=c99", *PLAIN, *define, "-I", C, "-c", C / "twofold.c",
            "-o", code)
        for headers in (C, ROOT / "include"):
            run("g++", "-std=c++11", *STRICT, *PLAIN, *define, "-I", headers,
                TEST / "user.cpp", code, "-lm", "-o", program)
            equal(f"C++ in {real}", run(program), ends_at(real))
    for header in sorted((ROOT / "include").rglob("*.h")):
        run("g++", "-std=c++11", *STRICT, "-I", ROOT / "include",
            "-fsyntax-only", "-x", "c++", "-include", header, "/dev/null")


def said_by(name, *runs):
    """Words that an example of docs/USE.md prints, by line, of each run, in
    double, then in float: the same in C and in C++."""
    place = folder(name)
    for define in REALS.values():
        said = set()
        run("gcc", "-std=c99", *define, "-c", C / "twofold.c", "-o",
            place / "core.o")
        for tool, package, options in COMPILERS:
            run(need(tool, package), *options, *STRICT, *define, "-I", C,
                EXAMPLES / f"{name}.c", "-x", "none", place / "core.o", "-lm",
                "-o", place / name)
            said.add(tuple(run(place / name, *given) for given in runs))
        equal(f"outputs of {name} in C and C++", len(said), 1)
        yield [[*map(str.split, text.splitlines())] for text in said.pop()]


def test_castor():
    """It sticks until A < 0, cos(psi)^2 = m e (kappa - e)/J, psi = 161 degrees,
    has other modes behind it, too, and slips to one side and the other."""
    for (first, second, *rest), in said_by("castor", ()):
        equal("castors begin", (first[4:], second[2:]), (
            ["stick-,", "only"], "160 deg stick-, of several".split()))
        *_, a, b, c, d = [float(row[0]) for row in rest if row[5] == "only"]
        check(b - a < d - c, f"windings end at {a, b, c, d} s")


def test_arm():
    """Friction heats; energy without a source is of order dt."""
    for (*_, coarse), (*rows, fine) in said_by("arm", ["1e-3"], ["1e-4"]):
        equal("modes of the arm", " ".join(row[2] for row in rows), "stick+ "
              "stick- stick+ slip+ stick+ slip- stick+ slip+ stick+")
        heat, less, drift = map(float, fine[2:])
        check(heat > 0 and 5 * abs(less) < abs(float(coarse[3])) < 2e-5
              and drift < 1e-9, f"the arm ends with {coarse}, {fine}")
