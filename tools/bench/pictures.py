"""The two pictures of the page. Colours are Okabe and Ito's for colour-blind
readers, and every series has a symbol of its own."""
from __future__ import annotations

import io
import re

import matplotlib
import numpy as np
import pandas as pd

from measure import OUT

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

matplotlib.rcParams.update({
    "svg.hashsalt": "twofold", "svg.fonttype": "none", "font.size": 9,
    "axes.grid": True,
    "grid.color": "#dddddd", "lines.markersize": 3.5, "lines.linewidth": 1,
    "legend.frameon": False})
# What a solver's name begins with, its colour and symbol.
STYLES = {
    "moreau": ("#000000", "o"), "compensated": ("#777777", "s"),
    "located": ("#D55E00", "D"), "events-rk4": ("#0072B2", "<"),
    "events-dp5": ("#0072B2", "^"), "cvode-adams": ("#009E73", "v"),
    "cvode-bdf": ("#009E73", "P"), "arkode-erk5": ("#56B4E9", "*"),
    "cvode-smooth": ("#CC79A7", "x"), "rk4-smooth": ("#CC79A7", "+"),
    "euler": ("#E69F00", "1"), "siconos": ("#E69F00", "2")}
SCHEMES = "moreau-0.5", "moreau-1", "located"


def best(rows: pd.DataFrame) -> pd.DataFrame:
    """The settings that no other one beats in both instructions and error."""
    rows = rows.sort_values(["instructions", "error"])
    return rows[rows.error < rows.error.cummin().shift(fill_value=np.inf)]


def save(figure: pyplot.Figure, name: str) -> None:
    """Writes a picture without a date and without digits that nobody sees."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    pyplot.close(figure)
    (OUT / name).write_text(
        re.sub(r"(\d\.\d\d)\d+", r"\1", text.getvalue()), "utf-8")


def costs(rows: pd.DataFrame) -> None:
    """Error at the end over instructions of the whole run."""
    figure, axes = pyplot.subplots(2, 2, figsize=(10, 7.5))
    rows = rows[rows.instructions.notna()
                & rows.verdict.isin(["ok", "flagged"])]
    for axis, problem in zip(axes.flat, ("chaos", "crossings", "stickslip",
                                         "driven")):
        for name, (colour, symbol) in STYLES.items():
            line = best(rows[(rows.problem == problem)
                             & rows.solver.str.startswith(name)
                             & ~rows.solver.str.contains("same")])
            axis.plot(line.instructions, line.error.clip(lower=1e-14),
                      color=colour, marker=symbol, markevery=8, label=name)
        axis.set(title=problem, xscale="log", yscale="log",
                 ylim=(5e-15, 1), xlabel="instructions of the run",
                 ylabel="error at the end [m, m/s, rad/s]")
        axis.minorticks_off()
    # Above the panels, where it hides no curve.
    figure.legend(*axes.flat[0].get_legend_handles_labels(), ncol=6,
                  loc="upper center")
    figure.tight_layout(rect=(0, 0, 1, 0.93))
    save(figure, "costs.svg")


def stability(rows: pd.DataFrame) -> None:
    """The share of stable values of each sweep over the step, in double."""
    rows = rows.assign(sweep=rows.problem.str.split("=").str[0],
                       dt=rows.dial.str[3:].astype(float),
                       good=rows.verdict.str.match("ok|degraded|physics"))
    rows = rows[~rows.verdict.str.startswith("bad_parameter")]
    figure, axes = pyplot.subplots(1, 3, figsize=(9, 6.5), sharey=True,
                                   layout="constrained")
    order = rows.sweep.unique()
    for axis, scheme in zip(axes, SCHEMES):
        share = rows[rows.solver == scheme].pivot_table(
            index="sweep", columns="dt", values="good").reindex(order)
        shown = axis.imshow(share, cmap="cividis", vmin=0, vmax=1,
                            aspect="auto")
        axis.set_xticks(range(0, 11, 2),
                        [f"{dt:.0e}" for dt in share.columns[::2]],
                        rotation=45)
        axis.set_yticks(range(len(order)), order)
        axis.set(title=scheme, xlabel="step dt [s]")
        axis.grid(False)
    figure.colorbar(shown, ax=axes, label="stable share of the values")
    save(figure, "stability.svg")


PICTURES = {"peers": costs, "stability": stability}
