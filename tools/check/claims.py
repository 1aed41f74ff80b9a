#!/usr/bin/python3
"""Public functions say all that they promise, row by row, and every test that
a promise names is run. Kernels claim in prose: only the rows are a contract."""
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
    return set(re.findall(r"^ *RUN\(([a-z0-9_]+)\);", text, re.M))


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
        "test; planted rows are judged right")
