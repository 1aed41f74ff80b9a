#!/usr/bin/python3 -B
"""What holds for files as such: none over 500 lines, no line of C, Python, sh
or make over 80 columns, no marker of unfinished work, no path of one machine,
no picture over 100 kB; no room, and none of the sums, with more lines than
LINES says. No test returns
where it meets one real type, which would count as passed: SKIP of tests/tap.h
says why.
"""
import re
from pathlib import Path

from findings import BUILD, checked, files_in, wrong

ROOMS = ("Makefile", ".ci", "include", "src", "port", "tests", "tools")
MAX_PICTURE = 100000
# What stands beside the core is weight that users and heirs carry. `goal` is
# what the rooms were to come down to, `most` what they may have: of the sums
# the goal and what later work may add (3000, 3000 and 500 lines), of a room
# above its goal what stands there.
LINES = {name: tuple(map(int, numbers)) for name, *numbers in (
    line.split() for line in """
name              most   goal
tools            43000  40000
tools/cli        15391  14500
tools/board       1385   1200
tools/package     5850   5200
tools/page        4380   4200
tools/bench        4422   4200
tools/study       5374   4200
tools/verify      6065   6500
tests            28000  25000
include           1950   1700
documents         5500   5000
DESIGN.md          700    700
docs/BENCH.md      250    250
docs/VERIFICATION.md 250  250
""".strip().splitlines()[1:])}
NOT_LINES = {".svg", ".png", ".hex", ".bin"}
NARROW = {".c", ".h", ".sh", ".py", ".mk"}
SCRIPT = re.compile(r"#!.*\b(?:python3?|(?:ba|da)?sh)\b")
# In pieces, which keep the patterns from finding themselves.
MARKER = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX|HA" r"CK)\b")
MACHINE = re.compile(r"(?:^|[^\w.}])/(?:[w]ork|[h]ome|[r]oot|[U]sers)/")
RETURNS = re.compile(r"if \s*\([^;{}]*(?:IS_DOUBLE|IS_FLOAT|tf_real_t)[^;{}]*\)"
                     r"\s*(?:\{\s*)?return\s*;"
                     r"|#if\w*[^\n]*TF_REAL_FLOAT[^\n]*\n\s*return\s*;")


def text_of(path):
    """None where it is not text."""
    data = path.read_bytes()
    return None if b"\0" in data else data.decode("utf-8", "replace")


def judge_layout(path, lines, text):
    if len(lines) > 500:
        wrong(f"{path}: {len(lines)} lines, at most 500")
    if path.suffix in NARROW or path.name == "Makefile" or SCRIPT.match(text):
        for number, line in enumerate(lines, 1):
            if len(line) > 80:
                wrong(f"{path}:{number}: {len(line)} columns")


def judge_words(path, lines):
    for number, line in enumerate(lines, 1):
        if MARKER.search(line):
            wrong(f"{path}:{number}: a marker of unfinished work: {line}")
        if MACHINE.search(line):
            wrong(f"{path}:{number}: a path of one machine: {line}")


def judge_test(path, text):
    for found in RETURNS.finditer(text):
        number = text.count("\n", 0, found.start()) + 1
        wrong(f"{path}:{number}: returns by the real type: SKIP says why")


def lines_at(name):
    """Lines of a room, of the documents, or of one file."""
    rooms = ["README.md", "DESIGN.md", *Path("docs").glob("*.md")] \
        if name == "documents" else [name]
    texts = [text_of(path) for path in files_in(*rooms)
             if path.suffix not in NOT_LINES]
    return sum(text.count("\n") for text in texts if text)


pictures = 0
own = list(files_in(*ROOMS))
for file in own:
    content = text_of(file)
    if content is None:
        continue
    rows = content.splitlines()
    judge_layout(file, rows, content)
    if file.parts[0] == "tests":
        judge_test(file, content)

print(f"{'lines':20s} {'there':>6s} {'most':>6s} {'goal':>6s}")
for place, (most, goal) in LINES.items():
    there = lines_at(place)
    print(f"{place:20s} {there:6d} {most:6d} {goal:6d}")
    if there > most:
        wrong(f"{place}: {there} lines, at most {most}")

everything = [path for path in files_in(".")
              if path.parts[0] not in (".git", "build", BUILD.parts[0])]
for file in everything:
    if file.suffix in (".svg", ".png"):
        pictures += 1
        if file.stat().st_size > MAX_PICTURE:
            wrong(f"{file}: {file.stat().st_size} bytes, at most "
                  f"{MAX_PICTURE}")
    content = text_of(file)
    if content is not None:
        judge_words(file, content.splitlines())
checked(f"{len(own)} files <= 500 lines in 80 columns; {lines_at('tools')} "
        f"lines of tools, {lines_at('tests')} of tests, "
        f"{lines_at('documents')} of documents; no "
        f"markers, no machine's paths in {len(everything)} files, {pictures} "
        "small pictures; no test returns by the real type")
