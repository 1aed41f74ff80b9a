"""Wrong calls: each is refused, by a message that names what is wrong, and
leaves the instance as it was."""
import ctypes
import random
import re
from ctypes import byref, c_bool, c_double, c_int, c_size_t, c_uint32, c_void_p

from numpy import interp

from importer import DISCARD, ERROR, MODES, Fmu, Refused, refused
from tap import check


def raw(wheel, verb, kind, reference, value=0.0, type_c=c_double):
    wheel.call(verb + kind, (c_uint32 * 1)(reference), c_size_t(1),
               (type_c * 1)(value), *wheel.count(1))


def test_bad_values(fmu):
    wheel = fmu.instance()
    refused(DISCARD, "kappa = -1|[1e-09, 1000000] m", wheel.set, "kappa", -1)
    refused(DISCARD, "mu = nan", wheel.set, "mu", float("nan"))
    refused(DISCARD, "m = inf", wheel.set, "m", float("inf"))
    refused(DISCARD, "law = 6|[0, 5]", wheel.set, "law", 6)
    refused(DISCARD, "take = slip+|before the motion", wheel.set, "take", 0)
    refused(ERROR, "choices is an output", wheel.set, "choices", 1)
    for name, value in (("kappa", 0.2724115371406203), ("theta", 0.5),
                        ("law", 0), ("take", 5)):
        check(wheel.get(name) == value, f"{name} was set all the same")
    for name, variable in fmu.variables.items():
        bounds = variable.attributes
        if "max" in bounds and variable.kind in ("Float64", "Real"):
            wheel.set(name, float(bounds["max"]))
            wheel.set(name, float(bounds["min"]))
            above = float(bounds["max"]) * (1 + 1e-15)
            refused(DISCARD, f"{name} = ", wheel.set, name, above)
    # Of several values none is set where one is refused.
    wheel = fmu.instance()
    names = ("kappa", "mu")
    references = (c_uint32 * 2)(*(fmu.variables[n].reference for n in names))
    refused(DISCARD, "mu = -1", wheel.call, "Set" + wheel.real, references,
            c_size_t(2), (c_double * 2)(0.5, -1), *wheel.count(2))
    check(wheel.get("kappa") != 0.5, "half of a refused call")


def test_bad_combinations(fmu):
    for values, words in (
            ({"scheme": 1, "law": 4}, "scheme = located|law"),
            ({"gamma": 0}, "start.h|sin(gamma)|start.from_h"),
            ({"follow_profile": 1}, "follow_profile|no profile"),
            ({"start_r": 9e8, "start_omega": 9e8}, "out of range")):
        wheel = fmu.instance()
        refused(DISCARD, words, lambda w=wheel, v=values: w.begin(**v))
        for name, value in (("law", 0), ("gamma", 1), ("follow_profile", 0),
                            ("start.r", 0.1), ("start.omega", -1)):
            wheel.set(name, value)
        wheel.call("ExitInitializationMode")  # the importer may correct it


def test_wrong_references(fmu):
    wheel = fmu.instance().begin()
    real = wheel.real
    for reference in (64, 65, 100, 4000000000):
        refused(ERROR, f"value reference {reference}", raw, wheel, "Get", real,
                reference)
    refused(ERROR, f"{real} variable|44", raw, wheel, "Get", real, 44)
    refused(ERROR, "Boolean variable", raw, wheel, "Set", "Boolean", 1, 1,
            c_bool if fmu.version == "3" else c_int)
    refused(ERROR, "String variable", raw, wheel, "Get", "String", 1, None,
            c_void_p)
    refused(ERROR, "NULL", wheel.call, "Get" + real,
            None, c_size_t(1), None, *wheel.count(1))
    raw(wheel, "Get", real, 1)


