#!/usr/bin/python3 -B
"""What holds for files as such: none over 500 lines, no line of C, Python, sh
or make over 80 columns, no marker of unfinished work, no path of one machine,
no picture and no text over 100 kB but those of LARGE; no room with more lines
or files than SIZES says, no document with more words than WORDS says. No test
returns where it meets one real type, which would count as passed: SKIP of
tests/tap.h says why.
"""
import re
from pathlib import Path

from findings import BUILD, checked, files_in, wrong

ROOMS = ("Makefile", ".ci", "include", "src", "port", "tests", "tools")
MOST_BYTES = 100000
# What commands make and git has all the same: the built page.
LARGE = {"docs/page/index.html"}
# What stands beside the core is weight that users and heirs carry. Lines that a
# room may have, those it is to come down to, and how many files it may have.
SIZES = {name: (*map(int, numbers), 10**6)[:3] for name, *numbers in map(
    str.split, """
room              most   goal  files
src               11875   9700     61
include            1990   1650     17
tools/cli         12427  10000
tools/board        1605   1200
tools/package      6557   5200
tools/page         4226   4000
tools/bench        3530   3200
tools/study        4958   3800
tools/verify       5365   4200
tests             28772  23000
""".strip().splitlines()[1:])}
# Words that a document may have, and all of them together.
WORDS = {name: int(most) for name, most in map(str.split, """
README.md              700
docs/README.md         200
docs/TUTORIAL.md      1450
docs/USE.md           2620
docs/PORTS.md         2500
docs/PROTOCOL.md      3500
DESIGN.md             6920
docs/SCHEMES.md       2000
docs/BENCH.md         1800
docs/VERIFICATION.md  1800
docs/PAPER.md         3500
docs/FINDINGS.md      2500
docs/NOISE.md         1725
docs/STUDIES.md       3300
CHANGELOG.md          2500
docs/PACKAGES.md         10
docs/FMU.md              10
docs/PAGE.md             10
""".strip().splitlines())}
MOST_WORDS = 36700
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


def texts_at(room):
    """Of the files that count."""
    texts = [text_of(path) for path in files_in(room)
             if path.suffix not in NOT_LINES]
    return [text for text in texts if text]


def judge_sizes():
    """Returns what there is, as text."""
    said = []
    for room, (most, goal, files) in SIZES.items():
        texts = texts_at(room)
        lines = sum(text.count("\n") for text in texts)
        said.append(f"{room} {lines} lines (goal {goal})")
        if lines > most:
            wrong(f"{room}: {lines} lines, at most {most}")
        if len(texts) > files:
            wrong(f"{room}: {len(texts)} files, at most {files}")
    documents = {str(path): len(path.read_text("utf-8").split())
                 for path in [*Path().glob("*.md"), *Path("docs").glob("*.md")]}
    documents.pop("CONTRIBUTING.md", 0)  # of one screen
    for name, words in documents.items():
        if words > WORDS.get(name, 0):
            wrong(f"{name}: {words} words, at most {WORDS.get(name, 0)}")
    words = sum(documents.values())
    if words > MOST_WORDS:
        wrong(f"the documents have {words} words, at most {MOST_WORDS}")
    return ", ".join([*said, f"{words} of {MOST_WORDS} words"])


own = list(files_in(*ROOMS))
for file in own:
    content = text_of(file)
    if content is None:
        continue
    rows = content.splitlines()
    judge_layout(file, rows, content)
    if file.parts[0] == "tests":
        judge_test(file, content)
everything = [path for path in files_in(".")
              if path.parts[0] not in (".git", "build", BUILD.parts[0])]
for file in everything:
    content = text_of(file)
    if (content is not None or file.suffix == ".png") and \
            file.stat().st_size > MOST_BYTES and str(file) not in LARGE:
        wrong(f"{file}: {file.stat().st_size} bytes, at most {MOST_BYTES}")
    if content is not None:
        judge_words(file, content.splitlines())
checked(f"{len(own)} files <= 500 lines in 80 columns; {judge_sizes()}; no "
        f"markers, no machine's paths, no large files of {len(everything)}; no "
        "test returns by the real type")
