"""The tables of docs/BENCH.md.

A table is made from sections of BUILD/bench/results.csv; what was not measured
in this build stays in the document as it is. What is not an error, a time or a
verdict of a solver at a dial is in tables beside the rows.
"""
import math
from typing import Callable, Iterable

import pandas as pd

import table as tables
from charts import PICTURES, kept
from measure import (COLUMNS, OUT, STIFF, SWITCHED, load, problems, put,
                     results, save)

LEVELS = 1e-3, 1e-6, 1e-9
STIFF_LEVELS = 1e-2, 1e-3, 1e-4, 1e-6
OWN = "moreau|compensated|located"
RIVALS = f"(?!{OWN})"
HAND, LIBRARIES = "events", f"(?!{OWN}|events)"
FIXED = "moreau"
STABLE = "ok", "degraded"
# Steps of section `kilohertz`, and how the page tells them apart.
IN = {"dt=1.000e-03": "", "dt=3.333e-04": " in three", "dt=1.000e-04": ""}


def series(rows: pd.DataFrame) -> pd.DataFrame:
    """What an error costs at least, a row a problem, solver and error: of
    settings that keep it, as the next two finer ones do, one at least."""
    lines = []
    for key, runs in kept(rows).groupby(["problem", "solver", "name"],
                                        sort=False):
        wrong = runs.verdict.isin(["branch", "refused"]).sum()
        for level in STIFF_LEVELS if key[0] in STIFF else LEVELS:
            good = runs[runs.error <= level]
            lines.append([*key[:2], f"least of {len(runs)}", level,
                          good.ns.min(), good.instructions.min(),
                          f"{wrong} wrong"])
    return pd.DataFrame(lines, columns=COLUMNS)


def kilohertz(rows: pd.DataFrame) -> pd.DataFrame:
    """Steps of 1 ms and less: instructions of a millisecond, and error."""
    length = rows.problem.map(problems().length)
    rows = rows[rows.dial.isin(list(IN)) & rows.instructions.notna()]
    return rows.drop(columns=["ns", "verdict"]).assign(
        instructions=rows.instructions / length / 1e3)


def verdicts(rows: pd.DataFrame) -> pd.DataFrame:
    """Cells by their verdict, and steps that say that they are coarse."""
    table = pd.crosstab(rows.solver, rows.verdict)
    kinds = ["ok", "degraded", "physics", "too_long", "diverged", "told",
             "created", "bad_parameter"]
    return table.reindex(columns=kinds, fill_value=0).reset_index()


def largest(rows: pd.DataFrame) -> pd.DataFrame:
    """The largest step up to which a value is stable, and how the next one
    fails; `*`: the motion itself left the range of states."""
    rows = rows.assign(said=rows.verdict, dt=rows.dial.str[3:])

    def tell(cells: pd.DataFrame) -> str:
        good = cells.said.isin((*STABLE, "physics"))
        first = good.idxmin() if not good.all() else None
        end = cells.loc[:first].iloc[:-1] if first is not None else cells
        star = "*" * bool((end.said == "physics").any())
        step = end.dt.iloc[-1] + star if len(end) else "none"
        return step if first is None else f"{step} {cells.said[first]}"

    told = rows.reset_index(drop=True).groupby(
        ["problem", "solver"], sort=False).apply(tell)
    return told.unstack("solver").reindex(rows.problem.unique()).reset_index()


Reduced = dict[str, Callable[[pd.DataFrame], pd.DataFrame]]
# What is kept of a section in place of its rows: sections of results.csv, and
# tables of other columns.
ROWS: dict[str, Reduced] = {
    "peers": {"peers": series, "kilohertz": kilohertz}, "stability": {}}
TABLES: dict[str, Reduced] = {
    "stability": {"verdicts": verdicts, "largest": largest}}


def keep(section: str, of: str, rows: pd.DataFrame) -> None:
    """Leaves what was measured, and the pictures of it."""
    if section in ROWS:
        save(OUT / f"all-{section}.csv", [of], rows)
    if section in PICTURES:
        PICTURES[section](rows)
    for name, make in TABLES.get(section, {}).items():
        save(OUT / f"{name}.csv", [of], make(rows))
    for name, make in ROWS.get(section, {section: pd.DataFrame.copy}).items():
        put(name, of, make(rows))


