"""docs/BENCH.md: words written by hand, tables of what was measured.

A table stands below the line `<!-- NAME -->`. What was measured in this
build is reduced to tables BUILD/bench/table-NAME.csv; what was not is taken
from docs/bench/NAME.csv, which has the same form and says in its first line of
which core it is.
"""
from __future__ import annotations

import re
from pathlib import Path
from typing import Callable

import pandas as pd

import pictures
from measure import COLUMNS, KEPT, OUT, bench

LEVELS = 1e-3, 1e-6, 1e-9
PEERED = "chaos", "crossings", "stickslip", "driven"
WINDOWS = "smooth", "stick", "approach", "cycle"
OWN = "moreau|compensated|located"
STABLE = "ok", "degraded"


def read(path: Path) -> tuple[str, pd.DataFrame]:
    """The first line of a table, without its mark, and the table."""
    with open(path, encoding="utf-8") as file:
        return file.readline()[2:].strip(), pd.read_csv(
            file, keep_default_na=False, na_values=[""])


def least(runs: pd.DataFrame, level: float, unit: str) -> float:
    """The least cost of a setting that keeps an error, as the next two finer
    ones do, one at least, so that no lucky setting counts."""
    kept = (runs.error <= level).to_numpy()
    good = [kept[i:i + 3].all() for i in range(len(kept) - 1)] + [False]
    return runs[unit].where(good).min()


def series(rows: pd.DataFrame) -> pd.DataFrame:
    """What an error costs, a line a problem and solver."""
    dial = rows.dial.str.split("=", expand=True)
    rows = rows.assign(name=dial[0], setting=dial[1].astype(float))
    lines = []
    for key, runs in rows.groupby(["problem", "solver", "name"], sort=False):
        runs = runs.sort_values("setting", ascending=False)
        wrong = runs.verdict.isin(["branch", "refused"]).sum()
        lines.append([*key[:2], *(least(runs, level, unit) for unit
                                  in ("instructions", "ns")
                                  for level in LEVELS), len(runs), wrong])
    return pd.DataFrame(lines, columns=[
        "problem", "solver", *(f"{unit} {level:.0e}" for unit
                               in ("instructions", "ns") for level in LEVELS),
        "settings", "wrong"]).round(0)


def kilohertz(rows: pd.DataFrame) -> pd.DataFrame:
    """Steps of 1 ms and less: instructions of a millisecond, and error."""
    long = {"driven": 2, "crossings": 2, "stickslip": 2, "cycle": 2,
            "rolling": 2.5, "chaos": 1, "smooth": 0.125, "stick": 0.25,
            "approach": 0.046}
    each = {"dt=1.000e-03": "", "dt=3.333e-04": " in three",
            "dt=1.000e-04": " in ten"}
    rows = rows[rows.dial.isin(list(each)) & rows.instructions.notna()]
    return pd.DataFrame({
        "problem": rows.problem, "solver": rows.solver + rows.dial.map(each),
        "instructions": (rows.instructions / rows.problem.map(long) / 1e3
                         ).round(0), "error": rows.error})


def one_step(rows: pd.DataFrame) -> pd.DataFrame:
    """Single steps: a line a run and phase."""
    what = rows.dial.str.extract(r"(\d+) steps, (.*): (.*)")
    rows = rows.assign(steps=what[0], phase=what[1], name=what[2])
    table = rows.pivot_table(index=["problem", "solver", "steps", "phase"],
                             columns="name", values=["instructions", "ns"],
                             sort=False)
    table.columns = [f"{unit} {name}" for unit, name in table.columns]
    return table.reset_index()


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


def as_measured(rows: pd.DataFrame) -> pd.DataFrame:
    """All rows, without empty columns."""
    return rows.dropna(axis="columns", how="all")


# What the page needs of each section: tables by their names.
Reduced = dict[str, Callable[[pd.DataFrame], pd.DataFrame]]
REDUCED: dict[str, Reduced] = {
    "precision": {"precision": series, "kilohertz": kilohertz},
    "peers": {"peers": series}, "steps": {"steps": one_step},
    "stability": {"sweeps": swept, "verdicts": verdicts, "largest": largest},
    **{name: {name: as_measured} for name in
       ("after", "rounded", "ensemble", "realtime", "budgets")}}


def reduce() -> None:
    """Tables of all sections that were measured in this build, and all rows."""
    whole = []
    for section, tables in REDUCED.items():
        path = OUT / f"{section}.csv"
        if not path.exists():
            continue
        of, rows = read(path)
        whole.append(rows)
        for name, make in tables.items():
            with open(OUT / f"table-{name}.csv", "w",
                      encoding="utf-8") as file:
                print(f"# {of}", file=file)
                make(rows).to_csv(file, index=False, float_format="%.6g")
        pictures.draw(section, rows)
    if whole:
        pd.concat(whole)[COLUMNS].to_csv(OUT / "results.csv", index=False)


