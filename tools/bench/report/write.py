#!/usr/bin/python3 -B
"""Writes the report and the pictures, from what `run` has measured.

The report goes to standard output, pictures and CSV files into WORK.
"""
from __future__ import annotations

import argparse
import csv
import re
import sys
from pathlib import Path
from typing import Callable, Iterable, Optional, Sequence

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import markdown, read  # noqa: E402
import costs  # noqa: E402
import digits  # noqa: E402
import figures  # noqa: E402
import pictures  # noqa: E402
import precision  # noqa: E402
import scatter  # noqa: E402
import texts  # noqa: E402
from kilohertz import Kilohertz  # noqa: E402
from step import Ensembles  # noqa: E402

def write_csv(path: Path, columns: Sequence[str],
              rows: Iterable[Sequence[object]]) -> None:
    """A CSV file with a header."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def csv_table(path: Path) -> str:
    """A CSV file as a table."""
    rows = read.read_csv(str(path))
    if not rows:
        raise read.TableError(f"{path}: has no row")
    return markdown.table(list(rows[0]), [row.values() for row in rows])


def processor() -> str:
    """The name of the processor."""
    try:
        told = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return "a processor without a name"
    found = re.search(r"^model name[^:]*: (.*)$", told, re.MULTILINE)
    return found[1] if found else "a processor without a name"


class Report:
    """The folders of a build, and what may stand beside each other."""

    def __init__(self, build: Path, work: Path) -> None:
        self.build, self.work = build, work
        self.stamp = (work / "stamp").read_text(encoding="utf-8").strip()
        self.peers_stamp = "nothing: it is not there"
        self.peers: Optional[str] = None
        path = build / "peers.csv"
        if path.exists():
            with open(path, encoding="utf-8") as file:
                self.peers_stamp = file.readline().lstrip("# ").strip()
        # Peers count only where they were measured at the same commit with
        # the same compiler.
        if self.peers_stamp == self.stamp:
            self.peers = str(path)

    def file(self, name: str) -> str:
        """A file that `run` has left."""
        return str(self.work / name)

    def make_csv(self) -> None:
        """Costs and digits as CSV."""
        write_csv(self.work / "costs.csv", costs.COLUMNS,
                  (row for unit in ("ns", "instructions")
                   for row in costs.rows(self.file(unit), unit)))
        write_csv(self.work / "digits.csv", digits.COLUMNS,
                  digits.rows(self.file("digits")))
        # Where valgrind is missing the steps have not been counted.
        (self.work / "steps").touch()
        (self.work / "kilohertz").touch()

    def picture(self, name: str, text: str,
                draw: Callable[[Path], None]) -> None:
        """Draws a picture and shows it."""
        draw(self.work / f"{name}.svg")
        print(f"\n![{text}](report/{name}.svg)")

    def head(self, seconds: int, opt: str) -> None:
        """What was measured, and the figures."""
        commit, compiler = self.stamp.split("; ", 1)
        print(texts.HEAD.format(seconds=seconds, commit=commit, opt=opt,
                                compiler=compiler, processor=processor()))
        print("## Figures\n")
        for line in figures.tables(self.file("sweep.csv"),
                                   self.file("costs.csv"),
                                   self.file("digits.csv"), self.file("steps"),
                                   self.file("ensemble"),
                                   self.file("kilohertz"), self.peers):
            print(line)

    def precision(self) -> None:
        """Work and precision, and what is after the two-fold."""
        print("\n## Work and precision")
        data = pictures.Data(self.work, self.peers)
        for real in "double", "float":
            self.picture(f"precision-{real}", f"error against time in {real}",
                         lambda out: pictures.precision(data, real, out))
        self.picture("dials", "error against the dial, with slopes",
                     lambda out: pictures.dials(data, out))
        self.picture("events", "times of events, drift",
                     lambda out: pictures.events(data, out))
        for text in precision.tables(self.file("parts.csv"),
                                     self.file("sweep.csv")):
            print(text)
        print(texts.AFTER, end="")
        self.picture("scatter",
                     "distance of distributions after the two-fold",
                     lambda out: scatter.draw(self.work, out))
        print("\n" + csv_table(self.work / "scatter.csv"))

    def costs(self) -> None:
        """What float keeps, and costs."""
        print(texts.DIGITS)
        print(csv_table(self.work / "digits.csv"))
        print(texts.COSTS)
        print(csv_table(self.work / "costs.csv"))
        for note in Path(self.file("notes")).read_text().splitlines():
            print(f"\n* {note}")
        print(texts.KILOHERTZ)
        print(Kilohertz(self.file("kilohertz")).table())
        print("\n## Many states at once\n")
        ensembles = Ensembles(self.file("ensemble"))
        if ensembles.missing:
            print(f"Left out: {ensembles.missing}.")
        else:
            print(texts.ENSEMBLES)
            print(markdown.table(Ensembles.COLUMNS, [
                row.values() for row in ensembles.lines]))
        print("\n## Cost of a step by phase\n")
        steps = Path(self.file("steps")).read_text(encoding="utf-8")
        for line in steps.lstrip("\n").splitlines():
            print(f"    {line}")
        if not steps:
            print("Left out: it needs valgrind (apt-get install valgrind).")

    def beside(self) -> None:
        """Peers and stability."""
        print("\n## Peers\n")
        if self.peers:
            print(texts.PEERS.format(stamp=self.peers_stamp))
            print(figures.peers_table(self.peers))
        else:
            print(texts.NO_PEERS.format(
                stamp=self.peers_stamp or "no commit that it names"), end="")
        print("\n## Stability\n")
        print(texts.STABILITY if (self.build / "STABILITY.md").exists()
              else texts.NO_STABILITY, end="")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=Path, help="folder of what was measured")
    parser.add_argument("--build", type=Path, required=True,
                        help="folder with peers.csv and STABILITY.md, if any")
    parser.add_argument("--seconds", type=int, required=True,
                        help="how long it took")
    parser.add_argument("--opt", required=True, help="optimisation")
    given = parser.parse_args()
    report = Report(given.build, given.work)
    report.make_csv()
    report.head(given.seconds, given.opt)
    report.precision()
    report.costs()
    report.beside()


if __name__ == "__main__":
    read.run_script(main)
