#!/usr/bin/python3 -B
"""Small wrong changes of src/, one at a time, for the tests to notice:

    mutation.py               the first SAMPLE changes in the order of SEED (0:
                              every change; default 60 and 1)
    mutation.py FILE NUMBER   one change: which test notices it

Changed are comparisons, arithmetic and logical operators, signs, literals,
truth values and strings, where the layout of clang-format shows which operator
is binary (blanks around it), unary or a pointer. Comments, characters,
directives, case labels, assertions and sizes of arrays are left. The order is a
hash of file, line and seed: a sample stays the same when other lines change.

The core is a shared library under test programs that are linked once. A test
is asked if it contains the part that changed: those first that noticed a change
of the same file before, then those that need few parts, in double and then in
float. Those with hashes are not asked: they say that something differs, not
what is wrong. A change that no test notices survives. More survivors than a
quarter fail the run: some changes make no difference. SEED=kept has the changes
of `kept`, each for its own test, of which none may survive.

Environment: SAMPLE, SEED, JOBS, MAKE, CC (gcc), BUILD. BUILD/mutation/REPORT
has all changes and a sum. SEED='kept 303' tries one order after the other on
the same tests.
"""
from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Iterator, NamedTuple

from scipy import stats

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import driven

KEPT = Path("tools/verify/mutation/kept")
KEPT_TEXT = re.compile("(.*){([^{}]*) -> ([^{}]*)}(.*)")
CC = os.environ.get("CC") or "gcc"
PLACE = Path(os.environ.get("BUILD") or "build", "mutation")
BASE, PLAIN = PLACE / "base", PLACE / "plain"
REALS = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
SLOW = {f"test_{name}" for name in (
    "extremes", "ensemble", "friction", "reference", "branch", "frame",
    "physics_numbers")}
LONG, SHORT = 200, 20  # s of the processor that a test may take, if slow or not
saw: dict[str, list[str]] = {}  # the tests that noticed a change of a file


# Changes.

# Operators that stand between blanks, and what each may become.
BINARY = {
    "<=": "< >", ">=": "> <", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "|=": "&=", "&=": "|=",
    "<<": ">>", ">>": "<<", "<": "<= >=", ">": ">= <=", "+": "-", "-": "+",
    "*": "/", "/": "*", "|": "&", "&": "|", "^": "|", "%": "*"}
OPPOSITE = {"true": "false", "false": "true", "++": "--", "--": "++"}
TOKEN = re.compile(
    # Directives but the value of a macro, labels, and what only declares.
    r"^[ ]*(?:\#(?!define[ ])|case[ ]|_Static_assert).* | ^\#define[ ]\w+"
    r"| //[^\n]* | /\*[\s\S]*?\*/ | '(?:\\.|[^\\'])*' | ->"
    r'| (?P<string>"(?:\\.|[^\\"])*")'
    r"| (?P<number>0x(?:[\w.]|(?<=[pP])[-+])* | [0-9](?:[\w.]|(?<=[eE])[-+])*)"
    r"| (?P<word>\w+)"
    r"| (?P<array>\[[0-9][^]\n]*[]\n]?)"
    r"| (?<=[ \n])(?P<binary>" + "|".join(map(re.escape, BINARY)) +
    r")(?=[ \n])"
    r"| (?P<pair>\+\+|--)"
    r"| (?<=[ \n(\[!-])(?P<sign>[-!~])(?=[\w(])", re.X | re.M | re.A)
# Before the size of an array that is declared here: a name behind a type.
DECLARED = re.compile(r"(?<!\breturn)(?<=\w) \w+\Z", re.A)


def next_literal(number: str) -> str:
    """A whole literal becomes the next one, another twice as large, 0.0 1."""
    is_hex = number.startswith("0x")
    if not re.search("[.pP]" if is_hex else "[.eE]", number):
        digits = re.match(r"0x[\da-fA-F]+|\d+", number)[0]
        base = 16 if is_hex else 8 if re.match("0[0-7]", digits) else 10
        return f"{int(digits, base) + 1}{number[len(digits):]}"
    digits = re.match(r"0x[\da-fA-F.]+[pP][-+]?\d+|[\d.]+(?:[eE][-+]?\d+)?",
                      number)[0]
    value = float.fromhex(digits) if is_hex else float(digits)
    text = f"{2 * value if value > 0 else 1:.17g}"
    return text + ("" if re.search("[.e]", text) else ".0") + \
        number[len(digits):]


def changed(kind: str | None, text: str) -> list[str]:
    """What a token may become."""
    if kind == "string":
        return ['""'] * (len(text) > 2)
    if kind == "number":
        return [next_literal(text)]
    if kind == "binary":
        return BINARY[text].split()
    if kind == "sign":
        return [""]
    return [OPPOSITE[text]] if kind and text in OPPOSITE else []


