"""docs/BENCH.md: words written by hand, tables of what was measured.

A table stands below the line `<!-- NAME -->`. It is made from a section of
BUILD/bench/results.csv; what was not measured in this build is taken from
docs/bench/results.csv, which has the same form. What is not an error, a time or
a verdict of a solver at a dial is in tables of its own beside it.
"""
from __future__ import annotations

import re
from pathlib import Path
from typing import Callable

import pandas as pd

from pictures import PICTURES
from measure import COLUMNS, KEPT, OUT, bench, csv, load, put, results, save

LEVELS = 1e-3, 1e-6, 1e-9
PEERED = "chaos", "crossings", "stickslip", "driven"
WINDOWS = "smooth", "stick", "approach", "cycle"
OWN = "moreau|compensated|located"
STABLE = "ok", "degraded"
# Steps of section `kilohertz`, and how the page tells them apart.
IN = {"dt=1.000e-03": "", "dt=3.333e-04": " in three", "dt=1.000e-04": ""}


def least(runs: pd.DataFrame, level: float, unit: str) -> float:
    """The least cost of a setting that keeps an error, as the next two finer
    ones do, one at least, so that no lucky setting counts."""
    kept = (runs.error <= level).to_numpy()
    good = [kept[i:i + 3].all() for i in range(len(kept) - 1)] + [False]
    return runs[unit].where(good).min()


def series(rows: pd.DataFrame) -> pd.DataFrame:
    """What an error costs at least, a row a problem, solver and error."""
    dial = rows.dial.str.split("=", expand=True)
    rows = rows.assign(name=dial[0], setting=dial[1].astype(float))
    lines = []
    for key, runs in rows.groupby(["problem", "solver", "name"], sort=False):
        runs = runs.sort_values("setting", ascending=False)
        wrong = runs.verdict.isin(["branch", "refused"]).sum()
        lines += [[*key[:2], f"least of {len(runs)}", level,
                   least(runs, level, "ns"), least(runs, level, "instructions"),
                   f"{wrong} wrong"] for level in LEVELS]
    return pd.DataFrame(lines, columns=COLUMNS)


def kilohertz(rows: pd.DataFrame) -> pd.DataFrame:
    """Steps of 1 ms and less: instructions of a millisecond, and error."""
    long = csv(bench("double", "sweep", "problems"), ["problem", "length"])
    length = rows.problem.map(long.set_index("problem").length)
    rows = rows[rows.dial.isin(list(IN)) & rows.instructions.notna()]
    return rows.drop(columns=["ns", "verdict"]).assign(
        instructions=rows.instructions / length / 1e3)


def swept(rows: pd.DataFrame) -> pd.DataFrame:
    """Stable cells of each sweep; after a plus sign those that the motion
    itself ended."""
    listed = [line.split("|") for line in
              bench("double", "stability", "--list").splitlines()]
    rows = rows.assign(sweep=rows.problem.str.split("=").str[0],
                       said=rows.verdict)

    def share(said: pd.Series) -> str:
        taken = (said != "bad_parameter").sum()
        good, ended = said.isin(STABLE).sum(), (said == "physics").sum()
        return f"{good}{f'+{ended}' * (ended > 0)}/{taken}" if taken else "n/a"

    table = rows.pivot_table(index="sweep", columns="solver", values="said",
                             aggfunc=share, sort=False)
    table.insert(0, "driven", [f"{axis} [{unit}]" if unit else axis
                               for _, axis, unit, _ in listed])
    table.insert(1, "else", [where or "-" for *_, where in listed])
    return table.reset_index()


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
    "precision": {"precision": series, "kilohertz": kilohertz},
    "peers": {"peers": series}, "stability": {}}
TABLES: dict[str, Reduced] = {
    "stability": {"sweeps": swept, "verdicts": verdicts, "largest": largest}}


def keep(section: str, of: str, rows: pd.DataFrame) -> None:
    """Leaves what was measured, and the pictures of it."""
    if section in ROWS:
        save(OUT / f"all-{section}.csv", [of], rows)
    if section in PICTURES:
        PICTURES[section](rows)
    for name, make in TABLES.get(section, {}).items():
        save(OUT / f"{name}.csv", [of], make(rows))
    for name, make in ROWS.get(section, {section: pd.DataFrame.copy}).items():
        put(OUT, {name: of}, make(rows).assign(section=name))


