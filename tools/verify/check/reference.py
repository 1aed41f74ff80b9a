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
    ("branch", ["--machines", 150, "--seed", 7], "wrong, all steps OK", .01),
    ("path", ["--machines", 300], "off, all OK", .01),
    ("energy", ["--machines", 200], "runs: 1e-2 in all", .01),
    ("impulses", ["--machines", 200, "--seed", 2], r"\d: 10 % off, all OK",
     .01),
]
# A small table: class, its steps, machines, and the most that may be silently
# wrong in one of its lines, with the reason for what is left; None: no bound.
TABLE = [
    ("A", "1e-3,1e-4", 20, None, ""),
    ("A8", "1e-3,1e-4", 20, None, ""),
    ("A'", "8e-3,4e-3,2e-3", 20, None, ""),
    ("B", "1e-3", 5, None, ""),
    ("C", "1e-3", 10, None, ""),
    ("D", "1e-3,1e-4", 20, None, ""),
    ("E", "1e-3,1e-4", 20, None, ""),
    ("F", "1e-4,1e-5", 20, None, ""),
    ("G", "1e-6", 4, None, ""),
    ("H", "1e-3,1e-4", 20, None, ""),
    ("I", "1e-3,1e-4", 20, None, ""),
    ("J", "1e-3,1e-4", 20, None, ""),
    ("K", "1,0.1", 20, None, ""),
]
LINE = re.compile(r"  (\S+ +\S+ +\S+ +\S+) +(\d+) +\d+ +(\d+) .*")
WORST = 1e-7  # of 40 machines on inputs that move, from SUNDIALS
ROW = re.compile(r"(.*?) +(\d+) of +(\d+)(?: .*)?")


def judge_table(program):
    """Compares the table with its bounds; returns how many runs it judged."""
    judged = 0
    for name, steps, machines, most, why in TABLE:
        done = subprocess.run(
            [program, "table", "--class", name, "--dt", steps, "--machines",
             str(machines), "--show", "0"], text=True, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, check=False)
        lines = [LINE.fullmatch(line) for line in done.stdout.splitlines()]
        lines = [line for line in lines if line and int(line[2])]
        if done.returncode or not lines:
            wrong(f"reference table, class {name}: code {done.returncode}, "
                  f"{len(lines)} lines")
        for line in lines:
            judged += int(line[2])
            if most is not None and int(line[3]) > most:
                wrong(f"reference table: {line[1]}: {line[3]} of {line[2]} "
                      f"silently wrong, at most {most} allowed ({why})")
    return judged


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
    judged += judge_table(place / "reference/reference")
    done = subprocess.run([place / "reference/reference", "second",
                           "--machines", "40"], text=True,
                          stdout=subprocess.PIPE, check=False)
    if done.returncode == 3:
        print(done.stdout, end="")
        sys.exit(3)
    worst = re.search(r"^worst (.*)", done.stdout, re.M)
    if done.returncode or not worst or not float(worst[1]) < WORST:
        wrong(f"reference second: {done.stdout}")
    checked(f"{judged} steps and motions of {len(CLASSES)} kinds and of "
            f"{len(TABLE)} classes of the table; SUNDIALS is "
            f"{worst[1] if worst else 'not'} apart at most")


main()
