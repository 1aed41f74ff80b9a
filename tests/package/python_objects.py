"""Objects of the Python package as users handle them: threads and signals,
pickles, words, tables, pictures: python_objects.py FOLDER, an empty one. Run by
in_python.py, where the package is installed."""
import contextlib
import copy
import ctypes
import io
import pickle
import signal
import subprocess
import sys
import threading
import warnings
import zlib
from pathlib import Path

import matplotlib
import numpy as np
import pandas

import twofold
from twofold import Ensemble, Machine, Mode, _check, _core, _table

matplotlib.use("agg")
PLACE = Path(sys.argv[1])
OWN = str(Path(__file__).parents[1] / "data/own.scene")


def refusal(kind, call, *arguments):
    """What it says."""
    try:
        call(*arguments)
    except kind as error:
        return str(error)
    raise AssertionError(f"{call} is taken")


def bits(held):
    """All that its future depends on."""
    return bytes(held._motion) + bytes(held._params) if isinstance(
        held, Machine) else held.states.tobytes() + held.reports.tobytes()


def entries(machine, ensemble):
    """All methods that compute, or copy, by the object that they belong to."""
    return {machine: [machine.start, lambda: machine.place(0.1, -1, v=0),
                      machine.copy, lambda: machine.run(0), machine.step,
                      machine.futures, machine.two_folds,
                      lambda: machine.regions(0.1, -1),
                      lambda: pickle.dumps(machine),
                      lambda: copy.copy(machine)],
            ensemble: [ensemble.step, lambda: pickle.dumps(ensemble)]}


def enters_once():
    """While one method runs, no other of the same object is entered, by a
    thread or by what a signal calls; what it computes is as if none had
    tried."""
    machine = Machine("chaos", h=0)
    ensemble = Ensemble(machine, [0.1, 0.2], -1, v=0)
    slices, _core.SLICE = _core.SLICE, 512
    work = {machine: lambda: machine.run(3.0), ensemble: lambda:
            ensemble.step(40000)}
    alone = machine.copy(), pickle.loads(pickle.dumps(ensemble))
    alone[0].run(3.0)
    alone[1].step(40000)
    for one, calls in entries(machine, ensemble).items():
        said, begun = [], threading.Event()

        def others(*_):
            begun.set()
            said.extend(refusal(RuntimeError, call) for call in calls)

        signal.signal(signal.SIGALRM, others)
        signal.setitimer(signal.ITIMER_REAL, 1e-3)
        work[one]()
        assert begun.wait(10)
        assert len(said) == len(calls)
        assert all("is busy" in text for text in said)
    assert bits(machine) == bits(alone[0]) and bits(ensemble) == bits(alone[1])
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    with contextlib.suppress(KeyboardInterrupt):
        machine.run(1e9, 10 ** 12)
    thread = threading.Thread(target=machine.run, args=(20.0,))
    thread.start()
    while thread.is_alive() and machine._free:
        pass
    refused = thread.is_alive() and refusal(RuntimeError, machine.start)
    thread.join()
    assert refused is not False and machine.start() is None
    _core.SLICE = slices


