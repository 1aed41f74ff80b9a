#!/usr/bin/python3 -B
"""Programs that read sources find nothing wrong: sources.py CHECK, the name of
a function below."""
import json
import re
import shutil
import subprocess
import sys
from glob import glob
from pathlib import Path

from findings import (BUILD, DEFINES, FULL, asked, checked, files_in, commit,
                      missing, need, passes, version, wrong)
import driven

CPPCHECK = ("cppcheck", "--quiet", "--std=c99", "-Iinclude", "-Isrc",
            "--suppress=missingIncludeSystem")
# Where these are defined cppcheck reads all again, and only lines of rounding.h
# and real.h differ: it does so for one file that includes them.
ONCE = [f"-U{name}" for name in "_MSC_VER __GNUC__ __clang__ TF_API_STATIC "
        "FLT_EVAL_METHOD __FLT_EVAL_METHOD__".split()]
DIFFERS = "src/num/kernel.c"
DEVIATIONS = Path("tools/verify/check/misra.deviations")


def layout():
    """Every C file is as .clang-format lays it out."""
    need("clang-format", "clang-format")
    files = [*files_in("include", "src", "port", "tests", "tools",
                       pattern="*.[ch]")]
    passes("to format: clang-format -i FILE", "clang-format", "--dry-run",
           "-Werror", *files)
    checked(f"{len(files)} files, {version('clang-format')}")


def scripts(interpreter, suffix=None):
    for path in files_in(".ci", "port", "tests", "tools"):
        with path.open("rb") as file:
            first = file.readline(80).decode("latin-1").rstrip()
        if path.suffix == suffix or re.match(rf"#!.*\b{interpreter}", first):
            yield path


def shell():
    """Of shell scripts."""
    need("shellcheck", "shellcheck")
    files = [*scripts("(ba)?sh$")]
    passes("shellcheck", "shellcheck", "-x", "-P", "SCRIPTDIR", *files)
    checked(f"{len(files)} scripts")


def python():
    """No name is unknown, defined twice or imported in vain; the types of the
    package agree."""
    need("pyflakes3", "pyflakes3")
    files = [*scripts(r"python3?\b", ".py")]
    passes("pyflakes3", "pyflakes3", *files)
    need("mypy", "mypy")
    passes("mypy", "mypy", "--ignore-missing-imports", "--cache-dir",
           BUILD / "mypy", "tools/package/dist/python/twofold")
    checked(f"{len(files)} programs and modules")


def cppcheck():
    """The core in both real types, and the tools. variableScope is a matter of
    taste: one line declares what belongs together.

    Programs of the boards hold the whole core in one file, where names that
    were local to one of its files shadow those of another; clang-tidy reads
    them. So do the tests of a firmware. Of a struct whose members are read
    through a pointer in another struct it says that none is used. Quadruple
    constants are no C of its own."""
    need("cppcheck", "cppcheck")
    for what, options in (
            ("core in double", f"-UTF_REAL_FLOAT {' '.join(ONCE)} src"),
            ("with other compilers", f"-UTF_REAL_FLOAT {DIFFERS}"),
            ("core in float", "-DTF_REAL_FLOAT=1 src"),
            ("tools", "-UTF_REAL_FLOAT -UREF_BITS -D__x86_64__ "
             "-itools/verify/cost/board.c tools"),
            ("tests", "-UTF_REAL_FLOAT -UREF_BITS "
             "--suppress=unusedStructMember -Itests -Itests/support "
             "-Itests/reference -itests/target "
             "-itests/support/firmware_start.c -itests/line/test_firmware.c "
             "tests")):
        passes(what, *CPPCHECK, "--inline-suppr", "--error-exitcode=1",
               "--enable=warning,style,performance,portability", "-Itools",
               "--suppress=variableScope", *options.split())
    checked(f"src in both real types, tools, tests; {version('cppcheck')}")


