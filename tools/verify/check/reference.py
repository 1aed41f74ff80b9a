#!/usr/bin/python3
"""The independent solver (tests/reference) builds, agrees with the paper's
equations, with itself at two tolerances and with SUNDIALS, and finds at most
3 % silently wrong of all runs of a few hundred machines. Inputs move in every
other one; docs/SCHEMES.md has thousands. In a mirror each ends mirrored."""
import re
import sys

from findings import asked, checked, in_common, need, place_of, wrong

MOST = .03  # of all runs of the table
# A small table, of which every class has lines: classes, their steps, machines.
TABLE = [("A A8 D E H I J", "1e-3,1e-4", 20), ("A'", "8e-3,4e-3,2e-3", 20),
         ("B", "1e-3", 5), ("C", "1e-3", 10), ("F", "1e-4,1e-5", 20),
         ("G", "1e-6", 4), ("K", "1,0.1", 20)]
LINE = re.compile(r"  (?:\S+ +){4}(\d+) +\d+ +(\d+)(?: +\d+){4} +(\d+) .*")
WORST = 1e-7  # of 40 machines on inputs that move, from SUNDIALS


def reference(*words):
    return asked(place_of("gcc", "-O3") / "reference/reference", *words)


def judge_table(name, steps, machines):
    """Returns how many runs a class of the table has, how many of them are
    silently wrong, and of how many the mirror image ends elsewhere."""
    said, code = reference("table", "--class", name, "--dt", steps,
                           "--machines", machines, "--show", 0)
    lines = [line for line in map(LINE.fullmatch, said.splitlines()) if line]
    runs, *bad = (sum(int(line[i]) for line in lines) for i in (1, 2, 3))
    if code or not runs:
        wrong(f"reference table, class {name}: code {code}, {runs} runs")
    return runs, *bad


need("gcc", "gcc")
if not in_common("gcc", "-O3", "reference"):
    wrong("make reference: it does not build, or is off the paper or itself")
    checked("nothing")
kinds = [(name, *row[1:]) for row in TABLE for name in row[0].split()]
judged, silent, parted = map(sum, zip(*(judge_table(*kind) for kind in kinds)))
if silent > MOST * judged or parted:
    wrong(f"reference table: {silent} of {judged} runs are silently wrong, "
          f"{parted} end elsewhere in a mirror")
second, failed = reference("second", "--machines", 40)
if failed == 3:
    print(second, end="")
    sys.exit(3)
worst = re.search(r"^worst (.*)", second, re.M)
if failed or not worst or not float(worst[1]) < WORST:
    wrong(f"reference second: {second}")
checked(f"{judged} runs of {len(kinds)} classes of the table; SUNDIALS is "
        f"{worst[1] if worst else 'not'} apart at most")
