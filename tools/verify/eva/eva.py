#!/usr/bin/python3 -B
"""Undefined behaviour and numbers that are not finite, looked for by abstract
interpretation (Frama-C Eva): tools/verify/eva/eva.py [ENTRY...], each entry
of tools/verify/eva/entries in both real types; all of them by default.

Every alarm has to stand in tools/verify/eva/alarms with its reason, and what
stands there has to be an alarm: else the run fails. Its paragraphs are lines
"in: ENTRY...", "at: FUNCTION", "what: KIND, EXPRESSION" (one or more) and "why:
REASON"; names go without the real type. Everything that is not proven is an
alarm, a check of an entry too. An entry ends in a check of what is false: were
it proven, or not looked at, then the end would not be reached and nothing
behind that point be analysed. Counted are proofs alone: not what is admitted,
what is dead in this entry or what the analyser's own library asks.

BUILD/eva/ keeps all output. REALS=f64 analyses one real type alone, which gives
no verdict: explained alarms may be those of the other type.
"""
from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterable, NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import driven

HERE = Path("tools/verify/eva")
OUT = Path(os.environ.get("BUILD") or "build", "eva")
REALS = {"f64": "-UTF_REAL_FLOAT", "f32": "-DTF_REAL_FLOAT"}
# Whole programs need no more than what they call.
SOURCES = {
    "STEP": "step,rare_end,report,codim2_end,balanced,codim2,course,quadrant,"
            "select,philox,tyre,prepare,kernel",
    "PREPARE": "prepare,kernel,prepare_compensated,compensated,machine"}
# Functions that say by their value whether they wrote a result: what is known
# where they return is kept apart by that value.
APART = ("first_offender validate_located within in_reach side_of "
         "in_reach_by_cases in_range_by_cases within_by_cases may_step "
         "complete_frame unpack_frame commit end_of_step common_end "
         "rare_step tf_decoder_push_REAL tf_prepare_REAL tf_step_REAL").split()
# The search for limit directions ends by conditions of which nothing is known:
# its iterations and their cases are not kept apart.
TOGETHER = ("zero_in search_cell limit_direction_in "
            "tf_search_quadrant_REAL").split()


class Entry(NamedTuple):
    """A line of tools/verify/eva/entries."""
    name: str
    file: str
    kind: str
    sources: str
    options: list[str]

    def files(self) -> list[str]:
        """Of src/, by the names of the entry."""
        found = set()
        for name in self.sources.split(","):
            for stem in SOURCES.get(name, name).split(","):
                stem = "*" if stem == "ALL" else stem
                found |= set(map(str, Path().glob(f"src/*/{stem}.c")))
        return sorted(found)


def entries() -> list[Entry]:
    lines = (HERE / "entries").read_text("utf-8").splitlines()
    words = [line.split() for line in lines
             if line.strip() and not line.startswith("#")]
    return [Entry(*line[:4], line[4:]) for line in words]


def by_value(names: list[str], value: str, real: str) -> str:
    return ",".join(f"{name}:{value}" for name in names).replace("REAL", real)


def analyse(entry: Entry, real: str) -> bool:
    """Leaves NAME-REAL.csv, its properties, and NAME-REAL.log. Whether it came
    to its end."""
    flags = ["-std=c99", "-Iinclude", "-Isrc", f"-I{HERE}", "-include",
             f"{HERE}/model.h", REALS[real],
             *(f"-D__builtin_{name}=model_{name}"
               for name in ("sqrt", "sqrtf", "fabs", "fabsf"))]
    if "cases" in entry.options:
        flags += ["-include", f"{HERE}/cases.h"]
    csv = OUT / f"{entry.name}-{real}.csv"
    csv.unlink(missing_ok=True)
    begin = time.time()
    with open(csv.with_suffix(".log"), "wb") as log:
        done = subprocess.run(
            ["nice", "-n", "5", "frama-c", "-machdep", "gcc_x86_64",
             f"-cpp-extra-args={' '.join(flags)}", f"{HERE}/{entry.file}",
             *entry.files(), "-main", entry.name, "-eva",
             *(option for option in entry.options if option != "cases"),
             "-warn-special-float", entry.kind, "-eva-interprocedural-splits",
             "-eva-no-print", "-eva-builtin",
             "model_sqrt:Frama_C_sqrt,model_sqrtf:Frama_C_sqrtf",
             "-permissive", "-eva-split-return-function",
             by_value(APART, "full", real), "-eva-slevel-function",
             by_value(TOGETHER, "0", real), "-then", "-report-csv", csv],
            stdin=subprocess.DEVNULL, stdout=log, stderr=log, check=False)
    print(f"{entry.name}-{real} {time.time() - begin:.0f} s")
    return done.returncode == 0


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
            for row in csv.DictReader(file, delimiter="\t",
                                      quoting=csv.QUOTE_NONE):
                self._take(row)

    def _take(self, row: dict[str, str]) -> None:
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


def main() -> None:
    driven.begin(__file__)
    if not shutil.which("frama-c"):
        print("missing: frama-c (apt-get install frama-c-base)",
              file=sys.stderr)
        sys.exit(3)
    OUT.mkdir(parents=True, exist_ok=True)
    explained = Explained(HERE / "alarms")
    known = {entry.name for entry in entries()}
    wanted = set(sys.argv[1:]) or known
    unknown = (wanted | {
        alarm.entry for alarm in explained.reasons}) - known
    if unknown:
        print(f"make eva: there is no entry {min(unknown)}", file=sys.stderr)
        sys.exit(2)
    pairs = [(entry, real) for entry in entries()
            if entry.name in wanted
            for real in (os.environ.get("REALS") or "f64 f32").split()]
    good = driven.side_by_side(lambda run: analyse(*run), pairs)
    broken = [run for run, done in zip(pairs, good) if not done]
    for entry, real in broken:
        print(f"{entry.name}-{real}: the analysis stopped")
    if broken:
        print(f"see {OUT}/*.log")
        sys.exit(1)
    runs = [Run(OUT / f"{entry.name}-{real}.csv") for entry, real in pairs]
    bad = list(wrong(explained, runs))
    for text in bad:
        print(text)
    used = explained.reasons & {alarm for run in runs
                                for alarm, _ in run.alarms}
    print(f"{len({run.entry for run in runs})} entries, "
          f"{sum(run.proven for run in runs)} properties proven, "
          f"{len(used)} alarms explained, {len(bad)} not")
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
