#!/usr/bin/python3 -B
"""Small wrong changes of src/, one at a time, for the tests to notice:

    mutation.py               the first SAMPLE changes in the order of SEED (0:
                              every change; default 60 and 1)
    mutation.py FILE NUMBER   one change: which test notices it

The order is a hash of file, line and seed (changes.py): a sample stays the same
when other lines change.

The core is a shared library under test programs that are linked once. A test
is asked if it contains the part that changed: those first that noticed a change
of the same file before, then the quick ones, in double and then in float.
A change that no test notices survives, and fails the run unless `equivalent`
beside this script gives its reason; a reason that fits no change fails it too.

Environment: SAMPLE, SEED, SURVIVORS (how many may be, default 0), JOBS, MAKE,
CC (gcc), BUILD; with AGAIN=1 a run that was stopped goes on, and what survived
is tried again. BUILD/mutation/log has a line for every change, BUILD/mutation/
REPORT a table by file and what survived.
"""
from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from collections import Counter
from pathlib import Path
from typing import Iterable, Iterator, NamedTuple, Optional

from scipy import stats

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import driven
from changes import Change, all_changes

EQUIVALENT = Path("tools/verify/mutation/equivalent")
CC = os.environ.get("CC") or "gcc"
PLACE = Path(os.environ.get("BUILD") or "build", "mutation")
BASE, PLAIN, LOG = PLACE / "base", PLACE / "plain", PLACE / "log"
REALS = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
# They start other programs.
STARTERS = ("test_device", "test_line", "test_hostile")
SLOW = {f"test_{name}" for name in (
    "extremes", "ensemble", "friction", "reference", "branch", "frame",
    "physics_numbers")}
# Whatever a change does, it cannot do much: bytes of output, of memory.
LIMITS = ("--fsize=102400000", "--as=4096000000")
RESULTS = "noticed", "survived", "same", "invalid"
lock = threading.Lock()
took: dict[str, int] = {}  # milliseconds of the processor, without a change
saw: dict[str, list[str]] = {}  # the tests that noticed a change of a file


# What changes are tried on.

class Test(NamedTuple):
    """A test program in one real type."""
    real: str
    source: Path
    needs: frozenset[str]  # stems of files of the core

    @property
    def name(self) -> str:
        return f"{self.real}-{self.source.stem}"


def compiled(real: str, file: Path, root: Path, target: Path) -> bool:
    """Compiles a file of the project, or of a changed copy of it in `root`, for
    a shared library. What goes beyond an array ends the program, as the checks
    with sanitizers would report, and what is read before it is written is not
    0, as memcheck would."""
    flags = ["-ffreestanding"] if file.parts[0] == "src" else [
        f"-I{root}/{place}" for place in (
            "tests", "tests/support", "tests/reference", "src")]
    return subprocess.run(
        [CC, "-std=c99", "-O1", "-ffp-contract=off", "-fno-math-errno",
         "-fPIC", "-w", REALS[real], "-fsanitize=bounds",
         "-fsanitize=bounds-strict", "-fsanitize-undefined-trap-on-error",
         "-ftrivial-auto-var-init=pattern", *flags, f"-I{root}/include",
         "-c", root / file, "-o", target],
        stderr=subprocess.DEVNULL, check=False).returncode == 0