class Page:
    """The tables, as the page shows them."""

    def __init__(self) -> None:
        self.of: dict[str, str] = {}

    def table(self, name: str) -> pd.DataFrame:
        """A table of this build, else the one that is kept."""
        path = OUT / f"table-{name}.csv"
        self.of[name], rows = read(path if path.exists()
                                   else KEPT / f"{name}.csv")
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
        rows, lines = self.table("peers"), []
        own = rows.solver.str.match(OWN)
        for problem in PEERED:
            for level in LEVELS:
                line: list[object] = [f"`{problem}`", f"{level:.0e}"]
                cost, time = (f"{unit} {level:.0e}"
                              for unit in ("instructions", "ns"))
                best = []
                for of in own, ~own & ~rows.solver.str.contains("same"):
                    one = rows[of & (rows.problem == problem)
                               & rows[cost].notna()]
                    best.append(one.loc[one[cost].idxmin()])
                    line += [f"{best[-1][cost] / 1e3:,.1f}", best[-1].solver]
                line += [f"{best[0][unit] / best[1][unit]:.2f}"
                         for unit in (cost, time)]
                lines.append(line)
        return pd.DataFrame(lines, columns=[
            "problem", "error", "this project", "by", "best peer", "by ",
            "ratio", "in time"])

    def peers(self) -> pd.DataFrame:
        """All solvers, of each its best width or step."""
        return to_levels(self.table("peers"), PEERED)

    def windows(self) -> pd.DataFrame:
        """The project's own schemes in windows of the motion."""
        return to_levels(self.table("precision"), WINDOWS)

    def kilohertz(self) -> pd.DataFrame:
        """A step of 1 ms: instructions and error."""
        rows = self.table("kilohertz")
        text = rows.instructions.map("{:.0f}, ".format) + \
            rows.error.map("{:.0e}".format)
        wide = rows.assign(text=text).drop_duplicates(
            ["problem", "solver"]).pivot(
            index="problem", columns="solver", values="text")
        return wide.loc[[*PEERED, "rolling"], [
            "moreau", "moreau in three", "located segments=1",
            "located segments=2", "located segments=8", "located 1 kHz"]
            ].reset_index()

    def phases(self) -> pd.DataFrame:
        """Instructions of one step: of Moreau's by phase, of all schemes over
        `cycle`, and beside one of Runge-Kutta's on the smoothed law."""
        rows = self.table("steps")
        moreau = rows[(rows.steps == 20000) & (rows.solver == "moreau")]
        others = rows[(rows.steps == 400) & (rows.phase == "all")
                      & (rows.problem == "cycle")
                      & ~rows.solver.str.contains("float")]
        table = pd.concat([moreau[moreau.phase != "all"], others]).rename(
            columns=lambda name: name.replace("instructions ", ""))
        mean = self.table("kilohertz")
        mean = mean[(mean.problem == "chaos")
                    & mean.solver.str.contains("in ten")]
        mean = mean.assign(
            solver=mean.solver.str.split().str[0], steps=10000,
            phase="`chaos`, mean", median=mean.instructions / 10)
        table = pd.concat([table, mean])
        return whole(table[["solver", "steps", "phase", "median", "99 %",
                            "most"]])

    def ensemble(self) -> pd.DataFrame:
        """Ratios of throughput."""
        rows = self.table("ensemble")
        rows = rows[rows.verdict.notna()]
        return rows.pivot(index="problem", columns="solver",
                          values="verdict").reset_index()

    def rounded(self) -> pd.DataFrame:
        """How the compensated step in float ends, by the length of the run."""
        rows = self.table("rounded")
        rows = rows[rows.verdict.notna()]
        run = rows.problem.str.extract(r"/(.*)")[0].fillna("problems, all dt")
        table = pd.crosstab(run.rename("steps"), rows.verdict)
        missed = rows.problem.str[8:].where(rows.verdict == "not reached")
        table["which"] = missed.dropna().groupby(run).unique().str.join(", ")
        return table.fillna("").reset_index()

    def after(self) -> pd.DataFrame:
        """The coarsest step from which on no distance is more than chance."""
        rows = self.table("after")
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
        rows = self.table("budgets")
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
        rows = self.table("realtime")
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
    cost = [f"instructions {level:.0e}" for level in LEVELS]
    time = [f"ns {level:.0e}" for level in LEVELS]
    counted = rows[cost].notna().any(axis=1).groupby(name).transform("any")
    # In units of the least time, in thousandths.
    least_time = rows.groupby("problem")[time].transform("min")
    others = name + ", times the least time"
    rows = rows.assign(name=name.where(counted, others))
    rows[cost] = rows[cost].where(
        counted, 1e3 * (rows[time] / least_time).to_numpy())
    best = rows.groupby(["name", "problem"], sort=False)[cost + time].min()
    text = pd.DataFrame({level: [
        f"{n / 1e3:,.0f}" if n > 0 else "?" if ns > 0 else "-"
        for n, ns in zip(best[level], best[level.replace("instructions", "ns")])
        ] for level in cost}, best.index)
    return text.agg(" / ".join, axis=1).unstack()[list(problems)].reset_index()


def whole(table: pd.DataFrame) -> pd.DataFrame:
    """Numbers without a point, `-` for none."""
    return table.applymap(lambda n: "-" if pd.isna(n) else
                          n if isinstance(n, str) else f"{n:.0f}")


def write() -> None:
    """The page of this build, beside its tables."""
    reduce()
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
