"""Pictures of the report, by matplotlib.

Colours are Okabe and Ito's for colour-blind readers, and every series has a
symbol of its own. Failures have marks of their own, in black.
"""
from __future__ import annotations

from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Optional, Sequence

import matplotlib
import numpy as np

from figures import best_peers
from precision import read_parts
from series import Series, Setting, read_sweep
from tables import read

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

matplotlib.rcParams.update({
    "svg.hashsalt": "twofold", "font.size": 9, "axes.grid": True,
    "grid.color": "#dddddd", "lines.markersize": 3.5, "lines.linewidth": 1,
    "legend.frameon": False})
PARTS = "smooth", "crossings", "stick", "codim2", "approach"
ERROR = "error at the end [m, m/s, rad/s]"
TOP = 10.0  # of the pictures of errors


class Style(NamedTuple):
    """How a series looks."""
    scheme: str
    dial: str
    colour: str
    symbol: str


STYLES = (
    Style("moreau", "dt", "#D55E00", "s"),
    Style("compensated", "dt", "#E69F00", "o"),
    Style("located", "dt", "#0072B2", "^"),
    Style("located", "order", "#56B4E9", "v"),
    Style("located", "tolerance@1s", "#8C7A00", "*"),
    Style("located", "tolerance@100ms", "#009E73", "D"),
    Style("located", "tolerance@20ms", "#666666", "P"),
    Style("located", "tolerance@5ms", "#CC79A7", "p"),
)
STEPS, TOLERANCES = STYLES[:4], (STYLES[5], STYLES[7])
PEER_STYLES = (("#7B3294", "s"), ("#8B4513", "^"), ("#D40055", "D"),
               ("#4D7A00", "v"))
MARKS = {"flagged": ("o", "flagged"), "branch": ("x", "another branch"),
         "refused": ("+", "refused")}
Number = Callable[[Setting], float]


class Data:
    """What was measured."""

    def __init__(self, work: Path, peers: Optional[str]) -> None:
        self.work = work
        self.parts = {row["name"]: row
                      for row in read_parts(str(work / "parts.csv"))}
        self.sweep = read_sweep(str(work / "sweep.csv"))
        self.peers = read.read_csv(peers) if peers else []
        self.best = best_peers(peers) if peers else []

    def settings(self, part: str, real: str, style: Style) -> list[Setting]:
        """The settings of one series."""
        return [setting for series in self.of(part, real)
                if (series.scheme, series.dial) == style[:2]
                for setting in series.settings]

    def of(self, part: str, real: str) -> Iterable[Series]:
        """All series of a part."""
        return (series for series in self.sweep
                if (series.part, series.real) == (part, real))


def seconds(setting: Setting) -> float:
    """The time of a run."""
    return setting.ns * 1e-9


def line(axes: pyplot.Axes, style: Style, settings: Iterable[Setting],
         x: Number, y: Number, **more: object) -> None:
    """One series that is more than 0."""
    points = [(x(one), y(one)) for one in settings if y(one) > 0]
    axes.plot(*zip(*points) if points else ([], []), color=style.colour,
              marker=style.symbol, **more)


def mark(axes: pyplot.Axes, what: str, settings: Iterable[Setting],
         x: Number, y: Number) -> None:
    """The settings with a mark, in black."""
    of = [one for one in settings if one.mark == what]
    axes.plot([x(one) for one in of], [min(y(one), 0.6 * TOP) for one in of],
              linestyle="none", marker=MARKS[what][0], color="black",
              fillstyle="none", markersize=6)


def slope(axes: pyplot.Axes, factor: float, order: int, dashes: str) -> None:
    """A straight line of an order."""
    x = np.array([1e-14, 1.0])
    axes.plot(x, factor * x ** order, color="#777777", linestyle=dashes)


def legend(axes: pyplot.Axes, handles: Sequence[pyplot.Line2D]) -> None:
    """A panel with the legend alone."""
    axes.axis("off")
    axes.legend(handles=list(handles), loc="center left")


def handle(label: str, **more: object) -> pyplot.Line2D:
    """A line of a legend."""
    return pyplot.Line2D([], [], label=label, **more)


def mark_handles(*marks: str) -> list[pyplot.Line2D]:
    """Lines of a legend for marks."""
    return [handle(MARKS[one][1], linestyle="none", marker=MARKS[one][0],
                   color="black", fillstyle="none", markersize=6)
            for one in marks]


def style_handles(styles: Iterable[Style]) -> list[pyplot.Line2D]:
    """Lines of a legend for series."""
    return [handle(f"{one.scheme}, {one.dial}", color=one.colour,
                   marker=one.symbol) for one in styles]


def panels(title: str, lines: int, columns: int,
           size: tuple[float, float]) -> tuple[pyplot.Figure, np.ndarray]:
    """A picture of several panels with logarithmic axes."""
    figure, axes = pyplot.subplots(lines, columns, figsize=size,
                                   layout="constrained")
    figure.suptitle(title)
    for one in axes.flat:
        one.set(xscale="log", yscale="log")
    return figure, axes.flatten()


def save(figure: pyplot.Figure, out: Path) -> None:
    """Writes a picture without a date, so that equal ones are equal."""
    figure.savefig(out, metadata={"Date": None})
    pyplot.close(figure)