def linked(target: Path, *parts: object) -> bool:
    return subprocess.run([CC, *map(str, parts), "-o", str(target)],
                          stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def must(done: bool, what: object) -> None:
    if not done:
        sys.exit(f"mutation: {what} does not compile")


@functools.lru_cache(maxsize=None)
def made_of(file: Path) -> frozenset[str]:
    """What an object was made of, by its file of dependencies."""
    text = (BASE / "double" / file).with_suffix(".d").read_text("utf-8")
    words = re.sub(r"\S*:|\\\n", " ", text).split()
    return frozenset(os.path.relpath(os.path.realpath(word)) for word in words
                     if re.match("(src|port|include|tests)/", word))


def core() -> list[Path]:
    return sorted(Path().glob("src/*/*.c"))


def prepare() -> list[Test]:
    """Builds all of it."""
    sources = sorted(path for path in Path("tests").rglob("test_*.c")
                     if path.stem not in STARTERS)
    print("mutation: building the tests ...", file=sys.stderr)
    log = PLACE / "build.log"
    with open(log, "w", encoding="utf-8") as said:
        if subprocess.run(
                [*(os.environ.get("MAKE") or "make").split(), "-s", f"CC={CC}",
                 f"BUILD={BASE}", "OPT=-O1", "EXTRA=-fPIC",
                 *(str(BASE / real / source.with_suffix(""))
                   for real in REALS for source in sources)],
                stdout=said, stderr=said, check=False).returncode:
            sys.exit("\n".join(log.read_text("utf-8").splitlines()[-20:]))
    tests = []
    for real in REALS:
        room, work = BASE / real, PLAIN / real
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        for file in core():
            must(compiled(real, file, Path("."), work / f"{file.stem}.o"), file)
        must(linked(work / "libtwofold.so", "-shared", *work.glob("*.o")), real)
        # What the replay of the corpus takes from the command line.
        subprocess.run(["ar", "rcs", work / "libparts.a",
                        *room.glob("tools/verify/fuzz/*.o"),
                        *room.glob("tools/cli/**/*.o")], check=True)
        tests += [linked_test(real, source) for source in sources]
    return tests


def linked_test(real: str, source: Path) -> Test:
    """Links a test, and looks which parts of the core it needs."""
    room, work = BASE / real, PLAIN / real
    parts = [room / source.with_suffix(".o"), room / "libsupport.a",
             work / "libparts.a"]
    must(linked(PLAIN / f"{real}-{source.stem}", *parts, f"-L{work}",
                "-ltwofold", "-lm"), source)
    must(linked(PLAIN / "static", *parts, room / "libtwofold.a", "-lm",
                f"-Wl,-Map={PLAIN}/map"), source)
    needs = re.findall(r"libtwofold\.a\((\w+)\.o\)",
                       (PLAIN / "map").read_text("utf-8"))
    return Test(real, source, frozenset(needs))


# A change, tried: which test notices it.

def limited(program: Path, seconds: int, out: Path,
            core_at: Path) -> tuple[int, int]:
    """Runs a test within its limits; its exit code (137 where it was killed)
    and the milliseconds of the processor."""
    with open(out, "wb") as said:
        # pylint: disable=consider-using-with
        child = subprocess.Popen(
            ["prlimit", *LIMITS, f"--cpu={seconds}", "timeout", "-k", "1",
             "3600", str(program)], stdin=subprocess.DEVNULL, stdout=said,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "TAP_BAIL": "1", "LD_LIBRARY_PATH": core_at})
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, int(1000 * usage.ru_utime)


