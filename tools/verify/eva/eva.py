"""Undefined behaviour and numbers that are not finite, looked for by abstract
interpretation (Frama-C Eva): tools/run eva [ENTRY...], each of ENTRIES in both
real types; all of them by default, but as a check, without FULL, not
step_finite, which takes longer than the others together.

Every alarm has to stand in tools/verify/eva/alarms with its reason, and what
stands there has to be an alarm: else the run fails. Its paragraphs are lines
"in: ENTRY...", "at: FUNCTION", "what: KIND, EXPRESSION" (one or more) and "why:
REASON"; names go without the real type. Everything that is not proven is an
alarm, a check of an entry too. An entry ends in a check of what is false: were
it proven, or not looked at, then the end would not be reached and nothing
behind that point be analysed. Counted are proofs alone: not what is admitted,
what is dead in this entry or what the analyser's own library asks.

BUILD/eva/ keeps all output.
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

import driven

HERE = Path("tools/verify/eva")
OUT = Path(os.environ.get("BUILD") or "build", "eva")
REALS = {"f64": "-UTF_REAL_FLOAT", "f32": "-DTF_REAL_FLOAT"}
# Name, file, and options of the analyser. non-finite: every number that is not
# finite is an alarm too. cases: cases.h comes before every file.
ENTRIES = {words[0]: (words[1], set(words[2:])) for words in map(str.split, """
seal_any          line     precision=2
push_any          line     precision=2
block_any         line     precision=2
block_small       line     precision=2 slevel=500
prepare_any       prepare  precision=2 slevel=400 min-loop-unroll=21
prepare_in_range  prepare  precision=1 slevel=100 min-loop-unroll=21 non-finite
step_any          steps    precision=1 auto-loop-unroll=16
range_any         range    precision=1 slevel=200 min-loop-unroll=21 cases
step_finite       finite   precision=1 slevel=200 auto-loop-unroll=21 cases
""".strip().splitlines())}
# Of src/, what the functions of a file call.
STEP = ("step mode_end rare_end split report codim2_end machine rest_motion "
        "balanced codim2 contact quadrant select tyre kernel")
SOURCES = {"line": "frame", "range": "kernel", "steps": STEP, "finite": STEP,
           "prepare": "machine contact select kernel compensated"}
# Functions that say by their value whether they wrote a result: what is known
# where they return is kept apart by that value.
APART = ("first_offender validate_located within in_reach side_of "
         "stick_borders in_reach_by_cases in_range_by_cases within_by_cases "
         "may_step complete_frame unpack_frame commit end_of_step "
         "rare_step tf_decoder_push_REAL tf_prepare_REAL tf_step_REAL").split()
# The search for limit directions ends by conditions of which nothing is known:
# its iterations and their cases are not kept apart.
TOGETHER = ("zero_in search_cell limit_direction_in "
            "tf_search_quadrant_REAL").split()


def sources_of(file: str) -> list[str]:
    found = {stem: [*map(str, Path().glob(f"src/*/{stem}.c"))]
             for stem in SOURCES[file].split()}
    for stem, files in found.items():
        if not files:
            sys.exit(f"eva: src/ has no {stem}.c")
    return sorted(sum(found.values(), []))


def by_value(names: list[str], value: str, real: str) -> str:
    return ",".join(f"{name}:{value}" for name in names).replace("REAL", real)


def analyse(entry: str, real: str) -> bool:
    """Leaves NAME-REAL.csv, its properties, and NAME-REAL.log. Whether it came
    to its end."""
    file, words = ENTRIES[entry]
    flags = ["-std=c99", "-Iinclude", "-Isrc", f"-I{HERE}", "-include",
             f"{HERE}/model.h", REALS[real],
             *(f"-D__builtin_{name}=model_{name}"
               for name in ("sqrt", "sqrtf", "fabs", "fabsf"))]
    if "cases" in words:
        flags += ["-include", f"{HERE}/cases.h"]
    options = [part for word in sorted(words) if "=" in word
               for part in f"-eva-{word}".split("=")]
    table = OUT / f"{entry}-{real}.csv"
    table.unlink(missing_ok=True)
    begin = time.time()
    with open(table.with_suffix(".log"), "wb") as log:
        done = subprocess.run(
            ["nice", "-n", "5", "frama-c", "-machdep", "gcc_x86_64",
             f"-cpp-extra-args={' '.join(flags)}", f"{HERE}/{file}.c",
             *sources_of(file), "-main", entry, "-eva", *options,
             "-warn-special-float",
             "non-finite" if "non-finite" in words else "none",
             "-eva-interprocedural-splits",
             "-eva-no-print", "-eva-builtin",
             "model_sqrt:Frama_C_sqrt,model_sqrtf:Frama_C_sqrtf",
             "-permissive", "-eva-split-return-function",
             by_value(APART, "full", real), "-eva-slevel-function",
             by_value(TOGETHER, "0", real), "-then", "-report-csv", table],
            stdin=subprocess.DEVNULL, stdout=log, stderr=log, check=False)
    print(f"{entry}-{real} {time.time() - begin:.0f} s")
    return done.returncode == 0


class Alarm(NamedTuple):
    """What is not proven, and in which entry."""
    entry: str
    function: str
    what: str

    def __str__(self) -> str:
        return f"{self.entry} {self.function} {self.what}"


def explained() -> set[Alarm]:
    """The alarms that have a reason."""
    found = set()
    for paragraph in (HERE / "alarms").read_text("utf-8").split("\n\n"):
        said: dict[str, list[str]] = {key: [] for key in (
            "in", "at", "what", "why")}
        for line in paragraph.splitlines():
            key, _, text = line.partition(": ")
            said.get(key, []).append(text)
        if said["in"] and not said["why"]:
            sys.exit(f"no reason given:\n{paragraph}")
        found |= {Alarm(entry, function, what) for entries_of in said["in"]
                  for entry in entries_of.split() for function in said["at"]
                  for what in said["what"]}
    return found


class Said(NamedTuple):
    """What the analyser says of one entry in one real type."""
    reached: bool
    proven: int
    alarms: dict[Alarm, str]  # and where


def said_of(entry: str, path: Path) -> Said:
    """From the table of its properties."""
    reached, proven, alarms = False, 0, {}
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t",
                                   quoting=csv.QUOTE_NONE))
    for row in rows:
        function, status = row["function"], row["status"]
        kind, text = row["property kind"], row["property"]
        if kind == "user check" and text == "\\false":
            reached |= function == entry and status not in ("Valid", "Dead")
        elif status == "Valid":
            proven += not function.startswith(("Frama_C_", "__builtin_"))
        elif status not in ("Considered valid", "Dead") and \
                not function.startswith("Frama_C_"):
            # A number behind the name: one static function in several files.
            function = re.sub(r"_\d+$", "", re.sub(r"_f(64|32)", "", function))
            text = re.sub(r"_(double|float)", "", text)
            text = re.sub(r"\((double|float|tf_real_t)\)", "", text)
            alarms[Alarm(entry, function, f"{kind}, {text}")] = \
                f"{row['file']}:{row['line']}"
    return Said(reached, proven, alarms)


def wrong(reasons: set[Alarm], runs: dict[str, Said],
          ran: set[str]) -> Iterable[str]:
    """What does not hold, a text each."""
    raised: set[Alarm] = set()
    for name, run in runs.items():
        raised |= run.alarms.keys()
        for alarm in run.alarms.keys() - reasons:
            yield (f"{name}: {run.alarms[alarm]}: not explained\n"
                   f"at: {alarm.function}\nwhat: {alarm.what}")
        if not run.reached:
            yield f"{name}: its end is not reached"
    yield from (f"explained, but no alarm: {alarm}"
                for alarm in sorted(reasons - raised) if alarm.entry in ran)


def main() -> None:
    if not shutil.which("frama-c"):
        print("missing: frama-c (apt-get install frama-c-base)",
              file=sys.stderr)
        sys.exit(3)
    OUT.mkdir(parents=True, exist_ok=True)
    reasons = explained()
    is_short = "CHECK_NOTE" in os.environ and not os.environ.get("FULL")
    wanted = sys.argv[1:] or [name for name in ENTRIES
                              if not is_short or name != "step_finite"]
    unknown = {*wanted, *(alarm.entry for alarm in reasons)} - set(ENTRIES)
    if unknown:
        print(f"make eva: there is no entry {min(unknown)}", file=sys.stderr)
        sys.exit(2)
    pairs = [(entry, real) for entry in wanted
             for real in REALS]
    good = driven.side_by_side(lambda run: analyse(*run), pairs)
    if not all(good):
        sys.exit(f"an analysis stopped: see {OUT}/*.log")
    runs = {f"{entry}-{real}": said_of(entry, OUT / f"{entry}-{real}.csv")
            for entry, real in pairs}
    bad = list(wrong(reasons, runs, {entry for entry, _ in pairs}))
    for text in bad:
        print(text)
    raised = {alarm for run in runs.values() for alarm in run.alarms}
    print(f"{len(pairs)} analyses, "
          f"{sum(run.proven for run in runs.values())} properties proven, "
          f"{len(reasons & raised)} alarms explained, {len(bad)} not")
    sys.exit(bool(bad))
