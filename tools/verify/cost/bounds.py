#!/usr/bin/python3 -B
"""The worst calls of the public functions: docs/bench/worst.csv has the
figures, worst.double and worst.float beside this script the calls.

    bounds.py    searches in both real types from the kept calls on, counts the
                 steps on boards, asks check `stack`, and makes BUILD/bounds/
                 (`make bounds`; `make keep-bounds` keeps it)

The calls are lines "name units instructions genes", which the search counts
again and goes on from. Environment: BUILD EVALUATIONS.
"""
from __future__ import annotations

import os
import random
import re
import subprocess
import sys
from pathlib import Path
from typing import Dict

import pandas

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/bench")]
import driven  # noqa: E402
from boards import Board, Firmware, plugin  # noqa: E402

REALS = "double", "float"
BOARDS = {"M4F float": "stm32f405", "M7 double": "mps2-an500",
          "M7 float": "mps2-an500"}
KEY = ["name", "units"]
ROW = ["function", "of"]
Genes = Dict[int, int]
GENES, PARAMETERS = 54, 21  # see subject.h
BEST, ROUND = 32, 100  # what a round of the search begins with, and its trials
WEIGHTS = {"tf_step": 8, "tf_step_compensated": 4, "tf_step_located": 4}
# The units of tf_step, see cost.c.
CLASSES = "one sign of g", "both signs of g", "near h = g = 0", "rest"
# What a call may take more, and a kept figure may be above it, without being
# wrong: compilers differ, and a search finds a little more each time.
SLACK, STALE = 1.1, 1.25


def most(path: Path) -> pandas.Series:
    """The count by name and units, in the order of a file of calls."""
    return pandas.read_csv(path, sep=" ", names=[*KEY, "count", "genes"],
                           index_col=KEY)["count"]


def named(found: pandas.DataFrame | pandas.Series):
    """With the rows of the table in the place of name and units."""
    of = [CLASSES[n] if name == "tf_step" else f"n = {n}" if n else ""
          for name, n in found.index]
    return found.set_axis(pandas.MultiIndex.from_arrays(
        [found.index.get_level_values(0), of], names=ROW))


def table(place: Path, depth: pandas.DataFrame,
          on_boards: pandas.DataFrame) -> pandas.DataFrame:
    """The table of the calls in a folder, of their steps on boards, and of the
    stack, functions by targets; functions without a call are plain."""
    found = pandas.DataFrame({f"x86-64 {real}": most(place / f"worst.{real}")
                              for real in REALS})
    found = named(found.join(on_boards)).astype("Int64").reset_index("of")
    found = pandas.concat(
        [found, pandas.DataFrame(index=depth.index.difference(found.index))])
    for target in sorted(depth, reverse=True):
        found[f"stack {target}"] = depth[target]
    return found.rename_axis("function")


def kept() -> pandas.DataFrame:
    """The table that is kept."""
    return pandas.read_csv(ROOT / "docs/bench/worst.csv", comment="#").fillna(
        {"of": ""}).set_index(ROW)


