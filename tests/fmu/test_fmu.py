#!/usr/bin/python3 -B
"""The FMUs of all scenes under an own importer.

usage: test_fmu.py [WORD]...     tests whose names contain one of the words

BUILD is the folder with fmu/SCENE/twofold.fmu and double/twofold, which
`make test-fmu` makes."""
import inspect
import os
import sys

import test_archive
import test_calls
from importer import (BUILD, COMMAND, DT, MODES, ROOT, Fmu, row_of, rows,
                      same_bits)
from tap import check, output, run

SCENES = [line.split()[0] for line in
          output(COMMAND, "scenes", text=True).splitlines()]


def instance(version, scene="chaos", **options):
    return Fmu(version, scene).instance(**options)


def test_scenes_have_the_bits_of_the_command_line(fmu):
    for scene in SCENES:
        expected = rows(scene, "--t-end", "12", "--every", "25")
        wheel = instance(fmu.version, scene).begin()
        same_bits(wheel, expected, 25)
        listed = wheel.fmu.home / "documentation/twofold_ref.csv"
        got = listed.read_text().splitlines()[101].split(",")
        row = expected[400]
        modes = int(got.pop())  # the bits of `set`
        check([*map(float, got)] == [*row[:8], MODES.index(row[8]), row[9]]
              and modes.bit_count() == row[9], f"reference: {got}, {modes}")


def test_from_a_file():
    """A scene from a file, with what only a file can change: the law of rest,
    the profile and the length."""
    file = "tests/data/own.scene"
    test_archive.make_fmu(file, BUILD)
    expected = rows(ROOT / file, "--every", "25")
    check(expected[-1][0] == 2, "length")
    for version in "23":
        same_bits(instance(version, "own.scene").begin(), expected, 25)


def test_settings(fmu):
    """Options of the command line, and the same values of the FMU."""
    cases = [
        ("chaos", ["--set", "kappa=0.3", "--set", "h=0", "--set", "r0=0.12"],
         {"kappa": 0.3, "start_h": 0, "r0": 0.12}),
        ("chaos", ["--select", "random:7"], {"rule": 3, "seed": 7}),
        ("chaos", ["--scheme", "located", "--set", "tolerance=1e-10"],
         {"scheme": 1, "tolerance": 1e-10}),
        ("chaos", ["--set", "law=smooth", "--set", "epsilon=1e-4"],
         {"law": 4}),
        ("chaos", ["--set", "law=string", "--set", "k=1", "--set", "delta=1",
                   "--set", "sigma=1", "--set", "a=1", "--set",
                   "rho=0.66666666666666667"], {"law": 3}),
        ("gamma_zero", ["--set", "v=0.2", "--set", "phi=2"],
         {"start_v": 0.2, "start_phi": 2}),
        ("driven", ["--scheme", "located"], {"scheme": 1})]
    for scene, options, values in cases:
        expected = rows(scene, "--t-end", "2.5", "--every", "10", *options)
        same_bits(instance(fmu.version, scene).begin(**values), expected, 10)


def test_other_step(fmu):
    """A dt that is no decimal, and a start time at which time is coarse."""
    dt = 1 / 60 / 64
    expected = rows("chaos", "--t-end", "3", "--dt", repr(dt), "--every", "64")
    wheel = fmu.instance().begin(start=1e5, dt=dt)
    time = 1e5
    for i, row in enumerate(expected):
        if i > 0:
            wheel.step(time, 0.016666666666666677)
            time += 0.016666666666666677
        check(row_of(wheel)[1:] == row[1:], f"row {i}")


def changes(expected):
    """(tick, mode, choices) of the rows in which mode or choices change."""
    return [(i, *row[-2:]) for i, row in enumerate(expected)
            if i > 0 and row[-2:] != expected[i - 1][-2:]]


def test_events_in_order():
    """Every change is an event of its own, at its tick, and no other but a
    change of the set of the same size."""
    expected = rows("chaos", "--t-end", "3")
    wheel = instance("3", events=True, early=True).begin()
    events, others, time, last_set = [], 0, 0.0, wheel.get("set")
    while wheel.get("tick") < 30000:
        event, early, time = wheel.step(time, 3 - time)
        tick = wheel.get("tick")
        check(early == (tick < 30000), "early return")
        check(time == tick * DT, "time reached")
        if event:
            wheel.handle_event()
            check(wheel.get("event_time") == time, "event_time")
            row = (tick, MODES[wheel.get("mode")], wheel.get("choices"))
            if row[1:] == tuple(expected[tick - 1][-2:]):
                check(wheel.get("set") != last_set, f"nothing changed: {row}")
                others += 1
            else:
                events.append(row)
        last_set = wheel.get("set")
    check(events == changes(expected), "other events than the command line")
    check(len(events) > 20, "hardly any events")
    check(wheel.get("events") == len(events) + others, "count")
    for same in (instance("3", events=True).begin(), instance("2").begin()):
        check(same.step(0.0, 3.0)[1:] == (False, 3.0), "an early return")
        check(row_of(same) == row_of(wheel), "events change the motion")
        check(same.get("events") == wheel.get("events"), "count")


def test_restored(fmu):
    """A state restores bit for bit, in another instance, and from bytes."""
    one = fmu.instance().begin(rule=3, seed=5)
    one.step(0.0, 1.9)
    handle = one.copy()
    data = one.serialize(handle)
    one.step(1.9, 0.8)
    expected = row_of(one)
    other = instance(fmu.version)  # of another binary
    read = other.deserialize(data)
    check(other.serialize(read) == data, "bytes of bytes")
    for again, at in ((one, handle), (fmu.instance(), handle), (other, read)):
        again.restore(at)
        again.step(1.9, 0.8)
        check(row_of(again) == expected, f"{again} from {at}")
    one.copy(handle)
    one.free_copy(handle)
    check(not handle.value, "freed handle")


def test_futures(fmu):
    """From one point with a choice the importer takes every open mode, under
    FMI 3 in event mode."""
    events = {"events": True} if fmu.version == "3" else {}
    wheel = fmu.instance(**events).begin(start_h=0.0, start_omega=-1.02)
    time = wheel.step(0.0, DT)[2]
    if events:
        wheel.call("EnterEventMode")
    modes = [m for m in range(5) if wheel.get("set") >> m & 1]
    check(len(modes) == 3, f"open: {modes}")
    before, ends = wheel.copy(), {}
    for mode in modes:
        wheel.restore(before)
        wheel.set("take", mode)
        wheel.to_step_mode()
        wheel.step(time, DT)
        check(wheel.get("mode") == mode, f"took {wheel.get('mode')}")
        wheel.step(time + DT, 0.5)
        ends[mode] = tuple(wheel.reals(["r", "v", "omega"]))
    check(len(set(ends.values())) == 3, f"futures: {ends}")


def tests():
    """One of an `fmu` is a test under each version."""
    for name, test in (one for room in (sys.modules[__name__], test_calls,
                                        test_archive)
                       for one in vars(room).items()):
        if name.startswith("test_") and inspect.isfunction(test):
            if not inspect.signature(test).parameters:
                yield name[5:], test
                continue
            for version in "23":
                yield (f"{name[5:]}_under_fmi_{version}",
                       lambda t=test, v=version: t(Fmu(v)))


if __name__ == "__main__":
    sys.exit(run([*tests()], jobs=len(os.sched_getaffinity(0))))
