#!/usr/bin/python3 -B
"""Tests of the figures, on small data that check `figures` has made.

usage: FIGURES=FOLDER test_figures.py [unittest option]...

FOLDER has the data and the pictures. A column that is added to a file changes
no picture; one that is gone or has another name is an error of every reader.
"""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
MADE = Path(os.environ["FIGURES"])
# What reads each file of the command line, and the columns that it reads. A
# reader is a figure of curves.py or, with .gp, a script of gnuplot.
BRANCHES = "branches.csv"
READERS = {
    "atlas.gp": {"atlas.csv": (
        "r omega overlap K--_positive K++_negative J1_negative J2_negative "
        "J1J2_above_1 k2_positive kappa_positive")},
    "regions.gp": {"regions.csv": "r omega region"},
    "perturbations.gp": {"returns-random.csv": "outcome"},
    "exits": {"exits-random.csv": "time r side phase",
              BRANCHES: "mode stick_time exit_r"},
    "regions": {BRANCHES: "mode exit_r exit_omega"},
    "normal": {BRANCHES: "r omega stick_time exit_r exit_omega"},
    "perturbations": {"exits-noise.csv": "time",
                      "returns-noise.csv": "outcome time landing_r"},
    "return": {"exits-random.csv": "time",
               "returns-random.csv": "landing_r time landings",
               BRANCHES: "stick_time mode end end_r exit_r"},
}
TRAILER = re.compile(
    rb"# shard 1/1: (\d+) rows, crc32 ([0-9a-f]{8})(, run [0-9a-f]{8}\n)")


def counted(data: bytes) -> bytes:
    """A file with the trailer that its rows ask for now."""
    found = TRAILER.search(data)
    if not found:
        return data
    rows = data[:found.start()]
    return rows + b"# shard 1/1: %s rows, crc32 %08x%s" % (
        found[1], zlib.crc32(rows), found[3])


def with_column(data: bytes) -> bytes:
    """A file with another column in front."""
    lines = data.splitlines(keepends=True)
    return counted(b"".join(
        line if line.startswith(b"#") else
        (b"another," if i == 0 else b"7,") + line
        for i, line in enumerate(lines)))


def renamed(data: bytes, column: str) -> bytes:
    """A file in which a column has another name."""
    header, rest = data.split(b"\n", 1)
    names = header.decode().split(",")
    names[names.index(column)] += "_"
    return counted(",".join(names).encode() + b"\n" + rest)


class Figures(unittest.TestCase):
    """A copy of the data that each test changes."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for path in MADE.iterdir():
            if path.suffix in (".csv", ".dat"):
                shutil.copy(path, self.folder)

    def draw(self, script: Path, name: str, *settings: str) -> list[str]:
        """What panels.py says of a picture that is drawn anew."""
        out = self.folder / f"{name}.svg"
        words = [f"out='{out}'; type='.svg'; data='{self.folder}'", *settings]
        style = [] if settings else [str(HERE / "style.gp")]
        done = subprocess.run(
            ["gnuplot", "-e", "; ".join(words), *style, str(script)],
            check=False, stderr=subprocess.DEVNULL)
        if done.returncode != 0:
            return ["gnuplot fails"]
        return self.judge(out)

    def judge(self, svg: Path) -> list[str]:
        """What panels.py says of a picture."""
        return subprocess.run(
            [str(HERE / "panels.py"), str(svg)], check=False, text=True,
            stdout=subprocess.PIPE).stdout.splitlines()

    def curves(self, figure: str) -> subprocess.CompletedProcess:
        """What curves.py picks for a figure."""
        return subprocess.run(
            [str(HERE / "curves.py"), figure, str(self.folder)], check=False,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def read(self, reader: str) -> str:
        """What a reader makes of the data; empty where it says it is wrong."""
        if reader.endswith(".gp"):
            name = Path(reader).stem
            said = self.draw(HERE / reader, name)
            return "" if said else (self.folder / f"{name}.svg").read_text()
        done = self.curves(reader)
        return done.stdout if done.returncode == 0 else ""

    def test_every_panel_has_marks(self):
        """Of the pictures as they were made."""
        pictures = sorted(MADE.glob("*.svg"))
        self.assertGreaterEqual(len(pictures), 10)
        for svg in pictures:
            self.assertEqual(self.judge(svg), [])

    def test_pictures_of_the_documents(self):
        """Of those that the README shows."""
        csv = self.folder / "chaos.csv"
        self.assertEqual(self.draw(HERE / "chaos.gp", "chaos",
                                   f"csv='{csv}'"), [])

    def test_an_empty_panel(self):
        """One plot without a mark, one panel less, no picture at all."""
        text = (MADE / "return.svg").read_text()
        svg = self.folder / "return.svg"
        first = text.index('<g id="gnuplot_plot_1a"')
        second = text.index('<g id="gnuplot_plot_2a"')
        points = re.compile("<use xlink:href='#gpPt6' transform.*/>")
        for changed in (
                text[:first] + points.sub("", text[first:second]) +
                text[second:], text.replace("gnuplot_plot_3b", "other"),
                text[:len(text) // 2], ""):
            svg.write_text(changed)
            self.assertNotEqual(self.judge(svg), [])
        (self.folder / "unknown.svg").write_text(text)
        self.assertNotEqual(self.judge(self.folder / "unknown.svg"), [])

    def test_a_column_more(self):
        """The same curves and pictures."""
        for reader, files in READERS.items():
            before = self.read(reader)
            self.assertNotEqual(before, "", reader)
            for name in files:
                path = self.folder / name
                kept = path.read_bytes()
                path.write_bytes(with_column(kept))
                self.assertEqual(self.read(reader), before, (reader, name))
                path.write_bytes(kept)

    def test_a_column_of_another_name(self):
        """Each column that is read, of each file: the reader fails."""
        for reader, files in READERS.items():
            for name, columns in files.items():
                path = self.folder / name
                kept = path.read_bytes()
                for column in columns.split():
                    path.write_bytes(renamed(kept, column))
                    self.assertEqual(self.read(reader), "",
                                     f"{reader} reads {name}: {column}")
                path.write_bytes(kept)


if __name__ == "__main__":
    unittest.main()