def pickles_are_whole():
    """With one turned bit a pickle raises, or is the same object."""
    machine = Machine(OWN, real="float", seed=7)
    machine.run(0.1)
    for held in (machine, Ensemble(Machine(), [0.1, 0.2], -1, v=0)):
        data = pickle.dumps(held)
        same = pickle.loads(data)
        assert bits(same) == bits(held) and repr(same) == repr(held)
        same.step(3)
        assert bits(same) != bits(held)
        for at in range(0, 8 * len(data), 8 * len(data) // 250):
            bad = bytearray(data)
            bad[at // 8] ^= 1 << at % 8
            try:
                got = pickle.loads(bad)
            except Exception:  # pylint: disable=broad-except
                continue
            assert type(got) is type(held) and bits(got) == bits(held), at
        _check.VERSION = "9.9.9"
        other = pickle.dumps(held)
        _check.VERSION = twofold.__version__
        assert "by twofold 9.9.9" in refusal(pickle.UnpicklingError,
                                             pickle.loads, other)
        assert "older" in refusal(pickle.UnpicklingError, held.__setstate__,
                                    dict(held.__dict__))


def copies_are_whole():
    """Of tables, states and inputs."""
    machine = Machine("chaos", real="float")
    rows = machine.run(0.01)
    for held in rows, machine.state, machine.input():
        for same in (copy.copy(held), copy.deepcopy(held),
                     pickle.loads(pickle.dumps(held))):
            assert bytes(same) == bytes(held) and type(same) is type(held)
        data = bytearray(pickle.dumps(held))
        data[len(data) // 2] ^= 1
        refusal((pickle.UnpicklingError, zlib.error, TypeError), pickle.loads,
                data)
    assert rows["mode"][0] == rows[0]["mode"] == str(Mode(rows["mode"].min()))


def a_table_in_milliseconds_is_noted():
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        twofold.simulate("chaos", 2, 100, between="held", inputs={
            "t": [0, 1000, 2000], "force": [0, 1, 0]})
    assert ["is t in seconds?" in str(one.message) for one in said] == [True]


def words_stand_for_members():
    for kind in (Mode, twofold.Status, twofold.Scheme, twofold.Folds):
        for one in kind:
            assert one == str(one) == kind(str(one)) == kind[one.name] and \
                one != "x" and {int(one): one}[one] is eval(
                    repr(one), vars(twofold))
    machine = Machine("chaos", omega=-1.02, h=0)
    assert machine.mode == "stick+" and "slip-" in machine.set
    assert machine.choices == len(machine.set) == 3
    futures = machine.futures()
    assert futures["slip+"] is futures[Mode.SLIP_PLUS] is futures.get("slip+")
    assert "stick+" in futures and "pinned" not in futures
    assert futures.get("pinned") is None and Mode.SLIP_MINUS in futures
    refusal(ValueError, futures.__getitem__, "slip")
    refusal(KeyError, futures.__getitem__, "pinned")
    other = machine.copy()
    rows = machine.run(3 * machine["dt"])
    assert machine.status == other.step(2) == other.step() == "ok"
    for one in (machine, other):
        for name in rows.columns:
            got = getattr(one, name)
            got = sum(1 << mode for mode in got) if name == "set" else got
            assert got == rows[-1][name], name
    for name in ("slip+", "stick+", "pinned"):
        assert ((rows["mode"] == name) == (rows.words("mode") == name)).all()
        assert ((rows["mode"] != Mode(name)) != (rows["mode"] == name)).all()
    refusal(ValueError, rows["mode"].__eq__, "slip")
    for row in rows[0], next(iter(rows)), rows[-1:][0]:
        assert row["mode"] in Mode and row["mode"] == str(row["mode"])
    assert type(rows["mode"].max()) is np.uint8
    assert (rows == rows).all() is np.True_ and type(np.diff(
        rows["mode"])) is np.ndarray
    for held, name in ((machine, "r"), (machine, "kappa"), (machine, "mode"),
                       (machine.state, "omega"), (machine.input(), "forse")):
        refusal(AttributeError, setattr, held, name, 0.2)
    assert "omega0=-1 rad/s" in repr(machine.input())
    assert "r=0.18 m" in repr(Machine().state) and "mode=slip+" in repr(
        Machine().state)


def tables_are_read_by_others():
    import xarray  # what it is for; also where only this fails
    rows = twofold.simulate("chaos", 0.5, 5)
    assert rows.columns[0] == "t" and rows.units["h"] == "m/s"
    frame, data = rows.to_pandas(), rows.to_xarray()
    assert frame["mode"].dtype == "category" and frame.attrs["units"] == \
        rows.units
    assert list(data.coords) == ["t"] and data["r"].attrs["units"] == "m"
    assert isinstance(data, xarray.Dataset) and data["h"].dims == ("t",)
    for got in (frame, data):
        assert (got["r"].values == rows["r"]).all()
        assert [*got["mode"].values] == [str(Mode(one)) for one in rows["mode"]]
        assert got["set"].values[-1] == "|".join(
            str(mode) for mode in Mode if rows["set"][-1] >> mode & 1)
    grid = twofold.sweep("chaos", {"kappa": [0.25, 0.3, -1], "law": [
        "jump", "none"], "r": [0.18, 0.2]}, 0.2, jobs=3)
    data = grid.to_xarray()
    assert data["end_r"].dims == ("kappa", "law", "r")
    assert data["kappa"].attrs["units"] == "m"
    assert data["end_r"].sel(kappa=0.3, law="none", r=0.2) == \
        grid["end_r"][1, 1, 1]
    assert data["final"].values[2, 0, 0] == "" and len(grid.to_pandas()) == 12
    alone = twofold.sweep("chaos", {"kappa": [0.25, 0.3, -1], "law": [
        "jump", "none"], "r": [0.18, 0.2]}, 0.2, jobs=1)
    assert grid.tobytes() == alone.tobytes()
    grid = Machine().regions([0.1, 0.2], [-1, -1.1, -1.2]).to_xarray()
    assert grid["region"].dims == ("r", "omega")
    with contextlib.redirect_stderr(io.StringIO()) as said:
        twofold.sweep("chaos", {"r": [0.1, 0.2]}, 0.1, progress=True)
        assert "2/2" in said.getvalue()
        twofold.sweep("chaos", {"r": [0.1, 0.2]}, 0.1, progress=False)
        assert said.getvalue().count("2/2") == 1


def sweeps_stop():
    """Ctrl-C ends all threads of a sweep."""
    before = threading.active_count()
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        twofold.sweep("chaos", {"r": np.linspace(0.1, 0.2, 9)}, 300, dt=1e-4)
        raise AssertionError("a sweep was not stopped")
    except KeyboardInterrupt:
        assert threading.active_count() == before


def arithmetic_is_checked():
    """Other rounding, and subnormal numbers that are flushed to 0, are refused
    by name wherever something is computed."""
    libm = ctypes.CDLL("libm.so.6")
    machine = Machine("chaos", h=0)
    ensemble = Ensemble(machine, [0.1, 0.2], -1, v=0)
    calls = [*entries(machine, ensemble)[machine][:2], lambda: machine.run(0.1),
             *entries(machine, ensemble)[machine][4:8], ensemble.step,
             machine.energy, lambda: machine.r, lambda: machine.turntable_to(
                 machine.input(), -1), lambda: Machine(OWN),
             lambda: Machine(real="float"),
             lambda: twofold.simulate("chaos", 0.1),
             lambda: twofold.sweep("chaos", {"r": [0.1]}, 0.1)]
    fast = PLACE / "fast.c"
    fast.write_text("int fast;\n")
    subprocess.run(["gcc", "-shared", "-fPIC", "-ffast-math", fast, "-o",
                    PLACE / "fast.so"], check=True)
    for disturb, word in ((lambda: libm.fesetround(0x800), "FE_TONEAREST"),
                          (lambda: ctypes.CDLL(str(PLACE / "fast.so")),
                           "subnormal")):
        disturb()
        said = [refusal(FloatingPointError, call) for call in calls]
        libm.fesetenv(ctypes.c_void_p(-1))  # FE_DFL_ENV
        assert all(word in text for text in said), said
        for call in calls:
            call()


def pictures_show_modes():
    """A line for each mode that a run has, grey where it has several."""
    file, picture = PLACE / "a.csv", PLACE / "a.png"
    program = [sys.executable, "-m", "twofold"]
    subprocess.run([*program, "run", "chaos", "--t-end", "2.2", "--every", "10",
                    "--out", file], check=True, capture_output=True)
    subprocess.run([*program, "plot", file, "-o", picture], check=True)
    assert picture.read_bytes().startswith(b"\x89PNG")
    page = (Path(__file__).parents[2] / "tools/page/page.css").read_text()
    for mode, colour in zip(Mode, _table.COLOURS):
        assert f"--{mode.name.lower().replace('_', '-')}: {colour};" in page
    rows = twofold.read_csv(file)
    figure = rows.strips()
    modes = len(np.unique(rows["mode"]))
    for axes, name in zip(figure.axes, ("r", "v", "omega", "h")):
        assert name in axes.get_ylabel()
        lines = [line for line in axes.lines if len(line.get_xdata()) ==
                 len(rows)]
        assert len(lines) == modes > 3
        shaded, = axes.collections
        grey = [path.get_extents() for path in shaded.get_paths()]
        assert all(any(box.x0 <= t <= box.x1 for box in grey) == (choices > 1)
                   for t, choices in zip(rows["t"], rows["choices"]))
    (PLACE / "b.csv").write_text("point,kappa\n1,2\n")
    for words, code, text in (
            ([*program, "plot", PLACE / "b.csv"], 1, "rows of a run"),
            ([*program, "plot", PLACE / "c.csv"], 1,
             f"twofold: {PLACE}/c.csv: No such file or directory\n"),
            ([*program, "plot", "/dev/null"], 1, "twofold: /dev/null: no "),
            ([*program, "plot"], 1, "usage"),
            ([*program, "rnu"], 2, "did you mean 'run'?"),
            ([sys.executable, "-c", "import runpy, sys\nsys.modules["
              "'matplotlib'] = None\nsys.argv = ['', 'plot', 'a.csv']\n"
              "runpy.run_module('twofold', run_name='__main__')"], 1,
             "needs matplotlib")):
        said = subprocess.run(words, capture_output=True, text=True,
                              check=False)
        assert said.returncode == code and text in said.stderr, said


def files_read_back():
    """To the bit; pandas does so with float_precision="round_trip"."""
    file = PLACE / "a.csv"
    exact = twofold.read_csv(file)
    for name in ("r", "v", "F"):
        want = [float(line.split(",")[exact.columns.index(name)])
                for line in file.read_text().splitlines()[1:]]
        assert [*exact[name]] == want
        assert [*pandas.read_csv(file, float_precision="round_trip")[
            name]] == want
    live = twofold.simulate("chaos", 2.2, 10)
    for name in exact.columns:
        assert (exact[name] == live[name]).all(), name
    assert "header" in refusal(ValueError, twofold.read_csv, "/dev/null")
    bad = PLACE / "bad.scene"
    refusal(FileNotFoundError, Machine, bad)
    bad.write_text("based-on chaos\nkapa 1\n")
    assert f"{bad}:2: unknown key 'kapa'; did you mean 'kappa'" in refusal(
        ValueError, Machine, bad)
    bad.write_text("t,force\n0,1\n1,2")
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        machine = Machine()
        machine.run(0.1, inputs=bad, between="held")
    assert "no newline" in str(said[0].message)


for law in (enters_once, pickles_are_whole, copies_are_whole,
            a_table_in_milliseconds_is_noted,
            words_stand_for_members, tables_are_read_by_others, sweeps_stop,
            arithmetic_is_checked, pictures_show_modes, files_read_back):
    law()
