#!/usr/bin/python3 -B
"""Writes STABILITY.md from the list of sweeps and from all cells.

The exit code is 1 where a promise of the core is broken.
"""
from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from pathlib import Path
from typing import Iterable

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402
from tables.markdown import or_dash, table  # noqa: E402

STABLE = "ok", "degraded"
VERDICTS = STABLE + ("physics", "too_long", "diverged", "told", "created",
                     "bad_parameter")
CODES = "TF_STEP_TOO_LONG", "TF_DIVERGED", "TF_BAD_STATE", "TF_BAD_PARAMETER"
FLAGS = "degraded", "fell_back", "coarse"


class Sweep:
    """One line of the list of sweeps."""

    def __init__(self, row: read.Row) -> None:
        self.name, self.where = row["name"], row["where"]
        self.axis = row["axis"] + (f" [{row['unit']}]" if row["unit"] else "")


def read_sweeps(path: str) -> list[Sweep]:
    """The list that the program `sweep` prints."""
    return [Sweep(row) for row in
            read.read_words(path, ["name", "axis", "unit", "where"], "|")]


class Cells:
    """All cells, in the order in which they were run."""

    def __init__(self, paths: Iterable[str]) -> None:
        self.rows = [row for path in paths for row in read.read_csv(path)]
        if not self.rows:
            raise read.TableError("there is no cell")
        self.of: dict[tuple[str, str], list[read.Row]] = defaultdict(list)
        self.by_combo: dict[str, list[read.Row]] = defaultdict(list)
        self.values: dict[str, dict[int, read.Row]] = defaultdict(dict)
        for row in self.rows:
            combo = f"{row['real']} {row['scheme']}"
            self.of[row["sweep"], combo].append(row)
            self.by_combo[combo].append(row)
            self.values[row["sweep"]][row.count("index")] = row
        self.combos = list(self.by_combo)
        self.sizes = list(dict.fromkeys(row["dt"] for row in self.rows))

    def value(self, sweep: str, i: int) -> str:
        """The parameter of one line of a sweep."""
        return self.values[sweep][i]["value"]

    def grows(self, sweep: str, i: int) -> bool:
        """Whether the motion itself is unstable there."""
        return self.values[sweep][i]["grows"] == "1"

    def line(self, sweep: str, combo: str, i: int) -> list[read.Row]:
        """The cells of one value, in rising order of the step."""
        return [row for row in self.of[sweep, combo]
                if row.count("index") == i]

    def cell(self, sweep: str, combo: str, i: int, dt: str) -> read.Row:
        """One cell."""
        for row in self.line(sweep, combo, i):
            if row["dt"] == dt:
                return row
        raise read.TableError(f"{sweep}, {combo}: no cell {i} at dt = {dt}")


def total(rows: Iterable[read.Row], column: str) -> int:
    """The sum of a column of whole numbers."""
    return sum(row.count(column) for row in rows)


def matching(rows: Iterable[read.Row], column: str, text: str) -> int:
    """How many rows have that text in a column."""
    return sum(row[column] == text for row in rows)


def promises(cells: Cells, seconds: int) -> Iterable[str]:
    """What must never happen."""
    refusals = sum(row["refusal"] != "" for row in cells.rows)
    yield "## Promises\n"
    yield (f"{len(cells.rows)} cells, {total(cells.rows, 'steps')} accepted "
           f"steps, {refusals} runs that ended in a refusal, {seconds} s.\n")
    yield table(["what must never happen", "how often"], [
        ["an accepted step leaves a number that is not finite, in the state "
         "or in the report", matching(cells.rows, "verdict", "non_finite")],
        ["a refused step changes a bit of the state, or returned and reported "
         "status differ", matching(cells.rows, "verdict", "touched")]]) + "\n"


def verdicts(cells: Cells) -> Iterable[str]:
    """How often each verdict was given."""
    yield "## Verdicts\n"
    yield table(["real, scheme", "cells", *VERDICTS],
                [[combo, len(rows)] + [matching(rows, "verdict", verdict)
                                       for verdict in VERDICTS]
                 for combo, rows in cells.by_combo.items()]) + "\n"


