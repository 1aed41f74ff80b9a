"""Many states of one machine, and many machines."""
from __future__ import annotations

import contextlib
import ctypes
import math
import os
from concurrent.futures import ThreadPoolExecutor
from ctypes import byref
from itertools import chain
from threading import Event

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._check import (LIMIT, STEPS, alone, column, columns, integer, member,
                     packed, unpacked, word)
from ._core import CORE_f64, LANES, NO_MODE, Struct, parameters
from ._machine import START, Inputs, Machine, placed
from ._names import Law, Mode, Rule, Scheme
from ._table import Table


class Ensemble:
    """Many states of one machine, stepped together with the bits of single
    steps of scheme moreau.

    machine: a Machine. r [m], omega [rad/s], v [m/s] or h [m/s]: numbers, or
    one-dimensional arrays of one length. seed: for rule "random", one for each
    state."""

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
        """Takes `steps` steps. inputs are from Machine.input(), held; alpha
        applies to the first step and is 0 afterwards. None: those of the scene.
        Only Machine.run() takes a table over time. A state whose step is
        refused stays where it is; see status. After KeyboardInterrupt all
        states have taken the same number of steps."""
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
        """Where each quantity is stored, and its name there."""
        return {**{"omega" if name == "w" else name: (self.states, name)
                   for name in self.states.dtype.names},
                **{name: (self.reports, name)
                   for name in self.reports.dtype.names if name != "mode"}}

    def __getitem__(self, name: str) -> np.ndarray:
        """Returns an array over the states: r [m], v [m/s], omega [rad/s], phi
        [rad], tick, seed; F [N], M [N m], h, g [m/s], delassus [1/kg], residual
        [N], mode (of Mode), set, choices, status (< 0: refused). Forces, slips,
        set, choices and status are those of the last step."""
        known = self._columns()
        home, name = known[word("name of a quantity", name, known)]
        return home[name].reshape(-1)[:self.n].copy()

    def table(self) -> Table:
        """Returns all quantities, one numbered row for each state."""
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


KINDS = {"law": Law, "rule": Rule}
OTHER_AXES = (*KINDS, "seed", *START)
# Those of the command line, where sets of modes are bits.
OUTCOMES = CORE_f64.measures
OF_MODES = {"modes": "U48", "final": "u1", "set": "u1"}
NUMBERS = ["t", *(name for name in OUTCOMES if name not in OF_MODES)]
ENDS = "done", "flagged", "stopped", "refused"


def _axis(name, values):
    """Values of an axis: numbers, or names of members."""
    if name not in KINDS:
        return np.atleast_1d(column(name, values, "iu" if name == "seed" else
                                    "iuf", -math.inf, math.inf))
    return np.array([str(member(name, value, KINDS[name])) for value in (
        values if np.ndim(values) and len(values) else [values])])


def _begin(row, scene, scheme, settings):
    """The machine of a point, and room for what is seen of it; or why it was
    refused."""
    row["final"] = NO_MODE
    try:
        machine = Machine(scene, **settings)
        machine._ready(machine._scheme(scheme))
    except ValueError as error:
        row["status"], row["reason"] = ENDS[3], str(error)
        return error
    return machine, ctypes.create_string_buffer(machine.core.size["seen"])


def _together(begun, t_end, stop):
    """Follows motions of one machine in lanes, under inputs of its scene."""
    machine, core = begun[0][0], begun[0][0].core
    lanes = ctypes.create_string_buffer(core.size["lanes"])
    head = (ctypes.c_size_t * (2 * LANES + 1)).from_buffer(lanes)
    for n, (one, seen) in enumerate(begun):
        head[n] = ctypes.addressof(one._motion)
        head[LANES + n] = ctypes.addressof(seen)
        core.call_outcome_begin(seen, byref(one._motion), core.call_scene_input(
            byref(one.scene), byref(one._motion), 0))
    head[2 * LANES], steps = len(begun), machine._steps(t_end)
    for done in range(0, max(1, steps), _core.SLICE):
        if stop():
            raise KeyboardInterrupt
        core.call_together(machine._run(), lanes, done, _core.SLICE, steps)