def test_wrong_order(fmu):
    wheel = fmu.instance()
    refused(ERROR, "DoStep|before Initialization|allowed in Step Mode",
            wheel.step, 0.0, 1e-4)
    refused(ERROR, "ExitInitializationMode|not allowed", wheel.call,
            "ExitInitializationMode")
    refused(ERROR, "Terminate|not allowed", wheel.call, "Terminate")
    refused(ERROR, "not known before", wheel.get, "r")
    wheel.initialize(0.0, 1.0)
    check(wheel.get("r") == 0.18, "outputs in Initialization Mode")
    wheel.set("start.r", 0.19)
    check(wheel.get("r") == 0.19, "outputs follow the start")
    wheel.set("start.r", 0.18)
    refused(ERROR, "in Initialization Mode", wheel.initialize, 0.0, None)
    refused(ERROR, "in Initialization Mode", wheel.step, 0.0, 1e-4)
    wheel.call("ExitInitializationMode")
    wheel.to_step_mode()
    refused(ERROR, "kappa is a fixed parameter", wheel.set, "kappa", 0.3)
    wheel.step(0.0, 1e-4)
    wheel.call("Terminate")
    check(wheel.get("tick") == 1, "outputs after the end")
    refused(ERROR, "after the end", wheel.step, 1e-4, 1e-4)
    refused(ERROR, "after the end", wheel.set, "force", 1)
    wheel.call("Reset")
    wheel.begin().step(0.0, 1e-4)
    wheel.free()
    refused(ERROR, "", wheel.get, "r")  # it is gone: there is no logger
    wheel.free()


def test_wrong_modes():
    fmu = Fmu("3")
    wheel = fmu.instance().begin()
    refused(ERROR, "without event mode", wheel.call, "EnterEventMode")
    wheel = fmu.instance(events=True).begin()
    flags = [byref(c_bool()) for _ in range(5)]
    refused(ERROR, "UpdateDiscreteStates|in Step Mode", wheel.call,
            "UpdateDiscreteStates", *flags, byref(c_double()))
    wheel.call("EnterEventMode")
    refused(ERROR, "DoStep|in Event Mode", wheel.step, 0.0, 1e-4)
    for name in ("EnterConfigurationMode", "EnterContinuousTimeMode"):
        refused(ERROR, f"{name}|co-simulation", wheel.call, name)
    refused(ERROR, "values and of value references", wheel.call, "GetFloat64",
            (c_uint32 * 1)(1), c_size_t(1), (c_double * 1)(), c_size_t(2))


def test_wrong_times(fmu):
    wheel = fmu.instance().begin(stop=1.0)
    for length in (0.00015, 1e-4 * (1 + 1e-5), 1e-9, 3.3e-5):
        refused(fmu.refusal, "communicationStepSize|dt = 0.0001|the nearest is",
                wheel.step, 0.0, length)
    for length in (0.0, -1e-4, float("nan"), float("inf")):
        refused(ERROR, "communicationStepSize", wheel.step, 0.0, length)
    for time in (5e-5, -1e-4, 1e-4, float("nan")):
        refused(ERROR, "currentCommunicationPoint", wheel.step, time, 1e-4)
    refused(ERROR, "stopTime", wheel.step, 0.0, 1.1)
    check(wheel.get("tick") == 0, "a refused step moved")
    # The importer's time may carry rounding, but must not drift.
    wheel = fmu.instance().begin()
    refused(fmu.refusal, "= 123456.00005 s|is 123456.0001 s", wheel.step, 0.0,
            123456.00005)
    wheel.step(0.0, 1e-4)
    wheel.step(1.09e-4, 1e-4)
    refused(ERROR, "currentCommunicationPoint", wheel.step, 2.11e-4, 1e-4)


def test_refused_steps(fmu):
    """A communication step that the core refuses leaves the state before it."""
    wheel = fmu.instance().begin(c2=0, k2=0)
    wheel.step(0.0, 0.01)
    names = ["r", "v", "omega", "h", "F", "energy", "turntable"]
    before = wheel.reals(names), wheel.get("tick"), 1
    wheel.set("force", 9e8)
    refused(fmu.refusal, "the step from t = |range of states", wheel.step,
            0.01, 1000.0)
    check((wheel.reals(names), wheel.get("tick"), wheel.get("refused"))
          == before, "state")
    wheel.set("force", 0)
    wheel.step(0.01, 0.01)


