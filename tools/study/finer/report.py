#!/usr/bin/python3 -B
"""What `make finer` found, as Markdown, and its picture.

usage: report.py TWOFOLD FOLDER     (FOLDER: runs.csv, families.json)
"""
from __future__ import annotations

import json
import math
import re
import sys
import textwrap
from collections import defaultdict
from pathlib import Path
from typing import Iterable, Optional, Sequence

import matplotlib
import numpy as np

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])
from finer import texts, theory  # noqa: E402
from tables import markdown, read  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

GROWN = 30  # the exponent from which the theory of growth is used
ALIKE = 0.05  # exits at times that differ by less are the same
Runs = dict[str, list[read.Row]]


def time_behind(row: read.Row) -> float:
    """From the two-fold to the exit [s]; NaN where it does not leave."""
    return row.number("exit_t") - row.number("fold_t")


def side(row: read.Row) -> str:
    return {"1": "+", "-1": "-", "0": "rests"}[row["side"]]


def exit_of(row: read.Row) -> str:
    """Side and time [ms] of an exit."""
    if row["side"] == "0":
        return "rests"
    return f"{side(row)} {1e3 * time_behind(row):.4g}"


def between(values: Sequence[float], digits: int) -> str:
    """The range of some numbers."""
    low, high = (f"{end:.{digits}f}" for end in (min(values, default=math.nan),
                                                 max(values, default=math.nan)))
    return "-" if not values else low if low == high else f"{low} to {high}"


def told(width: float) -> str:
    return f"{width:.2g}"


