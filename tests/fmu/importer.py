"""An importer of FMUs for co-simulation, FMI 2.0 and 3.0, of the standard
library alone: reads the model description, loads the binary, and calls its
functions. Two classes of one interface, so that a test runs under both. And
the command line, whose rows an FMU has."""
import csv
import ctypes
import os
import sys
import tempfile
import xml.etree.ElementTree as ET
import zipfile
from collections import namedtuple
from ctypes import (byref, c_bool, c_char_p, c_double, c_int,
                    c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p)
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "support"))
from tap import call, check  # noqa: E402

BUILD = (ROOT / os.environ.get("BUILD", "build")).resolve()
COMMAND = BUILD / "double" / "twofold"
COLUMNS = ["time", "r", "v", "omega", "h", "g", "F", "M"]
DT = 1e-4
OK, WARNING, DISCARD, ERROR = range(4)
MODES = ["slip+", "slip-", "stick+", "stick-", "pinned"]
NAMES = ["ok", "warning", "discard", "error", "fatal"]
TYPES3 = {"Float64": c_double, "Int32": c_int32, "UInt32": c_uint32,
          "UInt64": c_uint64, "Enumeration": c_int64, "Boolean": c_bool}
TYPES2 = {"Real": c_double, "Integer": c_int, "Enumeration": c_int,
          "Boolean": c_int}


class Refused(Exception):
    """A call that did not return ok. status: its number; text: what the FMU
    logged meanwhile."""

    def __init__(self, call, status, text):
        super().__init__(f"{call}: {NAMES[status]}: {text}")
        self.status, self.text = status, text


Variable = namedtuple("Variable", "reference kind attributes")


class Fmu:
    """An unpacked FMU with its binary loaded. A copy of its own is loaded for
    each object, so that the pools of two objects are two."""

    def __init__(self, version, scene="chaos", binary=None):
        self.archive = BUILD / "fmu" / scene / (
            "twofold.fmu" if version == "3" else "twofold-fmi2.fmu")
        # In the folder of the test, which goes with it.
        self.home = Path(tempfile.mkdtemp(prefix="fmu.", dir=Path.cwd()))
        with zipfile.ZipFile(self.archive) as files:
            files.extractall(self.home)
        self.root = ET.parse(self.home / "modelDescription.xml").getroot()
        self.version = self.root.get("fmiVersion")[0]
        self.variables = dict(self.read_variables())
        self.refusal = ERROR if self.version == "2" else DISCARD  # of a step
        library = binary or self.home / (
            "binaries/linux64/twofold.so" if self.version == "2"
            else "binaries/x86_64-linux/twofold.so")
        self.library = ctypes.CDLL(str(library))
        self.token = self.root.get(
            "guid" if self.version == "2" else "instantiationToken")

    def read_variables(self):
        for element in self.root.find("ModelVariables"):
            value = element[0] if self.version == "2" else element
            yield element.get("name"), Variable(
                int(element.get("valueReference")), value.tag,
                {**element.attrib, **value.attrib})

    def instance(self, **options):
        kind = Instance2 if self.version == "2" else Instance3
        return kind(self, **options)


class Instance:
    """What the two versions share. log: (status, category, text)."""
    prefix = types = None

    def __init__(self, fmu, token=None, logging=True, **options):
        self.fmu, self.log = fmu, []
        self.address = self.instantiate(token or fmu.token, logging, **options)
        if not self.address:
            raise Refused("instantiate", ERROR, self.last_text())

    def last_text(self):
        return self.log[-1][2] if self.log else ""

    def call(self, name, *arguments):
        before = len(self.log)
        status = self.function(name)(c_void_p(self.address), *arguments)
        if status != OK:
            texts = [text for _, _, text in self.log[before:]]
            raise Refused(name, status, "; ".join(texts))

    def function(self, name, result=c_int):
        function = getattr(self.fmu.library, self.prefix + name)
        function.restype = result
        return function

    def access(self, verb, name, value=0):
        variable = self.fmu.variables[name]
        type_c = self.types[variable.kind]
        kind = {"Enumeration": self.enumeration}.get(variable.kind,
                                                     variable.kind)
        values = (type_c * 1)(value)
        self.call(verb + kind, (c_uint32 * 1)(variable.reference), c_size_t(1),
                  values, *self.count(1))
        return values[0]

    def get(self, name):
        return self.access("Get", name)

    def set(self, name, value):
        self.access("Set", name, value)

    def reals(self, names):
        """Several real variables in one call."""
        n = len(names)
        references = (c_uint32 * n)(
            *(self.fmu.variables[name].reference for name in names))
        values = (c_double * n)()
        self.call("Get" + self.real, references, c_size_t(n), values,
                  *self.count(n))
        return list(values)

    def copy(self, handle=None):
        handle = handle or c_void_p()
        self.call(f"Get{self.state}", byref(handle))
        return handle

    def restore(self, handle):
        self.call(f"Set{self.state}", handle)

    def free_copy(self, handle):
        self.call(f"Free{self.state}", byref(handle))

    def serialize(self, handle):
        size = c_size_t()
        self.call(f"Serialized{self.state}Size", handle, byref(size))
        data = (ctypes.c_ubyte * size.value)()
        self.call(f"Serialize{self.state}", handle, data, size)
        return bytes(data)

    def deserialize(self, data):
        handle = c_void_p()
        self.call(f"{self.un_serialize}{self.state}",
                  (ctypes.c_ubyte * len(data))(*data), c_size_t(len(data)),
                  byref(handle))
        return handle

    def begin(self, start=0.0, stop=None, **values):
        """Sets values (start_h for start.h) and begins the motion."""
        for name, value in values.items():
            self.set(name.replace("start_", "start."), value)
        self.initialize(start, stop)
        self.call("ExitInitializationMode")
        self.to_step_mode()
        return self

    def free(self):
        self.function("FreeInstance", None)(c_void_p(self.address))