class Calls:
    """The program that counts, in one real type; SEEDS are the genes of both,
    for what is expensive in one may be in the other."""

    def __init__(self, build: Path, real: str, calls: Path) -> None:
        self.command = [build / real / "cost"]
        lines = [line.split() for one in REALS for line in
                 (calls / f"worst.{one}").read_text("utf-8").splitlines()]
        self.rows = dict.fromkeys((name, units) for name, units, *_ in lines)
        self.seeds = [{int(i): int(gene, 16) for i, gene in
                       re.findall(r"(\d+):(\w+)", line[3])} for line in lines]

    def counts(self, row: tuple[str, str], tries: list[Genes]) -> list[int]:
        """Instructions of a function with so many units, for some genes."""
        return [int(count) for count in self.said(
            [], [(row, genes) for genes in tries]).split()]

    def said(self, words: list[str], calls: list) -> str:
        return subprocess.run(
            [*self.command, *words], text=True, check=True, input="".join(
                f"{' '.join(row)} {spelled(genes)}\n" for row, genes in calls),
            stdout=subprocess.PIPE).stdout

    def constants(self) -> str:
        """What all seeds are to a step of each class and budget."""
        return self.said(["constants"], [
            (row, genes) for row in self.rows for genes in self.seeds
            if row[0] in ("tf_step", "tf_step_located")])

    def searched(self, row: tuple[str, str], evaluations: int
                 ) -> tuple[int, Genes]:
        """The most expensive call that a search finds: the seeds, a quarter of
        the evaluations at random, then changes of the best. What is no better
        but not worse takes their place: the count is a staircase, and its
        plateaus are walked along."""
        dice = random.Random(" ".join(row))
        best = [(count, genes) for count, genes in zip(
            self.counts(row, self.seeds), self.seeds)]
        size = ROUND * WEIGHTS.get(row[0], 1)
        rounds = -(-evaluations // ROUND)
        for n in range(rounds):
            best = sorted(best, key=lambda one: one[0])[-BEST:]
            tries = [changed(best, dice) if 4 * n >= rounds else drawn(dice)
                     for _ in range(size)]
            best += zip(self.counts(row, tries), tries)
        count, genes = max(best, key=lambda one: one[0])
        for i in list(genes):  # those that it does not hang on go
            fewer = {j: gene for j, gene in genes.items() if j != i}
            if evaluations > ROUND and (now := self.counts(row, [fewer])[0]
                                        ) >= count:
                count, genes = now, fewer
        return count, genes

    def search(self, evaluations: int) -> str:
        """Lines "name units instructions genes"."""
        found = driven.side_by_side(
            lambda row: (row, *self.searched(row, evaluations)), self.rows)
        return "".join(f"{' '.join(row)} {count} {spelled(genes)}\n"
                       for row, count, genes in found)


def spelled(genes: Genes) -> str:
    return ",".join(f"{i}:{gene:x}" for i, gene in sorted(genes.items())
                    if gene) or "-"


def drawn(dice: random.Random) -> Genes:
    """Few parameters off a scene at once, or nothing would be near anything."""
    genes = {i: dice.getrandbits(32) for i in range(GENES)}
    if dice.random() < .5:
        genes.update((i, genes[i] & ~7) for i in range(PARAMETERS)
                     if dice.random() < .75)
    return genes


def changed(best: list[tuple[int, Genes]], dice: random.Random) -> Genes:
    """One of the best with a few genes changed, or of another one."""
    genes, other = (dict(dice.choice(best)[1]) for _ in range(2))
    if dice.random() < 1 / 8:
        genes.update({i: gene for i, gene in other.items()
                      if dice.random() < .5})
    for _ in range(dice.randrange(1, 5)):
        i = dice.randrange(GENES)
        was = genes.get(i, 0)
        genes[i] = dice.choice((
            dice.getrandbits(32), was ^ 1 << dice.randrange(8),
            was + (dice.choice((1, -1)) << dice.randrange(8, 28)) & 2**32 - 1,
            was ^ 1 << dice.randrange(8, 32), other.get(i, 0)))
    return genes


def emulate(build: Path, calls: Path) -> pandas.DataFrame:
    """Instructions of steps, by boards: the dearest of all kept calls as a step
    of that class, or within that budget."""
    counter, found = plugin(), {}
    for column, board in BOARDS.items():
        real = column.split()[-1]
        one = Firmware(Board(board), real, "generic")
        constants = Calls(build, real, calls).constants()
        one.place.mkdir(parents=True, exist_ok=True)
        (one.place / "calls.inc").write_text(constants, "utf-8")
        (one.place / "calls.elf").unlink(missing_ok=True)
        names = re.findall(r"^{ // (\w+) (\d+)$", constants, re.M)
        counts = one.counted(counter, "calls", "SCHEME=located")
        if counts is None or len(counts[0]) != len(names):
            sys.exit(f"{one}: a call does not what it does on x86-64, or "
                     "nothing was counted")
        rows = pandas.DataFrame(names, columns=KEY).astype({"units": int})
        found[column] = rows.assign(count=counts[0]).groupby(KEY)["count"].max()
    return pandas.DataFrame(found)


def search(build: Path, evaluations: int) -> None:
    """Makes BUILD/bounds/."""
    place = build / "bounds"
    place.mkdir(parents=True, exist_ok=True)
    for real in REALS:
        print(f"{real}: {evaluations} calls of each function ...",
              file=sys.stderr)
        (place / f"worst.{real}").write_text(
            Calls(build, real, HERE).search(evaluations), "utf-8")
    print("boards ...", file=sys.stderr)
    on_boards = emulate(build, place)
    print("stack ...", file=sys.stderr)
    # What is kept may be out of date, which is what this is for.
    subprocess.run([ROOT / "tools/verify/check/stack.py"], check=False,
                   stdout=subprocess.DEVNULL,
                   env={**os.environ, "BUILD": str(build / "check"),
                        "FULL": "yes"})
    depth = pandas.read_csv(build / "check/worst.stack", index_col="function")
    core = subprocess.run([ROOT / "tools/stamp", "core"], text=True,
                          stdout=subprocess.PIPE, check=True).stdout.strip()
    (place / "worst.csv").write_text(
        f"# {core}\n{table(place, depth, on_boards).to_csv()}", "utf-8")
    print(f"The table is {place}/worst.csv.")


def main() -> None:
    text = os.environ.get("EVALUATIONS") or "100000"
    if not text.isdigit() or int(text) == 0:
        print(f"make bounds: EVALUATIONS={text}: a whole number > 0",
              file=sys.stderr)
        sys.exit(2)
    search(Path(os.environ.get("BUILD") or "build"), int(text))


if __name__ == "__main__":
    main()
