"""The core in both real types, by ctypes: functions, structs, rows."""
from __future__ import annotations

import ctypes
import os
import warnings
from ctypes import POINTER, c_bool, c_char, c_char_p, c_double, c_int, c_int8
from ctypes import c_size_t, c_uint, c_uint8, c_uint16, c_uint32, c_uint64
from ctypes import c_void_p
from pathlib import Path

import numpy as np

from ._check import packed, unpacked, word
from ._names import Mode
from ._table import UNITS

LANES = 16
NO_MODE = 5
# Steps of one call of the core; behind each, Python looks at its signals.
SLICE = 2 ** 16
LAYOUT = "machine", "report", "parameters", "scenes", "file", "table", "seen", \
    "lanes", "measures"


class Struct(ctypes.Structure):
    """A struct whose repr shows its fields with units; it accepts no others."""
    __slots__ = ()

    def __copy__(self):
        return type(self).from_buffer_copy(self)

    def __deepcopy__(self, _):
        return self.__copy__()

    def __reduce__(self):
        return _struct, (self.core, type(self).__name__,
                         packed(bytes(self), self.core.size))

    def __repr__(self):
        shown = []
        for name, *_ in self._fields_:
            value, unit = getattr(self, name), UNITS.get(name, "")
            if name == "mode" and value < NO_MODE:
                value = Mode(value)
            elif isinstance(value, float):
                value = f"{value:.9g}"
            shown.append(f"{name}={value} {unit}".rstrip())
        return f"{type(self).__name__}({', '.join(shown)})"


def _struct(core, name, held):
    return getattr(core, name).from_buffer_copy(unpacked(held, core.size))


