#!/usr/bin/python3 -B
"""Commands in documents run and print what stands there. README.md: its C
program compiles without a warning against the library in both real types, runs
and prints what is said; the line that compiles it and those of "use it from"
run; each promise names a test that exists. What the documents link to is there.
Each command of the documents in SHELLS, one after the other in one shell a
document, prints what stands below it."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from findings import (BUILD, DEFINES, asked, checked, in_common, need,
                      place_of, quietly, wrong)

PLACE = place_of("gcc", "-O3")
STRICT = ("-std=c99 -O2 -Wall -Wextra -pedantic -Wconversion "
          "-Wdouble-promotion -Werror -ffp-contract=off -Iinclude").split()
PROGRAM, DEMO = BUILD / "readme.c", BUILD / "demo"
MAKE = (  # in that place
    f'make() {{ flock {PLACE}.lock "${{MAKE:-make}}" --no-print-directory '
    f'CC=gcc OPT=-O3 BUILD={PLACE} EXTRA=-Werror "$@"; }}\n')
# Words of a line of "use it from", with what it then needs, and its package.
NEEDS = {"pkg-config": ("pkg-config", "pkg-config"),
         "cmake": ("cmake", "cmake"),
         "BOARD=stm32f405": ("arm-none-eabi-gcc", "gcc-arm-none-eabi")}
SHELLS = [Path("README.md"), Path("docs/TUTORIAL.md")]
not_tried = []
text = Path("README.md").read_text()


def last_cells(column):
    """The last column of the table whose first one is called so."""
    table = re.search(rf"^\| {column} \|.*\n.*\n((?:\|.*\n)*)", text, re.M)
    return [re.split(r"(?<!\\)\|", row)[-2] for row in
            (table[1].splitlines() if table else [])]


def judge_program():
    """In both real types with warnings. Returns what it prints in double."""
    for real, define in reversed(DEFINES.items()):
        library = PLACE / real / "libtwofold.a"
        if not in_common("gcc", "-O3", library) or not quietly(
                "gcc", *STRICT, define, PROGRAM, library, "-o", DEMO):
            wrong(f"the program of README.md does not compile in {real}")
        said, code = asked(DEMO)
        if code or not said:
            wrong(f"the program of README.md prints nothing or fails in {real}")
    claim = re.search(r"^It prints `([^`]*)`", text, re.M)
    if not claim or claim[1] not in said.splitlines():
        wrong(f"the program does not print: {claim and claim[1]}")
    return said


def judge_uses(said):
    """The lines as the reader would type them, in a build that checks share and
    a home of their own. Where one makes `demo`, it prints what the program
    prints. That of Python is test `python` of `make test-dist`."""
    home = BUILD.absolute() / "readme-home"
    for old in (home, PLACE / "demo"):
        shutil.rmtree(old, ignore_errors=True)
    if not in_common("gcc", "-O3", PLACE / "double/twofold"):
        wrong("the command line does not build")
    uses = [re.search("`(.*)`", cell)[1].replace(r"\|", "|")
            for cell in last_cells("use it from")]
    lines = re.findall(r"^    (gcc .*-fno-math-errno.*)$", text, re.M)
    if not uses or len(lines) != 1:
        wrong("README.md has no uses, or no line with gcc -fno-math-errno")
    # As on a plain Debian, with an empty home; the line says what it needs.
    environment = {**os.environ, "HOME": str(home)}
    environment.pop("PKG_CONFIG_PATH", None)
    for use in lines + uses:
        if "venv" in use:
            continue
        line = re.sub(r"-o demo$", f"-o {DEMO}", use.replace(
            "build/", f"{PLACE}/").replace(" demo.c", f" {PROGRAM}"))
        DEMO.unlink(missing_ok=True)
        tool, package = next((needs for word, needs in NEEDS.items()
                              if word in line), ("sh", ""))
        if not shutil.which(tool):
            not_tried.append(f"{use}: {tool} is missing (apt-get install "
                             f"{package})")
        elif not quietly("sh", "-c", MAKE + line, env=environment,
                         stdin=subprocess.DEVNULL):
            wrong(f"README.md: this line fails: {use}")
        elif line.endswith(f"-o {DEMO}") and asked(DEMO) != (said, 0):
            wrong(f"the program prints otherwise when compiled by {use}")
    return uses


def judge_promises():
    """The last column of the table: a test, or a file of tests."""
    there = "\n".join(path.read_text() for path in
                      Path("tests").rglob("*.[ch]"))
    tests = [cell.strip(" `") for cell in last_cells("promise")]
    for test in tests:
        if not Path(test).is_file() and not re.search(
                rf"^(?:TEST|LAW)\({re.escape(test)}\)", there, re.M):
            wrong(f"README.md promises by a test that does not exist: {test}")
    return tests


def judge_links():
    """Of all documents, from where each lies."""
    for document in [*Path().glob("*.md"), *Path("docs").glob("*.md")]:
        for target in re.findall(r"\]\(([^)#:\n]+)\)", document.read_text()):
            if not (document.parent / target).exists():
                wrong(f"a link leads nowhere: {document}: {target}")


def judge_shell(document):
    """Lines with $ are commands, with > go on, the others are what is printed;
    `...` is anything. Makes what it needs in the build that checks share."""
    blocks = re.findall(r"(?:^    .*\n)+", document.read_text(), re.M)
    steps = [step for block in blocks for step in
             re.split(r"^\$ ", re.sub("^    ", "", block, flags=re.M),
                      flags=re.M)[1:]]
    steps = [re.match(r"(.*\n(?:>.*\n)*)((?:.*\n)*)", step).groups()
             for step in steps]
    script = MAKE + "".join(
        "printf '\\0'\n" + re.sub("^> ?", "", command, flags=re.M)
        for command, _ in steps).replace("build/", f"{PLACE}/")
    said, _ = asked("bash", "-c", script, stdin=subprocess.DEVNULL,
                    stderr=subprocess.STDOUT)
    prints = said.split("\0")[1:]
    for (command, expected), text in zip(steps, prints):
        pattern = re.escape(expected).replace(r"\.\.\.", ".*")
        if not re.fullmatch(pattern, text, re.S):
            wrong(f"{document}: {command.rstrip()} prints\n{text}")
    if len(prints) != len(steps) or not steps:
        wrong(f"{document}: ended in {len(prints)} of {len(steps)}")
    return len(steps)


need("gcc", "gcc")
PROGRAM.write_text((re.search(r"^```c\n(.*?)^```", text, re.M | re.S) or
                    ["", ""])[1])
if not PROGRAM.read_text():
    wrong("README.md has no block ```c")
used = judge_uses(judge_program())
promised = judge_promises()
if not promised:
    wrong("README.md has no promises")
judge_links()
tried = sum(map(judge_shell, SHELLS))
checked(f"{len(promised)} promises with a test, links; its program and "
        f"{len(used)} uses run; {tried} commands print what "
        f"{', '.join(map(str, SHELLS))} quote")
if not_tried:
    print("not tried:", *not_tried, sep="\n")
    sys.exit(3)
