"""Rows as a numpy array that prints itself and converts to other packages."""
from __future__ import annotations

import csv
import os
from html import escape
from pathlib import Path
from typing import TextIO

import numpy as np

from ._check import packed, unpacked, word
from ._names import Folds, Mode, Region, Status

UNITS = {"w": "rad/s", "omega0": "rad/s", "r0": "m", "force": "N",
         "torque": "N m", "alpha": "rad/s^2", "residual": "N", "lambda": "N",
         "time_scale": "kg m^2"}
# What numbers of a column stand for.
MEMBERS = {"mode": Mode, "final": Mode, "status": Status, "region": Region,
           "type": Folds}
STRIPS = "r", "v", "omega", "h"
# Of modes, as on the page and in docs/PAPER.md.
COLOURS = ("#b84900", "#b57d00", "#0068b0", "#00876a", "#1b1f24")
SHOWN = 10
# Columns of the command line that are whole numbers; set: of words.
COUNTS = {"choices", "tick", "point", "changes", "arrivals", "sample", "cycle",
          "landings", "windings", "node", "depth", "to"}


def _cell(name, value):
    if name == "set":
        return "|".join(str(mode) for mode in Mode if value >> mode & 1)
    if name in MEMBERS and isinstance(value, np.integer):
        return "".join(str(one) for one in MEMBERS[name] if one == value)
    return f"{value:.6g}" if isinstance(value, np.floating) else str(value)


class _Plain(np.ndarray):
    """An array that numpy functions reduce to plain arrays and numbers."""

    def __array_wrap__(self, array, *_):
        return array.view(np.ndarray)[() if array.ndim == 0 else ...]


class _Members(_Plain):
    """Numbers of modes and the like, comparable with words."""

    def __array_finalize__(self, of):
        self.kind = getattr(of, "kind", None)

    def __eq__(self, other):
        return self.view(np.ndarray) == (
            self.kind(other) if isinstance(other, str) else other)

    def __ne__(self, other):
        return ~(self == other)

    def __getitem__(self, key):
        return _member(self.kind, super().__getitem__(key))

    def __iter__(self):
        return (self[i] for i in range(len(self)))


def _member(kind, value):
    """The member with this number, if there is one."""
    return kind(int(value)) if kind and isinstance(
        value, np.integer) and value in [*kind] else value


def _table(held):
    return unpacked(held, []).view(Table)


class _Row(np.void):
    """A row whose modes and the like are members."""

    def __getitem__(self, key):
        return _member(MEMBERS.get(key), super().__getitem__(key))