def test_wrong_arithmetic(fmu):
    """Another rounding mode of the importer is refused, and left as it is."""
    libm, upward = ctypes.CDLL("libm.so.6"), 0x800  # on x86
    new, wheel = fmu.instance(), fmu.instance().begin()
    wheel.step(0.0, 0.01)
    try:
        libm.fesetround(upward)
        refused(ERROR, "to nearest|fesetround", fmu.instance)
        refused(DISCARD, "to nearest", new.begin)
        refused(ERROR, "to nearest", wheel.step, 0.01, 0.01)
        check(libm.fegetround() == upward, "the mode of the importer is lost")
    finally:
        libm.fesetround(0)
    wheel.step(0.01, 0.01)
    check(wheel.get("tick") == 200, "the refused step has moved the unit")


def test_wrong_takes(fmu):
    """What a refusal calls open is what the next step takes."""
    at_rest = {"start_r": 0.17986265324413, "start_omega": -1, "start_h": 0}
    for tick in (0, 95, 96, 214, 381):  # where `set` has modes that are past
        wheel = fmu.instance().begin(**({} if tick else at_rest))
        said, taken = set(), []
        if tick:
            wheel.step(0.0, tick * 1e-4)
        before = wheel.copy()
        for mode, name in enumerate(MODES):
            wheel.restore(before)
            try:
                wheel.set("take", mode)
            except Refused as refusal:
                said.add(refusal.text.split("open in the next step: ")[1])
            else:
                wheel.step(tick * 1e-4, 1e-4)
                check(wheel.get("mode") == mode, f"{name} is not taken")
                taken.append(name)
        check(said == {", ".join(taken)}, f"{said}, but {taken}")
        wheel.restore(before)
        wheel.step(tick * 1e-4, 1e-4)
        check(len(taken) == wheel.get("choices"), f"{tick}: {taken}")
    # Open after the last step, but not under the inputs of the next one.
    wheel = fmu.instance().begin(start_h=0, start_omega=-1.02)
    wheel.step(0.0, 1e-4)
    wheel.set("take", 2)
    wheel.set("force", 1e3)
    refused(fmu.refusal, "take = stick+ is not open|in the next step: slip",
            wheel.step, 1e-4, 1e-4)
    check(wheel.get("tick") == 1, "a refused step moved")


def test_driven_inputs(fmu):
    """The turntable follows the profile until the importer moves it, or starts
    it otherwise; what it then does is what it does without a profile."""
    fmu = Fmu(fmu.version, "driven")
    names = ["turntable", "r", "v", "h", "F"]
    wheel, moved = (fmu.instance().begin(omega0=w, alpha=0) for w in (-1, -.5))
    free = fmu.instance().begin(follow_profile=0, omega0=-0.5)
    wheel.step(0.0, 1.5)
    check(wheel.get("turntable") == -1.75, "the profile")
    for time in (0.0, 1e-4):
        check(moved.reals(names) == free.reals(names), "motion")
        moved.step(time, 1e-4)
        free.step(time, 1e-4)
    check(moved.get("turntable") == -0.5, "the input at the start")
    wheel.set("omega0", -1)
    wheel.step(1.5, 1e-4)
    check(wheel.get("turntable") == -1, "the input in motion")


def test_start_time(fmu):
    """The profile and event_time are in the importer's time, the motion is not:
    without a profile it does not depend on when it starts."""
    fmu = Fmu(fmu.version, "driven")
    profile = [[0, 2, 4, 8, 10], [-1, -2, -2, 1, 0]]
    for start in (-1.0, 0.0, 1.0, 5.0, 7.5, 20.0):
        wheel, ends = fmu.instance().begin(start=start), []
        for time in [start + 0.25 * i for i in range(17)]:
            ends.append((wheel.get("turntable"), interp(time, *profile)))
            seen = wheel.get("events")
            wheel.step(time, 0.25)
            last = wheel.get("event_time")
            check(seen == wheel.get("events") or time < last <= time + 0.25,
                  f"event_time {last} in a step from {time}")
        check(max(abs(a - b) for a, b in ends) < 1e-9, f"{start}: {ends}")
        check(wheel.get("events") > 0, "no event")
    ends = []
    for start in (0.0, 5.0):
        wheel = fmu.instance().begin(start=start, follow_profile=0)
        wheel.step(start, 1.0)
        ends.append(wheel.reals(["r", "v", "omega"]))
    check(ends[0] == ends[1], "the motion depends on its start")


