#!/usr/bin/python3 -B
"""Tests of scripts that use the package, on small runs of the command line.

usage: TWOFOLD=build/double/twofold test_scripts.py [unittest option]...
"""
from __future__ import annotations

import csv
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[1]


def script(*command: object) -> str:
    """What a script prints."""
    return subprocess.run([str(word) for word in command], check=True,
                          stdout=subprocess.PIPE, text=True).stdout


class Statistics(unittest.TestCase):
    """Exits of `twofold diverge`, of two rates and seeds."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.twofold = os.environ["TWOFOLD"]
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.diverge("one", 200, 3)
        cls.diverge("alike", 200, 8)
        cls.diverge("faster", 300, 8)

    @classmethod
    def file(cls, name: str) -> str:
        """A file of the runs."""
        return str(Path(cls.folder.name, name))

    @classmethod
    def diverge(cls, name: str, rate: int, seed: int) -> None:
        """A run of 1000 samples that end soon behind the two-fold."""
        script(cls.twofold, "diverge", "chaos", "--samples", 1000, "--rate",
               rate, "--patience", 0.2, "--seed", seed, "--exits",
               cls.file(f"{name}-exits"), "--returns",
               cls.file(f"{name}-returns"))

    def p(self, other: str) -> float:
        """The probability that `ks` prints for the times of exit."""
        said = script(TOOLS / "study/statistics/ks.py", self.file("one-exits"),
                      self.file(f"{other}-exits"), "time").split()
        self.assertEqual(said[:4], ["n", "1000", "m", "1000"])
        return float(said[-1])

    def test_one_law_under_two_seeds(self):
        """Their distance is chance."""
        self.assertGreater(self.p("alike"), 1e-3)

    def test_two_rates(self):
        """Their distance is not."""
        self.assertLess(self.p("faster"), 1e-6)

    def test_summary(self):
        """Shares with their intervals."""
        said = script(TOOLS / "study/statistics/summary.py",
                      self.file("one-returns"), self.file("one-exits"))
        self.assertIn("samples 1000, cycles 1000", said)
        self.assertRegex(said, r"outcome timeout +9\d\d  share 0\.9\d+ \[0\.9")
        self.assertRegex(said, r"slip\+ share 0\.[45]\d* \[0\.4")

    def test_passages(self):
        """One line of four a run that wound, in its order."""
        said = script(TOOLS / "study/statistics/passages.py", self.file("one-exits"),
                      self.file("one-returns"), 0).splitlines()
        self.assertLessEqual(len(said), 1000)
        self.assertTrue(all(len(line.split()) == 4 for line in said))

    def test_a_column_that_is_not_there(self):
        """The error names it and the file."""
        said = subprocess.run(
            [str(TOOLS / "study/statistics/ks.py"), self.file("one-exits"),
             self.file("one-exits"), "speed"], stderr=subprocess.PIPE,
            text=True, check=False)
        self.assertEqual(said.returncode, 3)
        self.assertIn("one-exits: there is no column 'speed'", said.stderr)

    def test_a_shard_that_is_missing(self):
        """Every reader of the files of `diverge` refuses what is cut off."""
        for kind in "exits", "returns":
            text = Path(self.file(f"one-{kind}")).read_bytes()
            Path(self.file(f"cut-{kind}")).write_bytes(text[:len(text) // 2])
        exits, returns = self.file("cut-exits"), self.file("cut-returns")
        whole = self.file("one-returns")
        for name, *arguments in (("ks.py", exits, exits, "time"),
                                 ("summary.py", returns),
                                 ("summary.py", whole, exits),
                                 ("passages.py", exits, whole, "0"),
                                 ("passages.py", self.file("one-exits"),
                                  returns, "0")):
            said = subprocess.run(
                [str(TOOLS / "study/statistics" / name), *arguments], check=False,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual((said.returncode, said.stdout), (3, ""), name)
            self.assertIn("cut off", said.stderr)



class Diverge(unittest.TestCase):
    """Cycles of `twofold diverge`, of designs with a two-fold elsewhere."""

    def test_motion_from_the_two_fold_is_no_return(self):
        """A cycle that returns has left the surface: at its start A = 0 has
        the sign of its rounding, which is another one for each r."""
        twofold = os.environ["TWOFOLD"]
        for i in range(16):
            design = json.loads(script(
                twofold, "design", "chaos", "--r", 0.3 + 0.0064197530864 * i,
                "--omega=-1.27"))
            cycles = csv.DictReader(line for line in script(
                twofold, "diverge", "chaos", *design["set"].split(),
                "--samples", 2, "--patience", 1, "--returns",
                "-").splitlines() if line[0] != "#")
            self.assertEqual([cycle for cycle in cycles
                              if cycle["outcome"] == "returned"
                              and not cycle["exit_r"]], [])


if __name__ == "__main__":
    unittest.main()
