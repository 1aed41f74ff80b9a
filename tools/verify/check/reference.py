#!/usr/bin/python3
"""The independent solver (tests/reference) builds, agrees with the paper's
equations, with tests/data and with SUNDIALS, and finds no more wrong steps that
say TF_OK among a few hundred random machines, of which every other one of
`path` is driven, than docs/VERIFICATION.md has among thousands: at most 1 % of
a row."""
import re
import subprocess
import sys

from findings import BUILD, build, checked, need, wrong

# Class, its options, and the rows that count what no step may do.
CLASSES = [
    ("rest-law", ["--machines", 300], "none under the hexagon", 0),
    ("branch", ["--machines", 150, "--seed", 7], "wrong, all steps OK", .01),
    ("path", ["--machines", 300], "off, all OK", .01),
    ("energy", ["--machines", 200], "runs: 1e-2 in all", .01),
    ("impulses", ["--machines", 200, "--seed", 2], r"\d: 10 % off, all OK",
     .01),
    ("standing", ["--machines", 60, "--seed", 2], "in silence", .01),
]
WORST = 1e-7  # of 40 machines, 20 of them driven, from SUNDIALS
ROW = re.compile(r"(.*?) +(\d+) of +(\d+)(?: .*)?")


def main():
    need("gcc", "gcc")
    place = BUILD / "reference"
    if not build("CC=gcc", "OPT=-O2", f"BUILD={place}", "EXTRA=-Werror",
                 "reference"):
        wrong("make reference: it does not build, or is off the paper or "
              "tests/data")
        checked("nothing")
    judged = 0
    for name, options, what, most in CLASSES:
        command = [place / "reference/reference", name, "--show", 0, *options]
        done = subprocess.run([str(word) for word in command], text=True,
                              stdout=subprocess.PIPE, check=False)
        rows = [ROW.fullmatch(line) for line in done.stdout.splitlines()]
        rows = [row for row in rows if row and re.search(what, row[1])]
        if done.returncode or not rows:
            wrong(f"reference {name}: code {done.returncode}, "
                  f"{len(rows)} rows of \"{what}\"")
        for row in rows:
            count, of = int(row[2]), int(row[3])
            judged += of
            if count > most * of:
                wrong(f"reference {name}: {row[1]}: {count} of {of}, "
                      f"at most {most * of:g} allowed")
    done = subprocess.run([place / "reference/reference", "second",
                           "--machines", "40"], text=True,
                          stdout=subprocess.PIPE, check=False)
    if done.returncode == 3:
        print(done.stdout, end="")
        sys.exit(3)
    worst = re.search(r"^worst (.*)", done.stdout, re.M)
    if done.returncode or not worst or not float(worst[1]) < WORST:
        wrong(f"reference second: {done.stdout}")
    checked(f"{judged} steps and motions of {len(CLASSES)} classes; SUNDIALS "
            f"is {worst[1] if worst else 'not'} apart at most")


main()