def changes_in(source: str) -> Iterator[tuple[int, str, str]]:
    """Where each change is, what it replaces, and by what."""
    at = 0
    while found := TOKEN.search(source, at):
        at = found.end()
        if found["array"] and not DECLARED.search(
                source, max(0, found.start() - 80), found.start()):
            at = found.start() + 1
        for new in changed(found.lastgroup, found[0]):
            yield found.start(), found[0], new


def mixed(number: int, text: str) -> int:
    """FNV-1a, and a last mixing for its high bits."""
    for byte in text.encode():
        number = (number ^ byte) * 0x100000001b3 % 2**64
    number = (number ^ number >> 32) * 0x9e3779b97f4a7c15 % 2**64
    return number ^ number >> 29


class Change(NamedTuple):
    """A change of a file; `text` is its line with the change in braces, as in
    `if (a {< -> <=} b)`."""
    order: int
    file: str
    number: int  # of those of the file
    line: int
    text: str
    test: str = ""  # of a kept one: that alone is asked

    def excuse(self) -> str:
        return f"{self.file}: {self.text}"

    def make(self) -> str:
        """The file with the change."""
        source = Path(self.file).read_text("utf-8")
        if self.test:
            before, old, new, after = KEPT_TEXT.fullmatch(self.text).groups()
            was = before + old + after
            return source.replace(was, before + new + after, 1)
        at, old, new = list(changes_in(source))[self.number - 1]
        return source[:at] + new + source[at + len(old):]


def all_changes(seed: int) -> list[Change]:
    """In the order of a seed."""
    found = []
    for file in sorted(Path().glob("src/*/*.[ch]")):
        source = file.read_text("utf-8")
        start = mixed(0xcbf29ce484222325 ^ seed, str(file))
        for number, (at, old, new) in enumerate(changes_in(source), 1):
            begin = source.rfind("\n", 0, at) + 1
            end = re.compile("$", re.M).search(source, at + len(old)).start()
            text = (f"{source[begin:at].lstrip(' ')}{{{old} -> {new}}}"
                    f"{source[at + len(old):end]}")
            found.append(Change(mixed(start, text), str(file), number,
                                source.count("\n", 0, begin) + 1, text))
    return sorted(found)


def kept_changes() -> list[Change]:
    """Those that are tried always."""
    found = []
    for line in KEPT.read_text("utf-8").splitlines()[4:]:
        test, file, text = line.split(": ", 2)
        before, old, _, after = KEPT_TEXT.fullmatch(text).groups()
        source = Path(file).read_text("utf-8")
        above, fits, _ = source.partition(before + old + after)
        must(fits, f"no line of the source fits this of {KEPT}: {text}")
        found.append(Change(0, file, 0, above.count("\n") + 1, text, test))
    return found


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


def must(done: object, what: object) -> None:
    if not done:
        sys.exit(f"mutation: {what}")


@functools.lru_cache(maxsize=None)
def made_of(file: Path) -> frozenset[str]:
    """What an object was made of, by its file of dependencies."""
    text = (BASE / "double" / file).with_suffix(".d").read_text("utf-8")
    words = re.sub(r"\S*:|\\\n", " ", text).split()
    return frozenset(os.path.relpath(os.path.realpath(word)) for word in words
                     if re.match("(src|port|include|tests)/", word))


def core() -> list[Path]:
    return sorted(Path().glob("src/*/*.c"))


@functools.lru_cache(maxsize=None)
def prepare() -> list[Test]:
    """Builds all of it."""
    sources = sorted(source for source in Path("tests").rglob("test_*.c")
                     if source.parent.name != "golden")
    print("mutation: building the tests ...", file=sys.stderr)
    done = subprocess.run(
        [*(os.environ.get("MAKE") or "make").split(), "-s", f"CC={CC}",
         f"BUILD={BASE}", "OPT=-O1", "EXTRA=-fPIC",
         *(str(BASE / real / source.with_suffix(""))
           for real in REALS for source in sources)], text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    must(done.returncode == 0, done.stdout)
    tests = []
    for real in REALS:
        room, work = BASE / real, PLAIN / real
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        for file in core():
            must(compiled(real, file, Path("."), work / f"{file.stem}.o"),
                 f"{file} does not compile")
        must(linked(work / "libtwofold.so", "-shared", *work.glob("*.o")),
             "the core does not link")
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
                "-ltwofold", "-lm") and
         linked(PLAIN / "static", *parts, room / "libtwofold.a", "-lm",
                f"-Wl,-Map={PLAIN}/map"), f"{source} does not link")
    needs = re.findall(r"libtwofold\.a\((\w+)\.o\)",
                       (PLAIN / "map").read_text("utf-8"))
    return Test(real, source, frozenset(needs))


# A change, tried: which test notices it.

def passes(test: Test, program: Path, at: Path) -> bool:
    """Runs a test with the core in a folder. Whatever a change does, it cannot
    do much: seconds, bytes of output, of memory."""
    seconds = LONG if test.source.stem in SLOW else SHORT
    return subprocess.run(
        ["prlimit", "--fsize=102400000", "--as=4096000000", f"--cpu={seconds}",
         "timeout", "-k", "1", "3600", program], stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False,
        env={**os.environ, "TAP_BAIL": "1", "LD_LIBRARY_PATH": str(at)}
        ).returncode == 0