class Page:
    """The tables that this build has measured."""

    def __init__(self) -> None:
        self.results = results()

    def section(self, name: str) -> pd.DataFrame:
        """Rows of this build."""
        of, rows = self.results
        if name not in of:
            raise FileNotFoundError(name)
        return rows[rows.section == name]

    def table(self, name: str) -> pd.DataFrame:
        """A table of this build."""
        return load(OUT / f"{name}.csv")[1]

    def scenes(self) -> pd.DataFrame:
        """What a scene needs, in float."""
        rows = self.table("sizes")
        rows = rows[(rows.real == "float")
                    & ~rows.scene.str.startswith("gamma")]
        chosen = [("flash", board) for board in ("stm32f405", "microbit",
                                                 "mega", "uno")] + [
            (name, "stm32f405") for name in ("stack", "median", "most")]
        table = rows.pivot(index="scene", columns="board", values=[
            "flash", "stack", "median", "most"])[chosen]
        table.columns = [f"{name} {board}" for name, board in chosen]
        return whole(table.reindex(rows.scene.unique()).reset_index())

    def races(self) -> pd.DataFrame:
        """The least time of this project as a share of the best peers'."""
        rows, lines = self.section("peers"), []
        for problem in SWITCHED:
            own, hand, library, plain, rival = (
                least(rows, problem, of, LEVELS)
                for of in (OWN, HAND, LIBRARIES, FIXED, RIVALS))
            lines.append({
                "problem": problem,
                "of the best by hand": joined(own.ns / hand.ns, ".2f"),
                "which": names(hand),
                "of the best library": joined(own.ns / library.ns, ".2f"),
                "which one": names(library), "plain to 1e-3": joined(
                    (plain.instructions / rival.instructions).iloc[:1], ".2g")})
        return pd.DataFrame(lines)

    def stiff(self) -> pd.DataFrame:
        """The fixed step, the located one and the best peer [us]."""
        rows, lines = self.section("peers"), []
        for problem in STIFF:
            fixed, located, peer = (least(rows, problem, of, STIFF_LEVELS)
                                    for of in (FIXED, "located", RIVALS))
            lines.append({
                "problem": problem, "fixed step": joined(fixed.ns / 1e3),
                "located step": joined(located.ns / 1e3),
                "best peer": joined(peer.ns / 1e3), "which": names(peer),
                "fixed / peer": joined(fixed.ns / peer.ns, ".2g")})
        return pd.DataFrame(lines)

    def kilohertz(self) -> pd.DataFrame:
        """A step of 1 ms: instructions and error."""
        rows = self.section("kilohertz")
        rows = rows[rows.dial != "dt=1.000e-04"]
        text = rows.instructions.map("{:.0f}, ".format) + \
            rows.error.map("{:.0e}".format)
        solver = rows.solver + rows.dial.map(IN)
        wide = rows.assign(text=text, solver=solver).drop_duplicates(
            ["problem", "solver"]).pivot(
            index="problem", columns="solver", values="text")
        return wide.loc[[*SWITCHED, "rolling"], [
            "moreau", "moreau in three", "located segments=1", "located 1 kHz"]
            ].reset_index()

    def phases(self) -> pd.DataFrame:
        """Instructions of one step: by phase, of all schemes, and of random
        machines."""
        rows = self.section("steps")
        rows = rows.join(rows.dial.str.extract(
            r"(?P<steps>\d+) steps, (?P<phase>.*): (?P<name>.*)"))
        rows = rows.pivot_table(
            index=["steps", "phase", "solver"], columns="name",
            values="instructions", sort=False).reset_index()
        mean = self.section("kilohertz")
        mean = mean[(mean.problem == "chaos")
                    & (mean.dial == "dt=1.000e-04")]
        rows["phase"] += (", mean " + rows["mean"].map("{:.0f}".format)).where(
            rows.phase.str.startswith("machines"), "")
        table = pd.concat([rows, mean.assign(
            steps="10000", phase="`chaos`, mean",
            median=mean.instructions / 10)])
        return whole(table[["solver", "steps", "phase", "median", "99 %",
                            "most"]])

    def ensemble(self) -> pd.DataFrame:
        """Ratios of throughput."""
        rows = self.section("ensemble")
        rows = rows[rows.verdict.notna()]
        return rows.pivot(index="problem", columns="solver",
                          values="verdict").reset_index()

    def boards(self) -> pd.DataFrame:
        """What `chaos` needs on a board, in float / in double."""
        rows = self.table("sizes")
        rows = whole(rows[(rows.scene == "chaos") & (rows.board != "host")])
        return rows.drop(columns=["scene", "real", "painted", "least"]).groupby(
            "board").agg(
            " / ".join).reset_index()

    def worst(self) -> pd.DataFrame:
        """The dearest steps that a search found."""
        rows = self.table("worst")
        boards = rows.filter(like="stack ").drop(columns="stack x86-64")
        rows = rows.drop(columns=[*boards, *rows.filter(like="M7")]).assign(
            **{"stack of boards": boards.max(axis=1)})
        return whole(rows[rows.function.str.fullmatch(
            "tf_step(_located|_compensated)?") & ~rows.of.isin(
                ["n = 2", "n = 4"])])


def least(rows: pd.DataFrame, problem: str, solvers: str,
          levels: tuple[float, ...]) -> pd.DataFrame:
    """The least time to each error of solvers, a pattern, and whose it is; what
    nobody reaches costs nan."""
    rows = rows[(rows.problem == problem) & rows.solver.str.match(solvers)]
    return rows.dropna(subset="ns").sort_values("ns", kind="stable").groupby(
        "error")[["solver", "ns", "instructions"]].first().reindex(levels)


def names(of: pd.DataFrame) -> str:
    """The solvers in a cell, `-` for none."""
    return " / ".join(of.solver.fillna("-").str.replace(
        "^located ", "", regex=True).drop_duplicates())


def joined(numbers: Iterable[float], form: str = ",.0f") -> str:
    """Numbers in a cell, `-` for none."""
    return " / ".join("-" if math.isnan(x) else format(x, form)
                      for x in numbers)


def whole(table: pd.DataFrame) -> pd.DataFrame:
    """Numbers without a point, `-` for none."""
    return table.applymap(lambda n: "-" if pd.isna(n) else
                          n if isinstance(n, str) else f"{n:.0f}")


MADE = ("scenes", "races", "stiff", "kilohertz", "phases", "ensemble", "boards",
        "worst")


def write() -> None:
    """All tables of this build."""
    parts, page = {}, Page()
    for name in MADE:
        try:
            parts[name] = getattr(page, name)()
        except FileNotFoundError:
            continue
    tables.write(OUT / "tables.md", parts)