def stable_share(rows: list[read.Row]) -> str:
    """Stable cells of those that the scheme takes."""
    taken_not = matching(rows, "verdict", "bad_parameter")
    if taken_not == len(rows):
        return "n/a"
    physics = matching(rows, "verdict", "physics")
    good = sum(row["verdict"] in STABLE for row in rows)
    return f"{good}{f'+{physics}' if physics else ''}/{len(rows) - taken_not}"


def sweeps_table(cells: Cells, sweeps: list[Sweep]) -> Iterable[str]:
    """A line a sweep."""
    yield "## Stable cells of each sweep\n"
    yield ("Stable (and, after a plus sign, ended by the motion itself) of "
           "all.\n")
    yield table(["sweep", "axis", "differs from scene chaos", *cells.combos],
                [[s.name, s.axis, or_dash(s.where)] +
                 [stable_share(cells.of[s.name, combo])
                  for combo in cells.combos] for s in sweeps]) + "\n"


def refusals_table(cells: Cells) -> Iterable[str]:
    """Refusals by their reason."""
    yield "## Refusals\n"
    yield ("Runs that ended in a refusal, by reason; in brackets how many of "
           "them\nthe same scheme carries on with 1024 steps of dt/1024 (not "
           "below 1e-9 s).\nTF_BAD_PARAMETER stands for cases that the scheme "
           "does not take at all.\n")
    lines = []
    for combo, rows in cells.by_combo.items():
        line: list[object] = [combo]
        for code in CODES:
            refused = [row for row in rows if row["refusal"] == code]
            goes_on = matching(refused, "finer", "")
            line.append(len(refused) if code == CODES[-1]
                        else f"{len(refused)} ({goes_on})")
        lines.append(line)
    yield table(["real, scheme", *CODES], lines) + "\n"


def degraded_table(cells: Cells, sweeps: list[Sweep]) -> Iterable[str]:
    """Steps that were accepted with a flag."""
    yield "## Degraded steps\n"
    yield ("Accepted steps in which no mode was consistent (TF_DEGRADED), and"
           "\nsteps that tf_step_located left to tf_step (TF_FELL_BACK) or "
           "ended\nwith it because they ran out of segments (TF_COARSE).\n")
    yield table(["real, scheme", "accepted steps", "degraded", "fell back",
                 "coarse"],
                [[combo] + [total(rows, column)
                            for column in ("steps", *FLAGS)]
                 for combo, rows in cells.by_combo.items()])
    yield "\nWhere they are (degraded / fell back / coarse):\n"
    lines = []
    for s in sweeps:
        counts = [[total(cells.of[s.name, combo], flag) for flag in FLAGS]
                  for combo in cells.combos]
        if any(any(of_combo) for of_combo in counts):
            lines.append([s.name] + [" / ".join(map(str, of_combo))
                                     for of_combo in counts])
    yield table(["sweep", *cells.combos], lines) + "\n"


def stick_text(rows: list[read.Row]) -> str:
    """The largest drift of a sweep in stick."""
    if total(rows, "sticks") == 0:
        return "-"
    return f"{max(0.0, *(row.number('stick_drift') for row in rows)):.3g}"


def stick_table(cells: Cells, sweeps: list[Sweep]) -> Iterable[str]:
    """How well stick is held."""
    yield "## Stick\n"
    yield ("Largest |h| in stick, in units of the rounding of its terms,"
           "\nepsilon (|v| + (|d| + |r|)(|w| + |omega0|)), summed over both "
           "ends of the\nstep; a dash where the wheel never sticks. Below 1 "
           "nothing drifts: h is 0\nas far as the real type can tell.\n")
    yield table(["sweep", *cells.combos],
                [[s.name] + [stick_text(cells.of[s.name, combo])
                             for combo in cells.combos]
                 for s in sweeps]) + "\n"


def drift_text(row: read.Row) -> str:
    """The drift of energy in both halves, or how the run failed."""
    if row["verdict"] in STABLE:
        return f"{row['drift_first_half']} / {row['drift_second_half']}"
    return f"{row['drift_first_half']}, {row['verdict']}"


