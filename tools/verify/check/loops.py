#!/usr/bin/python3
"""Every loop of the core has a bound. `for (int i = 0; i < N; i++)` shows its
own, where N is a constant and nothing else in it moves i; so does one that
counts down. Every other loop stands in loops.bounds with what it is at most
and why. gcc and clang-tidy tell loops that change nothing they ask for, and
counters that wrap round; recursion is stack.py's.
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
PLANTED = """for (int i = 0; i < n; i++) at++;
for (int i = 0; i < 9; i++) { if (at) i--; }
for (int i = 0; i < 9; i--) at++;
for (int i = n; i > 0; i--) at++;
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
    """The head of each loop, and whether it shows its bound."""
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
        yield head, shows_bound(head, body)


def shows_bound(head, body):
    found = COUNTED.fullmatch(head)
    if not found:
        return False
    name, start, side, limit, move = found.groups()
    return ((side == "<") == (move == "++") and
            bool(CONSTANT.fullmatch(limit if side == "<" else start)) and
            not re.search(
                rf"(\+\+|--|&){name}\b|"
                rf"(?<![.>])\b{name}\s*(\+\+|--|[-+*/|&^%]?=[^=])", body))


def known():
    """Of loops.bounds the loops, as (file, head)."""
    for line in KNOWN.read_text("utf-8").splitlines():
        if line and not line.startswith("#"):
            words = line.split(" : ")
            if len(words) != 3:
                wrong(f"{KNOWN}: not file : loop : at most, why: {line}")
            yield tuple(words[:2])


if any(shown for _, shown in loops_of(PLANTED)) or \
        len(list(loops_of(PLANTED))) != PLANTED.count("\n"):
    wrong("a planted loop without a bound is not found")
loops = [(str(path), *loop) for room in ("include", "src")
         for path in sorted(Path(room).rglob("*.[ch]"))
         for loop in loops_of(path.read_text("utf-8"))]
told = set(known())
for file, head, shown in loops:
    if not shown and (file, head) not in told:
        wrong(f"{file}: {head}: its bound is no constant; see {KNOWN}")
for one in sorted(told - {(file, head) for file, head, shown in loops
                          if not shown}):
    wrong(f"{KNOWN}: there is no such loop: {' : '.join(one)}")
shown = sum(loop[2] for loop in loops)
checked(f"{len(loops)} loops, {shown} of constant bounds; planted ones without "
        "are found")
