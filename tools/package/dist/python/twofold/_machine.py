"""A machine and its state."""
from __future__ import annotations

import ctypes
import math
import os
from ctypes import byref, c_int
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._check import (LIMIT, STEPS, alone, column, columns, flag, integer,
                     member, number, packed, refuse, unpacked, word)
from ._core import CORES, Struct
from ._names import Law, Mode, Rest, Rule, Scheme, Status
from ._table import Table

# Float loses a motion in the rounding of its state at shorter steps [s].
SHORT_STEP = 1e-3
INPUTS = {"omega0": "rad/s", "r0": "m", "force": "N", "torque": "N m",
          "alpha": "rad/s^2"}
START = {"r": "m", "v": "m/s", "omega": "rad/s", "h": "m/s", "phi": "rad"}
BUFFERS = {"_motion": "Motion", "_params": "Params"}
# What else a mistyped setting may be; the command line selects by a rule.
HINTS = {"select": "rule", **{name: name for name in (
    *START, "real", "law", "rule", "rest", "with_angle", "seed", "t_end",
    "every", "scheme", "over", "inputs", "between")}}
Inputs = Union[Struct, str, os.PathLike, np.ndarray, dict, Any]


def placed(r, omega, v, h):
    """The given quantities of a place, by name."""
    if (v is None) == (h is None):
        raise ValueError("give either v or h")
    return {"r": r, "omega": omega, **({"h": h} if v is None else {"v": v})}


class Futures(dict):
    """Machines by mode; a key is a member of Mode or its word."""

    def __getitem__(self, mode):
        return super().__getitem__(Mode(mode))

    def __contains__(self, mode):
        return mode in [*self]

    def get(self, mode, default=None):
        return self[mode] if mode in self else default


class _Quantity:
    """A quantity of the present state."""

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, machine, owner=None) -> float:
        return self if machine is None else getattr(machine._row(), self.name)


class _Table:
    """Inputs over time that drive a machine, as --inputs does."""

    def __init__(self, machine, inputs, between, steps):
        self.core, name = machine.core, b"inputs"
        if isinstance(inputs, (str, os.PathLike)):
            name, text = os.fsencode(inputs), Path(inputs).read_bytes()
        else:
            text = _csv_of(inputs)
        if between is None:
            raise TypeError("a table of inputs needs between='held' or "
                            "between='linear'")
        linear = word("between", between, ("held", "linear")) == "linear"
        self.held = name, ctypes.create_string_buffer(self.core.size["table"])
        self.core.read(self.core.call_table, self.held[1],
                       ctypes.pointer(machine.scene), linear,
                       machine.state.tick * machine["dt"],
                       (machine.state.tick + steps) * machine["dt"], name, text)

    def __del__(self):
        if hasattr(self, "held"):
            self.core.call_free(self.held[1])


def _csv_of(inputs):
    """A DataFrame, a dict or a structured array as CSV, t first."""
    names = getattr(getattr(inputs, "dtype", None), "names", None)
    try:
        given = columns({name: column(f"inputs: {name}", inputs[name], "iuf",
                                      -LIMIT, LIMIT)
                         for name in sorted(names or inputs.keys(),
                                            key=lambda name: name != "t")})
    except AttributeError:
        raise TypeError(f"inputs is {inputs!r}, neither from input() of a "
                        "machine of this real type nor a path, DataFrame, dict "
                        "or structured array with the column t") from None
    return "\n".join([",".join(map(str, given)), *(
        ",".join(map(repr, row)) for row in zip(*(
            one.tolist() for one in given.values()))), ""]).encode()