class Page:
    """The tables, as the page shows them."""

    def __init__(self) -> None:
        self.of: dict[str, str] = {}
        self.results = results(OUT), results(KEPT)

    def section(self, name: str) -> pd.DataFrame:
        """Rows of this build, else those that are kept."""
        of, rows = self.results[name not in self.results[0][0]]
        self.of[name] = of[name]
        return rows[rows.section == name]

    def table(self, name: str) -> pd.DataFrame:
        """A table of this build, else the one that is kept."""
        path = OUT / f"{name}.csv"
        (self.of[name],), rows = load(path if path.exists()
                                      else KEPT / path.name)
        return rows

    def scenes(self) -> pd.DataFrame:
        """What a scene needs, in float."""
        rows = self.table("sizes")
        rows = rows[rows.real == "float"]
        chosen = [("flash", board) for board in ("stm32f405", "microbit",
                                                 "mega", "uno")] + [
            (name, "stm32f405") for name in ("stack", "median", "most")]
        table = rows.pivot(index="scene", columns="board", values=[
            "flash", "stack", "median", "most"])[chosen]
        table.columns = [f"{name} {board}" for name, board in chosen]
        return whole(table.reindex(rows.scene.unique()).reset_index())

    def races(self) -> pd.DataFrame:
        """The best of this project beside the best peer."""
        rows, lines = self.section("peers"), []
        own = rows.solver.str.match(OWN)
        for problem in PEERED:
            for level in LEVELS:
                line: list[object] = [f"`{problem}`", f"{level:.0e}"]
                best = []
                for of in own, ~own & ~rows.solver.str.contains("same"):
                    one = rows[of & (rows.problem == problem)
                               & (rows.error == level)]
                    best.append(one.loc[one.instructions.idxmin()])
                    line += [f"{best[-1].instructions / 1e3:,.1f}",
                             best[-1].solver]
                line += [f"{best[0][unit] / best[1][unit]:.2f}"
                         for unit in ("instructions", "ns")]
                lines.append(line)
        return pd.DataFrame(lines, columns=[
            "problem", "error", "this project", "by", "best peer", "by ",
            "ratio", "in time"])

    def peers(self) -> pd.DataFrame:
        """All solvers, of each its best width or step."""
        return to_levels(self.section("peers"), PEERED)

    def windows(self) -> pd.DataFrame:
        """The project's own schemes in windows of the motion."""
        return to_levels(self.section("precision"), WINDOWS)

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
        return wide.loc[[*PEERED, "rolling"], [
            "moreau", "moreau in three", "located segments=1",
            "located segments=2", "located segments=8", "located 1 kHz"]
            ].reset_index()

    def phases(self) -> pd.DataFrame:
        """Instructions of one step: of Moreau's by phase, of all schemes over
        `cycle`, and beside one of Runge-Kutta's on the smoothed law."""
        rows = self.section("steps")
        what = rows.dial.str.extract(r"(\d+) steps, (.*): (.*)")
        rows = rows.assign(steps=what[0], phase=what[1], name=what[2]
                           ).pivot_table(
            index=["problem", "solver", "steps", "phase"], columns="name",
            values="instructions", sort=False).reset_index()
        moreau = rows[(rows.steps == "20000") & (rows.solver == "moreau")]
        others = rows[(rows.steps == "400") & (rows.phase == "all")
                      & (rows.problem == "cycle")
                      & ~rows.solver.str.contains("float")]
        table = pd.concat([moreau[moreau.phase != "all"], others])
        mean = self.section("kilohertz")
        mean = mean[(mean.problem == "chaos")
                    & (mean.dial == "dt=1.000e-04")]
        mean = mean.assign(
            solver=mean.solver.str.split().str[0], steps="10000",
            phase="`chaos`, mean", median=mean.instructions / 10)
        table = pd.concat([table, mean])
        return whole(table[["solver", "steps", "phase", "median", "99 %",
                            "most"]])

    def ensemble(self) -> pd.DataFrame:
        """Ratios of throughput."""
        rows = self.section("ensemble")
        rows = rows[rows.verdict.notna()]
        return rows.pivot(index="problem", columns="solver",
                          values="verdict").reset_index()

    def rounded(self) -> pd.DataFrame:
        """How the compensated step in float ends, by the length of the run."""
        rows = self.section("rounded")
        rows = rows[rows.verdict.notna()]
        run = rows.problem.str.extract(r"/(.*)")[0].fillna("problems, all dt")
        table = pd.crosstab(run.rename("steps"), rows.verdict)
        missed = rows.problem.str[8:].where(rows.verdict == "not reached")
        table["which"] = missed.dropna().groupby(run).unique().str.join(", ")
        return table.fillna("").reset_index()

    def after(self) -> pd.DataFrame:
        """The coarsest step from which on no distance is more than chance."""
        rows = self.section("after")
        rows = rows[rows.dial.str.endswith("e-08")]

        def same(runs: pd.DataFrame) -> str:
            apart = (runs.verdict == "apart").to_numpy().nonzero()[0]
            first = apart[-1] + 1 if len(apart) else 0
            return "none" if first == len(runs) else \
                runs.dial.iloc[first].split()[0]

        return rows.groupby(["solver", "problem"], sort=False).apply(
            same).unstack().reset_index()

    def verdicts(self) -> pd.DataFrame:
        """Cells by verdict."""
        return self.table("verdicts")

    def boards(self) -> pd.DataFrame:
        """What `chaos` needs on a board, in float / in double."""
        rows = self.table("sizes")
        rows = whole(rows[(rows.scene == "chaos") & (rows.board != "host")])
        return rows.drop(columns=["scene", "real"]).groupby("board").agg(
            " / ".join).reset_index()

    def budgets(self) -> pd.DataFrame:
        """Median and most instructions of a step of 1 ms on boards."""
        rows = self.section("budgets")
        what = rows.dial.str.split(": ", expand=True)
        rows = rows.assign(scheme=what[0], name=what[1])
        wide = rows.pivot_table(index="solver", columns=["name", "scheme"],
                                values="instructions", sort=False)
        text = wide["median"].astype(int).astype(str) + ", " + \
            wide["most"].astype(int).astype(str)
        return text.reset_index().rename(columns={"solver": "board"})

    def worst(self) -> pd.DataFrame:
        """The dearest calls that a search found."""
        rows = self.table("worst")
        return whole(rows[rows.double >= 10000])

    def realtime(self) -> pd.DataFrame:
        """Lateness of loops that were alone [us]."""
        rows = self.section("realtime")
        value = rows.ns.div(1000).where(rows.ns.notna(), rows.error)
        table = rows.assign(value=value)[
            rows.problem.str.contains("alone")].pivot_table(
            index=["problem", "solver"], columns="dial", values="value",
            sort=False)
        return whole(table[["steps", "began: median", "ended: median",
                            "ended: 99.9 %", "ended: most", "late steps"]
                           ].reset_index())

    def made(self) -> pd.DataFrame:
        """Of which core each table is."""
        lines: dict[str, list[str]] = {}
        for name, of in self.of.items():
            core, _, how = of.partition(". ")
            how = f" ({how.rstrip('.')})" if how else ""
            lines.setdefault(core.rstrip("."), []).append(name + how)
        return pd.DataFrame([[core, ", ".join(names)]
                             for core, names in lines.items()],
                            columns=["core", "tables"])


