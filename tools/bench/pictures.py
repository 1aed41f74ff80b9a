"""The pictures of the page. Colours are Okabe and Ito's for colour-blind
readers, and every series has a symbol of its own."""
import io
import re

import matplotlib
import numpy as np
import pandas as pd

from measure import OUT

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import ListedColormap  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

matplotlib.rcParams.update({
    "svg.hashsalt": "twofold", "svg.fonttype": "none", "font.size": 9,
    "axes.grid": True,
    "grid.color": "#dddddd", "lines.markersize": 3.5, "lines.linewidth": 1,
    "legend.frameon": False})
# Of each solver, by the first word of its name, the colour and the symbol.
STYLES = {
    "moreau": ("#000000", "o"), "moreau-1": ("#000000", "s"),
    "compensated": ("#777777", "s"), "located": ("#D55E00", "D"),
    "events-rk4": ("#0072B2", "<"), "rk4": ("#0072B2", "<"),
    "events-dp5": ("#0072B2", "^"), "dp5": ("#0072B2", "^"),
    "cvode-adams": ("#009E73", "v"), "cvode-bdf": ("#009E73", "P"),
    "arkode-erk5": ("#56B4E9", "*"), "cvode-smooth": ("#CC79A7", "x"),
    "rk4-smooth": ("#CC79A7", "+"), "scipy-radau": ("#E69F00", "h"),
    "scipy-lsoda": ("#E69F00", "X"), "scipy-rk45": ("#E69F00", ">"),
    "siconos": ("#777777", "2")}
# The classes of a cell of the map, the worst last.
CLASSES = {
    "within 1 %": "#0072B2", "within 10 %": "#56B4E9",
    "TF_COARSE, within 10 %": "#F0E442", "TF_COARSE, worse": "#E69F00",
    "refused": "#BBBBBB", "worse, and silent": "#000000",
    "motion not known": "#FFFFFF"}
BOARDS = {"stm32f405 float": "#D55E00", "stm32f405 double": "#E69F00",
          "microbit float": "#0072B2", "mega float": "#009E73"}
AXES = {"k2_rest": "spring k2 [N/m], at rest",
        "conservative": "spring k2 [N/m], stretched, no friction",
        "mu": "friction mu [N]"}
SCHEMES = {"moreau-0.5": "fixed step, theta = 1/2",
           "moreau-1": "fixed step, theta = 1", "located": "located step"}


def kept(rows: pd.DataFrame) -> pd.DataFrame:
    """Of a setting the worst error of it and the next two finer ones, so that
    no lucky one counts."""
    dial = rows.dial.str.split("=", expand=True)
    rows = rows.assign(name=dial[0], setting=-dial[1].astype(float),
                       error=rows.error.where(rows.verdict.isin(
                           ["ok", "flagged"]), np.inf)).sort_values("setting")
    errors = rows.groupby(["problem", "solver", "name"]).error
    return rows.assign(error=np.maximum.reduce(
        [errors.shift(-i).fillna(np.inf if i == 1 else 0) for i in range(3)]))


def best(rows: pd.DataFrame) -> pd.DataFrame:
    """The settings that no faster one comes near in error."""
    rows = rows.sort_values(["ns", "error"])
    return rows[rows.error < rows.error.cummin().shift(fill_value=np.inf) / 1.3]


def save(figure: pyplot.Figure, name: str, handles: list, labels: list[str],
         columns: int, height: float) -> None:
    """Writes a picture, its legend above the panels, where it hides no curve;
    without a date, digits and blanks that nobody sees."""
    figure.legend(handles, labels, ncol=columns, loc="upper center")
    figure.tight_layout(rect=(0, 0, 1, height))
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    pyplot.close(figure)
    short = re.sub(r"(\d\.\d)\d+", r"\1", text.getvalue())
    (OUT / name).write_text(re.sub(r"\s*\n\s*", "\n", short), "utf-8")


