#!/usr/bin/python3
"""Public functions say all that they promise, row by row, and every test that
a promise names is run. Kernels claim in prose: only the rows are a contract.
Documents written by hand quote no figure that changes with the core: rows,
reports and commands have those. What docs/VERIFICATION.md says was tried is
what the tree tries, and the checks and tests it names are there."""
import re
import subprocess
import tempfile
from pathlib import Path

from findings import checked, need, wrong
from public import functions_of, public_functions

ROWS = ["Scheme:", "Returns:", "Cost:", "Stack:", "Memory:", "Claims:"]


def judge(function):
    """(what is wrong, the tests that are named) of one function."""
    place, found, at = f"{function.file}:{function.line}", [], -1
    for row in ROWS:
        here = function.text.find(row)
        if here <= at:
            found.append(f"{place}: row \"{row}\" is missing or misplaced")
        else:
            at = here
    names = re.split("[ ,]+", function.text.partition("Claims:")[2].strip())
    if names == [""]:
        return found + [f"{place}: claims nothing"], set()
    return found, set(names)


def tests_that_run():
    """The compiler takes the comments out: a test in one is not run. It says
    that macros of both real types are there, which is no matter."""
    text = subprocess.run(
        ["gcc", "-fpreprocessed", "-dD", "-E", "-P",
         *sorted(Path("tests").rglob("test_*.c"))],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        check=True).stdout
    return set(re.findall(r"^TEST\(([a-z0-9_]+)\)", text, re.M))


DOCUMENTS = ["README.md", "DESIGN.md"] + [f"docs/{name}.md" for name in (
    "FMU", "HIL", "PACKAGES", "PAGE", "PAPER", "PORTS", "PROTOCOL",
    "SWEEPS", "VERIFICATION")]
QUOTED = re.compile(
    r"\d[\d ]*(?:\.\d+)?(?: million)? (?:instructions|B of stack|tests in C)")


def quotations(text):
    """Figures of cost and of numbers of tests that a text quotes."""
    return QUOTED.findall(" ".join(text.split()))


def judge_quotations():
    """Every document, and first what is planted."""
    planted = ("A step takes 2300\ninstructions, 4.1 million instructions and "
               "504 B of stack; 12 tests in C. Twice the instructions.")
    if len(quotations(planted)) != 4:
        wrong(f"of four planted figures {quotations(planted)} are found")
    for name in DOCUMENTS:
        for figure in quotations(Path(name).read_text()):
            wrong(f"{name}: \"{figure}\" changes with the core: name the "
                  "command or the report that has it")


def corpus():
    return sum(len(list(Path("tests").glob(pattern))) for pattern in
               ("corpus/*/*", "regress/crash-*"))


def in_file(path, pattern):
    """The one number that a file has there."""
    found = re.findall(pattern, Path(path).read_text())
    return int(float(found[0])) if len(found) == 1 else None


# Rows of the table "By number" whose figure is written in the tree: the words
# that begin the row, and the figure. The check `hostile` runs two seeds in two
# real types.
FIGURES = {
    "bad input: kept by fuzzing": corpus,
    "frames: hostile": lambda: 4 * (in_file(
        "tools/verify/check/hostile.sh", r"HOSTILE_FRAMES:-(\d+)") or 0),
    "frames: over a line": lambda: in_file(
        "tests/unit/link/test_frame.c",
        r"a_million_frames_over_a_bad_line\) \{(?:[^;]*;){4} "
        r"n < samples\((\d+)\);"),
    "frames: nearly": lambda: in_file(
        "tests/line/test_streams.py", r"for _ in range\((\d+)\)\)"),
}


def wrong_figures(text):
    """The rows of that table whose figure is not that of the tree."""
    for begin, figure in FIGURES.items():
        row = re.search(rf"^\| {begin}.*?\| ([\d ]+) \|", text, re.M)
        stated = int(row[1].replace(" ", "")) if row else None
        if stated is None or stated != figure():
            yield f"\"{begin} ...\" has {stated}, the tree has {figure()}"


def unknown_commands(text, checks):
    """Checks and tests that a page's commands name and that are not there."""
    for line in re.findall("`([^`\n]*)`", text):
        for names in re.findall(r"\bCHECKS=(?:'([^']*)'|(\S+))", line):
            yield from set("".join(names).split()) - checks - {"NAME", "..."}
        for names in re.findall(r"\bTESTS=(?:'([^']*)'|(\S+))", line):
            yield from (name for name in "".join(names).split()
                        if not Path(name).is_file())


def judge_numbers():
    """The page, and first one with planted mistakes."""
    page = Path("docs/VERIFICATION.md").read_text()
    checks = set(re.findall(r"^([a-z-]+) +[a-z_]+\.(?:sh|py)\b",
                            Path("tools/verify/check/run").read_text(), re.M))
    planted = "`make check CHECKS='bits none'` `make test TESTS=tests/x.c`"
    if sorted(unknown_commands(planted, checks)) != ["none", "tests/x.c"]:
        wrong("two planted commands are not found")
    if len(list(wrong_figures(re.sub(r"\| (\d)([\d ]*) \|", r"| \g<1>1\2 |",
                                     page)))) != len(FIGURES):
        wrong("figures with a digit too many are not found")
    for name in unknown_commands(page, checks):
        wrong(f"docs/VERIFICATION.md: there is no {name}")
    for figure in wrong_figures(page):
        wrong(f"docs/VERIFICATION.md: {figure}")


def judge_seeds():
    """A row that is missing, one out of place and an empty one are found."""
    rows = [f"/// {row} x" for row in ROWS]
    for planted, count in ((rows, 0), (rows[1:], 1), (rows[:-1], 2),
                           (rows[1:2] + rows[:1] + rows[2:], 1),
                           (rows[:-1] + ["/// Claims:"], 1)):
        with tempfile.NamedTemporaryFile("w", suffix=".h") as seed:
            seed.write("\n".join(planted + ["TF_API int tf_seed(int n);", ""]))
            seed.flush()
            found, _ = judge(next(functions_of(seed.name)))
        if len(found) != count:
            wrong(f"planted rows are judged {found}, not {count} times wrong")


need("gcc", "gcc")
judge_seeds()
judge_quotations()
judge_numbers()
functions, wanted = public_functions(), {}
for function in functions:
    said, names = judge(function)
    for one in said:
        wrong(one)
    for name in names:
        wanted.setdefault(name, f"{function.file}:{function.line}")
if not functions:
    wrong("there are no public functions")
for name in sorted(set(wanted) - tests_that_run()):
    wrong(f"{wanted[name]}: no test is run as {name}")
checked(f"{len(functions)} functions, {len(wanted)} claims, each held up by a "
        f"test; no figure of cost in {len(DOCUMENTS)} documents; "
        f"{len(FIGURES)} numbers of what was tried; planted rows and figures "
        "are judged right")