class Trial:
    """One change of a file."""

    def __init__(self, change: Change, tests: list[Test], work: Path) -> None:
        self.change, self.tests, self.work = change, tests, work
        self.changed = {file.stem for file in core()
                        if change.file in made_of(file)}
        self.same = False

    def compile(self, real: str) -> bool:
        """Makes what the changed file is a part of, and links."""
        objects, place = [], self.work / real
        place.mkdir()
        for file in core():
            target = PLAIN / real / f"{file.stem}.o"
            if file.stem in self.changed:
                target = place / f"{file.stem}.o"
                if not compiled(real, file, self.work, target):
                    return False
            objects.append(target)
        return linked(place / "libtwofold.so", "-shared", *objects)

    def is_part_of(self, test: Test) -> bool:
        """Whether a test has the changed file in it, a header."""
        return self.change.file in made_of(test.source)

    def concerns(self, test: Test) -> bool:
        return self.is_part_of(test) or \
            not self.same and bool(test.needs & self.changed)

    def program(self, test: Test) -> Optional[Path]:
        """A test that has the changed file in it is made again."""
        if not self.is_part_of(test):
            return PLAIN / test.name
        target = self.work / "test"
        done = compiled(test.real, test.source, self.work,
                        self.work / "test.o") and linked(
            target, self.work / "test.o",
            BASE / test.real / "libsupport.a",
            f"-L{self.work}/{test.real}", "-ltwofold", "-lm")
        return target if done else None

    def asked(self, program: Path, at: Path, seconds: int) -> tuple[int, int]:
        return limited(program, seconds, self.work / "tap", at)

    def must_pass(self, test: Test) -> None:
        """A test that failed passes without a change, or the run ends."""
        if test.name in took:
            return
        code, time = self.asked(PLAIN / test.name, PLAIN / test.real,
                                200)
        if code != 0:
            sys.exit(f"mutation: {test.name} fails without a change")
        took[test.name] = time

    def order(self, test: Test) -> float:
        """Who noticed a change of this file before is asked first, then who is
        quick, or, where that is not known yet, who needs few parts; those that
        are known to be slow come last."""
        remembered = saw.get(self.change.file, [])
        if test.name in remembered:
            return remembered.index(test.name) - 1e6
        return took.get(test.name, (
            1e5 if test.source.stem in SLOW else 20) * (1 + len(test.needs)))

    def noticed(self, real: str) -> str:
        """The test of a real type that notices the change, or none."""
        for test in sorted((test for test in self.tests if test.real == real),
                           key=self.order):
            if not self.concerns(test):
                continue
            program = self.program(test)
            if program is None:
                return test.name
            # Many times what it took; what is enough, where that is not known.
            limit = took[test.name] // 100 + 5 if test.name in took else \
                200 if test.source.stem in SLOW else 20
            code, time = self.asked(program, self.work / real, limit)
            if code == 0:
                took.setdefault(test.name, time)
                continue
            self.must_pass(test)
            with lock:
                first = saw.get(self.change.file, [])
                saw[self.change.file] = [test.name] + [
                    name for name in first if name != test.name][:20]
            return test.name
        return ""

    def verdict(self) -> str:
        same_in_both = True
        for real in REALS:
            if not self.compile(real):
                return "invalid -"
            self.same = (self.work / real / "libtwofold.so").read_bytes() == (
                PLAIN / real / "libtwofold.so").read_bytes()
            same_in_both &= self.same
            name = self.noticed(real)
            if name:
                return f"noticed {name}"
        return "same -" if same_in_both else "survived -"


def tried(change: Change, tests: list[Test]) -> None:
    """Writes to the log what became of a change:
    noticed TEST | survived - | same - | invalid -  FILE NUMBER LINE COLUMN TEXT
    """
    with tempfile.TemporaryDirectory(dir=PLACE, prefix="work.") as name:
        work = Path(name)
        # Folders of the project, with links to its files.
        for part in ("src", "include", "port", "tests", "tools"):
            shutil.copytree(part, work / part, copy_function=lambda file, link:
                            os.symlink(os.path.abspath(file), link))
        (work / change.file).unlink()
        (work / change.file).write_text(change.make(), "utf-8")
        line = f"{Trial(change, tests, work).verdict()} {change}"
    with lock:
        with open(LOG, "a", encoding="utf-8") as file:
            print(line, file=file)
        count = len(LOG.read_text("utf-8").splitlines())
    if line.startswith("survived") or count % 25 == 0:
        print(f"{count}: {line}", file=sys.stderr)


# The run.

def die(text: str, lines: Iterable[str] = ()) -> None:
    for line in lines:
        print(line)
    print(f"mutation: {text}", file=sys.stderr)
    sys.exit(2)


def number(name: str, default: str) -> int:
    text = os.environ.get(name) or default
    if not text.isdigit():
        die(f"{name}={text}: a whole number")
    return int(text)


