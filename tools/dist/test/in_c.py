"""The two files and the prepared scene, in C and in C++."""
import re

from harness import (DIST, REALS, ROOT, STRICT, ends_at, equal, folder, need,
                     run)

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


def scene():
    """The header of one scene: without a warning, the golden hash of the scene,
    called from C++; it stands beside twofold.h in one program."""
    place = folder("scene")
    golden = (ROOT / "tests/golden/golden.inc").read_text()
    hashes = re.search(r'"chaos", TF_RULE_PERSIST, MOREAU,\s*'
                       r"0x(\w+)u, 0x(\w+)u", golden).groups()
    need("g++", "g++")
    for tool, package, options in COMPILERS:
        need(tool, package)
        for want, (real, define) in zip(hashes, REALS.items()):
            code, program = place / f"{real}.o", place / real
            run(tool, *options, *STRICT, *PLAIN, *define, "-I", C, "-c",
                TEST / "scene_code.c", "-o", code)
            run("g++", "-std=c++11", *STRICT, *PLAIN, *define, "-I", C,
                TEST / "scene.cpp", code, "-lm", "-o", program)
            equal(f"hash of {tool} {real}", run(program).split()[0], want)
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
