"""Rows as an array that shows itself."""
from __future__ import annotations

from html import escape

import numpy as np

from ._check import word
from ._names import Folds, Mode, Region, Status

UNITS = {"t": "s", "r": "m", "v": "m/s", "omega": "rad/s", "phi": "rad",
         "h": "m/s", "g": "m/s", "F": "N", "M": "N m", "delassus": "1/kg",
         "residual": "N", "lambda": "N", "time_scale": "kg m^2", "rest": "s",
         "arrival": "s", "recurrence": "s", "ambiguous": "s", "energy": "J",
         "energy_change": "J", "r_low": "m", "r_high": "m", "end_r": "m",
         "end_v": "m/s", "end_omega": "rad/s", "end_h": "m/s", "end_g": "m/s"}
# What numbers of a column stand for.
MEMBERS = {"mode": Mode, "final": Mode, "status": Status, "region": Region,
           "type": Folds}
# Okabe and Ito's colours, by mode as in docs/PAPER.md.
COLOURS = ("#d55e00", "#e69f00", "#0072b2", "#009e73", "#000000")
SHOWN = 10


def _cell(name, value):
    if name == "set":
        return "|".join(str(mode) for mode in Mode if value >> mode & 1)
    if name in MEMBERS and isinstance(value, np.integer):
        return "".join(str(one) for one in MEMBERS[name] if one == value)
    return f"{value:.6g}" if isinstance(value, np.floating) else str(value)


class Table(np.ndarray):
    """A structured array of numpy: table["r"] is a column, a plain array. It
    shows the first and the last rows, with units and names; in a notebook, as
    a table."""

    def __getitem__(self, key):
        if isinstance(key, str) and self.dtype.names:
            word("name of a column", key, self.dtype.names)
        got = super().__getitem__(key)
        plain = isinstance(got, Table) and got.dtype.names is None
        return got.view(np.ndarray) if plain else got

    def _cells(self):
        flat, half = self.reshape(-1), SHOWN // 2
        names = self.dtype.names
        rows = [[_cell(name, row[name]) for name in names]
                for row in (flat if flat.size <= SHOWN else
                            np.concatenate((flat[:half], flat[-half:])))]
        if flat.size > SHOWN:
            rows.insert(half, ["..."] * len(names))
        return [[f"{name} [{UNITS[name]}]" if name in UNITS else name
                 for name in names], *rows]

    def __repr__(self):
        if not self.dtype.names:
            return repr(self.view(np.ndarray))
        cells = self._cells()
        widths = [max(map(len, column)) for column in zip(*cells)]
        return "\n".join("  ".join(map(str.rjust, row, widths))
                         for row in cells) + f"\n({self.size} rows)"

    __str__ = __repr__

    def _repr_html_(self):
        rows = "".join(
            "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row)
            + "</tr>" for tag, row in zip(
                ["th"] + ["td"] * self.size, self._cells()))
        return f"<table>{rows}</table><p>{self.size} rows</p>"

    def plot(self, x: str = "r", y: str = "omega", axes=None, **style):
        """Draws one column over another by matplotlib, a colour for each mode
        or region; style is that of its plot(). Returns: the axes."""
        import matplotlib.pyplot as plt
        axes = plt.figure().add_subplot() if axes is None else axes
        by = next((name for name in ("mode", "final", "region")
                   if name in self.dtype.names), None)
        style = {"linestyle": "", "marker": ".", "markersize": 2, **style}
        for one in MEMBERS.get(by or "", (None,)):
            part = self if one is None else self[self[by] == one]
            if part.size:
                axes.plot(part[x].ravel(), part[y].ravel(), **{
                    "color": COLOURS[one or 0], "label": str(one), **style})
        axes.set(**{f"{axis}label": f"{name} [{UNITS.get(name, '1')}]"
                    for axis, name in (("x", x), ("y", y))})
        if by:
            axes.legend(markerscale=4)
        return axes
