#!/usr/bin/python3 -B
"""What is compiled keeps its promises: compiled.py CHECK [COMPILER], the name
of a function below."""
import importlib.util
import os
import re
import subprocess
import sys

from findings import (BUILD, DEFINES, FULL, MAKE, asked, build, checked, commit,
                      files_in, in_common, missing, need, passes, place_of,
                      quietly, version, wrong)
import driven

# Of the debugger's tables lines are enough, at half the time of compiling.
SANITIZERS = ("-g1 -fsanitize=address,undefined,float-cast-overflow "
              "-fno-sanitize-recover=all")
MEMORY = """unit/link/test_protocol unit/link/test_link unit/link/test_text
  unit/link/test_frame unit/scene/test_simulation unit/scene/test_scene
  unit/model/test_prepare unit/friction/test_select
  unit/friction/test_slip_residual unit/moreau/test_begin
  unit/moreau/test_ensemble law/test_located_report law/test_extremes
  regress/test_no_friction regress/test_degraded"""
ALLOWED = "sqrt sqrtf memcpy memset memmove memcmp"
STATIC = re.compile(r"\.(data|bss|tdata|tbss)|\*COM\*")


def tests_in(*rooms):
    return [str(path) for path in files_in(*rooms, pattern="test_*.c")]


def told(*command, **options):
    """What a command prints, which the log has too, and its code."""
    said, code = asked(*command, stderr=subprocess.STDOUT, **options)
    print(said, end="", flush=True)
    return said, code


def warnings(compiler):
    """Everything compiles without a warning. Those of gcc depend on what it
    optimises; clang's do not, which does so with FULL=yes only."""
    need(compiler, compiler)
    opt = "-O0" if compiler == "clang" and not FULL else "-O3"
    if not in_common(compiler, opt, "-k", "all"):
        wrong(f"warnings of {compiler}")
    objects = [*files_in(place_of(compiler, opt), pattern="*.o")]
    checked(f"{len(objects)} objects, both real types, {version(compiler)}")


def library(compiler, opt, real):
    path = place_of(compiler, opt) / real / "libtwofold.a"
    if not in_common(compiler, opt, path):
        wrong(f"{path} does not compile")
    return path


def symbols(path, which):
    said, _ = asked("nm", "-g", "-f", "posix", which, path)
    return {words[0] for words in map(str.split, said.splitlines())
            if len(words) > 1}


def freestanding():
    """The core needs nothing of a host but a square root and memory functions
    that every compiler may call: by gcc for size, and as other checks compile
    it; with FULL=yes with every optimisation."""
    need("nm", "binutils")
    need("clang", "clang")
    settings = [("gcc", "-Os"), ("gcc", "-O3"), ("clang", "-O0")]
    if FULL:
        settings += [("gcc", "-O0"), ("gcc", "-O2"), ("clang", "-O2"),
                     ("clang", "-Os")]
    libraries = [library(*setting, real) for setting in settings
                 for real in DEFINES]
    for path in libraries:
        for symbol in sorted(symbols(path, "-u") -
                             symbols(path, "--defined-only")):
            if symbol not in ALLOWED.split():
                wrong(f"{path} needs {symbol}")
    checked(f"{len(libraries)} libraries need nothing beyond: {ALLOWED}")


def data():
    """The core has no mutable static data: .data, .bss and common symbols are
    empty. Tables of pointers to constants are in .data.rel.ro, which is
    constant after relocation. And every global symbol carries its real type, so
    that builds for double and for float cannot be linked by mistake."""
    need("objdump", "binutils")
    for real, suffix in ("double", "_f64"), ("float", "_f32"):
        path = library("gcc", "-O3", real)
        for line in asked("objdump", "-t", path)[0].splitlines():
            *words, name = line.split() or [""]
            section = next(filter(STATIC.match, words[1:]), name)
            if section != name and not section.startswith(".data.rel.ro"):
                wrong(f"{path}: {name} is in {section}")
        names = symbols(path, "--defined-only")
        for name in sorted(names):
            if not name.endswith(suffix):
                wrong(f"{path}: {name} is without {suffix}")
        if not names:
            wrong(f"{path} has no symbols")
    checked("no byte of static data can change, every symbol carries its real "
            "type")


