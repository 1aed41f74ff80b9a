"""The pictures of the page. Every series has a symbol of its own."""
import numpy as np
import pandas as pd
from matplotlib.patches import Patch

import pictures
from measure import OUT, STIFF, SWITCHED
from pictures import LINE, SERIES, colors, pyplot

BLUE, ORANGE, GREEN, RED, SKY, PINK, YELLOW, BLACK, GREY = SERIES
# Of each solver, by the first word of its name, the colour and the symbol.
STYLES = {
    "moreau": (BLACK, "o"), "moreau-1": (BLACK, "s"),
    "compensated": (GREY, "s"), "located": (RED, "D"),
    "events-rk4": (BLUE, "<"), "events-dp5": (BLUE, "^"),
    "cvode-adams": (GREEN, "v"), "cvode-bdf": (GREEN, "P"),
    "arkode-erk5": (SKY, "*"), "cvode-smooth": (PINK, "x"),
    "scipy-radau": (ORANGE, "h"),
    "scipy-lsoda": (ORANGE, "X"), "scipy-rk45": (ORANGE, ">"),
    "siconos": (YELLOW, "2")}
# The classes of a cell of the map, the worst last.
CLASSES = {
    "within 1 %": BLUE, "within 10 %": SKY,
    "TF_COARSE, within 10 %": YELLOW, "TF_COARSE, worse": ORANGE,
    "refused": "#BBBBBB", "worse, and silent": BLACK,
    "motion not known": "#FFFFFF"}
BOARDS = {"stm32f405 float": RED, "stm32f405 double": ORANGE,
          "microbit float": BLUE, "mega float": GREEN}
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
         columns: int) -> None:
    """Writes a picture, its key above the panels, where it hides no curve."""
    figure.legend(handles, labels, ncol=columns, loc="upper center")
    pictures.save(figure, OUT / name)


def panel(axis: pyplot.Axes, rows: pd.DataFrame, problem: str) -> None:
    """Error at the end over the time of a whole run."""
    rows = kept(rows[rows.problem == problem])
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
    axis.grid(color=LINE)


def keyed(figure: pyplot.Figure) -> tuple[list, list[str]]:
    """The curves of all panels and their names, each once."""
    found = {name: line for axis in figure.axes for line, name in
             zip(*axis.get_legend_handles_labels())}
    names = [name for name in STYLES if name in found]
    return [found[name] for name in names], names


def costs(rows: pd.DataFrame) -> None:
    """The problems with switches, and the stiff ones."""
    for name, size, shape, of in (("costs.svg", (10, 8), (2, 2), SWITCHED),
                                  ("stiff.svg", (11, 4.6), (1, 3), STIFF)):
        figure, axes = pyplot.subplots(*shape, figsize=size)
        for axis, problem in zip(axes.flat, of):
            panel(axis, rows, problem)
        save(figure, name, *keyed(figure), 6)


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
                          va="bottom", rotation=90, color=GREY,
                          xycoords=("data", "axes fraction"))
        here = rows[rows.problem == problem]
        for (board, scheme), line in here.groupby(["board", "scheme"]):
            axis.plot(line.instructions, line.error, label=f"{board} {scheme}",
                      color=BOARDS[board], marker=STYLES[scheme][1],
                      linestyle={"located": "--"}.get(scheme, "-"))
        axis.set(title=problem, xscale="log", yscale="log",
                 xlabel="instructions of a simulated second")
    axes[0].set(ylabel="error at the end [m, m/s, rad/s]")
    save(figure, "boards.svg", *axes[0].get_legend_handles_labels(), 4)


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
    colours = colors.ListedColormap(CLASSES.values())
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
        Patch(facecolor=CLASSES[name], edgecolor=GREY) for name in shown],
        shown, 4)


PICTURES = {"peers": costs, "boards": boards, "map": stability}