def energy_tables(cells: Cells, sweeps: list[Sweep]) -> Iterable[str]:
    """Machines that neither take nor give energy: a line a value."""
    yield "## Energy without friction and damping\n"
    yield ("Largest |E - E0| / E0 in the first and in the second half of the "
           "run.\nTwo equal figures are an oscillation about the true energy; "
           "a second\ntwice the first is a drift. theta = 1 takes energy out "
           "of what it does\nnot resolve (its figure tends to 1), theta = 1/2 "
           "does not.\n")
    sizes = cells.sizes[::2]
    for combo in cells.combos:
        for s in sweeps:
            if s.name not in ("conservative", "spinning"):
                continue
            yield f"`{s.name}`, {combo}:\n"
            yield table([s.axis, *(f"dt = {dt}" for dt in sizes)],
                        [[cells.value(s.name, i)] +
                         [drift_text(cells.cell(s.name, combo, i, dt))
                          for dt in sizes]
                         for i in cells.values[s.name]]) + "\n"


def centrifugal_table(cells: Cells) -> Iterable[str]:
    """A motion that grows by itself."""
    name, dt = "centrifugal", cells.sizes[-5]
    yield "## Centrifugal instability\n"
    yield ("Below k2 = m w^2 the motion itself grows as exp(sqrt(w^2 - k2/m) "
           "t):\nthat is told from the parameters (column `motion`), before "
           "any scheme is\nblamed. The figure is |E - E0| / E0 at the end for "
           f"dt = {dt}.\n")
    lines = []
    for i in cells.values[name]:
        at_end = [cells.cell(name, combo, i, dt) for combo in cells.combos]
        lines.append([cells.value(name, i),
                      "grows" if cells.grows(name, i) else "oscillates"] +
                     [f"{row['verdict']} {row['drift_end']}"
                      for row in at_end])
    yield table(["k2 / (m w^2)", "motion", *cells.combos], lines) + "\n"


def largest_step(rows: list[read.Row]) -> str:
    """The largest stable step of one value, and how the next one fails."""
    largest, why, ends, again = "", "", "", ""
    for row in rows:
        if row["verdict"] in STABLE + ("physics",):
            if why:
                again = "+"
            else:
                largest = row["dt"]
            if row["verdict"] == "physics":
                ends = "*"
        elif not why:
            why = row["verdict"]
    if why == "bad_parameter":
        return "n/a"
    if not largest:
        return f"none: {why}"
    return largest + ends + (f" {why}" if why else "") + again


def largest_tables(cells: Cells, sweeps: list[Sweep]) -> Iterable[str]:
    """A table a sweep, a line a value."""
    yield "## Largest stable step\n"
    yield (f"dt in s, of {cells.sizes[0]} to {cells.sizes[-1]}: it and all "
           "smaller ones are\nstable. The word says how the next larger one "
           "fails; no word: none fails.\nA star: the motion itself left the "
           "range of states in some of them. A\nplus sign: some larger step "
           "is stable again.\n")
    for s in sweeps:
        yield f"### {s.name}{': ' if s.where else ''}{s.where}\n"
        lines = []
        for i in cells.values[s.name]:
            grows = " (k2 < m w^2)" if cells.grows(s.name, i) else ""
            lines.append([cells.value(s.name, i) + grows] +
                         [largest_step(cells.line(s.name, combo, i))
                          for combo in cells.combos])
        yield table([s.axis, *cells.combos], lines) + "\n"


def preface(stamp: str) -> str:
    """The words in front of all tables, with what was measured."""
    text = Path(__file__).with_name("preface.md").read_text(encoding="utf-8")
    title, rest = text.split("\n", 1)
    commit, compiler = stamp.split("; ", 1)
    return f"{title}\n\nFrom commit {commit}, compiler {compiler}.\n{rest}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stamp", required=True,
                        help="what was measured: COMMIT; COMPILER")
    parser.add_argument("--seconds", type=int, required=True,
                        help="how long it took")
    parser.add_argument("list", help="what sweep --list prints")
    parser.add_argument("cells", nargs="+", help="what sweep prints")
    given = parser.parse_args()
    sweeps = read_sweeps(given.list)
    cells = Cells(given.cells)
    print(preface(given.stamp))
    for part in (promises(cells, given.seconds), verdicts(cells),
                 sweeps_table(cells, sweeps), refusals_table(cells),
                 degraded_table(cells, sweeps), stick_table(cells, sweeps),
                 centrifugal_table(cells), energy_tables(cells, sweeps),
                 largest_tables(cells, sweeps)):
        for text in part:
            print(text)
    return int(any(row["verdict"] in ("non_finite", "touched")
                   for row in cells.rows))


if __name__ == "__main__":
    read.run_script(main)