def test_moved_turntable(fmu):
    """A communication step of eight steps moves the turntable as eight of one
    step do, and not as steps under a speed that stands. Numbers are sums of
    powers of two."""
    dt, slope, ends = 2.0 ** -10, 0.25, []
    for length, alpha in ((1, slope), (8, slope), (8, 0.0)):
        wheel = fmu.instance().begin(dt=dt, scheme=1)
        for n in range(0, 256, length):
            wheel.set("omega0", -1 + slope * dt * (n + length))
            wheel.set("alpha", alpha)
            wheel.step(n * dt, length * dt)
        ends.append(wheel.reals(["r", "v", "omega", "h", "g"]))
        wheel.free()
    check(ends[0] == ends[1], f"{ends[:2]}")
    check(ends[0] != ends[2], "alpha makes no difference")


def test_limits(fmu):
    refused(ERROR, "token|" + fmu.token, lambda: fmu.instance(token="{0}"))
    wheels = [fmu.instance() for _ in range(16)]
    refused(ERROR, "16 instances|FMU_INSTANCES", fmu.instance)
    wheels.pop().free()
    wheels.append(fmu.instance())
    wheel = wheels[0].begin()
    handles = [wheel.copy() for _ in range(256)]
    refused(ERROR, "256 states|FMU_COPIES", wheel.copy)
    data = wheel.serialize(handles[0])
    wheel.free_copy(handles.pop())
    handles.append(wheel.copy())
    for handle in handles:
        wheel.free_copy(handle)
    refused(ERROR, "not a state", wheel.restore, c_void_p(12345))
    refused(ERROR, "not a state", wheel.restore, c_void_p(None))
    for other in (data[:-1], data + b"\0", data + data):
        refused(ERROR, f"{len(other)} bytes; a state of this FMU has "
                f"{len(data)}", wheel.deserialize, other)
    for i in (0, 9, 17, 40, len(data) - 1):
        bad = bytearray(data)
        bad[i] ^= 1
        refused(ERROR, "not a state of this FMU", wheel.deserialize, bad)


def test_events_within_a_step(fmu):
    """Under scheme located each counts and is told with its time."""
    counts = []
    for dt in 0.7, 0.1:
        fmu = Fmu(fmu.version, "coulomb")
        wheel = fmu.instance(logging=True).begin(scheme=1, dt=dt)
        for n in range(round(1.4 / dt)):
            wheel.step(n * dt, dt)
        counts.append(wheel.get("events"))
    check(counts == [3, 3], f"{counts}")


def test_numbers_in_messages(fmu):
    """A message has the number that was given, with all its digits."""
    draw, wheel = random.Random(1), fmu.instance()
    values = [1e300, 1e23, 5e-324, 1 / 3] + [
        10 ** draw.uniform(-300, 300) for _ in range(200)]
    for value in values:
        refused(DISCARD, "kappa = -", wheel.set, "kappa", -value)
        told = re.search("kappa = (.*) must lie", wheel.last_text())[1]
        check(float(told) == -value and len(told) < 25, f"{value}: {told}")


def test_logging(fmu):
    """Refusals are told without logging, events only with it; of categories
    that are switched off only errors come."""
    wheel = fmu.instance(logging=False).begin()
    refused(DISCARD, "force = 1e+20", wheel.set, "force", 1e20)
    wheel.step(0.0, 0.3)
    check(wheel.get("events") > 0 and len(wheel.log) == 1, "an event is told")
    names = (ctypes.c_char_p * 1)(b"logEvents")
    wheel.call("SetDebugLogging", c_int(1), c_size_t(1), names)
    wheel.step(0.3, 3.0)
    check({entry[1] for entry in wheel.log[1:]} == {"logEvents"}, "no event")
    names[0] = b"log%All"
    wheel.call("SetDebugLogging", c_int(0), c_size_t(0), None)
    refused(DISCARD, "", wheel.set, "force", 1e20)
    check("force" not in wheel.last_text(), "a category that is off")
    refused(ERROR, "log%All", wheel.call, "SetDebugLogging", c_int(1),
            c_size_t(1), names)
