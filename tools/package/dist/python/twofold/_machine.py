"""One machine in one state."""
from __future__ import annotations

import copy
import ctypes
import math
from ctypes import Structure, byref, c_int
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._check import (LIMIT, STEPS, column, flag, integer, member, number,
                     refuse, word)
from ._core import CORES
from ._names import Law, Mode, Rest, Rule, Scheme
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
    "every", "scheme", "over")}}


def placed(r, omega, v, h):
    """What of a place is given, by its name."""
    if (v is None) == (h is None):
        raise ValueError("either v or h is to be given")
    return {"r": r, "omega": omega, **({"h": h} if v is None else {"v": v})}


class Machine:
    """A prepared machine, in one state.

    scene: one of scenes(); gives parameters, start and inputs.
    real: "double" or "float".
    law, rule, rest: of Law, Rule, Rest, or a name; rate [1/s] belongs to rule
      "random".
    with_angle: whether the angle of the disc is integrated.
    r, v, omega, h, phi: the start; None: that of the scene. h instead of v.
    state: its r, v, w, phi, tick, seed and mode.
    parameters: those to be changed, by name, in SI units (parameters()).
    Raises ValueError that names a parameter, its value and its range.
    """

    def __init__(self, scene: str = "chaos", real: str = "double",
                 law: Law | str | None = None, rule: Rule | str | None = None,
                 rest: Rest | str | None = None,
                 with_angle: bool | None = None, seed: int = 1,
                 r: float | None = None, v: float | None = None,
                 omega: float | None = None, h: float | None = None,
                 phi: float | None = None, **parameters: float):
        core: Any = CORES[word("real", real, CORES)]
        self.core = core
        self.scene = core.scenes[word("scene", scene, core.scenes)]
        self.name, self.seed = scene, seed
        self._params = core.Params.from_buffer_copy(self.scene.params)
        for name, value in parameters.items():
            one = core.ranges[word("name of a parameter", name, core.ranges,
                                   HINTS)]
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
            raise ValueError("either v or h is to be given, not both")
        self._start = self._given(zip(START, (r, v, omega, h, phi)))
        self._motion = core.Motion()
        offender = c_int(-1)
        if core.call_prepare_compensated(
                byref(self._motion), byref(self._params), byref(offender)) < 0:
            name, bad = [*core.ranges.items()][offender.value]
            refuse(name, self[name], bad.low, bad.high, bad.unit.decode())
        self.start()

    def __getitem__(self, name: str) -> float:
        """Value of a parameter in SI units, by its name."""
        return getattr(self._params, word("name of a parameter", name,
                                          self.core.ranges))

    def __repr__(self):
        x, t = self.state, self.state.tick * self["dt"]
        return (f"Machine({self.name!r}, law={Law(self._params.law)}, "
                f"rule={Rule(self._params.rule)}) at t={t:.6g} s: r={x.r:.6g} "
                f"m, v={x.v:.6g} m/s, omega={x.w:.6g} rad/s, "
                f"{Mode(x.mode)}")

    def _given(self, values):
        """A start; NaN where the scene gives it."""
        return tuple(math.nan if value is None else
                     number(name, value, -LIMIT, LIMIT, START[name])
                     for name, value in values)

    def start(self) -> None:
        """Returns to the start of the scene, or to that given."""
        self._begin(self._start, f"start of {self.name}")

    def place(self, r: float, omega: float, v: float | None = None,
              h: float | None = None) -> None:
        """Starts anew at r [m] and omega [rad/s], with the speed v [m/s] of the
        slider or, instead, the slip speed h [m/s]."""
        given = {**dict.fromkeys(START), **placed(r, omega, v, h)}
        for name in ("r", "omega"):  # which None does not leave to the scene
            number(name, given[name])
        self._begin(self._given(given.items()), "place")

    def _begin(self, start, what, seed=None, scheme=0):
        seed = integer("seed", self.seed if seed is None else seed, 0,
                       2 ** 32 - 1)
        status = self.core.call_begin(
            self._run(scheme), seed, (self.core.real * len(START))(*start))
        if status < 0:
            if math.isnan(start[1]) and abs(math.sin(self["gamma"])) < 1e-6:
                what += (": no speed v gives a slip speed h, because "
                         "sin(gamma) = 0; give v")
        self.core.fail(status, what)
        self._begun = start, bytes(self.state)

    @property
    def state(self) -> Structure:
        return self._motion.state

    def _run(self, scheme=0):
        self.core.check_arithmetic()
        return self.core.Run(ctypes.pointer(self._motion),
                             ctypes.pointer(self.scene), scheme)

    def copy(self) -> Machine:
        """One in the same state, which goes its own way."""
        return copy.copy(self)

    def __getstate__(self):
        """Of a copy and of a pickle, which has nothing of ctypes."""
        return {**self.__dict__, "scene": None,
                **{name: bytes(getattr(self, name)) for name in BUFFERS}}

    def __setstate__(self, held):
        self.__dict__ = held
        self.scene = self.core.scenes[self.name]
        for name, kind in BUFFERS.items():
            setattr(self, name, getattr(self.core, kind).from_buffer_copy(
                held[name]))

    def input(self, **changed: float) -> Structure:
        """The inputs of a machine that nothing drives, with changes: omega0
        [rad/s], r0 [m], force [N], torque [N m], alpha [rad/s^2]."""
        given = self.core.call_input_default(byref(self._motion))
        for name, value in changed.items():
            word("name of an input", name, INPUTS)
            setattr(given, name, number(name, value, -LIMIT, LIMIT,
                                        INPUTS[name]))
        return given

    def turntable_to(self, inputs: Structure, omega0: float) -> None:
        """Moves the turntable of inputs, of input(), on to omega0 [rad/s] at
        the end of the next step: alpha becomes the mean over that step."""
        self._held(inputs)
        self.core.call_turntable_to(
            byref(inputs), number("omega0", omega0, -LIMIT, LIMIT, "rad/s"),
            self["dt"])

    def _held(self, inputs):
        """Inputs of input(), which may have been altered since."""
        if not isinstance(inputs, self.core.Input):
            raise TypeError(f"inputs is {inputs!r}, not of input() of a "
                            "machine of this real type")
        for name, unit in INPUTS.items():
            number(f"inputs: {name}", getattr(inputs, name), -LIMIT, LIMIT,
                   unit)
        return byref(inputs)

    def two_folds(self) -> Table:
        """Every two-fold at g != 0, under the inputs at t = 0, with its normal
        form in the paper's time: a row each, as `twofold singularities` has
        them; none where the machine has none."""
        rows = np.zeros(8, self.core.fold)
        count = c_int(0)
        self.core.fail(self.core.call_folds(
            self._run(), rows.ctypes.data, byref(count)), "two_folds")
        return rows[:count.value].view(Table)

    def regions(self, r: ArrayLike, omega: ArrayLike) -> Table:
        """The regions of h = 0 over r [m] and omega [rad/s], arrays of one
        dimension, under the inputs at t = 0: a table of the shape (len(r),
        len(omega)); NaN where lambda or delassus is not defined."""
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
        """Mechanical energy of the present state [J]."""
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

    def _ready(self, scheme):
        """A start under it: compensated has the v of an h beyond rounding."""
        start, state = self._begun
        if bytes(self.state) == state:
            self._begin(start, "start", self.state.seed, scheme=scheme)
        return self._run(scheme)

    def futures(self, scheme: Scheme | str | None = None,
                inputs: Structure | None = None) -> dict[Mode, Machine]:
        """What the next step may be: for each mode of the set that it reports,
        and that which it takes, a machine one step on in it, whatever the rule
        takes; never none. An escaping stick may be left at any time, so each
        step has both slips beside it. Where a mode is possible only within the
        step, stick or rest is left into it at the end; one that is over by then
        (under located) is left out. scheme and inputs: those of run(). Raises
        ValueError where the step is refused."""
        scheme = self._scheme(scheme)
        held = None if inputs is None else self._held(inputs)
        self._ready(scheme)
        all_ = {mode: self.copy() for mode in Mode}
        taken = {mode: self.core.call_take(one._run(scheme), held, mode)
                 for mode, one in all_.items()}
        self.core.fail(max(taken.values()), "step 1")
        return {mode: all_[mode] for mode in Mode if taken[mode] >= 0}

    def run(self, t_end: float | None = None, every: int = 1,
            scheme: Scheme | str | None = None,
            inputs: Structure | None = None) -> Table:
        """Steps on for t_end [s] (default: the scene's length), the nearest
        whole number of steps.

        scheme: of Scheme, or a name; None: moreau, in float below 1 ms
          compensated, as on the command line.
        inputs: of input(), held; their alpha is that of the first step, behind
          which the turntable keeps its omega0 and alpha is 0, in `inputs` too.
          None: those of the scene.
        Returns: a table with a row at the beginning, one after every `every`
          steps and one at the end; t [s], r [m], v [m/s], omega [rad/s], phi
          [rad], h, g [m/s], F [N], M [N m], delassus [1/kg], mode (of Mode),
          set (bit 1 << mode of each that was possible), choices, status.
        Raises ValueError where a step is refused, and KeyboardInterrupt at
          once; `state` is the last one.
        """
        rows, done, status = self._rows(t_end, every, scheme, inputs)
        self.core.fail(status, f"step {done + 1}")
        return rows

    def _rows(self, t_end, every, scheme, inputs):
        """Rows, as far as they were reached, steps taken, last status."""
        scheme = self._scheme(scheme)
        every = integer("every", every, 1, STEPS)
        if t_end is None:
            t_end = self.scene.t_end
        t_end = number("t_end", t_end, 0, STEPS * self["dt"], "s")
        steps, rest = divmod(self.core.real(t_end).value / self["dt"], 1)
        steps = int(steps) + (rest >= 0.5)  # round() goes to even
        held = None if inputs is None else self._held(inputs)
        run = self._ready(scheme)
        rows = np.zeros(1 + -(-steps // every), self.core.row)
        done, status = 0, c_int(0)
        # A step of located is slow where its tolerance is small.
        most = max(1, _core.SLICE >> 4 * (run.scheme == Scheme.LOCATED))
        while True:
            done = self.core.call_run(
                run, held, done, most, steps, every,
                rows.ctypes.data, byref(status))
            if done == steps or status.value < 0:
                break
        kept = rows if status.value >= 0 else rows[:1 + done // every]
        return kept.view(Table), done, status.value


def simulate(scene: str = "chaos", t_end: float | None = None, every: int = 1,
             scheme: Scheme | str | None = None, **settings) -> Table:
    """The rows of one motion; settings are those of Machine."""
    return Machine(scene, **settings).run(t_end, every, scheme)
