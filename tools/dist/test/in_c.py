"""The two files and the prepared scene, in C and in C++."""
import re

from harness import (BUILD, DIST, REALS, ROOT, STRICT, ends_at, equal, folder,
                     need, run)

C = DIST / "c"
TEST = ROOT / "tools/dist/test"
COMPILERS = (("gcc", "gcc", ["-std=c99"]), ("gcc", "gcc", ["-std=gnu17"]),
             ("clang", "clang", ["-std=c99"]),
             ("g++", "g++", ["-x", "c++", "-std=gnu++11"]),
             ("g++", "g++", ["-x", "c++", "-std=c++20"]),
             ("clang++", "clang", ["-x", "c++", "-std=c++20"]))
# Where nothing is said about contraction, on what this processor has.
PLAIN = ["-O2", "-march=native"]


def two_files():
    """Without a warning as C99, gnu17 and C++; the tests of the golden hashes
    pass with them, in both real types."""
    place = folder("two-files")
    for tool, package, options in COMPILERS:
        need(tool, package)
        for real, define in REALS.items():
            built = place / f"{real}.o"
            run(tool, *options, *STRICT, *PLAIN, *define, "-I", C, "-c",
                C / "twofold.c", "-o", built)
            if options[-1] not in ("-std=gnu17", "-std=gnu++11"):
                continue
            golden = place / "golden"
            run("gcc", "-std=gnu17", *PLAIN, *define, "-I", C, "-I",
                ROOT / "tests", "-I", ROOT / "tests/support",
                ROOT / "tests/golden/test_golden.c", built, "-lm", "-o",
                golden)
            run(golden)


def scene_hash(place, name, real, compiler):
    """What the header of a scene computes, its code by one compiler."""
    tool, package, options = compiler
    need(tool, package)
    header, code = f"{place}/twofold_{name}.h", place / f"{name}-{real}.o"
    run(tool, *options, *STRICT, *PLAIN, *REALS[real],
        f"-DTWOFOLD_{name.upper()}_CODE", "-c", header_code(place, name), "-o",
        code)
    program = place / f"{name}-{real}"
    run("g++", "-std=c++11", *STRICT, *PLAIN, *REALS[real], f"-DSCENE={name}",
        f'-DHEADER="{header}"', TEST / "scene.cpp", code, "-lm", "-o", program)
    return run(program).split()[0]


def header_code(place, name):
    """A source file that has nothing but the header."""
    source = place / f"{name}.c"
    source.write_text(f'#include "twofold_{name}.h"\n')
    return source


def scene():
    """The header of each scene: without a warning, the golden hash of the
    scene, called from C++; it stands beside twofold.h in one program."""
    place = folder("scene")
    need("g++", "g++")
    golden = (ROOT / "tests/golden/golden.inc").read_text()
    found = re.findall(r'"(\w+)", TF_RULE_PERSIST, MOREAU,\s*'
                       r"0x(\w+)u, 0x(\w+)u", golden)
    constants = [BUILD / real / "constants" for real in REALS]
    for name, *hashes in found:
        run(ROOT / "tools/dist/scene.py", name, *constants, place)
        compilers = COMPILERS if name == "chaos" else COMPILERS[:1]
        for compiler in compilers:
            for real, want in zip(REALS, hashes):
                equal(f"{name} by {compiler[0]} in {real}",
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


def cpp():
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


TESTS = {"two-files": two_files, "scene": scene, "cpp": cpp}