def bits():
    """Same bits: the golden trajectory hashes hold under compilers and
    optimisations (three settings, of which check `clang` has compiled one; with
    FULL=yes twelve), and `twofold run` writes the same bytes."""
    need("gcc", "gcc")
    need("clang", "clang")
    native = "-O3 -march=native"
    settings = [("gcc", "-O0"), ("gcc", native), ("clang", "-O0")]
    if FULL:
        settings = [(compiler, opt) for compiler in ("gcc", "clang")
                    for opt in ("-O0", "-O1", "-O2", "-O3", "-Os", native)]
    tests = tests_in("tests/golden")
    if not tests:
        wrong("there are no tests/golden/*.c")
    first = {}
    for setting in settings:
        programs = {real: place_of(*setting) / real / "twofold"
                    for real in DEFINES}
        if not in_common(*setting, f"TESTS={' '.join(tests)}", "test",
                         *programs.values()):
            wrong(f"{setting} gives other hashes, or no program")
            continue
        for real, program in programs.items():
            csv = program.parent.with_suffix(".csv")
            # In float some steps stand still and say so, which is code 5.
            said, code = asked(program, "run", "chaos", "--t-end", 10,
                               "--every", 100, "--out", csv,
                               stderr=subprocess.STDOUT)
            if code and (real, code) != ("float", 5):
                wrong(f"{said}\n{setting} {real}: twofold run failed")
            elif first.setdefault(real, csv.read_bytes()) != csv.read_bytes():
                wrong(f"{setting} {real}: other bytes in the CSV")
    checked(f"golden hashes and the CSV of chaos, {len(settings)} compiler "
            "settings, both real types")


def sanitized(compiler, *arguments):
    """make under the sanitizers; one of the checks that share a folder at a
    time."""
    place = BUILD / f"sanitize-{compiler}"
    return told("flock", f"{place}.lock", MAKE, "--no-print-directory",
                f"CC={compiler}", "OPT=-O1", f"BUILD={place}",
                f"EXTRA={SANITIZERS} -fno-omit-frame-pointer", *arguments)


def sanitize(compiler):
    """Tests under the address and undefined-behaviour sanitizers. With gcc
    those of units and the line in double, with clang laws, golden and regress
    in float; with FULL=yes all tests in both."""
    need(compiler, compiler)
    empty = BUILD / f"empty-{compiler}.c"
    empty.write_text("int main(void) { return 0; }\n")
    if not quietly(compiler, *SANITIZERS.split(), empty, "-o",
                   empty.with_suffix("")):
        missing(f"the sanitizers of {compiler}", "libclang-rt-dev")
    # What is left of a stack is watched under one of them: with gcc it doubles
    # the time of the tests.
    if compiler == "clang":
        os.environ["ASAN_OPTIONS"] = "detect_stack_use_after_return=1"
    few, real = [], ""
    if not FULL:
        rooms, real = {
            "gcc": (("tests/unit", "tests/line"), "double"),
            "clang": (("tests/law", "tests/golden", "tests/regress"), "float"),
        }[compiler]
        # None starts the command line, which would be compiled for nothing.
        few = [f"VARIANTS={real}", "TWOFOLD=",
               f"TESTS={' '.join(tests_in(*rooms))}"]
    said, code = sanitized(compiler, *few, "test")
    if code:
        wrong(f"tests fail under the sanitizers of {compiler}")
    checked(f"{said.splitlines()[-1]}; address and undefined behaviour"
            f"{real and ', '}{real}")


def memory():
    """No decision by a value that was never set, which the other sanitizers do
    not see: the tests of MEMORY in double under the memory sanitizer of clang,
    of the line, the session, the step and what is beside it; with FULL=yes all
    programs in both real types."""
    need("clang", "clang")
    place, tests = BUILD / "memory", [f"tests/{name}.c" for name in
                                      MEMORY.split()]
    programs = [f"{place}/{real}/{test[:-2]}"
                for real in (DEFINES if FULL else ["double"])
                for test in (tests_in("tests") if FULL else tests)]
    if not build("CC=clang", "OPT=-O1", f"BUILD={place}", "EXTRA=-g1 "
                 "-fsanitize=memory -fno-sanitize-recover=all", *programs):
        wrong("tests do not compile for the memory sanitizer")
    said, code = told("tests/run", *programs)
    if code:
        wrong("tests fail under the memory sanitizer")
    checked(f"{said.splitlines()[-1]}; {len(programs)} programs")