class Study:
    """The runs, and the tables made of them."""

    def __init__(self, twofold: str, folder: Path) -> None:
        self.fold = theory.TwoFold(twofold)
        self.runs: Runs = defaultdict(list)
        for row in read.read_csv(str(folder / "runs.csv"), ["experiment"]):
            self.runs[row["experiment"]].append(row)
        self.turned = [(row.number("width"), abs(row.number("high"))) for row
                       in read.read_csv(str(folder / "turning.csv"))]
        self.families = json.loads((folder / "families.json").read_text())
        self.exact = {(row["form"], int(name.split()[1])): row
                      for name, rows in self.runs.items()
                      if name.startswith("exact ") for row in rows}

    def disturbance(self, row: read.Row) -> Optional[float]:
        """The kick at the two-fold that would make this exit [m/s]."""
        exponent = row.number("behind")
        if row["side"] == "0" or exponent < GROWN:
            return None
        return self.fold.disturbance(self.effective(row), exponent)

    def effective(self, row: read.Row) -> float:
        """The effective width of a run [m/s]."""
        return row.number("width") / self.fold.width(row["form"], 1)

    def selected(self) -> str:
        """Side and time by form and width, and what follows."""
        lines = []
        for n in sorted({n for _, n in self.exact}):
            here = [self.exact[form, n] for form in theory.PHI
                    if (form, n) in self.exact]
            grown = [row.number("behind") for row in here
                     if row["side"] != "0"]
            places = [1e3 * row.number("zero_r") for row in here
                      if row["form"] != "angle"]
            lines.append([
                told(10 ** (-n / 4)),
                *(exit_of(self.exact[form, n]) if (form, n) in self.exact
                  else "" for form in theory.PHI),
                between(grown if min(grown, default=0) > GROWN else [], 1),
                between(places, 2)])
        return markdown.table(["effective width [m/s]", *theory.PHI, "E",
                               "r [mm], all but `angle`"], lines)

    def power(self) -> tuple[float, float, int]:
        """Exponent of the disturbance over the width, its 95 % half interval
        and the number of motions: where all are past GROWN."""
        points = [(math.log(self.effective(row)), math.log(found))
                  for (form, n), row in self.exact.items()
                  for found in [self.disturbance(row)]
                  if found and n >= 22 and form != "angle"]
        x, y = np.array(points).T
        slope, start = np.polyfit(x, y, 1)
        rest = y - slope * x - start
        error = math.sqrt(sum(rest ** 2) / (len(x) - 2)
                          / sum((x - x.mean()) ** 2))
        return slope, 2 * error, len(x)

    def kicked(self) -> str:
        """Spread of futures under one disturbance."""
        lines = []
        for name, rows in self.runs.items():
            if not name.startswith("kicked "):
                continue
            _, kick, n = name.split()
            exits = [1e3 * row.number("exit_r") for row in rows
                     if row["side"] != "0"]
            lines.append((float(kick), int(n), [
                kick, told(10 ** (-int(n) / 4)),
                f"{len(exits)} of {len(rows)}",
                str(sum(row["side"] == "1" for row in rows)),
                markdown.digits(np.ptp(exits), 2) if exits else "",
                markdown.digits(np.ptp([1e3 * row.number("zero_r")
                                        for row in rows]), 2)]))
        return markdown.table(
            ["disturbance [m/s]", "effective width [m/s]", "leave", "to slip+",
             "range of r at exit [mm]", "range of r where g = 0 [mm]"],
            [line for _, _, line in sorted(lines)])

    def starts(self) -> str:
        """How far the exit moves under changes of the start [m]."""
        rows = self.runs[f"start {0.001:g}"]
        return f"{np.ptp([row.number('exit_r') for row in rows]):.0e}"

    def alike(self, bits: int, n: int) -> Optional[float]:
        """The share of last-bit starts whose exit is that of quad."""
        rows = [row for row in self.runs.get(f"bits {n}", [])
                if row["bits"] == str(bits)]
        if not rows:
            return None
        exact = self.exact["algebraic", n]
        if exact["side"] == "0":
            return sum(row["side"] == "0" for row in rows) / len(rows)
        return sum(row["side"] == exact["side"]
                   and abs(time_behind(row) / time_behind(exact) - 1) < ALIKE
                   for row in rows) / len(rows)

    def critical(self, bits: int) -> float:
        """Where half of them are."""
        steps = sorted(n for n in range(60)
                       if self.alike(bits, n) is not None)
        for a, b in zip(steps, steps[1:]):
            high, low = self.alike(bits, a), self.alike(bits, b)
            if high >= 0.5 > low:
                return 10 ** (-(a + (high - 0.5) / (high - low)) / 4)
        return math.nan

    def rounding(self, bits: int) -> Optional[float]:
        """The disturbance, in half units in the last place of 1, that
        rounding amounts to: the median where no exit is that of quad."""
        found = [self.disturbance(row)
                 for name, rows in self.runs.items()
                 if name.startswith("bits ") for row in rows
                 if row["bits"] == str(bits)
                 and self.alike(bits, int(name.split()[1])) < 0.25]
        known = [one for one in found if one]
        return float(np.median(known)) * 2.0 ** bits if known else None

    def predicted(self, bits: int, units: float) -> float:
        """Where the disturbance that the exact motion carries is `units`."""
        points = sorted((n, self.disturbance(row))
                        for (form, n), row in self.exact.items()
                        if form == "algebraic" and self.disturbance(row))
        want = math.log(units * 2.0 ** -bits)
        logs = [math.log(found) for _, found in points]
        steps = [n for n, _ in points]
        at = np.interp(-want, [-one for one in logs], steps)
        return 10 ** (-at / 4) if -logs[0] <= -want <= -logs[-1] else math.nan

    def precision(self) -> str:
        """Shares by width and precision, and the critical widths."""
        units = self.rounding(53) or math.nan
        lines = []
        for n in range(16, 27):
            shares = [self.alike(bits, n) for bits in (24, 53, 64)]
            lines.append([told(10 ** (-n / 4)), *(
                "" if one is None else f"{one:.2f}" for one in shares)])
        lines.append(["critical width, measured", *(
            markdown.digits(self.critical(bits), 2) for bits in (24, 53, 64))])
        lines.append(["predicted", *(
            markdown.digits(self.predicted(bits, units), 2)
            for bits in (24, 53, 64))])
        lines.append(["rounding, in units u", *(
            markdown.digits(self.rounding(bits) or math.nan, 2)
            for bits in (24, 53, 64))])
        return markdown.table(["effective width [m/s]", "float", "double",
                               "x87, 64 bits"], lines)

    def kick_exponents(self) -> Iterable[tuple[str, read.Row, Optional[float]]]:
        """Width, motion after a kick and, where the kick is small enough, the
        exponent that Kummer's function predicts."""
        for width in "1e-06", "1e-07":
            for row in self.runs[f"kick {width}"]:
                gain = theory.EXIT * self.effective(row) / row.number("kick")
                yield width, row, (self.fold.exponent(gain) if gain >
                                   self.fold.gain(27) else None)

    def excess(self) -> dict[str, float]:
        """By how many per cent the measured exponents are above these: the
        ends over all kicks but the least one, and at that."""
        found = sorted((row.number("kick"),
                        100 * (row.number("behind") / want - 1))
                       for _, row, want in self.kick_exponents() if want)
        others = [one for _, one in found[1:]]
        return {"kick_least": found[0][0], "kick_last": found[0][1],
                "kick_low": min(others), "kick_high": max(others)}

    def kicks(self) -> str:
        """Growth of single kicks, beside Kummer's function."""
        lines = []
        for width, row, want in self.kick_exponents():
            kick = row.number("kick")
            lines.append((float(width), -kick, [
                f"{float(width):g}", f"{kick:g}", exit_of(row),
                f"{row.number('behind'):.2f}",
                f"{want:.2f}" if want else "-"]))
        return markdown.table(
            ["effective width [m/s]", "kick [m/s]", "side, time [ms]",
             "exponent", "predicted"], [line for _, _, line in sorted(lines)])

    def stiff(self) -> str:
        rows = sorted((row for name, rows in self.runs.items()
                       if name.startswith("stiff ") for row in rows),
                      key=lambda row: (-row.number("width"), row["bits"]))
        return markdown.table(
            ["k [1/m^2]", "bits", "left the layer before",
             "h = g = 0 after [ms]", "r [mm]"],
            [[f"{1 / row.number('width'):.4g}", row["bits"],
              "no" if row["side"] == "0" else "yes",
              f"{1e3 * (row.number('zero_t') - row.number('fold_t')):.4g}",
              f"{1e3 * row.number('zero_r'):.3f}"] for row in rows])

    def gamma(self) -> str:
        lines = []
        for row in self.families["gamma"]:
            ratio = row["strong"] / row["weak"]
            lines.append([
                f"{row['angle']:.4g}", f"{row['kappa']:.4g}",
                f"{row['k2']:.4g}", row["type"], row["case"] or "-",
                f"{row['weak']:.4g}", f"{row['strong']:.4g}",
                f"{ratio:.4g}" if ratio > 0 else "-",
                f"{row['jump_p']:.3g}", f"{row['jump_w']:.3g}",
                f"{row['behind']:.3g}" if row["behind"] else "-"])
        return markdown.table(
            ["gamma + pi", "kappa [m]", "k2 [N/m]", "type", "case", "weak",
             "strong", "ratio", "jump of p' [m/s^2]", "of w' [rad/s^2]",
             "stick behind [s]"], lines)

    def contraction(self) -> str:
        lines = []
        for n in 20, 24, 28:
            row = self.exact["algebraic", n]
            C = -row.number("before") * row.number("width")
            lines.append([f"{row.number('width'):.3g}", f"{1e3 * C:.5f}",
                          f"{C / self.families['C'] - 1:.1e}",
                          f"{-row.number('before'):.0f}",
                          f"{row.number('behind'):.1f}"])
        return markdown.table(
            ["width [m/s]", "contraction times width [mm/s]",
             "relative difference from C", "exponent before",
             "behind, at the exit"], lines)

    def core(self) -> str:
        return ", ".join(f"{error:.2g} at dt = {dt:g} s"
                         for dt, error in self.families["core"])

    def numbers(self) -> dict[str, object]:
        """What the text quotes."""
        slope, error, count = self.power()
        nu, limits = self.fold.nu, self.families["limits"]
        p = theory.SCENE
        units = self.rounding(53) or math.nan
        finest = self.exact["algebraic", max(n for _, n in self.exact)]
        Q = math.sin(p["gamma"]) * 1e-3 / p["kappa"]
        ends = [(-s * Q + sign * math.sqrt(Q * Q + 4 * 2.2270992253886014 * 0.9)
                 ) / 2 for s, sign in ((1, -1), (-1, 1))]
        rates = self.families["circle"]["rates"]
        motions = self.families["circle"]["motions"]
        width, kick = np.log(np.array(self.turned)).T
        critical = {f"crit{bits}": self.critical(bits) for bits in (24, 53, 64)}
        return {
            "exit": theory.EXIT, "half_four": 2 * nu, **self.excess(),
            "off": self.fold.ratio - 14, "share": self.fold.share, "nu": nu,
            "power": nu / 2 + 1, "slope": slope,
            "error": error, "count": count, "C": 1e3 * self.families["C"],
            "turned": ", ".join(f"{two:.2g} m/s at {one:.2g} m/s"
                                for one, two in self.turned),
            "turn_slope": np.polyfit(width, kick, 1)[0],
            **critical, "up": critical["crit24"] / critical["crit53"],
            "down": critical["crit64"] / critical["crit53"],
            "drift": max(gone for _, gone, _, _, _ in motions),
            "apart": max(min(abs(end - one) for one in ends)
                         for _, _, end, _, _ in motions),
            "units": units, "designed": limits["designed"],
            "low": limits["held_low"], "high": limits["held_high"],
            "at_6": self.disturbance(self.exact["algebraic", 24]),
            "at_finest": self.disturbance(finest),
            "finest": self.effective(finest),
            "end_minus": ends[0], "end_plus": ends[1],
            "rate_minus": rates[0], "rate_plus": rates[1],
            "worst": max(row.number("error") for (form, _), row
                         in self.exact.items() if form != "angle")}


