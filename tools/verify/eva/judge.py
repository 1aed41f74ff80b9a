#!/usr/bin/python3 -B
"""Alarms of the analysis against their explanations.

Paragraphs of ALARMS are lines "in: ENTRY...", "at: FUNCTION", "what: KIND,
EXPRESSION" (one or more) and "why: REASON"; names go without the real type.
Everything that is not proven is an alarm, a check of an entry too. An entry
ends in a check of what is false: were it proven, or not looked at, then the end
would not be reached and nothing behind that point be analysed. Counted are
proofs alone: not what is admitted, what is dead in this entry or what the
analyser's own library asks. Exits with code 1 where something is wrong.
"""
from __future__ import annotations

import argparse
import csv
import re
import sys
from pathlib import Path
from typing import Iterable, NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

COLUMNS = ("directory", "file", "line", "function", "property kind", "status",
           "property")


class Alarm(NamedTuple):
    """What is not proven, and in which entry."""
    entry: str
    function: str
    what: str

    def __str__(self) -> str:
        return f"{self.entry} {self.function} {self.what}"


class Explained:
    """The alarms that have a reason, and those that have none."""

    def __init__(self, path: Path) -> None:
        self.reasons: set[Alarm] = set()
        self.open: list[Alarm] = []
        self.entries: list[str] = []
        self.function = ""
        for line in path.read_text(encoding="utf-8").splitlines():
            self._take(line)

    def _take(self, line: str) -> None:
        """One line. All since the last reason have the next one."""
        key, _, text = line.partition(": ")
        if not line:
            self.entries, self.function = [], ""
        elif key == "in":
            self.entries = text.split()
        elif key == "at":
            self.function = text
        elif key == "what":
            self.open += [Alarm(entry, self.function, text)
                          for entry in self.entries]
        elif key == "why" and text:
            self.reasons.update(self.open)
            self.open = []


class Run:
    """What the analyser says of one entry in one real type."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.entry = re.sub(r"-f(64|32)\.csv$", "", path.name)
        self.reached = False
        self.proven = 0
        self.alarms: list[tuple[Alarm, str]] = []
        with open(path, encoding="utf-8", newline="") as file:
            lines = csv.reader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
            header = next(lines, [])
            for column in COLUMNS:
                if column not in header:
                    raise read.TableError(f"{path}: there is no column "
                                          f"'{column}'")
            for i, fields in enumerate(lines, start=2):
                self._take(read.Row(f"{path}:{i}", header, fields))

    def _take(self, row: read.Row) -> None:
        """One property."""
        function, status = row["function"], row["status"]
        kind, text = row["property kind"], row["property"]
        if kind == "user check" and text == "\\false":
            if function == self.entry and status not in ("Valid", "Dead"):
                self.reached = True
            return
        if status == "Valid":
            self.proven += not function.startswith(("Frama_C_", "__builtin_"))
        elif status not in ("Considered valid", "Dead") and \
                not function.startswith("Frama_C_"):
            # A number behind the name: one static function in several files.
            function = re.sub(r"_\d+$", "", re.sub(r"_f(64|32)", "", function))
            text = re.sub(r"_(double|float)", "", text)
            text = re.sub(r"\((double|float|tf_real_t)\)", "", text)
            self.alarms.append((Alarm(self.entry, function, f"{kind}, {text}"),
                                f"{row['file']}:{row['line']}"))


def wrong(explained: Explained, runs: list[Run]) -> Iterable[str]:
    """What does not hold, a text each."""
    raised = {alarm for run in runs for alarm, _ in run.alarms}
    ran = {run.entry for run in runs}
    for run in runs:
        for alarm, where in run.alarms:
            if alarm not in explained.reasons:
                yield (f"{run.entry}: {where}: not explained\n"
                       f"at: {alarm.function}\nwhat: {alarm.what}")
    for alarm in explained.open:
        yield f"no reason given: {alarm}"
    for alarm in sorted(explained.reasons - raised):
        if alarm.entry in ran:
            yield f"explained, but no alarm: {alarm}"
    for run in runs:
        if not run.reached:
            yield f"{run.entry}: its end is not reached ({run.path})"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("alarms", type=Path, help="alarms with their reasons")
    parser.add_argument("runs", nargs="+", type=Path,
                        help="ENTRY-f64.csv, ENTRY-f32.csv, ...")
    given = parser.parse_args()
    explained = Explained(given.alarms)
    runs = [Run(path) for path in given.runs]
    bad = list(wrong(explained, runs))
    for text in bad:
        print(text)
    used = explained.reasons & {alarm for run in runs
                                for alarm, _ in run.alarms}
    print(f"{len({run.entry for run in runs})} entries, "
          f"{sum(run.proven for run in runs)} properties proven, "
          f"{len(used)} alarms explained, {len(bad)} not")
    return int(bool(bad))


if __name__ == "__main__":
    read.run_script(main)
