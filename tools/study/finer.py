"""`make finer`: motions under laws without a jump, from the sliding region of
`chaos` through its two-fold, as the width of the laws shrinks.

What theory says of a motion in the layer. Across a layer of effective width eps
(the width over the slope of phi where the stick through the two-fold runs, phi
= lambda/mu), at a time t from the two-fold and with s = t sqrt(a/eps), a =
|dA/dt| mu, a deviation xi (in units of eps) obeys

    xi'' - s xi' + nu xi = 0,   nu = (ratio of the eigenvalues) - 1

Before the two-fold the part that decays slowest is |s|^nu; behind it all grows
like exp(s^2/2) s^(-nu - 1). A kick at s = 0 grows by M(-nu/2, 1/2, s^2/2),
Kummer's function, and s^2/2 is the integral of the layer's rate, the `behind`
of finer.c.
"""
from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Callable, Iterator, Optional

import numpy as np
import pandas as pd
from scipy import integrate, optimize, special, stats

import driven
import families
import pictures
import table
from pictures import MODES, SERIES, pyplot

EXIT = 3  # a motion has left where |h| is that many widths
GROWN = 30  # the exponent from which the theory of growth is used
ALIKE = 0.05  # exits at times that differ by less are the same
UNITS = {24: 2.0 ** -24, 53: 2.0 ** -53, 64: 2.0 ** -64}
# Effective widths are 10^(-n/4) m/s.
EXACT = range(18, 27)
EXACT_ALGEBRAIC = range(16, 29)
LAST_BITS = {24: range(16, 25), 53: range(18, 27), 64: range(20, 27)}
STARTS = 1e-15, 1e-12, 1e-9, 1e-6, 1e-3
KICKED = 1e-12, 1e-8  # [m/s]
KICKED_WIDTHS = range(16, 27, 2)
TURNED = range(22, 29, 2)  # widths at which the kick is sought that turns it
SINGLE = {1e-6: (113, range(8, 22, 3)), 1e-7: (64, range(10, 17, 3))}

PHI: dict[str, Callable[[float], float]] = {
    "algebraic": lambda x: x / math.hypot(1, x),
    "tanh": math.tanh,
    "arctan": lambda x: math.atan(x) * 2 / math.pi,
    "cubic": lambda x: x * (3 - x * x) / 2,
    "skew": lambda x: (2 * x + math.hypot(1, x) - 1)
    / math.hypot(1, 2 * x + math.hypot(1, x) - 1),
    "corner": lambda x: x / math.hypot(1, x),
    "angle": lambda x: x}


def slope(form: str, share: float) -> float:
    """phi' where phi is `share`."""
    phi, by = PHI[form], 1e-5
    end = 1 - by if form in ("cubic", "angle") else 50
    x = optimize.brentq(lambda y: phi(y) - share, -end, end)
    return (phi(x + by) - phi(x - by)) / (2 * by)


class TwoFold:
    """The two-fold of `chaos`, and the theory of the layer next to it."""

    def __init__(self, fold: dict) -> None:
        self.r, self.g, self.share = fold["r"], fold["g"], fold["share"]
        self.ratio = fold["ratio"]
        self.nu = self.ratio - 1

    def width(self, form: str, effective: float) -> float:
        """The width of a form that has this effective one [m/s]."""
        scale = abs(self.g) if form == "angle" else 1
        return effective * slope(form, self.share) / scale

    def gain(self, exponent: float) -> float:
        """By how much a kick at the two-fold grows up to s^2/2 = exponent."""
        return abs(special.hyp1f1(-self.nu / 2, 0.5, exponent))

    def exponent(self, gain: float) -> Optional[float]:
        """Where it has grown that much, where it is enough to tell."""
        return optimize.brentq(
            lambda e: math.log(self.gain(e) / gain), 27, 300) \
            if gain > self.gain(27) else None


# Following.

def experiments(fold: TwoFold) -> Iterator[tuple[str, int, list[str]]]:
    """Name, bits and arguments of each run."""
    def of(form: str, effective: float, *more: str) -> list[str]:
        return [f"form={form}", f"width={fold.width(form, effective):.17g}",
                *more]

    for form in PHI:
        for n in EXACT_ALGEBRAIC if form == "algebraic" else EXACT:
            yield f"exact {n}", 113, of(form, 10 ** (-n / 4))
    for bits, steps in LAST_BITS.items():
        for n in steps:
            yield f"bits {n}", bits, of(
                "algebraic", 10 ** (-n / 4), "samples=24", "seed=1",
                f"delta={4 * UNITS[bits]}")
    for start in STARTS:
        yield f"start {start:g}", 113, of("algebraic", 1e-6, "samples=4",
                                          "seed=2", f"delta={start}")
    for kick in KICKED:
        for n in KICKED_WIDTHS:
            yield f"kicked {kick:g} {n}", 64, of(
                "algebraic", 10 ** (-n / 4), "samples=24", "seed=3",
                f"kick={kick}")
    for width, (bits, powers) in SINGLE.items():
        for n in powers:
            yield f"kick {width:g}", bits, of("algebraic", width,
                                              f"kick=1e-{n}")
    # 1 / (3 kappa): the law that the paper stretches.
    for k in 1 / (3 * families.SCENE["kappa"]), 10, 100, 1000:
        for bits in 53, 64:
            yield f"stiff {k:.4g}", bits, ["form=two_piece",
                                           f"width={1 / k:.17g}"]


