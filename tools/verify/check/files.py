#!/usr/bin/python3 -B
"""What holds for files as such: none over 500 lines, no line of C, Python, make
or of a *.sh over 80 columns, no marker of unfinished work, no path of one
machine; and no more than 4500 lines of sh and awk in all. No test returns where
it meets one real type, which would count as passed: SKIP of tests/tap.h says
why. Says how many lines tools/ has beside the command line: of products (the
page, FMUs, packages) and of the workshop, which is all else."""
import re
from pathlib import Path

from findings import BUILD, checked, wrong

ROOMS = ("Makefile", ".ci", "include", "src", "port", "tests", "tools")
MAX_SHELL = 4500
PRODUCTS = ("dist", "fmu", "page")
NARROW = {".c", ".h", ".sh", ".py", ".mk"}
# In pieces, which keep the patterns from finding themselves.
MARKER = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX|HA" r"CK)\b")
MACHINE = re.compile(r"(?:^|[^\w.}])/(?:[w]ork|[h]ome|[r]oot|[U]sers)/")
RETURNS = re.compile(r"if \s*\([^;{}]*(?:IS_DOUBLE|IS_FLOAT|tf_real_t)[^;{}]*\)"
                     r"\s*(?:\{\s*)?return\s*;"
                     r"|#if\w*[^\n]*TF_REAL_FLOAT[^\n]*\n\s*return\s*;")
SHELL = re.compile(r"#!.*\b(?:ba|da)?(?:sh|awk)\b")


def files_in(*rooms):
    """Files below folders, and those that are named."""
    for room in map(Path, rooms):
        yield from sorted(path for path in ([room] if room.is_file() else
                                            room.rglob("*")) if path.is_file())


def text_of(path):
    """None where it is not text."""
    data = path.read_bytes()
    return None if b"\0" in data else data.decode("utf-8", "replace")


def is_shell(path, text):
    return path.suffix in (".sh", ".awk") or bool(SHELL.match(text))


def judge_layout(path, lines):
    if len(lines) > 500:
        wrong(f"{path}: {len(lines)} lines, at most 500")
    if path.suffix in NARROW or path.name == "Makefile":
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


PLANTED = ("if (sizeof(tf_real_t) == 4) return;",
           "if (n < 9 &&\n    !IS_DOUBLE) {\n  return;",
           "#ifdef TF_REAL_FLOAT\n  return;\n#endif")
HARMLESS = ('if (!IS_DOUBLE) SKIP("why");', "if (IS_DOUBLE) n = 1;\nreturn;",
            "return IS_DOUBLE ? 1 : 2;")
for text in PLANTED + HARMLESS:
    if bool(RETURNS.search(text)) != (text in PLANTED):
        wrong(f"a planted return is judged wrong: {text}")


def group_of(path):
    """Of a file of tools/; None for the command line."""
    room = path.parts[1]
    return None if room in ("cli", "twofold.c") else (
        "product" if room in PRODUCTS else "workshop")


lines_of = {"shell": 0, "product": 0, "workshop": 0}
own = list(files_in(*ROOMS))
for file in own:
    content = text_of(file)
    if content is None:
        continue
    rows = content.splitlines()
    judge_layout(file, rows)
    if file.parts[0] == "tests":
        judge_test(file, content)
    if is_shell(file, content):
        lines_of["shell"] += len(rows)
    group = group_of(file) if file.parts[0] == "tools" else None
    if group:
        lines_of[group] += len(rows)
if lines_of["shell"] > MAX_SHELL:
    wrong(f"{lines_of['shell']} lines of sh and awk, at most {MAX_SHELL}: "
          "what has logic is Python, or a test in C")

everything = [path for path in files_in(".")
              if path.parts[0] not in (".git", "build", BUILD.parts[0])]
for file in everything:
    content = text_of(file)
    if content is not None:
        judge_words(file, content.splitlines())
checked(f"{len(own)} files <= 500 lines, C, Python, make and *.sh in 80 "
        f"columns; {lines_of['shell']} lines of sh and awk, at most "
        f"{MAX_SHELL}; tools beside the command line: {lines_of['product']} "
        f"lines of products, {lines_of['workshop']} of the workshop; no "
        f"markers, no machine's paths in {len(everything)} files; no test "
        "returns by the real type")
