"""A wheel on a turntable whose friction is not always deterministic.

The core is twofold's, in C, called by ctypes: in fixed steps it finds every
mode of contact that is possible, reports them, and takes one by a declared
rule. Results have the bits of the command line `twofold`.

    import twofold
    machine = twofold.Machine("chaos", dt=1e-4)
    rows = machine.run(t_end=2.0, every=10)
    rows["t"], rows["r"], rows["omega"], rows["mode"]

All numbers are in SI units. `parameters()` lists names, units and ranges.
"""
from __future__ import annotations

import ctypes
import math
import numbers
import operator
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t
from ctypes import c_uint, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p
from itertools import count, takewhile
from pathlib import Path

import numpy as np

__all__ = ["Ensemble", "LAWS", "MODES", "Machine", "RULES", "parameters",
           "scenes"]
__version__ = "@VERSION@"
LANES = 16
NO_MODE = 5
# Largest magnitude of a state and of an input, and number of steps at once.
LIMIT = 1e9
STEPS = 2 ** 53
# Steps of one call of the core; behind each, Python looks at its signals.
SLICE = 2 ** 16
INPUTS = {"omega0": "rad/s", "r0": "m", "force": "N", "torque": "N m",
          "alpha": "rad/s^2"}
PLACE = {"r": "m", "omega": "rad/s", "v": "m/s", "h": "m/s"}
LAYOUT = ("params", "law", "rule", "with_angle", "machine", "state", "input",
          "report", "state_block", "report_block", "point", "parameters",
          "two_folds")

_shared = ctypes.CDLL(str(Path(__file__).with_name("_twofold.so")))


def _names(function):
    """All names of a kind: the first that there is not is unknown."""
    name = getattr(_shared, f"{function}_f64")
    name.argtypes, name.restype = [c_uint], c_char_p
    names = (name(i).decode() for i in count())
    return tuple(takewhile(lambda text: not text.startswith("unknown"), names))


MODES = _names("tf_mode_name")
LAWS = _names("tf_tyre_law_name")
RULES = _names("tf_rule_name")


# What the core is given is checked here: ctypes itself takes a bool for a
# number, and an integer modulo its size.
def _refuse(name, value, low, high, unit=""):
    raise ValueError(f"{name} is {value}, allowed is [{low}, {high}] {unit}"
                     .rstrip())


def _integer(name, value, low, high):
    """An integer in a range; a float is none, even where it is whole."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value}, not an integer")
    try:
        whole = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, not an integer") from None
    if not low <= whole <= high:
        _refuse(name, whole, low, high)
    return whole


def _number(name, value, low=-math.inf, high=math.inf, unit=""):
    """A real number in a range, as a float; without a range also one that is
    not finite, which the core judges."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {value!r}, not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf if value > 0 else -math.inf
    if low > -math.inf and not low <= number <= high:
        _refuse(name, number, low, high, unit)
    return number


def _flag(name, value):
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}, not True or False")
    return bool(value)


def _word(name, value, words):
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}, not a str")
    if value not in words:
        raise ValueError(f"{name} is {value!r}, not one of "
                         + ", ".join(words))
    return value


def _column(name, values, kinds, low, high, unit=""):
    """Numbers in a range, of the kinds that numpy has for them: a number, or an
    array of one dimension."""
    try:
        array = np.asarray(values)
    except ValueError:  # rows of several lengths
        raise TypeError(f"{name} is no array of numbers") from None
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name} is of {array.dtype}, not of "
                        + ("numbers" if "f" in kinds else "integers"))
    if array.ndim > 1 or array.size == 0:
        raise ValueError(f"{name} has the shape {array.shape}, not (n,)")
    allowed = (low <= array) & (array <= high)
    if not allowed.all():
        _refuse(name, array.flat[np.argmin(allowed)], low, high, unit)
    return array


