"""The figures of one Moreau step and of the ensemble step.

They are taken from what tools/bench/steps/steps.py and ensembles have printed; only
double has figures to reach.
"""
from __future__ import annotations

import re
from typing import Iterable, Optional

from tables import read
from tables.markdown import row

CODIM2 = "of the dearest step, at h = g = 0"
RK4 = "the same, smoothed RK4 with libm"
STEP = "instructions a step, mean over 10 s"
COUNTS = "RK4 / step in instructions"
NS = "ns a step, median"
TIMES = "RK4 / step in time, median (10 %, 90 %)"
# What, its line, the figure to reach, and whether it is the least one.
FIGURES = (
    ("one Moreau step of `chaos` in double, instructions, mean over 10 s",
     STEP, 450, False),
    ("a step of smoothed-sign RK4 with libm by a Moreau step, in instructions",
     COUNTS, 4, True),
    ("the same in time, median (10 %, 90 %)", TIMES, 4, True),
    ("stack of `tf_step` in double [B]", "stack of tf_step, worst, B", 512,
     False),
    ("state in double [B]", "state, B", 64, False),
)
# The phases of the steps of `chaos`, whose dearest step has a figure too.
PHASES = ("slip goes on", "stick goes on", "pinned goes on", "the mode changes")
DEAREST = 1500
KINDS = ("arithmetic", "comparisons and jumps", "loads, stores and copies")
ENSEMBLE = ("at least 3 times the throughput of single steps, with AVX2 on "
            "one core")


def judge(measured: float, target: float, least: bool) -> str:
    """Whether a figure is reached."""
    off = target / measured if least else measured / target
    if off <= 1:
        return "reached"
    return f"not reached: {off:.3g} times too {'small' if least else 'large'}"


class Bench:
    """The lines of tools/bench/steps/steps.py about double, by their texts.

    A text that comes twice is followed by what stands above it.
    """

    def __init__(self, path: str) -> None:
        self.texts: dict[str, str] = {}
        above, wide = "", False
        with open(path, encoding="utf-8") as file:
            for line in file:
                if line.startswith("== "):
                    wide = " double" in line
                fields = re.split(r"  +", line.strip(), maxsplit=1)
                if not wide or len(fields) < 2:
                    continue
                name, value = fields
                value = re.sub(r" *target.*", "", value).strip()
                self.texts[f"{name} < {above}" if name == RK4 else name] = value
                above = name

    def number(self, name: str, field: int = 0) -> Optional[float]:
        """A number of a line, if it is there and is one."""
        try:
            return float(self.texts[name].split()[field])
        except (KeyError, IndexError, ValueError):
            return None

    def dearest(self) -> Optional[tuple[float, str]]:
        """The most that a step of the run has taken, and in which phase."""
        found = [(most, phase) for phase in PHASES
                 for most in [self.number(phase, 3)] if most is not None]
        return max(found) if found else None

    def judge_dearest(self) -> str:
        """The row of the dearest step."""
        what = ("one Moreau step of `chaos` in double, instructions, the most "
                "found in 10 s")
        found = self.dearest()
        if not found:
            return row([what, "-", DEAREST, "not known: needs valgrind"])
        return row([what, f"{found[0]:.0f} ({found[1]})", DEAREST,
                    judge(found[0], DEAREST, False)])

    def rows(self) -> Iterable[str]:
        """Rows of the table of figures."""
        for text, name, target, least in FIGURES:
            measured = self.number(name)
            if measured is None:
                said = self.texts.get(name, "needs valgrind")
                yield row([text, "-", target, f"not known: {said}"])
            else:
                yield row([text, self.texts[name], target,
                           judge(measured, target, least)])
            if name == STEP:
                yield self.judge_dearest()

    def kinds(self) -> str:
        """What the instructions of a step do."""
        work, jumps, moves = (self.number(f"of them {kind}") for kind in KINDS)
        if work is None or jumps is None or moves is None:
            return ""
        return (f" In the mean {work:.0f} are arithmetic, {jumps:.0f} "
                f"comparisons and jumps and {moves:.0f} loads, stores and "
                "copies, which two operands an instruction and 16 registers "
                f"ask for: those of the first two kinds alone are "
                f"{work + jumps:.0f}.")

    def why(self) -> Iterable[str]:
        """Why figures are not reached."""
        step, counts = self.number(STEP), self.number(COUNTS)
        least, usual = (self.number("stick goes on", i) for i in (1, 2))
        slip = self.number("slip goes on", 1)
        if step is not None and step > 450 and None not in (least, slip):
            yield ("* The Moreau step forms the quadratics h+ and g+ of the "
                   "force, asks every mode for its consistency and measures a "
                   "residual that does not know the answer. Of that a stick "
                   f"takes {least:.0f} instructions at least ({usual:.0f} in "
                   "the median) and a slip, with two evaluations of T, "
                   f"{slip:.0f}." + self.kinds())
        dearest, usual = self.dearest(), self.number("the mode changes", 2)
        if dearest and dearest[0] > DEAREST and usual is not None:
            within = self.number(CODIM2)
            yield (f"* The dearest step, of {dearest[0]:.0f} instructions, "
                   "comes to h = g = 0 and leaves it: it looks for the limit "
                   "directions of the slip there and follows the course to "
                   "that point" +
                   (f", which are {within:.0f} of them" if within else "") +
                   f". A usual change of the mode takes {usual:.0f}. A search "
                   "over machines, states and inputs finds a dearer one still "
                   "(docs/BOUNDS.md).")
        rk4, rk4_ns = (self.number(f"{RK4} < {above}") for above in (STEP, NS))
        own_ns = self.number(NS)
        if counts is not None and counts < 4 and None not in (rk4, rk4_ns,
                                                              own_ns):
            yield (f"* A step of smoothed-sign RK4 takes {rk4:.0f} "
                   f"instructions: a quarter of it is {rk4 / 4:.0f}, less "
                   "than the shortest stick. Its instructions wait longer, "
                   f"though: {rk4_ns / rk4:.2f} ns each, those of the Moreau "
                   f"step {own_ns / step:.2f} ns. Nor does it find what the "
                   "Moreau step finds, all consistent modes.")