class Core:
    """The core in one real type."""

    def __init__(self, suffix, real, dtype):
        self.suffix, self.real, self.dtype = suffix, real, np.dtype(dtype)
        self.path = str(Path(__file__).with_name(f"_{suffix}.so"))
        self.library = ctypes.CDLL(self.path)
        self.size = dict(zip(LAYOUT, (c_uint32 * len(LAYOUT)).in_dll(
            self.library, "twofold_layout")))
        self.columns = dict(one.split(" ", 1) for one in c_char_p.in_dll(
            self.library, "twofold_columns").value.decode().split(", "))
        self._structs()
        self._rows()
        self._functions()

    def __reduce__(self):
        return f"CORE_{self.suffix}"

    def _struct(self, reals, *others, name="Struct", first=()):
        """A struct type of the core; fields of its real type come first."""
        fields = [*first, *((one, self.real) for one in reals.split()), *others]
        return type(name, (Struct,),
                    {"__slots__": (), "core": self, "_fields_": fields})

    def _structs(self):
        self.State = self._struct("r v w phi", ("tick", c_uint64),
                                  ("seed", c_uint32), ("mode", c_uint8),
                                  name="State")
        self.Input = self._struct("omega0 r0 force torque alpha", name="Input")
        self.Row = self._struct(
            " ".join([*self.columns][1:]), ("mode", c_uint8), ("set", c_uint8),
            ("choices", c_uint8), ("status", c_int8), first=[("t", c_double)])
        Range = self._struct(
            "", ("name", c_char_p), ("unit", c_char_p), ("offset", c_uint16),
            ("laws", c_uint16), ("low", self.real), ("high", self.real))
        self.ranges = {one.name.decode(): one for one in
                       (Range * self.size["parameters"]).in_dll(
                           self.library, f"tf_parameter_ranges_{self.suffix}")}
        Measure = self._struct("", *((one, c_char_p) for one in (
            "name", "unit", "what")), ("counts", c_bool))
        self.measures = {one.name.decode(): one.unit.decode() for one in
                         (Measure * self.size["measures"]).in_dll(
                             self.library, "cli_measures")}
        self.Params = self._struct(
            " ".join(self.ranges), ("law", c_uint), ("rule", c_uint),
            ("rest", c_uint), ("with_angle", c_bool))
        self.Scene = self._struct(
            "", ("name", c_char_p), ("shows", c_char_p), ("leaves", c_char_p),
            ("params", self.Params), ("start", 4 * self.real),
            ("v_is_given", c_bool), ("t_end", self.real))
        self.Motion = self._struct(
            "", ("machine", c_char * self.size["machine"]),
            ("state", self.State), ("low", 4 * self.real),
            ("report", c_char * self.size["report"]))
        self.Run = self._struct(
            "", ("motion", POINTER(self.Motion)),
            ("scene", POINTER(self.Scene)), ("scheme", c_int))
        self.scenes = {one.contents.name.decode(): one.contents for one in
                       (POINTER(self.Scene) * self.size["scenes"]).in_dll(
                           self.library, f"tf_scenes_{self.suffix}")}

    def _dtype(self, reals, *others, lanes=()):
        """The dtype of a row, or of a block of an ensemble."""
        return np.dtype([
            *((name, self.dtype, lanes) for name in reals.split()),
            *((name, kind, lanes) for name, kind in others)], align=True)

    def _rows(self):
        mode = ("mode", "u1")
        flags = mode, ("set", "u1"), ("choices", "u1"), ("status", "i1")
        self.row = np.dtype(self.Row)
        self.fold = self._dtype(
            "r v omega g K++ K+- K-+ K-- J1 J2 eigenvalue_1 eigenvalue_2 "
            "time_scale", ("type", "u1"), ("case", "u1"))
        self.place = self._dtype("r omega lambda delassus", ("region", "u1"))
        self.state_block = self._dtype("r v w phi", ("tick", "u8"),
                                       ("seed", "u4"), mode, lanes=LANES)
        self.report_block = self._dtype("F M h g delassus residual", *flags,
                                        lanes=LANES)

    def _functions(self):
        real, any_, run = self.real, c_void_p, POINTER(self.Run)
        input_ = POINTER(self.Input)
        words = c_char_p, c_char_p, c_size_t, any_, c_size_t
        # Messages have one place: calls that hold Python's lock share it.
        locked = ctypes.PyDLL(self.path)
        for name, result, arguments in (
                ("tf_prepare_compensated", c_int,
                 (any_, any_, POINTER(c_int))),
                ("tf_input_default", self.Input, (any_,)),
                ("tf_turntable_to", None, (input_, real, real)),
                ("tf_energy", real, (any_, POINTER(self.State), real)),
                ("tf_status_name", c_char_p, (c_int,)),
                ("tf_arithmetic", c_int, ()),
                ("tf_arithmetic_name", c_char_p, (c_int,)),
                ("tf_ensemble_put", None,
                 (any_, c_size_t, POINTER(self.State))),
                ("twofold_lanes", None,
                 (run, any_, c_size_t, input_, any_, *2 * [c_uint64])),
                ("twofold_takes_law", c_int, (c_int, c_int)),
                ("twofold_begin", c_int, (run, c_uint32, any_, input_)),
                ("twofold_scene", c_int, (any_, *words)),
                ("twofold_table", c_int,
                 (any_, POINTER(self.Scene), c_bool, c_double, c_double,
                  *words)),
                ("twofold_drive", self.Input, (any_, run, any_)),
                ("twofold_free", None, (any_,)),
                ("twofold_row", self.Row, (run,)),
                ("twofold_take", c_int, (run, input_, c_uint)),
                ("twofold_folds", c_int, (run, any_, POINTER(c_int))),
                ("twofold_regions", c_int, (run, any_, c_size_t)),
                ("tf_scene_input", self.Input, (any_, any_, c_uint64)),
                ("cli_outcome_begin", None, (any_, any_, input_)),
                ("cli_outcome_end", c_int, (any_, any_, any_)),
                ("twofold_together", None, (run, any_, *3 * [c_uint64])),
                ("twofold_run", c_uint64,
                 (run, input_, any_, any_, *4 * [c_uint64], any_,
                  POINTER(c_int)))):
            function = getattr(
                locked if name in ("twofold_scene", "twofold_table") else
                self.library,
                name + f"_{self.suffix}" * name.startswith("tf_"))
            function.restype, function.argtypes = result, arguments
            setattr(self, "call_" + name.split("_", 1)[1], function)

    def check_arithmetic(self):
        """Raises where the arithmetic would change the bits. Some libraries
        that Python loads set FTZ or another rounding mode for their own
        purposes, so the mode is not corrected here."""
        found = self.call_arithmetic()
        if found:
            raise FloatingPointError("this arithmetic changes bits: " +
                                     self.call_arithmetic_name(found).decode())

    def read(self, call, *arguments):
        """Reads a text as the command line does; raises with its message."""
        self.check_arithmetic()
        *_, text = arguments
        why = ctypes.create_string_buffer(1024)
        code = call(*arguments, len(text), why, len(why))
        said = os.fsdecode(why.value)
        if code:
            raise ValueError(said)
        if said:
            warnings.warn(said.replace("note: ", ""))

    def scene(self, name, text=None):
        """The scene of that name, or of the text of a file of that name."""
        if text is None:
            return self.scenes[word("scene", name, self.scenes)]
        file = ctypes.create_string_buffer(self.size["file"])
        self.read(self.call_scene, file, os.fsencode(name), text)
        return self.Scene.from_buffer(file)

    def fail(self, status, what):
        """Raises for a negative status."""
        if status < 0:
            raise ValueError(
                f"{what}: {self.call_status_name(status).decode()}")


CORE_f64 = Core("f64", ctypes.c_double, "f8")
CORE_f32 = Core("f32", ctypes.c_float, "f4")
CORES = {"double": CORE_f64, "float": CORE_f32}
UNITS.update((name, unit) for name, unit in (
    *((name, one.unit.decode()) for name, one in CORE_f64.ranges.items()),
    *CORE_f64.measures.items(), *CORE_f64.columns.items())
    if unit not in ("", "1"))
SIZES = [[*one.size.values()] for one in CORES.values()]


def scenes() -> dict[str, str]:
    """Returns the name of each scene and what it shows."""
    return {name: scene.shows.decode()
            for name, scene in CORES["double"].scenes.items()}


def parameters() -> dict[str, tuple[str, float, float]]:
    """Returns {name: (unit, lowest value, highest value)}."""
    return {name: (one.unit.decode(), one.low, one.high)
            for name, one in CORES["double"].ranges.items()}