def draw(study: Study, path: Path) -> None:
    """What decides, over the width; and where motions leave."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for form in theory.PHI:
        points = [(study.effective(row), study.disturbance(row))
                  for (name, _), row in sorted(study.exact.items())
                  if name == form and study.disturbance(row)]
        if points:
            left.loglog(*zip(*points), "o-", ms=3, lw=0.8, label=form)
    left.loglog(*zip(*study.turned), "s", ms=6, mfc="none", color="black",
                label="turns the exit")
    for bits, name in (24, "float"), (53, "double"), (64, "x87"):
        points = [(study.effective(row), study.disturbance(row))
                  for key, rows in study.runs.items()
                  if key.startswith("bits ") for row in rows
                  if row["bits"] == str(bits) and study.disturbance(row)]
        if points:
            left.loglog(*zip(*points), "x", ms=3, color="0.5")
            left.annotate(name, points[-1], fontsize=8)
    left.set(xlabel="effective width [m/s]",
             ylabel="kick at the two-fold that decides, from E [m/s]",
             title="binary128: the motion itself; grey: rounding")
    left.legend(fontsize=7)
    for kick, mark in ("1e-08", "s"), ("1e-12", "o"):
        for name, rows in study.runs.items():
            if name.startswith(f"kicked {kick} "):
                for row in rows:
                    if row["side"] == "0":
                        continue
                    right.semilogx(
                        study.effective(row), 1e3 * row.number("exit_r"), mark,
                        ms=3, color="#D55E00" if row["side"] == "1"
                        else "#E69F00", alpha=0.6 if mark == "o" else 0.25)
    for form in theory.PHI:
        points = [(study.effective(row), 1e3 * row.number("exit_r"))
                  for (name, _), row in sorted(study.exact.items())
                  if name == form and row["side"] != "0"]
        right.semilogx(*zip(*points), "-", lw=0.6, color="0.4")
    right.axhline(1e3 * study.fold.r, lw=0.6, color="black")
    right.set(xlabel="effective width [m/s]", ylabel="r at the exit [mm]",
              title="lines: undisturbed; kicks of 1e-12 (o), 1e-8 (square)")
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def filled(page: str) -> str:
    """Its paragraphs and lists in lines of 79; what else there is as it is."""
    parts = []
    for part in page.rstrip().split("\n\n"):
        if not part.startswith(("#", "|", "![")):
            part = "\n".join(
                textwrap.fill(" ".join(item.split()), 79,
                              break_on_hyphens=False, break_long_words=False,
                              subsequent_indent=" " * len(mark[0]))
                for item in re.split(r"\n(?=\d\. |\* )", part)
                for mark in [re.match(r"\d\. |\* |", item)])
        parts.append(part)
    return "\n\n".join(parts)


def main() -> None:
    study = Study(sys.argv[1], Path(sys.argv[2]))
    draw(study, Path(sys.argv[2], "finer.png"))
    tables = {name: getattr(study, name)() for name in (
        "core", "contraction", "selected", "kicked", "starts",
        "precision", "kicks", "stiff", "gamma")}
    print(filled(texts.PAGE.format(**study.numbers(), **tables)))


if __name__ == "__main__":
    read.run_script(main)