def _points(rows, scene, how, settings, stop):
    """Fills in the rows of points, which are several only if they differ in
    nothing but their starts. Returns why each was refused, or None."""
    found = [_begin(row, scene, how[1], given)
             for row, given in zip(rows, settings)]
    begun = [one for one in found if isinstance(one, tuple)]
    if len(begun) > 1 and begun[0][0]._scheme(how[1]) == Scheme.MOREAU:
        _together(begun, how[0], stop)
    else:
        for machine, seen in begun:
            machine._rows(how[0], STEPS, *how[1:], seen, stop)
    return [_end(row, *one) if isinstance(one, tuple) else one
            for row, one in zip(rows, found)]


def _end(row, machine, seen):
    core, values = machine.core, np.empty(len(OUTCOMES))
    end = core.call_outcome_end(seen, byref(machine._motion),
                                values.ctypes.data)
    found = dict(zip(OUTCOMES, values))
    modes = int(found.pop("modes"))
    row["modes"] = "|".join(str(one) for one in Mode if modes >> one & 1)
    row["final"] = int(found.pop("final")).bit_length() - 1
    row["t"] = machine.state.tick * machine["dt"]
    row["status"], row["reason"] = ENDS[end], seen.value.decode()
    for name, value in found.items():
        row[name] = value


def _in_threads(work, groups, jobs, progress, stop):
    """The results of all points. The core does not hold Python's lock."""
    with ThreadPoolExecutor(jobs) as pool:
        try:
            results = chain.from_iterable(pool.map(work, groups))
            if progress is not False:
                with contextlib.suppress(ImportError):
                    from tqdm.auto import tqdm
                    results = tqdm(results, "sweep", sum(map(len, groups)),
                                   unit="point",
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
    """Simulates one motion for each point of a grid, as `twofold sweep` does.

    over: the values of each axis by name: a parameter or argument of Machine.
    inputs, between: for each motion, as in Machine.run.
    jobs: points at a time; None: one for each processor.
    progress: whether tqdm, if installed, shows it; None: on a terminal.
    Returns a table with a column for each axis, then t (reached), the outcomes
      of `twofold sweep` (NaN: did not happen), status (done, flagged, stopped,
      refused) and the reason. to_xarray() makes the axes coordinates.
    Raises ValueError if every point is refused: then no axis is the cause."""
    if not (over is None or isinstance(over, dict)):
        raise TypeError(f"over is {over!r}, not a dict of axes")
    axes = {word("name of an axis", name, (*parameters(), *OTHER_AXES)):
            _axis(name, values) for name, values in (over or {}).items()}
    for name in axes.keys() & settings.keys():
        raise ValueError(f"{name} is an axis, and given as {settings[name]!r}")
    threads: int = integer("jobs", os.cpu_count() if jobs is None else jobs, 1,
                           2 ** 16)
    table = np.zeros([len(values) for values in axes.values()], [
        *((name, values.dtype) for name, values in axes.items()),
        *((name, "f8") for name in NUMBERS), *OF_MODES.items(),
        ("status", "U8"), ("reason", "U160")])
    for name, grid in zip(axes, np.meshgrid(*axes.values(), indexing="ij")):
        table[name] = grid
    for name in NUMBERS:
        table[name] = math.nan
    stop, points = Event(), [*np.ndindex(table.shape)]
    alike = {*axes} <= {"seed", *START} and inputs is None and between is None
    size = min(LANES, -(-len(points) // threads)) if alike else 1
    errors = _in_threads(lambda group: _points(
        [table[at] for at in group], scene, (t_end, scheme, inputs, between),
        [{**settings, **{name: table[name][at].item() for name in axes}}
         for at in group], stop.is_set),
        [points[i:i + size] for i in range(0, len(points), size)],
        threads, progress, stop)
    if all(errors):
        raise errors[0]
    return table.view(Table)
