#!/usr/bin/python3 -B
"""Tests of tools/study/finer at small size: its integrator converges to the motion of
the core's law `smooth`, and the layer next to the two-fold is as theory says.

usage: TWOFOLD=build/double/twofold test_finer.py [unittest option]...
"""
from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "study"))
from finer import families, report, theory
from tables import read

FINER = Path(__file__).resolve().parents[1] / "study/finer"


class Finer(unittest.TestCase):
    """Runs of the tool in x87's long double."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.twofold = os.environ["TWOFOLD"]
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        Path(cls.folder.name, "finer").mkdir()
        subprocess.run(
            ["gcc", "-std=c99", "-O2", "-DFINER_BITS=64",
             *map(str, sorted(FINER.glob("*.c"))), "-o",
             f"{cls.folder.name}/finer/finer-64", "-lm"], check=True)
        cls.fold = theory.TwoFold(cls.twofold)

    def run_one(self, *words: str) -> dict[str, str]:
        """The columns of one motion."""
        said = subprocess.run(
            [f"{self.folder.name}/finer/finer-64", *words], check=True,
            text=True, stdout=subprocess.PIPE).stdout.splitlines()
        return dict(zip(said[0].split(","), said[1].split(",")))

    def test_order(self):
        """Two columns are of order 4, three of order 6."""
        slip = ("form=tanh", "width=0.2", "r=0.3", "w=-0.6", "x=1", "fold=-1",
                "until=0.2")
        exact = float(self.run_one(*slip)["v"])
        for columns, order in (2, 4), (3, 6):
            errors = [abs(float(self.run_one(
                *slip, f"step={step}", f"columns={columns}")["v"]) - exact)
                for step in (0.02, 0.01)]
            self.assertAlmostEqual(math.log2(errors[0] / errors[1]), order,
                                   delta=0.5)

    def test_core(self):
        """The core's law `smooth` comes to the same motion, at order 2."""
        errors = [error for _, error in families.core_agreement(
            self.twofold, self.folder.name)]
        self.assertLess(errors[-1], 1e-7)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(coarse / fine, 4, delta=0.05)

    def test_contraction(self):
        """Width times contraction tends to C of the set-valued stick."""
        C = theory.contraction(self.twofold, "algebraic", self.folder.name)
        far, near = (
            -float(self.run_one(f"width={width}", "until=0.13")["before"])
            * width / C - 1 for width in (1e-5, 1e-6))
        self.assertLess(abs(near), 0.005)
        self.assertAlmostEqual(far / near, 10, delta=2)

    def test_growth(self):
        """A kick at the two-fold leaves where Kummer's function says."""
        width = self.fold.width("algebraic", 1e-7)
        for kick in 1e-13, 1e-15:
            found = self.run_one(f"width={width}", f"kick={kick}")
            want = self.fold.exponent(theory.EXIT * 1e-7 / kick)
            self.assertAlmostEqual(float(found["behind"]), want,
                                   delta=0.03 * want)

    def test_starts(self):
        """What the start was is forgotten at the two-fold, not a kick."""
        plain, moved, kicked = (
            float(self.run_one("width=1e-5", word)["exit_r"])
            for word in ("x=0", "w=-1.0533", "kick=1e-10"))
        self.assertLess(abs(moved - plain), 1e-6)
        self.assertGreater(abs(kicked - plain), 2e-4)

    def test_names(self):
        """A name that is none is told."""
        said = subprocess.run(
            [f"{self.folder.name}/finer/finer-64", "colour=1"], check=False,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((said.returncode, said.stdout), (2, ""))
        self.assertIn("colour=1", said.stderr)


class Words(unittest.TestCase):
    """What the page says of its tables."""

    def test_excess_of_the_kicks(self):
        """Over all but the least one, and at that; of one that is too large
        nothing is predicted."""
        study = report.Study.__new__(report.Study)
        study.kick_exponents = lambda: [
            ("1e-06", read.Row("", ("kick", "behind"), (kick, behind)), want)
            for kick, behind, want in (("1e-8", "9.94", None),
                                       ("1e-17", "46.9", 44.57),
                                       ("1e-20", "59.87", 52.99),
                                       ("1e-13", "28.52", 28.39))]
        self.assertEqual({name: round(value, 21 if name == "kick_least" else 1)
                          for name, value in study.excess().items()},
                         {"kick_least": 1e-20, "kick_last": 13.0,
                          "kick_low": 0.5, "kick_high": 5.2})


if __name__ == "__main__":
    unittest.main()