class Machine:
    """A machine and its state: t [s], r [m], v [m/s], omega [rad/s], phi [rad],
    h [m/s], g [m/s] and mode. Of the last step: F [N] and M [N m], its means,
    delassus [1/kg], set (the modes that were possible), choices (their number)
    and status. `state` has what can be changed: r, v, w (omega), phi, tick,
    seed, mode.

    scene: one of scenes(), or a file if the name contains "." or "/". It gives
      parameters, start and inputs.
    real: "double" or "float".
    law, rule, rest: a member of Law, Rule or Rest, or its name. The parameter
      rate [1/s] belongs to rule "random".
    with_angle: whether to integrate the angle of the disc.
    r, v, omega, h, phi: the start; None: as in the scene. Give v or h.
    parameters: those to be changed, by name, in SI units; see parameters().
    Raises ValueError that names the parameter, its value and its range.
    A method raises RuntimeError if another thread, or the code that a signal
    interrupted, is inside a method of the same machine: give each a copy()."""
    _fixed = *CORES["double"].columns,
    t, r, v, omega, phi, h, g, F, M, delassus = (_Quantity() for _ in range(10))

    def __init__(self, scene: str | os.PathLike = "chaos", real: str = "double",
                 law: Law | str | None = None, rule: Rule | str | None = None,
                 rest: Rest | str | None = None,
                 with_angle: bool | None = None, seed: int = 0,
                 r: float | None = None, v: float | None = None,
                 omega: float | None = None, h: float | None = None,
                 phi: float | None = None, **parameters: float):
        core: Any = CORES[word("real", real, CORES)]
        self.core, self._free, self._text = core, [None], None
        if isinstance(scene, os.PathLike) or \
                isinstance(scene, str) and ("." in scene or "/" in scene):
            scene, self._text = os.fspath(scene), Path(scene).read_bytes()
        self.scene = core.scene(scene, self._text)
        self.name, self.seed = scene, seed
        self._params = core.Params.from_buffer_copy(self.scene.params)
        for name, value in parameters.items():
            one = core.ranges[word("name of a parameter", name, core.ranges,
                                   HINTS, TypeError)]
            rounded = core.real(number(name, value)).value
            setattr(self._params, name, number(
                name, rounded, one.low, one.high, one.unit.decode()))
        for name, given, kind in (("law", law, Law), ("rule", rule, Rule),
                                  ("rest", rest, Rest)):
            if given is not None:
                setattr(self._params, name, member(name, given, kind))
        if with_angle is not None or phi is not None:
            self._params.with_angle = flag(
                "with_angle", True if with_angle is None else with_angle)
        if v is not None and h is not None:
            raise ValueError("give either v or h, not both")
        self._start = self._given(zip(START, (r, v, omega, h, phi)))
        self._motion = core.Motion()
        offender = c_int(-1)
        if core.call_prepare_compensated(
                byref(self._motion), byref(self._params), byref(offender)) < 0:
            name, bad = [*core.ranges.items()][offender.value]
            refuse(name, self[name], bad.low, bad.high, bad.unit.decode())
        self.start()

    def __getitem__(self, name: str) -> float:
        """Returns a parameter in SI units."""
        return getattr(self._params, word("name of a parameter", name,
                                          self.core.ranges))

    def __repr__(self):
        x, t = self.state, self.state.tick * self["dt"]
        return (f"Machine({self.name!r}, law={Law(self._params.law)}, "
                f"rule={Rule(self._params.rule)}) at t={t:.6g} s: r={x.r:.6g} "
                f"m, v={x.v:.6g} m/s, omega={x.w:.6g} rad/s, "
                f"{Mode(x.mode)}")

    def _row(self):
        return self.core.call_row(self._run())

    @property
    def mode(self) -> Mode:
        return Mode(self._row().mode)

    @property
    def set(self) -> tuple[Mode, ...]:
        found = self._row().set
        return tuple(mode for mode in Mode if found >> mode & 1)

    @property
    def choices(self) -> int:
        return self._row().choices

    @property
    def status(self) -> Status:
        return Status(self._row().status)

    def __setattr__(self, name, value):
        if name in (*self._fixed, *CORES["double"].ranges):
            raise AttributeError(
                f"{name} cannot be assigned: give parameters to Machine(), "
                "and a state by place() or in `state`")
        super().__setattr__(name, value)

    def _given(self, values):
        """A start, with NaN for what the scene gives."""
        return tuple(math.nan if value is None else
                     number(name, value, -LIMIT, LIMIT, START[name])
                     for name, value in values)

    @alone
    def start(self) -> None:
        """Returns to the start of the scene, or to the given one."""
        self._begin(self._start, f"start of {self.name}")

    @alone
    def place(self, r: float, omega: float, v: float | None = None,
              h: float | None = None) -> None:
        """Starts anew at r [m] and omega [rad/s], with either the speed v [m/s]
        of the slider or the slip speed h [m/s]."""
        given = {**dict.fromkeys(START), **placed(r, omega, v, h)}
        for name in ("r", "omega"):  # which None does not leave to the scene
            number(name, given[name])
        self._begin(self._given(given.items()), "place")

    def _begin(self, start, what, seed=None, scheme=0, first=None):
        seed = integer("seed", self.seed if seed is None else seed, 0,
                       2 ** 32 - 1)
        status = self.core.call_begin(
            self._run(scheme), seed, (self.core.real * len(START))(*start),
            first)
        if status < 0:
            if math.isnan(start[1]) and abs(math.sin(self["gamma"])) < 1e-6:
                what += (": no speed v gives a slip speed h, because "
                         "sin(gamma) = 0; give v")
        self.core.fail(status, what)
        self._begun = start, bytes(self.state)

    @property
    def state(self) -> Struct:
        return self._motion.state

    def _run(self, scheme=0):
        self.core.check_arithmetic()
        return self.core.Run(ctypes.pointer(self._motion),
                             ctypes.pointer(self.scene), scheme)

    @alone
    def copy(self) -> Machine:
        """Returns an independent machine in the same state."""
        return self._copy()

    def _copy(self):
        one = object.__new__(type(self))
        one.__dict__.update(self.__dict__, _free=[None], **{
            name: getattr(self.core, kind).from_buffer_copy(getattr(self, name))
            for name, kind in BUFFERS.items()})
        return one

    def __copy__(self):
        return self.copy()

    @alone
    def __getstate__(self):
        """The state for pickle, without objects of ctypes."""
        return packed({**self.__dict__, "_free": [None], "scene": None, **{
            name: bytes(getattr(self, name)) for name in BUFFERS}},
            _core.SIZES)

    def __setstate__(self, held):
        held = unpacked(held, _core.SIZES)
        self.__dict__.update(held)
        self.scene = self.core.scene(self.name, self._text)
        for name, kind in BUFFERS.items():
            setattr(self, name, getattr(self.core, kind).from_buffer_copy(
                held[name]))

    def input(self, **changed: float) -> Struct:
        """Returns the inputs of an undriven machine, with changes: omega0
        [rad/s], r0 [m], force [N], torque [N m], alpha [rad/s^2]."""
        given = self.core.call_input_default(byref(self._motion))
        for name, value in changed.items():
            word("name of an input", name, INPUTS)
            setattr(given, name, number(name, value, -LIMIT, LIMIT,
                                        INPUTS[name]))
        return given

    def turntable_to(self, inputs: Struct, omega0: float) -> None:
        """Moves the turntable in `inputs` (from input()) to omega0 [rad/s] at
        the end of the next step. alpha becomes the mean over that step."""
        self._held(inputs)
        self.core.check_arithmetic()
        self.core.call_turntable_to(
            byref(inputs), number("omega0", omega0, -LIMIT, LIMIT, "rad/s"),
            self["dt"])

    def _held(self, inputs):
        """Checks inputs from input(), which the caller may have altered."""
        if not isinstance(inputs, self.core.Input):
            raise TypeError(f"inputs is {inputs!r}, not from input() of a "
                            "machine of this real type")
        for name, unit in INPUTS.items():
            number(f"inputs: {name}", getattr(inputs, name), -LIMIT, LIMIT,
                   unit)
        return byref(inputs)

    @alone
    def two_folds(self) -> Table:
        """Returns every two-fold at g != 0 under the inputs at t = 0, with its
        normal form in the paper's time: one row each, as `twofold
        singularities` prints them."""
        rows = np.zeros(8, self.core.fold)
        count = c_int(0)
        self.core.fail(self.core.call_folds(
            self._run(), rows.ctypes.data, byref(count)), "two_folds")
        return rows[:count.value].view(Table)

    @alone
    def regions(self, r: ArrayLike, omega: ArrayLike) -> Table:
        """Returns the regions of h = 0 over r [m] and omega [rad/s], arrays of
        one dimension, under the inputs at t = 0. The table has the shape
        (len(r), len(omega)); lambda and delassus are NaN where undefined."""
        axes = [np.atleast_1d(column(name, values, "iuf", -LIMIT, LIMIT))
                for name, values in (("r", r), ("omega", omega))]
        rows = np.zeros([axis.size for axis in axes], self.core.place)
        rows["r"], rows["omega"] = np.meshgrid(*axes, indexing="ij")
        self.core.fail(self.core.call_regions(
            self._run(), rows.ctypes.data, rows.size),
            "regions needs law jump or coulomb and |sin(gamma)| in [1e-06, 1], "
            f"not law {Law(self._params.law)} and gamma = {self['gamma']:g}")
        return rows.view(Table)

    def energy(self) -> float:
        """Returns the mechanical energy of the present state [J]."""
        self.core.check_arithmetic()
        return self.core.call_energy(byref(self._motion), byref(self.state),
                                     self["r0"])

    def _scheme(self, scheme):
        if scheme is None:
            short = self.core is CORES["float"] and self["dt"] < SHORT_STEP
            return Scheme.COMPENSATED if short else Scheme.MOREAU
        scheme, law = member("scheme", scheme, Scheme), Law(self._params.law)
        if not self.core.call_takes_law(scheme, law):
            raise ValueError("scheme is located, which needs law jump, coulomb "
                             f"or none, not {law}; moreau takes every law")
        return scheme

    def _ready(self, scheme, first=None):
        """Begins under a scheme: the compensated step starts with v of the
        given h beyond rounding."""
        start, state = self._begun
        if bytes(self.state) == state:
            self._begin(start, "start", self.state.seed, scheme, first)
        return self._run(scheme)

    @alone
    def futures(self, scheme: Scheme | str | None = None,
                inputs: Struct | None = None) -> Futures:
        """Returns what may follow: a dict of machines one step on, by mode (a
        member of Mode or its word): futures()["slip+"]. It has each mode of the
        set that the step reports, and the mode that the step takes, whatever
        the rule chooses; it is never empty.

        An escaping stick may end at any time, so each of its steps offers both
        slips as well. If a mode is possible only within the step, stick or rest
        changes to it at the end. Under located, a mode that is over by then is
        left out. scheme and inputs are those of step(). Raises ValueError if
        the step is refused."""
        scheme = self._scheme(scheme)
        held = None if inputs is None else self._held(inputs)
        self._ready(scheme)
        all_ = {mode: self._copy() for mode in Mode}
        taken = {mode: self.core.call_take(one._run(scheme), held, mode)
                 for mode, one in all_.items()}
        self.core.fail(max(taken.values()), "step 1")
        return Futures((mode, all_[mode]) for mode in Mode if taken[mode] >= 0)

    @alone
    def step(self, steps: int = 1, inputs: Struct | None = None,
             scheme: Scheme | str | None = None) -> Status:
        """Takes `steps` steps; r, mode and the others then have the result.
        inputs are from input(); run() also takes a table. Returns the status of
        the last step. Raises ValueError if a step is refused."""
        steps = integer("steps", steps, 1, STEPS)
        self._follow(steps, steps, scheme, inputs, None)
        return self.status

    @alone
    def run(self, t_end: float | None = None, every: int = 1,
            scheme: Scheme | str | None = None, inputs: Inputs = None,
            between: str | None = None) -> Table:
        """Advances by t_end [s] (default: the length of the scene), rounded to
        whole steps.

        scheme: a member of Scheme or its name. None: moreau, or compensated in
          float below 1 ms, as on the command line.
        inputs: None: those of the scene. From input(): held; alpha applies to
          the first step, then the turntable keeps its omega0 and alpha becomes
          0, in `inputs` too. Or a table over time, as for --inputs: a path, a
          DataFrame, a dict or a structured array with the column t [s] and any
          of omega0 [rad/s], r0 [m], force [N] and torque [N m]. Its t is the
          machine's.
        between: for a table: "held" (a row holds until the next) or "linear".
        Returns a table: a row at the beginning, one after every `every` steps
          and one at the end, with t [s], r [m], v [m/s], omega [rad/s], phi
          [rad], h, g [m/s], F [N], M [N m], delassus [1/kg], mode (of Mode),
          set (bit 1 << mode for each possible mode), choices, status.
        Raises ValueError if a step is refused, and KeyboardInterrupt at once;
          `state` is then that of the last step taken."""
        rows, done, status = self._rows(t_end, every, scheme, inputs, between)
        self.core.fail(status, f"step {done + 1}")
        return rows

    def _rows(self, t_end, every, scheme, inputs, between, seen=None,
              stop=None):
        """Returns the rows that were reached, the steps taken and the last
        status. seen: memory for the outcomes of a sweep."""
        every = integer("every", every, 1, STEPS)
        return self._follow(self._steps(t_end), every, scheme, inputs, between,
                            seen, stop)

    def _steps(self, t_end):
        if t_end is None:
            t_end = self.scene.t_end
        t_end = number("t_end", t_end, 0, STEPS * self["dt"], "s")
        steps, rest = divmod(self.core.real(t_end).value / self["dt"], 1)
        return int(steps) + (rest >= 0.5)  # round() goes to even

    def _follow(self, steps, every, scheme, inputs, between, seen=None,
                stop=None):
        scheme = self._scheme(scheme)
        held = table = first = None
        if between is not None or not (inputs is None or
                                       isinstance(inputs, Struct)):
            table = _Table(self, inputs, between, steps)
            first = self.core.call_drive(table.held[1], self._run(scheme),
                                         byref(self._params))
        elif inputs is not None:
            held = self._held(inputs)
        run = self._ready(scheme, first)
        if seen:
            self.core.call_outcome_begin(
                seen, byref(self._motion), first or held or
                self.core.call_scene_input(byref(self.scene),
                                           byref(self._motion), 0))
        rows = np.zeros(1 + -(-steps // every), self.core.row)
        done, status = 0, c_int(0)
        # A step of located is slow where its tolerance is small.
        most = max(1, _core.SLICE >> 4 * (run.scheme == Scheme.LOCATED))
        while True:
            done = self.core.call_run(
                run, held, table and table.held[1], seen, done, most, steps,
                every, rows.ctypes.data, byref(status))
            if done == steps or status.value < 0:
                break
            if stop and stop():
                raise KeyboardInterrupt
        kept = rows if status.value >= 0 else rows[:1 + done // every]
        return kept.view(Table), done, status.value


def simulate(scene: str | os.PathLike = "chaos", t_end: float | None = None,
             every: int = 1, scheme: Scheme | str | None = None,
             inputs: Inputs = None, between: str | None = None,
             **settings) -> Table:
    """Simulates one motion and returns its rows. The arguments t_end to between
    are those of Machine.run(), scene and settings those of Machine."""
    return Machine(scene, **settings).run(t_end, every, scheme, inputs, between)