def to_levels(rows: pd.DataFrame, problems: tuple[str, ...]) -> pd.DataFrame:
    """Thousands of instructions to each error; of what was not counted times
    by the least time. `?`: too many to be counted, `-`: never."""
    rows = rows[~rows.solver.str.contains("float|same|kHz|segments|order")
                & rows.problem.isin(problems)]
    name = rows.solver.str.split().str[0]
    counted = rows.instructions.notna().groupby(name).transform("any")
    # In units of the least time, in thousandths.
    least_time = rows.groupby(["problem", "error"]).ns.transform("min")
    rows = rows.assign(
        name=name.where(counted, name + ", times the least time"),
        cost=rows.instructions.where(counted, 1e3 * rows.ns / least_time))
    best = rows.groupby(["name", "problem", "error"], sort=False)[
        ["cost", "ns"]].min()
    best["text"] = [f"{n / 1e3:,.0f}" if n > 0 else "?" if ns > 0 else "-"
                    for n, ns in zip(best.cost, best.ns)]
    text = best.groupby(["name", "problem"], sort=False).text.agg(" / ".join)
    return text.unstack().loc[rows.name.unique(), list(problems)].reset_index()


def whole(table: pd.DataFrame) -> pd.DataFrame:
    """Numbers without a point, `-` for none."""
    return table.applymap(lambda n: "-" if pd.isna(n) else
                          n if isinstance(n, str) else f"{n:.0f}")


def write() -> None:
    """The page of this build, beside its rows and tables."""
    page = Page()

    def block(found: re.Match) -> str:
        table = getattr(page, found[1])().to_markdown(
            index=False, disable_numparse=True)
        table = re.sub(r" +\|", " |", table)
        table = re.sub(r"-{3,}", "--", table)
        return f"<!-- {found[1]} -->\n{table}\n"

    text = re.sub(r"<!-- (\w+) -->\n(?:\|.*\n)*", block,
                  Path("docs/BENCH.md").read_text("utf-8"))
    (OUT / "BENCH.md").write_text(text, "utf-8")