@functools.lru_cache(maxsize=None)
def passes_unchanged(test: Test) -> bool:
    return passes(test, PLAIN / test.name, PLAIN / test.real)


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

    def fails(self, test: Test) -> bool:
        """A test that has the changed file in it, a header, is made again."""
        program, at = PLAIN / test.name, self.work / test.real
        if self.change.file in made_of(test.source):
            program, made = self.work / "test", self.work / "test.o"
            if not (compiled(test.real, test.source, self.work, made) and
                    linked(program, made, BASE / test.real / "libsupport.a",
                           f"-L{at}", "-ltwofold", "-lm")):
                return True
        elif self.same or not test.needs & self.changed:
            return False
        if passes(test, program, at):
            return False
        must(passes_unchanged(test), f"{test.name} fails without a change")
        return True

    def order(self, test: Test) -> tuple[int, bool, int]:
        """Who noticed a change of this file before is asked first."""
        known = saw.get(self.change.file, [])
        return (known.index(test.name) if test.name in known else len(known),
                test.source.stem in SLOW, len(test.needs))

    def verdict(self) -> str:
        """noticed TEST, survived, same or invalid"""
        same_in_both = True
        for real in REALS:
            if not self.compile(real):
                return "invalid"
            self.same = (self.work / real / "libtwofold.so").read_bytes() == (
                PLAIN / real / "libtwofold.so").read_bytes()
            same_in_both &= self.same
            for test in sorted((test for test in self.tests
                                if test.real == real), key=self.order):
                if self.fails(test):
                    saw[self.change.file] = [test.name] + [
                        name for name in saw.get(self.change.file, [])
                        if name != test.name]
                    return f"noticed {test.name}"
        return "same" if same_in_both else "survived"


def tried(change: Change, tests: list[Test]) -> str:
    """What became of a change."""
    with tempfile.TemporaryDirectory(dir=PLACE, prefix="work.") as name:
        work = Path(name)
        # Folders of the project, with links to its files.
        for part in ("src", "include", "port", "tests", "tools"):
            shutil.copytree(part, work / part, copy_function=lambda file, link:
                            os.symlink(os.path.abspath(file), link))
        (work / change.file).unlink()
        (work / change.file).write_text(change.make(), "utf-8")
        said = Trial(change, [test for test in tests if change.test in
                              ("", test.source.stem)], work).verdict()
    if said == "survived":
        print(f"survived: {change.excuse()}", file=sys.stderr)
    return said


# The run.

def total(verdicts: list[str]) -> str:
    """The share that is noticed, with Wilson's interval; "same" are changes
    that compile to the same bytes, "invalid" those that do not compile."""
    of = Counter(verdict.split()[0] for verdict in verdicts)
    tries = of["noticed"] + of["survived"]
    share = "none was tried"
    if tries:
        ends = stats.binomtest(of["noticed"], tries).proportion_ci(
            method="wilson")
        share = (f"{100 * of['noticed'] / tries:.1f} % (95 % interval "
                 f"{100 * ends.low:.1f} to {100 * ends.high:.1f})")
    return (f"{of['noticed']} of {tries} changes noticed: {share}; "
            f"{of['same']} compile to the same, {of['invalid']} not at all")


def too_many_survive(seed: str) -> bool:
    """Whether more changes of the sample of an order survive than may."""
    size = int(os.environ.get("SAMPLE") or 60)
    is_kept, one = seed == "kept", sys.argv[1:3]
    everything = kept_changes() if is_kept else all_changes(int(seed))
    sample = [change for change in everything if not one
              or [change.file, str(change.number)] == one]
    if size and not one and not is_kept:
        sample = sample[:size]
    must(bool(sample), "there is no such change")
    tests = prepare()
    verdicts = driven.side_by_side(lambda change: tried(change, tests), sample)
    text = "".join(f"{change.file}:{change.line}: {verdict}: {change.text}\n"
                   for change, verdict in zip(sample, verdicts))
    text += (f"{total(verdicts)}\nseed {seed}, of {len(everything)} changes in "
             "all\n")
    with open(PLACE / "REPORT", "a", encoding="utf-8") as file:
        file.write(text)
    print(text, end="")
    missed = {"survived", *(("same", "invalid") if is_kept else ())}
    most = 0 if is_kept or one else len(sample) // 4
    return sum(verdict in missed for verdict in verdicts) > most


def main() -> None:
    driven.begin(__file__)
    PLACE.mkdir(parents=True, exist_ok=True)
    (PLACE / "REPORT").write_text("", "utf-8")
    seeds = (os.environ.get("SEED") or "1").split()
    sys.exit(any(list(map(too_many_survive, seeds))))  # all are tried


if __name__ == "__main__":
    main()