def turning(fold: TwoFold, run: Callable[..., list[str]],
            n: int) -> tuple[float, float, float]:
    """Effective width, and between which two kicks of h at the two-fold the
    exit of form algebraic changes its side, by bisection in binary128."""
    effective = 10 ** (-n / 4)
    width = fold.width("algebraic", effective)
    form = ["form=algebraic", f"width={width:.17g}"]

    def side(kick: float) -> object:
        said = "\n".join(run(113, [*form, f"kick={kick:.17g}"]))
        return table.parsed(said).side[0]

    plain = side(0)
    scale = 1e-20 * (effective / 1e-6) ** 7.5 / 30
    sign, low = next((sign, scale * 3 ** i) for i in range(8)
                     for sign in (1, -1)
                     if side(sign * scale * 3 ** (i + 1)) != plain)
    high = 3 * low
    while high > 1.05 * low:
        middle = math.sqrt(low * high)
        if side(sign * middle) == plain:
            low = middle
        else:
            high = middle
    return effective, sign * low, sign * high


def delassus(r: Any, kappa: float) -> Any:
    """A, by which a force across the wheel's plane changes h' [1/kg]."""
    scene = families.SCENE
    sine, cosine = math.sin(scene["gamma"]), math.cos(scene["gamma"])
    return (r ** 2 + (scene["beta"] * sine) ** 2
            + kappa * r * cosine) / (scene["beta"] ** 2 + r ** 2)


def contraction(twofold: str, form: str, folder: Path) -> float:
    """C, the integral of A phi'(phi^-1(F/mu)) mu over the stick that leads to
    the two-fold, by the core's set-valued stick alone: the layer's contraction
    is exp(-C/width) as the width goes to 0. The last 0.07 ms, in which A goes
    to 0, are a share of 3e-7."""
    path = folder / "stick.csv"
    table.said(
        twofold, "run", "chaos", "--scheme", "located", "--dt", "1e-4",
        "--t-end", "0.1236", "--set", "r=0.191960972", "--set",
        "omega=-1.053244828", "--set", "h=0", "--every", "1", "--out", path)
    rows = table.read(path)
    return float(integrate.simpson(
        delassus(rows.r, families.SCENE["kappa"])
        * [slope(form, force) for force in rows.F], x=rows.t))


def follow(work: Path, twofold: str) -> None:
    """runs.csv, the lines of finer.c after the name of their experiment;
    turning.csv, which kick turns the exit; families.json, what the command line
    says."""
    programs = work.parent / "finer-"

    def run(bits: int, words: list[str]) -> list[str]:
        return driven.output(f"{programs}{bits}", *words).splitlines()

    told = {"fold": families.two_fold(twofold)}
    fold = TwoFold(told["fold"])
    # The longest first.
    runs = sorted(experiments(fold), key=lambda one: (-one[1], one[0]))
    lines = driven.side_by_side(lambda one: run(*one[1:]), runs)
    (work / "runs.csv").write_text(f"experiment,{lines[0][0]}\n" + "".join(
        f"{name},{line}\n" for (name, _, _), said in zip(runs, lines)
        for line in said[1:]), "ascii")
    pd.DataFrame(driven.side_by_side(lambda n: turning(fold, run, n), TURNED),
                 columns=["width", "low", "high"]).to_csv(
        work / "turning.csv", index=False, float_format="%.6g")
    told.update(gamma=families.by_angle(twofold),
                limits=families.limits(twofold),
                circle=families.circle(twofold, work))
    (work / "families.json").write_text(json.dumps(told, indent=1), "ascii")


