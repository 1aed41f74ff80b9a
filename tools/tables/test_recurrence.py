#!/usr/bin/python3 -B
"""Tests of `make recurrence`, on few machines.

usage: TWOFOLD=build/double/twofold test_recurrence.py [unittest option]...
"""
from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

TOOLS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS), str(TOOLS / "study/recurrence")]
import machines  # noqa: E402
import regions  # noqa: E402
import resonance  # noqa: E402

FEW = 104


class Recurrence(unittest.TestCase):
    """A few machines, all passes."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        build = Path(cls.folder.name)
        (build / "double").mkdir()
        (build / "double/twofold").symlink_to(
            Path(os.environ["TWOFOLD"]).resolve())
        cls.environment = dict(os.environ, BUILD=str(build), SIDE="5",
                               MACHINES=str(FEW), DESIGNS="2")
        cls.work = build / "recurrence"
        cls.run_it()
        cls.table = cls.work / "recurrence.csv"
        with cls.table.open(encoding="ascii") as file:
            cls.rows = list(csv.DictReader(
                line for line in file if line[0] != "#"))
        cls.followed = [row for row in cls.rows if not row["reason"]]

    @classmethod
    def run_it(cls, *words: str) -> str:
        return subprocess.run(
            [TOOLS / "study/recurrence/recurrence", *words], check=True, text=True,
            env=cls.environment, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE).stdout

    def test_page_tells_of_all_machines(self):
        """All are counted; the basins are there."""
        text = (self.work / "RECURRENCE.md").read_text("utf-8")
        self.assertEqual(len(self.rows), FEW)
        for title, count in ("figure 4", 52), ("at random", 26):
            self.assertIn(f"| {title} | random | {count} |", text)
        self.assertIn("| h = -0.05 m/s | 25 | 0.", text)

    def test_parts_are_made_once(self):
        """A run that was killed goes on with what is not whole, and gives the
        same rows."""
        before = self.table.read_bytes()
        first, second = self.work / "1.csv", self.work / "2.csv"
        made = first.stat().st_mtime_ns
        second.write_bytes(second.read_bytes()[:-9])
        self.run_it()
        self.assertEqual(first.stat().st_mtime_ns, made)
        self.assertEqual(self.table.read_bytes(), before)

    def test_damaged_rows_are_refused(self):
        """Of a table that lacks one no page is made."""
        cut = self.table.read_text("ascii").splitlines(keepends=True)
        damaged = self.work / "damaged.csv"
        damaged.write_text("".join(cut[:50] + cut[51:]), "ascii")
        done = subprocess.run(
            [TOOLS / "study/recurrence/report.py", damaged, self.work / "no.png"],
            check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True)
        self.assertIn("is damaged", done.stdout)
        self.assertNotEqual(done.returncode, 0)

    def test_long_pass_is_of_those_that_lost_nothing(self):
        """And every cycle has one ending."""
        self.assertGreater(len(self.followed), 20)
        for row in self.followed:
            count = {name: [int(row[f"{name}_{end}"])
                            for end in machines.ENDINGS]
                     for name in machines.PASSES}
            for name, run in machines.PASSES.items():
                self.assertLessEqual(int(row[f"{name}_late"]), count[name][0])
                followed = machines.is_followed(name, count.__getitem__)
                self.assertEqual(sum(count[name]) >= run.samples, followed)
                self.assertLessEqual(sum(count[name]), run.all_cycles())

    def test_seeds_are_own(self):
        """No run of any machine shares one."""
        seeds = [machines.seed_of(number, name) for number in range(FEW)
                 for name in machines.PASSES]
        self.assertEqual(len(set(seeds)), len(seeds))
        for row in self.followed:
            self.assertEqual(int(row["seed"]), machines.seed_of(
                int(row["machine"]), "random"))

    def test_printed_commands_give_the_row(self):
        """Those of a machine, as a user would type them."""
        for row in self.followed[:2]:
            said = self.run_it("machine", row["machine"]).splitlines()
            self.assertEqual(said[1].split(","), list(row.values()))
            done = subprocess.run(
                said[2].split() + ["--returns", "-"], check=True, text=True,
                cwd=TOOLS.parent, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE)
            self.assertEqual(done.stdout.count(",returned,"),
                             int(row["random_returned"]))


class Grid(unittest.TestCase):
    """Machines by number."""

    def test_each_design_has_a_cell_of_its_own(self):
        """All cells are in the grid, and no more than a row is left over."""
        for name in "designs", "near":
            cells = [machines.cell(number, name, 1000) for number in range(
                1000) if machines.space_of(number) == name]
            side = machines.side(name, 1000)
            self.assertEqual(len(set(cells)), len(cells))
            self.assertLess(max(max(cell) for cell in cells), side)
            self.assertGreater(len(cells), side * (side - 2))

    def test_figure_4_is_covered(self):
        """From one end to the other along both axes."""
        total = machines.MACHINES
        places = [machines.drawn(number)[1:3] for number in (0, total - 5)]
        (low, high), (slow, fast) = machines.SPACES["designs"].window
        self.assertLess(places[0][0] - low, 0.02 * (high - low))
        self.assertLess(places[0][1] - slow, 0.02 * (fast - slow))
        self.assertGreater(places[1][1] - slow, 0.97 * (fast - slow))


class Resonance(unittest.TestCase):
    """Planted shares."""

    @staticmethod
    def planted(share, n=20000):
        random = np.random.default_rng(1)
        ratios = random.uniform(2.5, 10.5, n)
        hits = random.random(n) < share(ratios)
        found = [resonance.count(list(zip(ratios, hits)), whole)
                 for whole in resonance.WHOLE]
        return resonance.together(found), resonance.difference(found)

    def test_a_resonance_is_seen(self):
        """Twice as many near whole numbers."""
        p, found = self.planted(lambda ratio: np.where(
            abs(ratio - np.round(ratio)) < 0.05, 0.2, 0.1))
        self.assertLess(p, 1e-6)
        self.assertLess(abs(found.value - 0.1), 0.03)

    def test_a_trend_is_none(self):
        """A share that falls with the ratio."""
        p, found = self.planted(lambda ratio: 1 - ratio / 11)
        self.assertGreater(p, 0.01)
        self.assertTrue(found.low < 0 < found.high)


    def test_none_of_few_is_no_certainty(self):
        """Where none is counted the difference has an interval."""
        found = resonance.difference([resonance.Count(0, 10, 0, 40)])
        self.assertEqual(found.value, 0)
        self.assertGreater(found.high, 0.1)


class Passes(unittest.TestCase):
    """Which machine is followed where."""

    def test_those_who_lose_some_are_waited_for(self):
        """Some, in either pass; of the other kind of exit it says nothing."""
        def waits(random, long, noise=(0, 0)):
            found = {"random": random, "random_long": long, "noise": noise,
                     "noise_long": (0, 0)}
            return machines.is_followed("random_wait", found.__getitem__)
        self.assertTrue(waits((48, 1), (0, 0)))
        self.assertTrue(waits((50, 0), (499, 1)))
        self.assertFalse(waits((50, 0), (500, 0), (3, 5)))
        self.assertFalse(waits((0, 10), (0, 0), (9, 1)))


class Regions(unittest.TestCase):
    """Cells that touch."""

    def test_sides_and_corners(self):
        """Five cells in a crooked line, and two apart from it."""
        cells = [(4, 4), (0, 0), (0, 1), (1, 2), (5, 4), (2, 3), (3, 2)]
        self.assertEqual(regions.regions(cells), [[1, 2, 3, 5, 6], [0, 4]])
        self.assertEqual(regions.regions([]), [])


if __name__ == "__main__":
    unittest.main()