def misra_says(addon, real):
    """The places and rules that are violated. The addon's two stages are
    started here, the one for a file and the one for all files together, because
    cppcheck goes on without a word where a stage of an addon ends early."""
    room = BUILD / "misra"
    shutil.rmtree(room, ignore_errors=True)
    for place in "src", "include":
        shutil.copytree(place, room / place)
    for files in [*ONCE, "src"], [DIFFERS]:
        passes("the dump", *CPPCHECK, DEFINES[real], "--dump", *files, cwd=room)
    files = sorted(path.relative_to(room) for path in room.rglob("src/*/*.c"))

    def stage(*parts):
        said, code = asked(sys.executable, addon, "--cli", *parts, cwd=room)
        if code:
            wrong(f"the addon ends with code {code}: {parts[0]}")
        return map(json.loads, said.splitlines())

    found = [one for stage_of_one in driven.side_by_side(
        lambda file: [*stage(f"{file}.dump")], files) for one in stage_of_one]
    shared = [file.with_suffix(".c.ctu-info") for file in files]
    for path in shared:
        if not (room / path).exists():
            wrong(f"the addon did not end: {path} is missing")
    of_all = [*stage(*filter(lambda path: (room / path).exists(), shared))]
    if not found or not of_all:
        wrong("a stage of the addon found nothing, which it never does")
    return {(f"{one['file']}:{one['linenr']}", one["errorId"].split("-")[1])
            for one in found + of_all}


def misra():
    """MISRA C:2012 over src/, by cppcheck's addon, in double, with FULL=yes in
    both real types. Every rule that is deviated from stands in misra.deviations
    with its reason; what it does not name is wrong, and so is a rule there that
    nothing violates."""
    need("cppcheck", "cppcheck")
    addons = glob("/usr/lib/*/cppcheck/addons/misra.py") + glob(
        "/usr/*/cppcheck/addons/misra.py")
    if not addons:
        missing("the addon misra.py of cppcheck", "cppcheck")
    rules = dict((*line.split(maxsplit=1), "")[:2] for line in
                 DEVIATIONS.read_text("utf-8").splitlines()
                 if line.strip() and line[0] != "#")
    found = set().union(*(misra_says(addons[0], real)
                          for real in (DEFINES if FULL else ["double"])))
    for place, name in sorted(found):
        if name not in rules:
            wrong(f"{place}: violates rule {name}, which is no deviation")
    for name, reason in rules.items():
        if not reason:
            wrong(f"{DEVIATIONS}: rule {name} has no reason")
        if name not in {rule for _, rule in found}:
            wrong(f"{DEVIATIONS}: nothing violates rule {name}")
    checked(f"src in double{' and float' * FULL}; {len(rules)} rules deviated "
            f"from, {len(found)} places")


def tidy():
    """As .clang-tidy says: the core in double, and of the core in float and of
    the other files an eighth, another one with each commit (with FULL=yes
    all)."""
    need("clang-tidy", "clang-tidy")

    def sample(files):
        return files if FULL else files[(commit() - 1) % 8::8]

    core, tools, tests, boards = ([str(path) for path in files_in(
        room, pattern="*.c")] for room in ("src", "tools", "tests",
                                           "tests/target"))
    # What Frama-C alone compiles is left out, what is for packages, whose
    # headers are not here (`make test-dist` compiles it), and what needs
    # constants. Programs of the boards are given a number of steps, and a rate.
    others = [
        ("tools", sample([file for file in tools if not re.match(
            "tools/(verify/(eva|cost/board)|package/dist)", file)]),
         "-Itools -DFINER_BITS=64"),
        ("tests", sample([file for file in tests if file not in boards]),
         "-Itests -Itests/support -Itests/reference -Isrc"),
        ("a program of the boards", sample(boards),
         "-Iport -DSTEPS=1000 -DRATE=1000 -DUPLINK -DFAULT=fault_bus")]
    kinds = [("core in double", core, ""),
             ("core in float", sample(core), "-DTF_REAL_FLOAT"), *others]

    def read(what, file, flags):
        said, code = asked("clang-tidy", "--quiet", file, "--", "-std=c99",
                           "-Iinclude", *flags.split(),
                           stderr=subprocess.DEVNULL)
        print(said, end="")
        if code:
            wrong(f"clang-tidy: {file}: {what}")

    driven.side_by_side(lambda one: read(*one), [
        (what, file, flags) for what, files, flags in kinds for file in files])
    checked(f"{len(core) + sum(len(files) for _, files, _ in others)} files, "
            f"the core in double{' and float' * FULL}")


globals()[sys.argv[1]](*sys.argv[2:])
