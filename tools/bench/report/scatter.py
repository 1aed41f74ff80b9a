"""The picture of what comes after the two-fold, by matplotlib."""
from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot

from pictures import panels, save
from tables import read

LENGTHS = "0.08", "0.15"
# Scheme, real type, colour, symbol, line.
RUNS = (("moreau", "double", "#D55E00", "s", "-"),
        ("moreau", "float", "#E69F00", "s", "--"),
        ("located", "double", "#0072B2", "^", "none"),
        ("located", "float", "#56B4E9", "^", "none"))
# Column of the quantiles, colour, width, line.
CURVES = (("reference", "#BBBBBB", 4, "-"),
          ("moreau 4 ms", "#D55E00", 1.2, ":"),
          ("moreau 0.1 ms", "#D55E00", 1.2, "-"),
          ("located 10 ms", "#0072B2", 1.2, "--"))


def distances(axes: pyplot.Axes, rows: list[read.Row]) -> None:
    """Distances from the reference, those of double with their bands."""
    for scheme, real, colour, symbol, dashes in RUNS:
        of = [row for row in rows
              if (row["scheme"], row["real"]) == (scheme, real)]
        bands = ([row.number("band") for row in of] if real == "double"
                 else None)
        axes.errorbar([row.number("ns") * 1e-9 for row in of],
                      [row.number("distance") for row in of], yerr=bands,
                      color=colour, marker=symbol, linestyle=dashes,
                      fillstyle="full" if real == "double" else "none",
                      label=scheme + (", float" if real == "float" else ""))
    for real, dashes, label in (("double", "--", "band, double"),
                                ("float", ":", "band, float (fewer runs)")):
        bands = [row.number("band") for row in rows if row["real"] == real]
        if bands:
            axes.axhline(bands[0], color="black", linestyle=dashes,
                         label=label)


def quantiles(axes: pyplot.Axes, rows: list[read.Row]) -> None:
    """The distributions themselves."""
    for column, colour, width, dashes in CURVES:
        axes.plot(read.numbers(rows, column), read.numbers(rows, "p"),
                  color=colour, linewidth=width, linestyle=dashes,
                  label=column.replace(" ", ", dt = ", 1))


def draw(work: Path, out: Path) -> None:
    """Distances on the left, distributions on the right."""
    figure, axes = panels("After the two-fold: distributions of r", 2, 2,
                          (11.5, 7.8))
    rows = read.read_csv(str(work / "scatter.csv"))
    for i, length in enumerate(LENGTHS):
        left, right = axes[2 * i], axes[2 * i + 1]
        distances(left, [row for row in rows if row["length"] == length])
        left.set(title=f"{length} s after it: distance from the reference "
                 "ensemble", xlabel="time of a run [s]", xlim=(3e-7, 2e-3),
                 ylim=(0.005, 10),
                 ylabel="Kolmogorov-Smirnov distance [1]")
        quantiles(right, read.read_csv(str(work / f"quantiles-{length}.csv")))
        right.set(title=f"{length} s after it: the distributions (double)",
                  xscale="linear", yscale="linear", ylim=(0, 1),
                  xlabel="slider displacement r [m]",
                  ylabel="share of runs below r [1]")
        right.legend(loc="upper left")
    axes[0].legend(loc="upper right")
    save(figure, out)
