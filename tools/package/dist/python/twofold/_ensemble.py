"""Many states of one machine, and many machines."""
from __future__ import annotations

import contextlib
import math
import os
from concurrent.futures import ThreadPoolExecutor
from ctypes import byref
from threading import Event

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._check import (LIMIT, STEPS, alone, column, columns, integer, member,
                     packed, unpacked, word)
from ._core import LANES, NO_MODE, Struct, parameters
from ._machine import START, Inputs, Machine, placed
from ._names import Law, Mode, Rule, Scheme, Status
from ._table import Table


class Ensemble:
    """Many states of one machine, stepped together with the bits of single
    steps of scheme moreau.

    machine: a Machine. r [m], omega [rad/s], v [m/s] or h [m/s]: arrays of one
    length and one dimension, or numbers. seed: of rule "random", one a state.
    """

    def __init__(self, machine: Machine, r: ArrayLike, omega: ArrayLike,
                 v: ArrayLike | None = None, h: ArrayLike | None = None,
                 seed: ArrayLike | None = None):
        if not isinstance(machine, Machine):
            raise TypeError(f"machine is {machine!r}, not a Machine")
        self.machine, self.core, self._free = machine.copy(), machine.core, [0]
        given = {name: column(name, values, "iuf", -LIMIT, LIMIT, START[name])
                 for name, values in placed(r, omega, v, h).items()}
        if seed is not None:
            given["seed"] = column("seed", seed, "iu", 0, 2 ** 32 - 1)
        given = columns(given)
        self.n = given["r"].size
        seeds = given.pop("seed", np.arange(self.n))
        blocks = -(-self.n // LANES)
        self.states = np.zeros(blocks, self.core.state_block)
        self.reports = np.zeros(blocks, self.core.report_block)
        one = self.machine.copy()
        for i in range(self.n):
            start = {**dict.fromkeys(START), **{
                name: float(values[i]) for name, values in given.items()}}
            one._begin(one._given(start.items()), f"state {i}", int(seeds[i]))
            self.core.call_ensemble_put(self.states.ctypes.data, i,
                                        byref(one.state))

    @alone
    def __getstate__(self):
        return packed({**self.__dict__, "_free": [None]}, _core.SIZES)

    def __setstate__(self, held):
        self.__dict__.update(unpacked(held, _core.SIZES))

    @alone
    def step(self, steps: int = 1, inputs: Struct | None = None) -> None:
        """Takes so many steps. inputs: of Machine.input(), held; their alpha is
        that of the first step, and 0 behind it. None: those of the scene. A
        table over time drives single motions only: Machine.run(). A state whose
        step is refused stays where it is; see status. Where KeyboardInterrupt
        ends it, all states have taken as many of the steps."""
        steps = integer("steps", steps, 0, STEPS)
        held = None if inputs is None else self.machine._held(inputs)
        most = max(1, _core.SLICE // self.n)
        first = int(self.states["tick"].max())
        for tick in range(first, first + steps, most):
            self.core.call_lanes(
                self.machine._run(), self.states.ctypes.data, self.n, held,
                self.reports.ctypes.data, tick,
                min(tick + most, first + steps))

    def _columns(self):
        """Home and name there of each quantity."""
        return {**{"omega" if name == "w" else name: (self.states, name)
                   for name in self.states.dtype.names},
                **{name: (self.reports, name)
                   for name in self.reports.dtype.names if name != "mode"}}

    def __getitem__(self, name: str) -> np.ndarray:
        """An array over the states: r [m], v [m/s], omega [rad/s], phi [rad],
        tick, seed; F [N], M [N m], h, g [m/s], delassus [1/kg], residual [N],
        mode (of Mode), set, choices, status (< 0: refused). Forces, slips, set,
        choices and status are those of the last step."""
        known = self._columns()
        home, name = known[word("name of a quantity", name, known)]
        return home[name].reshape(-1)[:self.n].copy()

    def table(self) -> Table:
        """All of them, a row for each state, which is numbered."""
        own = {"state": np.arange(self.n),
               **{name: self[name] for name in self._columns()}}
        return np.rec.fromarrays(own.values(), dtype=[
            (name, one.dtype) for name, one in own.items()]).view(Table)

    def __repr__(self):
        return f"{self.n} states of {self.machine!r}\n{self.table()!r}"

    def _repr_html_(self):
        return self.table()._repr_html_()

    def __len__(self):
        return self.n


def _outcomes(rows, energy, end_energy):
    """What is left of a motion: the outcomes of `twofold sweep`, by its
    rows."""
    t, mode, g, A = (rows[name] for name in ("t", "mode", "g", "delassus"))
    slip, choice = mode <= Mode.SLIP_MINUS, rows["choices"] > 1
    stick = ~slip & (mode != Mode.PINNED)
    steps = len(rows) - 1 or math.nan
    moves, several = np.flatnonzero(mode != Mode.PINNED), np.flatnonzero(choice)
    fold = np.flatnonzero(
        stick[:-1] & (A[:-1] > 0) & ~(A[1:] > 0)
        & np.where(stick[1:], mode[1:] == mode[:-1],
                   slip[1:] & (np.sign(g[1:]) * np.sign(g[:-1]) >= 0))) + 1
    since = moves[-1] + 1 if len(moves) else 0
    return {
        "modes": "|".join(str(one) for one in Mode if one in mode),
        "final": mode[-1], "changes": np.count_nonzero(np.diff(mode)),
        "rest": t[since] if since < len(t) else math.nan,
        "arrivals": len(fold), "arrival": t[fold[0]] if len(fold) else math.nan,
        "recurrence": ((t[fold[-1]] - t[fold[0]]) / (len(fold) - 1)
                       if len(fold) > 1 else math.nan),
        "ambiguous": t[several[0]] if len(several) else math.nan,
        "ambiguous_share": np.count_nonzero(choice[1:]) / steps,
        "stick_share": np.count_nonzero(~slip[1:]) / steps,
        "energy": end_energy, "energy_change": end_energy - energy,
        "r_low": rows["r"].min(), "r_high": rows["r"].max(),
        **{f"end_{name}": rows[name][-1]
           for name in ("r", "v", "omega", "h", "g")}}


KINDS = {"law": Law, "rule": Rule}
OTHER_AXES = (*KINDS, "seed", *START)
NUMBERS = ("t changes rest arrivals arrival recurrence ambiguous "
           "ambiguous_share stick_share energy energy_change r_low r_high "
           "end_r end_v end_omega end_h end_g").split()


FLAGS = Status.DEGRADED, Status.COARSE, Status.STALLED


def _axis(name, values):
    """Values of an axis: numbers, or names of members."""
    if name not in KINDS:
        return np.atleast_1d(column(name, values, "iu" if name == "seed" else
                                    "iuf", -math.inf, math.inf))
    return np.array([str(member(name, value, KINDS[name])) for value in (
        values if np.ndim(values) and len(values) else [values])])


def _point(row, scene, how, settings, stop):
    """Fills in the row of a point. Returns: why it was refused."""
    row["final"] = NO_MODE
    try:
        machine = Machine(scene, **settings)
        machine._ready(machine._scheme(how[1]))
    except ValueError as error:
        row["status"], row["reason"] = "refused", str(error)
        return error
    energy = machine.energy()
    t_end, *others = how
    rows, done, status = machine._rows(t_end, 1, *others, stop)
    row["t"] = rows["t"][-1]
    found = _outcomes(rows, energy, machine.energy())
    for name, value in found.items():
        row[name] = value
    flags = rows["status"] * (rows["t"] > 0)  # the start has none
    counts = [np.count_nonzero(flags == flag) for flag in FLAGS]
    row["status"] = ("stopped" if status < 0 else
                     "flagged" if any(counts) else "done")
    if status < 0:
        reason = machine.core.call_status_name(status).decode()
        row["reason"] = f"step {done + 1}: {reason}"
    elif any(counts):
        row["reason"] = (
            "{} steps degraded; {} coarse; {} stalled; first at t = {:.9g} s"
            .format(*counts, rows["t"][np.flatnonzero(flags)[0]]))
    return None


def _in_threads(work, points, jobs, progress, stop):
    """The results of all points; the core does not hold Python's lock."""
    with ThreadPoolExecutor(jobs) as pool:
        try:
            results = pool.map(work, points)
            if progress is not False:
                with contextlib.suppress(ImportError):
                    from tqdm.auto import tqdm
                    results = tqdm(results, "sweep", len(points), unit="point",
                                   disable=None if progress is None else False)
            return list(results)
        finally:
            stop.set()
            pool.shutdown(cancel_futures=True)


def sweep(scene: str | os.PathLike = "chaos", over: dict | None = None,
          t_end: float | None = None, scheme: Scheme | str | None = None,
          inputs: Inputs = None, between: str | None = None,
          jobs: int | None = None, progress: bool | None = None,
          **settings) -> Table:
    """Follows a motion from each point of a grid: what `twofold sweep` finds.

    over: values of each axis by its name, a parameter or argument of Machine.
    inputs, between: of each, as of Machine.run.
    jobs: points at a time; None: one for each processor.
    progress: whether tqdm, where it is installed, shows how far the sweep is;
      None: on a terminal.
    Returns: a table with an axis for each; columns: those of over, t (reached),
      the outcomes of `twofold sweep` (NaN: it did not happen), status (done,
      flagged, stopped, refused) and the reason. to_xarray() has the axes as
      coordinates.
    Raises ValueError where every point is refused: that is no axis' doing.
    """
    if not (over is None or isinstance(over, dict)):
        raise TypeError(f"over is {over!r}, not a dict of axes")
    axes = {word("name of an axis", name, (*parameters(), *OTHER_AXES)):
            _axis(name, values) for name, values in (over or {}).items()}
    for name in axes.keys() & settings.keys():
        raise ValueError(f"{name} is an axis, and given as {settings[name]!r}")
    jobs = integer("jobs", os.cpu_count() if jobs is None else jobs, 1, 2 ** 16)
    table = np.zeros([len(values) for values in axes.values()], [
        *((name, values.dtype) for name, values in axes.items()),
        *((name, "f8") for name in NUMBERS), ("modes", "U48"),
        ("final", "u1"), ("status", "U8"), ("reason", "U160")])
    for name, grid in zip(axes, np.meshgrid(*axes.values(), indexing="ij")):
        table[name] = grid
    for name in NUMBERS:
        table[name] = math.nan
    stop = Event()
    errors = _in_threads(lambda at: _point(
        table[at], scene, (t_end, scheme, inputs, between), {**settings, **{
            name: table[name][at].item() for name in axes}}, stop.is_set),
        [*np.ndindex(table.shape)], jobs, progress, stop)
    if all(errors):
        raise errors[0]
    return table.view(Table)