def _columns(columns):
    """All with the length of those that are no single numbers."""
    length, first = 1, None
    for name, array in columns.items():
        if array.ndim and first is None:
            length, first = array.size, name
        if array.ndim and array.size != length:
            raise ValueError(f"{name} has {array.size} values, {first} has "
                             f"{length}")
    return {name: np.broadcast_to(array, length)
            for name, array in columns.items()}


class _Core:
    """The core in one real type: its functions, structs and row types."""

    def __init__(self, suffix, real, dtype):
        self.suffix, self.real, self.dtype = suffix, real, np.dtype(dtype)
        sizes = (c_uint32 * len(LAYOUT)).in_dll(
            _shared, f"twofold_layout_{suffix}")
        self.size = dict(zip(LAYOUT, sizes))
        self._structs()
        self._rows()
        self._functions()

    def _struct(self, name, fields):
        """A struct of the core; its size is compared with the compiler's."""
        struct = type(name, (ctypes.Structure,), {"_fields_": fields})
        if ctypes.sizeof(struct) != self.size[name]:
            raise ImportError(f"{name} is laid out in another way here")
        return struct

    def _structs(self):
        real = self.real

        def reals(names):
            return [(name, real) for name in names.split()]

        self.State = self._struct("state", reals("r v w phi") + [
            ("tick", c_uint64), ("seed", c_uint32), ("mode", c_uint8)])
        self.Input = self._struct(
            "input", reals("omega0 r0 force torque alpha"))
        self.Point = self._struct("point", reals("r v w g"))
        self.Range = type("Range", (ctypes.Structure,), {"_fields_": [
            ("name", c_char_p), ("unit", c_char_p), ("offset", c_uint16),
            ("laws", c_uint16), ("low", real), ("high", real)]})
        self.ranges = (self.Range * self.size["parameters"]).in_dll(
            _shared, f"tf_parameter_ranges_{self.suffix}")

    def _rows(self):
        real = self.dtype
        self.row = np.dtype(
            [("t", "f8")] + [(name, real) for name in
                             ("r", "v", "omega", "phi", "h", "g", "F", "M")]
            + [("mode", "u1"), ("set", "u1"), ("choices", "u1"),
               ("status", "i1")], align=True)
        self.state_block = np.dtype(
            [(name, real, LANES) for name in ("r", "v", "w", "phi")]
            + [("tick", "u8", LANES), ("seed", "u4", LANES),
               ("mode", "u1", LANES)], align=True)
        self.report_block = np.dtype(
            [(name, real, LANES)
             for name in ("F", "M", "h", "g", "delassus", "residual")]
            + [("mode", "u1", LANES), ("set", "u1", LANES),
               ("choices", "u1", LANES), ("status", "i1", LANES)], align=True)
        row_size = c_uint32.in_dll(_shared, f"twofold_row_size_{self.suffix}")
        for dtype, size in ((self.row, row_size.value),
                            (self.state_block, self.size["state_block"]),
                            (self.report_block, self.size["report_block"])):
            if dtype.itemsize != size:
                raise ImportError("arrays are laid out in another way here")

    def _functions(self):
        real, any_, state = self.real, c_void_p, POINTER(self.State)
        input_, report = POINTER(self.Input), c_void_p
        for name, result, arguments in (
                ("tf_prepare", c_int, (any_, any_, POINTER(c_int))),
                ("tf_input_default", self.Input, (any_,)),
                ("tf_turntable_to", None, (input_, real, real)),
                ("tf_begin", c_int, (any_, state, input_, report)),
                ("tf_begin_with_slip", c_int,
                 (any_, state, input_, real, report)),
                ("tf_scene_start", c_int,
                 (any_, any_, c_uint32, state, report)),
                ("tf_energy", real, (any_, state, real)),
                ("tf_status_name", c_char_p, (c_int,)),
                ("twofold_ensemble_run", None,
                 (any_, any_, c_size_t, input_, any_, c_uint64)),
                ("twofold_scene", any_, (c_uint,)),
                ("twofold_scene_text", c_char_p, (any_, c_int)),
                ("twofold_scene_params", any_, (any_,)),
                ("twofold_scene_end", c_double, (any_,)),
                ("tf_ensemble_put", None, (any_, c_size_t, state)),
                ("tf_two_folds", c_int,
                 (any_, input_, POINTER(self.Point), POINTER(c_int), any_)),
                ("twofold_row", None, (any_, state, report, c_int, any_)),
                ("twofold_run", c_uint64,
                 (any_, any_, c_int, state, input_, report, *4 * [c_uint64],
                  any_, POINTER(c_int)))):
            function = getattr(_shared, f"{name}_{self.suffix}")
            function.restype, function.argtypes = result, arguments
            setattr(self, "call_" + name.split("_", 1)[1], function)

    def scenes(self):
        """Handle of each scene by name."""
        found, index = {}, 0
        while scene := self.call_scene(index):
            found[self.call_scene_text(scene, 0).decode()] = scene
            index += 1
        return found

    def new_report(self):
        """A report that a step fills in."""
        return ctypes.create_string_buffer(self.size["report"])

    def fail(self, status, what):
        """Raises for a negative status."""
        if status < 0:
            name = self.call_status_name(status).decode()
            raise ValueError(f"{what}: {name}")


