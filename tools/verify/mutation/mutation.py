"""Small wrong changes of src/, one at a time, for the tests to notice: the
first SAMPLE ones in the order of SEED (0: all; default 60 and 1).

Changed are comparisons, arithmetic and logical operators, signs, literals,
truth values and strings, where the layout of clang-format shows which operator
is binary (blanks around it), unary or a pointer. Comments, characters,
directives, case labels, assertions and sizes of arrays are left. The order is a
hash of file, line and seed: a sample stays the same when other lines change.

A copy of the tree is changed, made and tested. First run the tests that noticed
a change of the same file before, then the others, in double and then in float;
a test whose program has the same bytes as without the change is left out. Those
with hashes never run: they say that something differs, not what is wrong. A
change that no test notices survives. More survivors than a quarter fail the
run: some changes make no difference. SEED=kept has the changes of `kept`, each
for its own test, of which none may survive.

Environment: SAMPLE, SEED, JOBS, MAKE, CC (gcc), BUILD. SEED='kept 303' tries
one order after the other.
"""
from __future__ import annotations

import hashlib
import os
import queue
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Iterator, NamedTuple

from scipy import stats

import driven

KEPT = Path("tools/verify/mutation/kept")
KEPT_TEXT = re.compile("(.*){([^{}]*) -> ([^{}]*)}(.*)")
CC = os.environ.get("CC") or "gcc"
PLACE = Path(os.environ.get("BUILD") or "build", "mutation")
REALS = "double", "float"
SLOW = {f"test_{name}" for name in (
    "extremes", "ensemble", "friction", "reference", "branch", "frame",
    "physics_numbers")}
LONG, SHORT = 200, 20  # s of the processor that a test may take, if slow or not
# What goes beyond an array ends the program, as the checks with sanitizers
# would report, and what is read before it is written is not 0.
FLAGS = ("-w -fsanitize=bounds -fsanitize=bounds-strict "
         "-fsanitize-undefined-trap-on-error -ftrivial-auto-var-init=pattern")
saw: dict[str, list[tuple[str, Path]]] = {}  # which tests noticed, by files
rooms: queue.Queue[Path] = queue.Queue()  # copies of the tree to change

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