class Instance3(Instance):
    prefix, types, enumeration = "fmi3", TYPES3, "Int64"
    real, state, un_serialize = "Float64", "FMUState", "Deserialize"

    def instantiate(self, token, logging, events=False, early=False):
        log_t = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
        self.logger = log_t(lambda _, status, category, text: self.log.append(
            (status, category.decode(), text.decode())))
        self.events = events
        return self.function("InstantiateCoSimulation", c_void_p)(
            b"wheel", token.encode(), None, c_bool(False), c_bool(logging),
            c_bool(events), c_bool(early), None, c_size_t(0), None,
            self.logger, None)

    def count(self, n):
        return (c_size_t(n),)

    def initialize(self, start, stop):
        self.call("EnterInitializationMode", c_bool(False), c_double(0),
                  c_double(start), c_bool(stop is not None),
                  c_double(stop or 0))

    def to_step_mode(self):
        if self.events:
            self.call("EnterStepMode")

    def step(self, time, length):
        """Returns event, early, time reached."""
        event, ends, early = c_bool(), c_bool(), c_bool()
        last = c_double()
        self.call("DoStep", c_double(time), c_double(length), c_bool(True),
                  byref(event), byref(ends), byref(early), byref(last))
        return event.value, early.value, last.value

    def handle_event(self):
        flags = [c_bool() for _ in range(5)]
        self.call("EnterEventMode")
        self.call("UpdateDiscreteStates", *map(byref, flags),
                  byref(c_double()))
        self.call("EnterStepMode")


class Instance2(Instance):
    prefix, types, enumeration = "fmi2", TYPES2, "Integer"
    real, state, un_serialize = "Real", "FMUstate", "DeSerialize"

    def instantiate(self, token, logging):
        log_t = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p,
                                 c_char_p, c_char_p)
        # A text that is no format itself is the argument of "%s".
        self.logger = log_t(
            lambda _, name, status, kind, form, text: self.log.append(
                (status, kind.decode(), form.replace(b"%s", text).decode())))
        self.callbacks = (c_void_p * 5)(
            ctypes.cast(self.logger, c_void_p), None, None, None, None)
        return self.function("Instantiate", c_void_p)(
            b"wheel", c_int(1), token.encode(), b"", self.callbacks, c_int(0),
            c_int(logging))

    def count(self, n):
        return ()

    def initialize(self, start, stop):
        self.call("SetupExperiment", c_int(0), c_double(0), c_double(start),
                  c_int(stop is not None), c_double(stop or 0))
        self.call("EnterInitializationMode")

    def to_step_mode(self):
        pass

    def step(self, time, length):
        self.call("DoStep", c_double(time), c_double(length), c_int(1))
        return False, False, time + length


def rows(scene, *options):
    """What the command line computes."""
    out = call("run", scene, *options, code=(0, 5), program=COMMAND)[0]
    return [[float(row[k.replace("time", "t")]) for k in COLUMNS]
            + [row["mode"], int(row["choices"])]
            for row in csv.DictReader(out.splitlines())]


def row_of(wheel):
    return wheel.reals(COLUMNS) + [MODES[wheel.get("mode")],
                                   wheel.get("choices")]


def same_bits(wheel, expected, every):
    """Steps an instance along the rows of the command line."""
    for i, row in enumerate(expected):
        if i > 0:
            wheel.step((i - 1) * every * DT, every * DT)
        got = row_of(wheel)
        check(got == row, f"row {i}: {got} is not {row}")
    check(len(expected) > 10, "no rows")


def refused(status, words, function, *arguments):
    """Calls what has to be refused, with all the words in the message."""
    try:
        function(*arguments)
    except Refused as refusal:
        check(refusal.status == status, f"status of {refusal}")
        for word in words.split("|"):
            check(word in refusal.text, f"no '{word}' in: {refusal.text}")
        return
    raise AssertionError(f"not refused: {words}")