_CORES = {"double": _Core("f64", ctypes.c_double, "f8"),
          "float": _Core("f32", ctypes.c_float, "f4")}


def scenes():
    """Name of each scene, and what it shows."""
    core = _CORES["double"]
    return {name: core.call_scene_text(scene, 1).decode()
            for name, scene in core.scenes().items()}


def parameters():
    """Name of each parameter: (unit, lowest, highest value)."""
    return {one.name.decode(): (one.unit.decode(), one.low, one.high)
            for one in _CORES["double"].ranges}


class Machine:
    """A prepared machine, in one state.

    scene: one of scenes(); gives parameters, start and inputs.
    real: "double" or "float".
    law, rule: one of LAWS, RULES; rate [1/s] belongs to rule "random".
    with_angle: whether the angle of the disc is integrated.
    parameters: those to be changed, by name, in SI units (parameters()).
    Raises ValueError that names a parameter, its value and its range.
    """

    def __init__(self, scene="chaos", real="double", law=None, rule=None,
                 with_angle=None, seed=1, **changed):
        self.core = core = _CORES[_word("real", real, _CORES)]
        known = core.scenes()
        self.scene = known[_word("scene", scene, known)]
        self.name, self.seed = scene, seed
        self._params = ctypes.create_string_buffer(
            ctypes.string_at(core.call_scene_params(self.scene),
                             core.size["params"]), core.size["params"])
        for name, value in changed.items():
            one = self._range(name)
            rounded = core.real(_number(name, value)).value
            self._put(one.offset, core.real, _number(
                name, rounded, one.low, one.high, one.unit.decode()))
        for name, value, names in (("law", law, LAWS), ("rule", rule, RULES)):
            if value is not None:
                self._put(core.size[name], c_uint,
                          names.index(_word(name, value, names)))
        if with_angle is not None:
            self._put(core.size["with_angle"], ctypes.c_bool,
                      _flag("with_angle", with_angle))
        self._machine = ctypes.create_string_buffer(core.size["machine"])
        offender = c_int(-1)
        if core.call_prepare(self._machine, self._params, byref(offender)) < 0:
            bad = core.ranges[offender.value]
            name = bad.name.decode()
            _refuse(name, self[name], bad.low, bad.high, bad.unit.decode())
        self.start()

    def _put(self, offset, type_, value):
        ctypes.memmove(byref(self._params, offset), byref(type_(value)),
                       ctypes.sizeof(type_))

    def _range(self, name):
        known = {one.name.decode(): one for one in self.core.ranges}
        return known[_word("name of a parameter", name, known)]

    def __getitem__(self, name):
        """Value of a parameter in SI units, by its name."""
        return self.core.real.from_buffer(
            self._params, self._range(name).offset).value

    def start(self):
        """Returns to the start of the scene."""
        state, report = self.core.State(), self.core.new_report()
        self.core.fail(self.core.call_scene_start(
            self.scene, self._machine, self._seed(), byref(state), report),
            f"start of {self.name}")
        self.state, self.report = state, report

    def _seed(self):
        return _integer("seed", self.seed, 0, 2 ** 32 - 1)

    def place(self, r, omega, v=None, h=None):
        """Starts anew at r [m] and omega [rad/s], with the speed v [m/s] of the
        slider or, instead, the slip speed h [m/s]."""
        given = {name: _number(name, value, -LIMIT, LIMIT, PLACE[name])
                 for name, value in _placed(r, omega, v, h).items()}
        self.state, self.report = self._begun(given, self._seed(), "place")

    def _begun(self, given, seed, what):
        state = self.core.State(r=given["r"], w=given["omega"],
                                v=given.get("v", 0), seed=seed, mode=NO_MODE)
        report, input_ = self.core.new_report(), byref(self.input())
        self.core.fail(
            self.core.call_begin(self._machine, byref(state), input_, report)
            if "v" in given else self.core.call_begin_with_slip(
                self._machine, byref(state), input_, given["h"], report), what)
        return state, report

    def input(self, **changed):
        """The inputs of a machine that nothing drives, with changes: omega0
        [rad/s], r0 [m], force [N], torque [N m], alpha [rad/s^2]."""
        given = self.core.call_input_default(self._machine)
        for name, value in changed.items():
            _word("name of an input", name, INPUTS)
            setattr(given, name, _number(name, value, -LIMIT, LIMIT,
                                         INPUTS[name]))
        return given

    def turntable_to(self, inputs, omega0):
        """Moves the turntable of inputs, of input(), on to omega0 [rad/s] at
        the end of the next step: alpha becomes the mean over that step."""
        self._given(inputs)
        self.core.call_turntable_to(
            byref(inputs), _number("omega0", omega0, -LIMIT, LIMIT, "rad/s"),
            self["dt"])

    def _given(self, inputs):
        """Inputs of input(), which may have been altered since."""
        if not isinstance(inputs, self.core.Input):
            raise TypeError(f"inputs is {inputs!r}, not of input() of a "
                            "machine of this real type")
        for name, unit in INPUTS.items():
            _number(f"inputs: {name}", getattr(inputs, name), -LIMIT, LIMIT,
                    unit)
        return byref(inputs)

    def two_folds(self):
        """Every two-fold at g != 0: an array of rows r [m], v [m/s], omega
        [rad/s], g [m/s]; empty where the machine has none."""
        points = (self.core.Point * self.core.size["two_folds"])()
        count = c_int(0)
        self.core.fail(self.core.call_two_folds(
            self._machine, byref(self.input()), points, byref(count), None),
            "two_folds")
        return np.array([(p.r, p.v, p.w, p.g) for p in points[:count.value]],
                        [(name, self.core.dtype)
                         for name in ("r", "v", "omega", "g")])

    def energy(self):
        """Mechanical energy of the present state [J]."""
        return self.core.call_energy(self._machine, byref(self.state),
                                     self["r0"])

    def run(self, t_end=None, every=1, scheme="moreau", inputs=None):
        """Steps on for t_end [s] (default: the scene's length), the nearest
        whole number of steps.

        scheme: "moreau", or "located" (high order, events located).
        inputs: of input(), held; their alpha is that of the first step, behind
          which the turntable keeps its omega0 and alpha is 0, in `inputs` too.
          None: those of the scene.
        Returns: an array with a row at the beginning, one after every `every`
          steps and one at the end; t [s], r [m], v [m/s], omega [rad/s], phi
          [rad], h, g [m/s], F [N], M [N m], mode (index into MODES), set (bit
          1 << mode of each that was possible), choices, status.
        Raises ValueError where a step is refused, and KeyboardInterrupt at
          once; `state` is the last one.
        """
        _word("scheme", scheme, ("moreau", "located"))
        every = _integer("every", every, 1, STEPS)
        if t_end is None:
            t_end = self.core.call_scene_end(self.scene)
        steps = round(_number("t_end", t_end, 0, STEPS * self["dt"], "s")
                      / self["dt"])
        held = None if inputs is None else self._given(inputs)
        rows = np.zeros(1 + -(-steps // every), self.core.row)
        self.core.call_row(self._machine, byref(self.state), self.report, 0,
                       rows.ctypes.data)
        done, status = 0, c_int(0)
        while done < steps and status.value >= 0:
            done = self.core.call_run(
                self._machine, self.scene, scheme == "located",
                byref(self.state), held, self.report, done, SLICE, steps,
                every, rows[1:].ctypes.data, byref(status))
        self.core.fail(status.value, f"step {done + 1}")
        return rows


def _placed(r, omega, v, h):
    """What of a place is given, by its name."""
    if (v is None) == (h is None):
        raise ValueError("either v or h is to be given")
    return {"r": r, "omega": omega, **({"h": h} if v is None else {"v": v})}


class Ensemble:
    """Many states of one machine, stepped together with the bits of single
    steps.

    machine: a Machine. r [m], omega [rad/s], v [m/s] or h [m/s]: arrays of one
    length and one dimension, or numbers. seed: of rule "random", one a state.
    """

    def __init__(self, machine, r, omega, v=None, h=None, seed=None):
        if not isinstance(machine, Machine):
            raise TypeError(f"machine is {machine!r}, not a Machine")
        self.machine, self.core = machine, machine.core
        given = {name: _column(name, values, "iuf", -LIMIT, LIMIT, PLACE[name])
                 for name, values in _placed(r, omega, v, h).items()}
        if seed is not None:
            given["seed"] = _column("seed", seed, "iu", 0, 2 ** 32 - 1)
        given = _columns(given)
        self.n = given["r"].size
        seeds = given.pop("seed", np.arange(self.n))
        blocks = -(-self.n // LANES)
        self.states = np.zeros(blocks, self.core.state_block)
        self.reports = np.zeros(blocks, self.core.report_block)
        for i in range(self.n):
            state, _ = machine._begun(
                {name: float(values[i]) for name, values in given.items()},
                int(seeds[i]), f"state {i}")
            self.core.call_ensemble_put(self.states.ctypes.data, i,
                                        byref(state))

    def step(self, steps=1, inputs=None):
        """Takes so many steps. inputs: of Machine.input(), held; their alpha is
        that of the first step, and 0 behind it. A state whose step is refused
        stays where it is; see status. Where KeyboardInterrupt ends it, all
        states have taken as many of the steps."""
        steps = _integer("steps", steps, 0, STEPS)
        inputs = self.machine.input() if inputs is None else inputs
        self.machine._given(inputs)
        most = max(1, SLICE // self.n)
        for taken in range(0, steps, most):
            self.core.call_ensemble_run(
                self.machine._machine, self.states.ctypes.data, self.n,
                byref(inputs), self.reports.ctypes.data,
                min(most, steps - taken))

    def __getitem__(self, name):
        """An array over the states: r [m], v [m/s], omega [rad/s], phi [rad],
        tick, seed; F [N], M [N m], h, g [m/s], delassus [1/kg], residual [N],
        mode (index into MODES), set, choices, status (< 0: refused). Forces,
        slips, set, choices and status are those of the last step."""
        states = {"omega" if one == "w" else one: one
                  for one in self.states.dtype.names}
        _word("name of a quantity", name,
              dict.fromkeys((*states, *self.reports.dtype.names)))
        home, name = ((self.states, states[name]) if name in states
                      else (self.reports, name))
        return home[name].reshape(-1)[:self.n].copy()

    def __len__(self):
        return self.n