def mixed(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")


class Change(NamedTuple):
    """A change of a file; `text` is its line with the change in braces, as in
    `if (a {< -> <=} b)`."""
    order: int
    file: str
    text: str
    source: str  # the file with the change
    test: str = ""  # of a kept one: that alone runs


def all_changes(seed: str) -> list[Change]:
    """In the order of a seed."""
    found = []
    for file in sorted(Path().glob("src/*/*.[ch]")):
        source = file.read_text("utf-8")
        for at, old, new in changes_in(source):
            begin, behind = source.rfind("\n", 0, at) + 1, at + len(old)
            text = (f"{source[begin:at].lstrip(' ')}{{{old} -> {new}}}"
                    f"{source[behind:].partition(chr(10))[0]}")
            found.append(Change(mixed(f"{seed} {file} {text}"), str(file),
                                text, source[:at] + new + source[behind:]))
    return sorted(found)


def kept_changes() -> list[Change]:
    """Those that are tried always. A line of the source has one place."""
    found = []
    sources = {str(file): file.read_text("utf-8")
               for file in sorted(Path().glob("src/*/*.[ch]"))}
    for line in KEPT.read_text("utf-8").splitlines():
        if line.startswith("#"):
            continue
        test, text = line.split(": ", 1)
        before, old, new, after = KEPT_TEXT.fullmatch(text).groups()
        file = next((file for file, source in sources.items()
                     if before + old + after in source), None)
        must(file, f"no line of src/ fits this of {KEPT}: {text}")
        found.append(Change(0, file, text, sources[file].replace(
            before + old + after, before + new + after, 1), test))
    return found


def must(done: object, what: object) -> None:
    if not done:
        sys.exit(f"mutation: {what}")


def make(room: Path, *targets: object) -> bool:
    return subprocess.run(
        [os.environ.get("MAKE") or "make", "-s", "-C", room, f"CC={CC}",
         "BUILD=build", "OPT=-O1", f"EXTRA={FLAGS}", *map(str, targets)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        check=False).returncode == 0


def tests() -> list[tuple[str, Path]]:
    """(real type, program) of each test, in the order of the real types."""
    return [(real, Path("build", real, source.with_suffix("")))
            for real in REALS for source in sorted(
                Path("tests").rglob("test_*.c"))
            if source.parent.name != "golden"]


def prepare(sample: list[Change]) -> None:
    """A copy of the tree with all tests that a sample needs, and one for each
    job."""
    while not rooms.empty():
        rooms.get()
    print("mutation: building the tests ...", file=sys.stderr)
    shutil.rmtree(PLACE / "rooms", ignore_errors=True)
    first = (PLACE / "rooms/0").absolute()
    for part in ("Makefile", "src", "include", "port", "tests", "tools"):
        copy = shutil.copytree if Path(part).is_dir() else shutil.copy2
        (first / part).parent.mkdir(parents=True, exist_ok=True)
        copy(part, first / part)
    wanted = {change.test for change in sample}
    must(make(first, *(program for _, program in tests()
                       if wanted & {"", program.name})), "make fails")
    for n in range(1, driven.processors() + 1):
        subprocess.run(["cp", "-a", first, first.with_name(str(n))], check=True)
        rooms.put(first.with_name(str(n)))


def passes(program: Path) -> bool:
    """Whatever a change does, it cannot do much: seconds, bytes of output, of
    memory."""
    seconds = LONG if program.name in SLOW else SHORT
    return subprocess.run(
        ["prlimit", "--fsize=102400000", "--as=4096000000", f"--cpu={seconds}",
         "timeout", "-k", "1", "3600", program], stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False,
        env={**os.environ, "TAP_BAIL": "1"}).returncode == 0


def verdict(change: Change, room: Path) -> str:
    """noticed TEST, survived, same or invalid"""
    known = saw.get(change.file, [])
    order = sorted((one for one in tests()
                    if change.test in ("", one[1].name)),
                   key=lambda one: (REALS.index(one[0]), one not in known,
                                    one[1].name in SLOW))
    differ = False
    for real, program in order:
        unchanged = room.with_name("0") / program
        if not make(room, program):
            return "invalid"
        if (room / program).read_bytes() == unchanged.read_bytes():
            continue
        differ = True
        if not passes(room / program):
            must(passes(unchanged), f"{program} fails without a change")
            saw[change.file] = [(real, program)] + known
            return f"noticed {program}"
    return "survived" if differ else "same"


def tried(change: Change) -> str:
    """What became of a change."""
    prepared = rooms.get()
    file = prepared / change.file
    plain = file.read_text("utf-8")
    file.write_text(change.source, "utf-8")
    said = verdict(change, prepared)
    file.write_text(plain, "utf-8")
    rooms.put(prepared)
    if said == "survived":
        print(f"survived: {change.file}: {change.text}", file=sys.stderr)
    return said


def total(verdicts: list[str]) -> str:
    """The share that is noticed, with Wilson's interval; "same" are changes
    that compile to the same bytes, "invalid" those that do not compile."""
    of = Counter(verdict.split()[0] for verdict in verdicts)
    tries = of["noticed"] + of["survived"]
    ends = stats.binomtest(of["noticed"], max(tries, 1)).proportion_ci(
        method="wilson")
    return (f"{of['noticed']} of {tries} changes noticed: "
            f"{of['noticed'] / max(tries, 1):.1%} (95 % interval "
            f"{ends.low:.1%} to {ends.high:.1%}); {of['same']} compile to the "
            f"same, {of['invalid']} not at all")


def too_many_survive(seed: str) -> bool:
    """Whether more changes of the sample of an order survive than may."""
    size = int(os.environ.get("SAMPLE") or 60)
    is_kept = seed == "kept"
    everything = kept_changes() if is_kept else all_changes(seed)
    sample = everything if is_kept or not size else everything[:size]
    prepare(sample)
    verdicts = driven.side_by_side(tried, sample)
    for change, verdict in zip(sample, verdicts):
        print(f"{change.file}: {verdict}: {change.text}")
    print(f"{total(verdicts)}\nseed {seed}, of {len(everything)} changes")
    missed = {"survived", *(("same", "invalid") if is_kept else ())}
    most = 0 if is_kept else len(sample) // 4
    return sum(verdict in missed for verdict in verdicts) > most


def main() -> None:
    seeds = (os.environ.get("SEED") or "1").split()
    sys.exit(any(list(map(too_many_survive, seeds))))  # all are tried