def panel(axis: pyplot.Axes, rows: pd.DataFrame, problem: str) -> None:
    """Error at the end over the time of a whole run."""
    rows = kept(rows[(rows.problem == problem)
                     & ~rows.solver.str.contains("same|float")])
    rows = rows[rows.error < 1]
    of = rows.solver.str.split().str[0]
    for name, (colour, symbol) in STYLES.items():
        line = best(rows[of == name])
        if len(line):
            axis.plot(line.ns / 1e3, line.error.clip(lower=1e-14),
                      color=colour, marker=symbol, label=name,
                      markevery=max(1, len(line) // 4))
    axis.set(title=problem, xscale="log", yscale="log", ylim=(5e-15, 1),
             xlabel="time of the run [us]",
             ylabel="error at the end [m, m/s, rad/s]")
    axis.minorticks_off()


def keyed(figure: pyplot.Figure) -> tuple[list, list[str]]:
    """The curves of all panels and their names, each once."""
    found = {name: line for axis in figure.axes for line, name in
             zip(*axis.get_legend_handles_labels())}
    names = [name for name in STYLES if name in found]
    return [found[name] for name in names], names


def costs(rows: pd.DataFrame) -> None:
    """The problems with switches, and the stiff ones."""
    figure, axes = pyplot.subplots(2, 2, figsize=(10, 8))
    for axis, problem in zip(axes.flat, ("chaos", "crossings", "stickslip",
                                         "driven")):
        panel(axis, rows, problem)
    save(figure, "costs.svg", *keyed(figure), 6, 0.93)
    figure, axes = pyplot.subplots(1, 3, figsize=(11, 4.6))
    for axis, problem in zip(axes, ("stiff-spring", "stiff-smooth",
                                    "stiff-string")):
        panel(axis, rows[~rows.solver.str.match(
            "compensated|rk4-smooth")], problem)
    save(figure, "stiff.svg", *keyed(figure), 6, 0.88)


def boards(rows: pd.DataFrame) -> None:
    """Error at the end over the instructions of a simulated second; where a
    line ends in real time at one instruction a cycle."""
    figure, axes = pyplot.subplots(1, 3, figsize=(11, 4.6), sharex=True,
                                 sharey=True)
    rows = rows.assign(board=rows.solver.str.rsplit(n=1).str[0],
                       scheme=rows.solver.str.split().str[-1])
    for axis, problem in zip(axes, rows.problem.unique()):
        for hertz in (16e6, 168e6):
            axis.axvline(hertz, color="#999999", linestyle=":")
            axis.annotate(f"{hertz / 1e6:.0f} MHz", (hertz, 0.02), ha="right",
                          va="bottom", rotation=90, color="#777777",
                          xycoords=("data", "axes fraction"))
        here = rows[rows.problem == problem]
        for (board, scheme), line in here.groupby(["board", "scheme"]):
            axis.plot(line.instructions, line.error, label=f"{board} {scheme}",
                      color=BOARDS[board], marker=STYLES[scheme][1],
                      linestyle={"located": "--"}.get(scheme, "-"))
        axis.set(title=problem, xscale="log", yscale="log",
                 xlabel="instructions of a simulated second")
    axes[0].set(ylabel="error at the end [m, m/s, rad/s]")
    save(figure, "boards.svg", *axes[0].get_legend_handles_labels(), 4, 0.86)


def classes(rows: pd.DataFrame) -> pd.Series:
    """Of each cell of the map its class. What a step says that found no mode,
    or left its work to another one, counts like TF_COARSE."""
    told, worse = rows.verdict != "ok", rows.error > 0.1
    return pd.Series(np.select(
        [rows.verdict == "refused", rows.error.isna(), told & worse, told,
         worse, rows.error > 0.01],
        ["refused", "motion not known", "TF_COARSE, worse",
         "TF_COARSE, within 10 %", "worse, and silent", "within 10 %"],
        "within 1 %"), rows.index)


def stability(rows: pd.DataFrame) -> None:
    """The map: stability and accuracy over the step and a parameter."""
    number = {name: i for i, name in enumerate(CLASSES)}
    rows = rows.assign(kind=classes(rows).map(number),
                       dt=rows.dial.str[3:].astype(float))
    rows[["sweep", "value"]] = rows.problem.str[4:].str.split("=", expand=True)
    rows["value"] = rows.value.astype(float)
    figure, axes = pyplot.subplots(3, 3, figsize=(10, 9.5))
    colours = ListedColormap(CLASSES.values())
    for line, (sweep, label) in zip(axes, AXES.items()):
        for axis, (scheme, title) in zip(line, SCHEMES.items()):
            cells = rows[(rows.sweep == sweep) & (rows.solver == scheme)].pivot(
                index="value", columns="dt", values="kind")
            axis.imshow(cells, cmap=colours, vmin=0, vmax=len(CLASSES) - 1,
                        aspect="auto", origin="lower")
            axis.set_xticks(range(0, len(cells.columns), 2),
                            [f"{dt:.0e}" for dt in cells.columns[::2]])
            axis.set_yticks(range(0, len(cells), 2),
                            [f"{value:.0e}" for value in cells.index[::2]])
            axis.set(xlabel="step dt [s]", ylabel=label)
            axis.grid(False)
            if sweep == "k2_rest":
                axis.set_title(title)
    shown = [name for name in CLASSES if number[name] in set(rows.kind)]
    save(figure, "stability.svg", [
        Patch(facecolor=CLASSES[name], edgecolor="#777777") for name in shown],
        shown, 4, 0.94)


PICTURES = {"peers": costs, "boards": boards, "map": stability}