class Ensembles:
    """What `ensembles` has measured, or why it has not."""

    COLUMNS = ("real", "ensemble", "step", "ensemble step", "ratio", "10 %",
               "90 %", "alone")

    def __init__(self, path: str) -> None:
        with open(path, encoding="utf-8") as file:
            comments = [line[1:].strip() for line in file
                        if line.startswith("#")]
        self.missing = comments[0] if comments else ""
        self.lines = ([] if self.missing
                      else read.read_words(path, self.COLUMNS))

    def spread(self) -> list[read.Row]:
        """Ensembles of all phases, a line a real type."""
        return [line for line in self.lines if line["ensemble"] == "spread"]

    def rows(self) -> Iterable[str]:
        """Rows of the table of figures."""
        for line in self.spread():
            measured = f"{line['ratio']} (10 %: {line['10 %']}, 90 %: " \
                       f"{line['90 %']})"
            yield row([f"ensemble step in {line['real']}: {ENSEMBLE}", measured,
                       3, judge(line.number("ratio"), 3, True)])
        if not self.spread():
            yield row([f"ensemble step: {ENSEMBLE}", "-", 3,
                       f"not known: {self.missing}"])

    def why(self) -> Iterable[str]:
        """Why figures are not reached."""
        ratio = {line["real"]: line.number("ratio") for line in self.spread()}
        if ratio and min(ratio.values()) < 3:
            yield ("* The ensemble: a vector of AVX2 holds 4 doubles or 8 "
                   "floats, and twice the lanes bring "
                   f"{ratio['float'] / ratio['double']:.2g} times as much. "
                   "Lanes have no branches: each goes through all modes and "
                   "keeps one, where a single step leaves out what its phase "
                   "does not need. Lanes that the common path does not cover, "
                   + " and ".join(f"{line['alone']} of them in {line['real']}"
                                  for line in self.spread()) +
                   ", take a single step besides.")
