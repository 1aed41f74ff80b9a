"""The core in both real types, by ctypes: functions, structs, rows."""
from __future__ import annotations

import ctypes
from ctypes import POINTER, c_bool, c_char, c_char_p, c_int, c_size_t
from ctypes import c_uint, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p
from pathlib import Path

import numpy as np

LANES = 16
NO_MODE = 5
# Steps of one call of the core; behind each, Python looks at its signals.
SLICE = 2 ** 16
LAYOUT = "machine", "report", "parameters", "scenes"
_shared = ctypes.CDLL(str(Path(__file__).with_name("_twofold.so")))


class Core:
    """The core in one real type."""

    def __init__(self, suffix, real, dtype):
        self.suffix, self.real, self.dtype = suffix, real, np.dtype(dtype)
        self.size = dict(zip(LAYOUT, (c_uint32 * len(LAYOUT)).in_dll(
            _shared, f"twofold_layout_{suffix}")))
        self._structs()
        self._rows()
        self._functions()

    def __reduce__(self):
        return f"CORE_{self.suffix}"

    def _struct(self, reals, *others):
        """A struct of the core with fields of its real type first."""
        return type("Struct", (ctypes.Structure,), {"_fields_": [
            *((name, self.real) for name in reals.split()), *others]})

    def _structs(self):
        self.State = self._struct("r v w phi", ("tick", c_uint64),
                                  ("seed", c_uint32), ("mode", c_uint8))
        self.Input = self._struct("omega0 r0 force torque alpha")
        Range = self._struct(
            "", ("name", c_char_p), ("unit", c_char_p), ("offset", c_uint16),
            ("laws", c_uint16), ("low", self.real), ("high", self.real))
        self.ranges = {one.name.decode(): one for one in
                       (Range * self.size["parameters"]).in_dll(
                           _shared, f"tf_parameter_ranges_{self.suffix}")}
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
                           _shared, f"tf_scenes_{self.suffix}")}

    def _dtype(self, reals, *others, first=(), lanes=()):
        """Of a row, or of a block of an ensemble."""
        return np.dtype([*first, *(
            (name, self.dtype, lanes) for name in reals.split()), *(
                (name, kind, lanes) for name, kind in others)], align=True)

    def _rows(self):
        mode = ("mode", "u1")
        flags = mode, ("set", "u1"), ("choices", "u1"), ("status", "i1")
        self.row = self._dtype("r v omega phi h g F M delassus", *flags,
                               first=[("t", "f8")])
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
                ("twofold_begin", c_int, (run, c_uint32, any_)),
                ("twofold_take", c_int, (run, input_, c_uint)),
                ("twofold_folds", c_int, (run, any_, POINTER(c_int))),
                ("twofold_regions", c_int, (run, any_, c_size_t)),
                ("twofold_run", c_uint64,
                 (run, input_, *4 * [c_uint64], any_, POINTER(c_int)))):
            avx2 = "_avx2" * (name == "twofold_lanes" and
                              _shared.twofold_has_avx2_f64())
            function = getattr(_shared, f"{name}{avx2}_{self.suffix}")
            function.restype, function.argtypes = result, arguments
            setattr(self, "call_" + name.split("_", 1)[1], function)

    def check_arithmetic(self):
        """Raises where the bits would be others: some libraries that Python
        loads set FTZ or another rounding mode, for their own purposes, so it is
        left as it is."""
        found = self.call_arithmetic()
        if found:
            raise FloatingPointError("the bits would be others: " +
                                     self.call_arithmetic_name(found).decode())

    def fail(self, status, what):
        """Raises for a negative status."""
        if status < 0:
            raise ValueError(
                f"{what}: {self.call_status_name(status).decode()}")


CORE_f64 = Core("f64", ctypes.c_double, "f8")
CORE_f32 = Core("f32", ctypes.c_float, "f4")
CORES = {"double": CORE_f64, "float": CORE_f32}


def scenes() -> dict[str, str]:
    """Name of each scene, and what it shows."""
    return {name: scene.shows.decode()
            for name, scene in CORES["double"].scenes.items()}


def parameters() -> dict[str, tuple[str, float, float]]:
    """Name of each parameter: (unit, lowest, highest value)."""
    return {name: (one.unit.decode(), one.low, one.high)
            for name, one in CORES["double"].ranges.items()}
