#!/usr/bin/python3
"""Every loop of the core has a bound. `for (int i = 0; i < N; i++)` shows its
own, where N is a constant and nothing else in it moves i; so does one that
counts down. N may be made of names, too, that nothing in the loop changes and
that loops.bounds has for its file, with what each is at most and why; so it has
every other loop. gcc and clang-tidy tell loops that change nothing they ask
for, and counters that wrap round; recursion is stack.py's.
"""
import re
from pathlib import Path

from findings import checked, wrong

KNOWN = Path("tools/verify/check/loops.bounds")
QUIET = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.S)
LOOP = re.compile(r"\b(?:for|while) \(|\bdo \{")
COUNTED = re.compile(r"for \((?:\w+ )+(\w+) = ([^;]*); \1 ([<>])=? ([^;&|]*)"
                     r"(?: && [^;]*)?; \1(\+\+|--)(?:, [^;]*)?\)")
CONSTANT = re.compile(r"(?:\b(?:[A-Z][A-Z_0-9]*|\d+)\b|[-+*/() ])+")
NAME = re.compile(r"\b[a-z]\w*(?:->\w+)*\b(?!\()")
PLANTED = """for (int i = 0; i < n; i++) at++;
for (int i = 0; i < 9; i++) { if (at) i--; }
for (int i = 0; i < 9; i--) at++;
for (int i = n; i > 0; i--) at++;
for (int i = 0; i < m; i++) { m++; }
for (;;) { at++; }
while (at < 9) at++;
do { at++; } while (at < n);
"""


def closed(text, at):
    """Behind what the bracket at this place opens."""
    depth = 0
    for end in range(at, len(text)):
        depth += (text[end] in "({[") - (text[end] in ")}]")
        if depth == 0:
            return end + 1
    return len(text)


def loops_of(text):
    """The head of each loop, and the names of which its bound is made; None
    where it shows none."""
    text = QUIET.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    for loop in LOOP.finditer(text):
        end = closed(text, loop.end() - 1)
        head = "do" if loop[0][0] == "d" else re.sub(
            r"\s+", " ", text[loop.start():end])
        if head.startswith("while") and text[end:end + 1] == ";":
            head = f"do {head}"  # of a loop that has been met
        if head == "do":
            continue
        rest = text[end:].lstrip()
        body = rest[:closed(rest, 0) if rest[:1] == "{" else
                    rest.find(";") + 1]
        yield head, bound_of(head, body)


def bound_of(head, body):
    found = COUNTED.fullmatch(head)
    if not found:
        return None
    name, start, side, limit, move = found.groups()
    bound = limit if side == "<" else start
    names = set(NAME.findall(bound))
    if (side == "<") != (move == "++") or \
            not CONSTANT.fullmatch(NAME.sub("0", bound)) or any(re.search(
                rf"(\+\+|--|&){one}\b|"
                rf"(?<![\w.>]){one}\s*(\+\+|--|[-+*/|&^%]?=[^=])", body)
                for one in (name, *names)):
        return None
    return names


def known():
    """Of loops.bounds the loops and names, as (file, it)."""
    for line in KNOWN.read_text("utf-8").splitlines():
        if line and not line.startswith("#"):
            words = line.split(" : ")
            if len(words) != 3:
                wrong(f"{KNOWN}: not file : loop : at most, why: {line}")
            yield tuple(words[:2])


told = set(known())
planted = [bound for _, bound in loops_of(PLANTED)]
if set() in planted or planted.count({"n"}) != 2 or \
        len(planted) != PLANTED.count("\n"):
    wrong("a planted loop without a bound is not found")
loops = [(str(path), *loop) for room in ("include", "src")
         for path in sorted(Path(room).rglob("*.[ch]"))
         for loop in loops_of(path.read_text("utf-8"))]
used, shown = set(), 0
for file, head, names in loops:
    needs = {(file, name) for name in names or ()}
    if names is None or not needs <= told:
        needs = {(file, head)}
    if not needs <= told:
        wrong(f"{file}: {head}: its bound is no constant; see {KNOWN}")
    used |= needs
    shown += not needs
for one in sorted(told - used):
    wrong(f"{KNOWN}: no loop needs: {' : '.join(one)}")
checked(f"{len(loops)} loops, {shown} of constant bounds; planted ones without "
        "are found")