def coverage():
    """Lines and branches of src/ that the tests of the host reach, both real
    types together: what no test reaches is not known to work, so it is wrong.
    The parts of a step are functions here, so that each counts once: the
    attribute that makes them one (kernel.h) is renamed to one without effect.

    Programs, not the command line: whoever breaks the core should hear it from
    a test that names what broke. Those of units in double, of analysis and laws
    in float are enough, and without some that take long."""
    need("gcov", "gcc")
    need("gcovr", "gcovr")
    place = BUILD / "coverage"
    quietly("rm", "-rf", place)
    programs = [f"{place}/{real}/{test[:-2]}" for real, rooms in (
        ("double", ("unit", "line", "regress")),
        ("float", ("law", "golden", "regress", "unit/analysis")))
        for test in tests_in(*(f"tests/{room}" for room in rooms))
        if not re.search("/test_(branch|convergence|degraded|signs).c", test)]
    if not build("CC=gcc", f"BUILD={place}", "OPT=-O0", "TEST_OPT=",
                 f"TESTS={' '.join(tests_in('tests'))}", "EXTRA=--coverage "
                 "-Dalways_inline=unused -fkeep-inline-functions", *programs):
        wrong("tests do not compile for coverage")
    passes("tests fail", "tests/run", *programs)
    if told("grep", "-rnE", "GCOVR?_EXCL|LCOV_EXCL", "src")[0]:
        wrong("lines are left out: no comment excuses a line")
    for source in files_in("src", pattern="*.c"):
        if not (place / "double" / source.with_suffix(".gcno")).exists():
            wrong(f"{source}: is compiled for no test")
    # Headers are also reached from within a test. An object that no program was
    # linked with counts as not reached. What gcov says is read once.
    counts = place / "counts.json"
    said = ""
    for words in (
            ["-j", driven.processors(), "--filter", "src/", "--json", counts,
             place], ["-a", counts],
            ["-a", counts, "--branches", "--print-summary",
             "--fail-under-line", 100, "--fail-under-branch", 100]):
        said, code = told("gcovr", *words)
        if code:
            wrong("a line or a branch is reached by no test")
    counted = re.findall(r"^(lines|branches): .*\((\d+) out of (\d+)\)", said,
                         re.M)
    checked(", ".join(f"{some} of {all_} {what}"
                      for what, some, all_ in counted) + " of src/")


def figures():
    """Every figure, drawn on small data: a panel without marks is an error."""
    for module, package in (("matplotlib", "python3-matplotlib"),
                            ("PIL", "python3-pil")):
        if not importlib.util.find_spec(module):
            missing(module, package)
    place = place_of("gcc", "-O3")
    program, made = place / "double/twofold", place / "futures.made"
    if not in_common("gcc", "-O3", program):
        wrong("the command line does not build")
    passes("a figure cannot be drawn", "env", "QUICK=1", f"BUILD={place}",
           f"TWOFOLD={program}", "tools/run", "study", "figures")
    passes("no moving picture", "tools/study/futures.py", program, made)
    passes("docs/futures.svg is of another core: make keep-futures", "cmp",
           made, "docs/futures.svg")
    checked("nine figures on small data, and the moving picture")


def hostile():
    """HOSTILE_FRAMES hostile frames (1e5; with FULL=yes 1e6) against the
    running firmware of the host port, in both real types and under the
    sanitizers of gcc: it goes on, and sends nothing that is not whole and
    finite. Bounded in count and time; the line is a pseudo-terminal of this
    machine."""
    frames = os.environ.setdefault("HOSTILE_FRAMES",
                                   "1000000" if FULL else "100000")
    place, test = BUILD / "sanitize-gcc", "tests/line/test_hostile.py"
    if sanitized("gcc", *(f"line-{real}" for real in DEFINES))[1]:
        wrong("the firmware does not build")
    runs = [asked("timeout", "-k", 5, 800, test, env={
        **os.environ, **seed, "TWOFOLD": f"{place}/double/twofold"})
        for seed in ({}, {"SEED": "2"})]
    for said, code in runs:
        if code:
            wrong(f"the firmware did not stand {frames} hostile frames:"
                  f"\n{said}")
    checked("; ".join(re.findall("^# (.*)", runs[1][0], re.M)))


def fuzz():
    """Every fuzz target from its corpus, SECONDS_EACH s (5; with FULL=yes 30).
    The target `machine` in double, with FULL=yes also in float."""
    need("clang", "clang")
    seconds = os.environ.get("SECONDS_EACH") or (30 if FULL else 5)
    if not build("-s", f"BUILD={BUILD}/fuzz", "fuzz-clang"):
        missing("libFuzzer of clang", "libclang-rt-dev")
    said, code = told(MAKE, "-s", "--no-print-directory",
                      f"BUILD={BUILD}/fuzz", f"SECONDS={seconds}",
                      f"FUZZ_REALS=double{' float' * FULL}", "fuzz")
    if code:
        wrong("a fuzz target found something")
    runs = sum(map(int, re.findall(r"^\S+ +(\d+) .* ok$", said, re.M)))
    checked(f"{said.splitlines()[-1]}; {runs} runs, {seconds} s a target")


def mutation():
    """Wrong changes of src/ that only a hash noticed once (make mutation): each
    has a test that notices it. With FULL=yes also a hundred others in the order
    of the commit, of which more survivors than a quarter are not chance."""
    need("gcc", "gcc")
    seed = os.environ.get("MUTATION_SEED") or commit()
    said, code = told("tools/run", "mutation", env={
        **os.environ, "CC": "gcc", "SAMPLE": "100", "BUILD": str(BUILD),
        "SEED": "kept" + f" {seed}" * FULL})
    if code:
        wrong(f"wrong changes of src/ survive: SEED={seed}")
    checked("; ".join(re.findall("^(.* changes noticed: .*);.*$", said, re.M)))


globals()[sys.argv[1]](*sys.argv[2:])