def draw(study: Study, path: Path) -> None:
    """The picture of `make finer`: what decides, over the width; and where
    motions leave."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    exact = study.exact.reset_index()
    for (form, rows), colour in zip(exact.groupby("form", sort=False),
                                      SERIES):
        decided = rows.dropna(subset="disturbance")
        left.loglog(decided.effective, decided.disturbance, "o-", ms=3, lw=0.8,
                    color=colour, label=form)
        out = rows[rows.side != 0]
        right.semilogx(out.effective, 1e3 * out.exit_r, "-", lw=0.8,
                       color=colour)
    left.loglog(study.turned.width, abs(study.turned.high), "s", ms=6,
                mfc="none", color="black", label="turns the exit")
    for bits, name in (24, "float"), (53, "double"), (64, "x87"):
        rows = study.of("bits", bits=bits).dropna(subset="disturbance")
        if len(rows):
            left.loglog(rows.effective, rows.disturbance, "x", ms=3,
                        color="0.5")
            left.annotate(name, (rows.effective.iloc[-1],
                                 rows.disturbance.iloc[-1]), fontsize=8)
    left.set(xlabel="effective width [m/s]",
             ylabel="kick at the two-fold that decides, from E [m/s]",
             title="binary128: the motion itself; grey: rounding")
    left.legend(fontsize=7)
    kicked = study.of("kicked")
    for kick, mark, alpha in (1e-8, "s", 0.25), (1e-12, "o", 0.6):
        for side, colour in (1, MODES["slip+"]), (-1, MODES["slip-"]):
            rows = kicked[(kicked.n == kick) & (kicked.side == side)]
            right.semilogx(rows.effective, 1e3 * rows.exit_r, mark, ms=3,
                           color=colour, alpha=alpha)
    right.axhline(1e3 * study.fold.r, lw=0.6, color="black")
    right.set(xlabel="effective width [m/s]", ylabel="r at the exit [mm]",
              title="lines: undisturbed; kicks of 1e-12 (o), 1e-8 (square)")
    pictures.save(figure, path)


# Tables.

class Study:
    """The motions, and the tables made of them. Of each motion `effective` is
    its effective width, `after` the time from the two-fold to the exit, and
    `disturbance` the kick at the two-fold that would make this exit [m/s]."""

    def __init__(self, folder: Path) -> None:
        self.families = json.loads((folder / "families.json").read_text())
        self.fold = TwoFold(self.families["fold"])
        self.turned = table.read(folder / "turning.csv")
        rows = table.read(folder / "runs.csv")
        rows["after"] = rows.exit_t - rows.fold_t
        unit = {form: self.fold.width(form, 1) for form in PHI}
        rows["effective"] = rows.width / rows.form.map(unit)
        grown = (rows.side != 0) & (rows.behind >= GROWN)
        rows["disturbance"] = (EXIT * rows.effective / rows.behind.map(
            self.fold.gain)).where(grown)
        name = rows.experiment.str.split(expand=True)
        rows["name"], rows["n"] = name[0], pd.to_numeric(name[1])
        self.rows = rows
        self.exact = rows[rows.name == "exact"].set_index(["form", "n"])

    def of(self, name: str, **values: object) -> pd.DataFrame:
        """The motions of some experiments."""
        found = self.rows[self.rows.name == name]
        for column, value in values.items():
            found = found[found[column] == value]
        return found

    def alike(self, bits: int, n: int) -> Optional[float]:
        """The share of last-bit starts whose exit is that of binary128."""
        rows = self.of("bits", bits=bits, n=n)
        if rows.empty:
            return None
        exact = self.exact.loc["algebraic", n]
        same = rows.side == exact.side
        if exact.side:
            same &= (rows.after / exact.after - 1).abs() < ALIKE
        return float(same.mean())

    def critical(self, bits: int) -> float:
        """The effective width at which half of them are."""
        for a, b in zip(LAST_BITS[bits], LAST_BITS[bits][1:]):
            high, low = self.alike(bits, a), self.alike(bits, b)
            if high is not None and low is not None and high >= 0.5 > low:
                return 10 ** (-(a + (high - 0.5) / (high - low)) / 4)
        return math.nan

    def rounding(self, bits: int) -> float:
        """The disturbance, in half units in the last place of 1, that rounding
        amounts to: the median where no exit is that of binary128."""
        rows = self.of("bits", bits=bits)
        few = [n for n in LAST_BITS[bits]
               if (self.alike(bits, n) or 0) < 0.25]
        kicks = rows[rows.n.isin(few)].disturbance.dropna()
        return kicks.median() / UNITS[bits]

    def predicted(self, bits: int) -> float:
        """Where the exact motion carries as much as rounding in double."""
        exact = self.exact.loc["algebraic"].disturbance.dropna()
        want = -math.log(self.rounding(53) * UNITS[bits])
        at = -np.log(exact.to_numpy())
        return 10 ** (-np.interp(want, at, exact.index) / 4) \
            if at[0] <= want <= at[-1] else math.nan

    def kick_exponents(self) -> pd.DataFrame:
        """Motions after a kick and, where the kick is small enough, the
        exponent that Kummer's function predicts."""
        rows = self.of("kick").sort_values(["n", "kick"],
                                           ascending=[True, False])
        return rows.assign(want=[self.fold.exponent(gain) for gain in
                                 EXIT * rows.effective / rows.kick])

    def gamma(self) -> pd.DataFrame:
        """Machines with the wheel at other angles."""
        rows = pd.DataFrame(self.families["gamma"])
        rows.insert(7, "ratio", rows.strong / rows.weak)
        rows["case"] = rows.case.map("{:.0f}".format, "ignore")
        rows["ratio"] = rows.ratio.where(rows.ratio > 0)
        texts = rows.applymap(lambda one: one if isinstance(one, str) else
                              "-" if one != one else f"{one:.4g}").fillna("-")
        texts.columns = ["gamma + pi", "kappa [m]", "k2 [N/m]", "type", "case",
                         "weak", "strong", "ratio", "jump of p' [m/s^2]",
                         "of w' [rad/s^2]", "stick rests at r [m]"]
        return texts

    def power(self) -> str:
        """Exponent of the disturbance over the width, where all are past
        GROWN, by a fit with its 95 % half interval."""
        rows = self.exact[self.exact.disturbance > 0].reset_index()
        rows = rows[(rows.n >= 22) & (rows.form != "angle")]
        fit = stats.linregress(np.log(rows.effective),
                               np.log(rows.disturbance))
        return (f"{fit.slope:.2f} (+- {2 * fit.stderr:.2f} by the fit alone, "
                f"{len(rows)} motions from 3e-6 m/s down)")

    def numbers(self) -> pd.DataFrame:
        """What the text speaks of."""
        limits, circle = self.families["limits"], self.families["circle"]
        exact = self.exact.loc["algebraic"]
        kicks = self.kick_exponents().dropna(subset="want").sort_values("kick")
        over = 100 * (kicks.behind / kicks.want - 1)
        turn = np.polyfit(*np.log(self.turned.abs().values.T[::2]), 1)
        wide = [self.critical(bits) for bits in UNITS]
        roots = families.circle_roots()
        apart = max(min(abs(end - one) for one in roots)
                    for _, _, end, _, _ in circle["motions"])
        last = exact.iloc[-1]
        moved = np.ptp(self.of("start", n=1e-3).exit_r)
        return pd.DataFrame(columns=["what", "value"], data=[
            ["phi of the stick through the two-fold, lambda/mu",
             f"{self.fold.share:.4f}"],
            ["shift of r at the exit, if w at the start changes by 1e-3",
             f"{moved:.0e} m"],
            ["kick [m/s] between these turns the exit, at effective width",
             ", ".join("{1:+.2e} and {2:+.2e} at {0:.2g} m/s".format(*one)
                       for one in self.turned.values)],
            ["its exponent over these widths; for width to 0, (ratio + 1)/2",
             f"{turn[0]:.1f}; {self.fold.nu / 2 + 1:.2f}"],
            ["that kick from E, by theory's leading order",
             f"{exact.disturbance[24]:.0e} m/s at 1e-6 m/s, "
             f"{last.disturbance:.0e} at {last.effective:.0e}, exponent "
             + self.power()],
            ["critical widths of float, double, x87; to that of double",
             ", ".join(f"{one:.1e} m/s" for one in wide) +
             f"; {wide[0] / wide[1]:.1f}, {wide[2] / wide[1]:.2f}"],
            ["predicted; rounding is a kick of so many u", ", ".join(
                "-" if np.isnan(one) else f"{one:.1e} m/s" for one in
                map(self.predicted, UNITS)) + "; " + ", ".join(
                    "-" if np.isnan(one) else f"{one:.1g}" for one in
                    map(self.rounding, UNITS))],
            ["measured E above what is predicted",
             f"{over[1:].min():.1g} to {over[1:].max():.1g} %; at the least "
             f"kick, {kicks.kick.iloc[0]:g} m/s, {over.iloc[0]:.0f} %"],
            ["case 1 ends at gamma + pi; with kappa and k2 held it lasts",
             f"{limits['designed']:.4f}; from {limits['held_low']:.4f} to "
             f"{limits['held_high']:.4f}"],
            ["rolling circle: roots; motions keep r, end within",
             f"{roots[0]:.7f} and {roots[1]:.7f} rad/s; to "
             f"{max(one[1] for one in circle['motions']):g} m, "
             f"{apart:.0e} rad/s"],
            ["rate of the distance from it at -1.415 and 1.415 rad/s",
             "{:.4f} and {:.4f} 1/s".format(*circle["rates"])]])


def count(work: Path, kept: Path) -> dict[str, pd.DataFrame]:
    """The tables, and the picture."""
    study = Study(work)
    draw(study, kept / "finer.png")
    return {"numbers": study.numbers(), "gamma": study.gamma()}