def excused(changes: list[Change]) -> set[str]:
    """Excused changes, as "FILE: TEXT", each of which fits one change; lines
    that begin with a blank say why."""
    found, waiting = set(), ""
    for line in [*EQUIVALENT.read_text("utf-8").splitlines(), ""]:
        if line.startswith("src/"):
            waiting = line
            found.add(line)
        elif line.startswith("  "):
            waiting = ""
        elif waiting:
            die("a change is excused without a reason", [waiting])
    fits = Counter(change.excuse() for change in changes)
    for lines, what in (
            ([text for text in found if fits[text] > 1],
             f"these lines of {EQUIVALENT} fit several changes each"),
            ([text for text in found if not fits[text]],
             f"no change fits these lines of {EQUIVALENT}")):
        if lines:
            die(what, sorted(lines))
    return found


def known(sample: list[Change]) -> set[str]:
    """What a former run has found out stays true where tests are only added.
    Leaves the log with that, and returns the changes that are in it."""
    found = {}
    if os.environ.get("AGAIN") and LOG.exists():
        for line in LOG.read_text("utf-8").splitlines():
            verdict, _, change = line.split(" ", 2)
            if verdict != "survived":
                found[change] = line
    names = [str(change) for change in sample]
    LOG.write_text("".join(found[name] + "\n" for name in names
                           if name in found), "utf-8")
    return set(found)


def report(log: list[list[str]]) -> Iterator[str]:
    """Files and results, what survived, and a sum; "same" are changes that
    compile to the same bytes, "invalid" those that do not compile. The share
    that is noticed has Wilson's interval."""
    count = Counter((row[2], row[0]) for row in log)
    yield f"{'file':<26}" + "".join(f" {one:>8}" for one in RESULTS)
    for name in sorted({row[2] for row in log}):
        yield f"{name:<26}" + "".join(f" {count[name, one]:8}"
                                      for one in RESULTS)
    yield ""
    for row in sorted((row for row in log if row[0] == "survived"),
                      key=lambda row: (row[2], int(row[4]), int(row[5]))):
        yield f"{row[2]}:{row[4]}:{row[5]}: {row[6]}"
    of = Counter(row[0] for row in log)
    tries = of["noticed"] + of["survived"]
    share = "none was tried"
    if tries:
        ends = stats.binomtest(of["noticed"], tries).proportion_ci(
            method="wilson")
        share = (f"{100 * of['noticed'] / tries:.1f} % (95 % interval "
                 f"{100 * ends.low:.1f} to {100 * ends.high:.1f})")
    yield (f"{of['noticed']} of {tries} changes noticed: {share}; "
           f"{of['same']} compile to the same, {of['invalid']} not at all")


def main() -> None:
    driven.begin(__file__)
    PLACE.mkdir(parents=True, exist_ok=True)
    size, seed = number("SAMPLE", "60"), number("SEED", "1")
    everything = all_changes(seed, sorted(Path().glob("src/*/*.[ch]")))
    let_off = excused(everything)
    one = sys.argv[1:3]
    sample = [change for change in everything if (
        [change.file, str(change.number)] == one if one else
        change.excuse() not in let_off)]
    if size and not one:
        sample = sample[:size]
    if not sample:
        die("there is no such change")
    tests = prepare()
    done = known(sample)
    driven.side_by_side(lambda change: tried(change, tests), [
        change for change in sample if str(change) not in done])
    log = [line.split(" ", 6) for line in
           LOG.read_text("utf-8").splitlines()]
    text = "\n".join([*report(log), f"seed {seed}, of {len(everything)} changes"
                      f" in all, {len(let_off)} of them excused"])
    (PLACE / "REPORT").write_text(text + "\n", "utf-8")
    print(text)
    verdicts = Counter(row[0] for row in log)
    sys.exit(verdicts["survived"] > number("SURVIVORS", "0"))


if __name__ == "__main__":
    main()