def draw_peers(axes: pyplot.Axes, data: Data, problem: str) -> None:
    """Other tools; the best have colours, the others are grey."""
    for peer in {row["peer"]: None for row in data.peers}:
        rows = [row for row in data.peers
                if (row["problem"], row["peer"]) == (problem, peer)]
        if peer.startswith("twofold"):
            continue
        colour, symbol, size = "#bbbbbb", "o", 1.5
        if peer in data.best:
            (colour, symbol), size = PEER_STYLES[data.best.index(peer)], 2.5
        axes.plot([row.number("ns") * 1e-9 for row in rows],
                  [row.number("error") for row in rows], linestyle="none",
                  color=colour, marker=symbol, markersize=size)


def precision(data: Data, real: str, out: Path) -> None:
    """Error at the end over the time of the whole run, a panel a part."""
    low = 1e-17 if real == "double" else 1e-9
    figure, axes = panels(f"Error and time of a run in {real}", 2, 3,
                          (11.5, 7.8))
    with_peers = real == "double" and bool(data.peers)
    for one, part in zip(axes, PARTS):
        row = data.parts[part]
        one.set(title=row["title"], xlabel="time of the run [s]", ylabel=ERROR,
                xlim=(3e-7, 0.3), ylim=(low, TOP))
        uncertainty = row.number("uncertainty")
        one.axhline(max(uncertainty, 2 * low), linestyle="--", color="#555555")
        one.text(0.25, 8 * max(uncertainty, 2 * low),
                 f"reference: {uncertainty:.0e}", horizontalalignment="right",
                 color="#555555")
        if with_peers and part in ("crossings", "codim2"):
            draw_peers(one, data, row["problem"])
        for style in STYLES:
            line(one, style, (s for s in data.settings(part, real, style)
                              if s.mark in ("ok", "flagged")),
                 seconds, lambda s: max(s.error, low))
        every = [s for series in data.of(part, real) for s in series.settings]
        for what in MARKS:
            mark(one, what, every, seconds,
                 lambda s: TOP if s.mark == "refused" else s.error)
    handles = style_handles(STYLES) + mark_handles(*MARKS)
    handles.append(handle("uncertainty of the reference", linestyle="--",
                          color="#555555"))
    if with_peers:
        handles += [handle(f"peer {peer}", linestyle="none", color=colour,
                           marker=symbol) for peer, (colour, symbol)
                    in zip(data.best, PEER_STYLES)]
        handles.append(handle("other peers (make bench-peers)", marker="o",
                              linestyle="none", color="#bbbbbb"))
    legend(axes[-1], handles)
    save(figure, out)


def dials(data: Data, out: Path) -> None:
    """Error over the step of every scheme, and the tolerance, in double."""
    figure, axes = panels("Error over step and tolerance, in double", 2, 4,
                          (12.5, 6.8))
    for one, part in zip(axes, PARTS):
        one.set(title=data.parts[part]["title"], xlabel="step dt [s]",
                ylabel=ERROR, xlim=(5e-7, 0.3), ylim=(1e-16, TOP))
        draw_dial(one, data, part, STEPS)
        for factor, order, dashes in (0.05, 1, ":"), (10, 2, "--"), \
                (1e13, 8, "-."):
            slope(one, factor, order, dashes)
    last = axes[len(PARTS)]
    last.set(title="(b), tolerance of located", xlabel="tolerance [1]",
             ylabel=ERROR, xlim=(1e-14, 1e-2), ylim=(1e-16, TOP))
    draw_dial(last, data, "crossings", TOLERANCES)
    slope(last, 1, 1, ":")
    legend(axes[-2], style_handles(STEPS + TOLERANCES)
           + mark_handles("flagged", "branch")
           + [handle(f"slope {order}", linestyle=dashes, color="#777777")
              for order, dashes in ((1, ":"), (2, "--"), (8, "-."))])
    axes[-1].axis("off")
    save(figure, out)


def draw_dial(axes: pyplot.Axes, data: Data, part: str,
              styles: Iterable[Style]) -> None:
    """Errors of a part over some dials, with their marks."""
    for style in styles:
        settings = [s for s in data.settings(part, "double", style)
                    if s.mark != "refused"]
        line(axes, style, settings, lambda s: s.dial, lambda s: s.error)
        for what in "flagged", "branch":
            mark(axes, what, settings, lambda s: s.dial, lambda s: s.error)


def events(data: Data, out: Path) -> None:
    """Times of events and drift in stick over the step."""
    figure, axes = panels("Times of events and drift in stick", 1, 4,
                          (12.5, 3.8))
    for one, part, title in (
            (axes[0], "crossings", "crossings, double"),
            (axes[1], "cycle", "chaos to t = 2, double")):
        one.set(title=title, ylim=(1e-14, 1),
                ylabel="largest error of the time of an event [s]")
        for style in STEPS[:3]:
            line(one, style, (s for s in data.settings(part, "double", style)
                              if s.mark != "refused"),
                 lambda s: s.step, lambda s: s.event)
        slope(one, 1, 1, "--")
    axes[2].set(title="chaos to t = 2", ylim=(1e-23, 1e-6),
                ylabel="largest |h| in stick [m/s]")
    for real, more in (("double", {}),
                       ("float", {"linestyle": "--", "fillstyle": "none"})):
        for style in STEPS[:3]:
            line(axes[2], style, (s for s in data.settings("cycle", real, style)
                                  if s.mark != "refused"),
                 lambda s: s.step, lambda s: s.drift, **more)
    for one in axes[:3]:
        one.set(xlabel="step dt [s]", xlim=(1e-6, 0.3))
    legend(axes[3], style_handles(STEPS[:3])
           + [handle(f"{one.scheme}, float", color=one.colour,
                     marker=one.symbol, linestyle="--", fillstyle="none")
              for one in STEPS[:3]]
           + [handle("dt", linestyle="--", color="#777777")])
    save(figure, out)