class Table(_Plain):
    """A structured array of numpy. table["r"] is a column, a plain array; a
    column of modes can be compared with words, as can table[0]["mode"]. It
    prints its first and last rows with units and names; notebooks show a table.
    """

    def __getitem__(self, key):
        if isinstance(key, str) and self.dtype.names:
            word("name of a column", key, self.dtype.names)
        got = super().__getitem__(key)
        if isinstance(got, np.void):
            return got.view(np.dtype((_Row, got.dtype)))
        if not isinstance(got, Table) or got.dtype.names is not None:
            return got
        if not isinstance(key, str) or key not in MEMBERS or \
                got.dtype.kind not in "iu":
            return got.view(np.ndarray)
        got = got.view(_Members)
        got.kind = MEMBERS[key]
        return got

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __reduce__(self):
        return _table, (packed(self.view(np.ndarray), []),)

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

    @property
    def columns(self) -> list[str]:
        return [*(self.dtype.names or ())]

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns that have one."""
        return {name: UNITS[name] for name in self.columns if name in UNITS}

    def words(self, name: str) -> np.ndarray:
        """A column in words, for modes, status and the like. A set becomes one
        word, such as "slip+|stick+"."""
        values = self[name]
        if name != "set" and name not in MEMBERS or values.dtype.kind not in \
                "iu":
            return values
        found, at = np.unique(values, return_inverse=True)
        return np.array([_cell(name, one) for one in found], str)[
            at.reshape(values.shape)]

    def to_pandas(self):
        """Returns a DataFrame with a line for each row. Modes and the like are
        categories, sets are words; attrs["units"] has the units."""
        import pandas
        flat = self.reshape(-1)
        frame = pandas.DataFrame({
            name: pandas.Categorical(flat.words(name),
                                     [*map(str, MEMBERS[name])])
            if name in MEMBERS and flat[name].dtype.kind in "iu"
            else flat.words(name) for name in self.columns})
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self):
        """Returns a Dataset. The axes (t of a run, those of a grid) are
        coordinates, modes and the like words, units attributes."""
        import xarray
        axes = []
        for k in range(self.ndim):
            ends = tuple(slice(None) if i == k else slice(1)
                         for i in range(self.ndim))
            axes.append(next((
                name for name in self.columns if name not in axes and
                np.unique(self[name][ends]).size > (self.shape[k] > 1)
                and (self[name] == self[name][ends]).all()), f"row_{k}"))
        data = xarray.Dataset()
        for name in self.columns:
            k = axes.index(name) if name in axes else None
            data[name] = (axes, self.words(name)) if k is None else (
                name, self.words(name)[tuple(
                    slice(None) if i == k else 0 for i in range(self.ndim))])
            if name in UNITS:
                data[name].attrs["units"] = UNITS[name]
        return data

    def plot(self, x: str = "r", y: str = "omega", axes=None, **style):
        """Plots one column over another with matplotlib, one colour for each
        mode or region. style goes to matplotlib's plot(). Returns the axes."""
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

    def strips(self, title: str = ""):
        """Plots r, v, omega and h over time with matplotlib, one colour for
        each mode, shaded where several futures were possible. Returns the
        figure."""
        import matplotlib.pyplot as plt
        from matplotlib.patches import Patch
        for name in {"t", "mode", "choices", *STRIPS}.difference(self.columns):
            raise ValueError(f"no column {name}: strips() needs rows of a run")
        figure, strips = plt.subplots(len(STRIPS), sharex=True, figsize=(9, 8),
                                      layout="constrained")
        t, mode, several = self["t"], self["mode"], self["choices"] > 1
        edges = np.diff(np.concatenate(([0], several.astype("i1"), [0])))
        from_ = t[np.flatnonzero(edges > 0)]
        to = t[np.flatnonzero(edges < 0) - 1]
        seen = [one for one in Mode if (mode == one).any()]
        for name, axes in zip(STRIPS, strips):
            if name == "h":
                axes.axhline(0, color="#888888", linewidth=0.6)
            for one in seen:  # to the row behind it, as a line has no gaps
                there = mode == one
                there[1:] |= there[:-1]
                axes.plot(t, np.where(there, self[name], np.nan),
                          color=COLOURS[one], linewidth=1.2)
            axes.set_ylabel(f"{name} [{UNITS[name]}]")
            axes.margins(x=0)
            axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
            axes.broken_barh([*zip(from_, to - from_)], (0, 1), color="#cccccc",
                             transform=axes.get_xaxis_transform(), zorder=0)
        strips[-1].set_xlabel("t [s]")
        figure.align_ylabels()
        figure.suptitle(title)
        strips[0].legend(handles=[
            *(Patch(color=COLOURS[one], label=str(one)) for one in seen),
            *several.any() * [Patch(color="#cccccc",
                                    label="several modes possible")]],
            loc="lower center", bbox_to_anchor=(0.5, 1), ncol=6, frameon=False)
        return figure


def read_csv(path: str | os.PathLike | TextIO) -> Table:
    """Reads a CSV file of the command line, exact in every digit (in pandas:
    float_precision="round_trip"). Modes become numbers of Mode, sets become
    bits, and empty fields NaN."""
    text = Path(path).read_text("utf-8") if isinstance(
        path, (str, os.PathLike)) else path.read()
    rows = [*csv.reader(line for line in text.splitlines()
                        if not line.startswith("#"))]
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise ValueError(f"{path}: no header, or rows of other lengths")
    columns = dict(zip(rows[0], zip(*rows[1:]) if rows[1:] else [()] * 99))
    read = {name: _column(name, texts) for name, texts in columns.items()}
    table = np.zeros(len(rows) - 1, [(name, one.dtype)
                                     for name, one in read.items()])
    for name, one in read.items():
        table[name] = one
    return table.view(Table)


def _column(name, texts):
    """Numbers if all fields are numbers, else words."""
    bits = {str(mode): 1 << mode for mode in Mode}
    try:
        if name == "set":
            return np.array([sum(bits[one] for one in text.split("|") if one)
                             for text in texts], "u1")
        if name in MEMBERS:
            return np.array([MEMBERS[name](text) if text else 5
                             for text in texts],
                            "i1" if name == "status" else "u1")
        if name in COUNTS and all(texts):
            return np.array([int(text) for text in texts], int)
        return np.array([float(text) if text else np.nan for text in texts],
                        float)
    except (KeyError, ValueError):
        return np.array(texts, str)
