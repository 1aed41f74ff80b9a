"""`make sides`: to which side motions leave the layer of finer laws, at 200
widths a decade, and how often the side changes along lines of starts before
the two-fold, between which are canards.

The side is that of the first swing of h, where |h| first is 1 width. At 3
widths, where finer.py says that a motion has left, it is the other one where
the first swing turns back in between.
"""
import itertools
import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import optimize

import driven
import families
import finer
import pictures
import table
from pictures import LINE, MODES, colors, pyplot

WIDTHS = range(700, 1501)  # effective ones, 10^(-n/200) m/s
READ = [(form, 1) for form in finer.PHI] + [("algebraic", 3)]
HANDED_ON = 0.0997  # [s], 24 ms before the two-fold: binary128 from there on
RATIOS = 13.5, 13.9, 14, 14.1
LAYERS = 1e-6, 1e-7  # effective widths
BEFORE = 32, 72  # the layer contracts by exp(-BEFORE) from the starts on
LINES = list(itertools.product(RATIOS, LAYERS, BEFORE))
STARTS = 161
GROWN = 10  # E of a motion that was in the layer behind the two-fold
SIGNS = {-1: "-", 0: "0", 1: "+"}


def motion(program: str, *words: object) -> pd.Series:
    """What finer.c says of one."""
    return table.parsed(driven.output(program, *words)).iloc[-1]


def side(programs: str, fold: finer.TwoFold, form: str, exit_at: int,
         n: int) -> str:
    """Of a motion from where `chaos` lands; what x87 rounds far before the
    two-fold decays."""
    width = fold.width(form, 10 ** (-n / 200))
    words = f"form={form}", f"width={width!r}", f"exit={exit_at}", "only=1"
    start = motion(f"{programs}64", *words, f"until={HANDED_ON}")
    last = motion(f"{programs}113", *words, f"r={start.r!r}", f"w={start.w!r}",
                  f"x={start.x!r}", "until=0.7")
    return SIGNS[last.side]


def design(twofold: str, ratio: float) -> dict:
    """`chaos` with the two-fold's omega where its eigenvalues have a ratio."""
    def found(omega: float) -> dict:
        return json.loads(table.said(
            twofold, "design", "chaos", "--r", families.PLACE[0],
            f"--omega={omega!r}") or "")

    def above(omega: float) -> float:
        weak, strong = found(omega)["two_fold"]["eigenvalues"]
        return strong / weak - ratio

    return found(optimize.brentq(above, -1.05, -1.02, xtol=1e-13))


def line(twofold: str, made: dict, width: float, before: float,
         ) -> tuple[float, float, np.ndarray]:
    """Time before the two-fold, r, and omega of starts: evenly from where the
    stick there ends, past the weak direction, to four times as far."""
    fold = made["two_fold"]
    speed, _, turned = fold["directions"][0]["velocity"]
    steep = (finer.delassus(fold["r"] + 1e-6, made["kappa"])
             - finer.delassus(fold["r"] - 1e-6, made["kappa"])) / 2e-6
    t = math.sqrt(2 * before * width / abs(steep * speed))
    r, middle = fold["r"] - t * speed, fold["omega"] - t * turned

    def slips(omega: float) -> bool:
        said = table.said(
            twofold, "run", "chaos", *made["set"].split(), "--t-end", 0,
            "--set", f"r={r!r}", "--set", f"omega={omega!r}", "--set", "h=0",
            "--out", "-")
        return "stick" not in said

    low = families.bisect(slips, middle - 0.1, middle)
    return t, r, np.linspace(low, low + 4 * (middle - low), STARTS + 1)[1:]


def along(twofold: str, program: str, at: tuple[float, float, float],
          ) -> str:
    """The sides of the motions of a line."""
    ratio, width, before = at
    made = design(twofold, ratio)
    t, r, starts = line(twofold, made, width, before)
    wide = finer.TwoFold(families.folded(made["two_fold"])).width(
        "algebraic", width)

    def one(w: float) -> str:
        last = motion(program, f"width={wide!r}", "exit=1", "only=1",
                      f"r={r!r}", f"w={w!r}", f"until={3 * t!r}", *(
                          f"{name}={made[name]!r}" for name in ("kappa", "k2")))
        return SIGNS[last.side if last.behind > GROWN else 0]

    return "".join(map(one, starts))


def follow(work: Path, twofold: str) -> None:
    """sides.csv: a row for each form, and for each line of starts."""
    programs = f"{work.parent}/finer-"
    fold = finer.TwoFold(families.two_fold(twofold))
    wanted = [(form, exit_at, n) for n in reversed(WIDTHS)
              for form, exit_at in READ]
    found = driven.side_by_side(lambda of: side(programs, fold, *of), wanted)
    rows = [(form, exit_at, "".join(
        side for of, side in zip(wanted[::-1], found[::-1])
        if of[:2] == (form, exit_at))) for form, exit_at in READ]
    rows += zip([f"{ratio} {width:g} {before}" for ratio, width, before
                 in LINES], [1] * len(LINES), driven.side_by_side(
                     lambda at: along(twofold, f"{programs}113", at), LINES))
    pd.DataFrame(rows, columns=["of", "exit", "sides"]).to_csv(
        work / "sides.csv", index=False)


def turns(sides: str) -> list[int]:
    """Where a side differs from that of the motion before it."""
    return [i for i in range(1, len(sides)) if sides[i] != sides[i - 1]
            and "0" not in sides[i - 1:i + 1]]


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The tables, and the picture."""
    rows, lines = table.read(work / "sides.csv"), []
    draw(kept / "sides.png", rows.sides[:len(READ)])
    for form, exit_at, sides in rows.iloc[:len(READ)].itertuples(index=False):
        left, up = len(sides) - sides.count("0"), sides.count("+")
        # Wald and Wolfowitz
        by_chance = 2 * up * (left - up) / left
        spread = math.sqrt(by_chance * (by_chance - 1) / (left - 1))
        last = turns(sides)[-1:]
        lines.append({
            "form": form, "read at [widths]": exit_at, "leave": left,
            "to slip+": up, "changes of side": len(turns(sides)),
            "of a random order": f"{by_chance - 2 * spread:.0f} to "
                                 f"{by_chance + 2 * spread:.0f}",
            "last change at [m/s]": "".join(
                f"{10 ** (-WIDTHS[i] / 200):.2g}" for i in last)})
    found = rows.iloc[len(READ):].sides.map(lambda one: " ".join(
        side for side, _ in itertools.groupby(one.replace("0", ""))))
    each = dict(zip(LINES, found))
    return {"sides": pd.DataFrame(lines), "canards": pd.DataFrame([
        {"width [m/s]": f"{width:g}", "E before": before, **{
            f"ratio {ratio}": each[ratio, width, before] for ratio in RATIOS}}
        for width in LAYERS for before in BEFORE])}


def draw(path: Path, sides: pd.Series) -> None:
    """The side over the width, of each form."""
    figure, axes = pyplot.subplots(figsize=(9, 3.2))
    axes.pcolormesh(
        [10 ** (-n / 200) for n in WIDTHS], range(len(READ)),
        [["-0+".index(side) for side in one] for one in sides],
        cmap=colors.ListedColormap([MODES["slip-"], LINE, MODES["slip+"]]),
        vmin=0, vmax=2)
    axes.set(xscale="log", xlabel="effective width [m/s]",
             title="first slip+ (dark), slip- (light), or rest (grey)")
    axes.set_yticks(range(len(READ)), [
        form + f", at {exit_at} widths" * (exit_at > 1)
        for form, exit_at in READ])
    pictures.save(figure, path)
