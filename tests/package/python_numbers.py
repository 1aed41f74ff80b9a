"""Names and numbers of the Python package are those of the command line, to the
bit: python_numbers.py BUILD FOLDER. Run by in_python.py, where it is
installed."""
import csv
import ctypes
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas

import twofold
from twofold import Folds, Law, Mode, Region, Rest, Rule, _core, _table

SMALL = {"double": np.float64, "float": np.float32}


def said(real, *words):
    """What the command line prints."""
    return subprocess.run([f"{sys.argv[1]}/{real}/twofold", *map(str, words)],
                          capture_output=True, text=True, check=False).stdout


def agree(real, name, got, want):
    """A number of a table and the text of the command line."""
    if name == "set":
        got = _table._cell(name, got)
    elif name in _table.MEMBERS and isinstance(got, (int, np.integer)):
        got = str(_table.MEMBERS[name](int(got)))
    elif not isinstance(got, str):
        want = math.nan if want == "" else want
        got, want = SMALL[real](got), SMALL[real](want)
    assert got == want or (got != got and want != want), (name, got, want)


def same(table, real, *words, behind=0):
    """Each column of the command line, behind so many rows."""
    rows = list(csv.DictReader(line for line in said(real, *words).splitlines()
                               if not line.startswith("#")))[behind:]
    assert len(rows) == table.size > 0, (words, len(rows), table.size)
    for name in set(rows[0]) - {"point"}:
        for got, row in zip(table[name].ravel(), rows):
            if (name, row.get("status")) != ("reason", "refused") and (
                    table[name].dtype.kind != "u" or row[name]):
                agree(real, name, got, row[name])


for function, kind in {"mode": Mode, "tyre_law": Law, "rule": Rule,
                       "rest_law": Rest, "region": Region,
                       "folds": Folds}.items():
    name_of = getattr(_core.CORE_f64.library, f"tf_{function}_name_f64")
    name_of.restype = ctypes.c_char_p
    assert [name_of(i).decode() for i in range(len(kind))] == [*map(str, kind)]

OWN = Path(__file__).parents[1] / "data/own.scene"
TABLE = {"t": [-1, 0.00005, 0.3, 0.3, 0.7, 5], "force": [0, 1, 1, -0.5, 0.1, 3],
         "omega0": [-1, -1.1, -1.2, -0.9, -1, -1.3]}
FILE = Path(sys.argv[2], "table.csv")


def driven(real):
    """Inputs over time, in each form in which they may be given."""
    frame = pandas.DataFrame(TABLE)
    frame.to_csv(FILE, index=False)
    forms = (FILE, str(FILE), TABLE, frame[["force", "t", "omega0"]],
             frame.to_records(index=False))
    for i, (scheme, scene) in enumerate(
            (scheme, scene) for scheme in twofold.Scheme
            for scene in ("driven", "chaos")):
        for between in ("held", "linear"):
            given = {"inputs": forms[i % len(forms)], "between": between}
            words = [real, "run", scene, "--scheme", scheme, "--inputs", FILE,
                     "--between", between, "--set", "h=0", "--t-end", 1,
                     "--every", 50]
            same(twofold.simulate(scene, 1, 50, scheme, real=real, h=0,
                                  **given), *words)
            machine = twofold.Machine(scene, real=real, h=0)
            swept = twofold.sweep(scene, {"h": [0, .01]}, 1, scheme, real=real,
                                  **given)
            parts = [machine.run(t, 50, scheme, **given) for t in (0.25, 0.75)]
            assert swept["end_r"][0] == machine.r, (scheme, scene)
            same(np.concatenate([parts[0], parts[1][1:]]), *words)


for REAL in SMALL:
    driven(REAL)
    same(twofold.simulate(OWN, every=7, real=REAL, kappa=0.3), REAL, "run", OWN,
         "--every", 7, "--set", "kappa=0.3")
    same(twofold.sweep(str(OWN), {"r": [0.1, 0.2]}, 0.2, real=REAL), REAL,
         "sweep", OWN, "--over", "r=0.1:0.2:2", "--t-end", 0.2)
    drawn = {"rule": "random", "omega": -1.02, "h": 0, "rate": 300}
    words = ["--select", "random", "--set", "omega=-1.02", "--set", "h=0",
             "--set", "rate=300", "--t-end", 0.02]
    same(twofold.simulate("chaos", 0.02, real=REAL, **drawn), REAL, "run",
         "chaos", *words)
    same(twofold.sweep("chaos", {"seed": [*range(17)]}, 0.02, real=REAL,
                       **drawn), REAL, "sweep", "chaos", "--over",
         "seed=0:16:17", *words)
    for rows, options, words in (
            ("returns", {"samples": 20, "seed": 3}, ["--samples", 20]),
            ("exits", {"samples": 8, "seed": 3, "kappa": 0.27},
             ["--samples", 8, "--set", "kappa=0.27"]),
            ("returns", {"by": "noise", "size": 1e-3, "samples": 1,
                         "patience": 3, "seed": 3},
             ["--by", "noise", "--size", 1e-3, "--samples", 1, "--patience",
              3]),
            ("branches", {"count": 2, "grid": 0.05, "omega": -1.02, "h": 0,
                          "seed": 3},
             ["--exhaustive", "--count", 2, "--grid", 0.05, "--set",
              "omega=-1.02", "--set", "h=0"])):
        same(twofold.diverge("chaos", rows, REAL, **options), REAL, "diverge",
             "chaos", f"--{rows}", "-", "--seed", 3, *words)
    for scene in twofold.scenes():
        same(twofold.simulate(scene, 2, 100, real=REAL), REAL, "run", scene,
             "--t-end", 2, "--every", 100)
        folds = twofold.Machine(scene, real=REAL).two_folds()
        wants = json.loads(said(REAL, "singularities", scene))["two_folds"]
        assert len(wants) == len(folds)
        for fold, want in zip(folds, wants):
            want["eigenvalue_1"], want["eigenvalue_2"] = want["eigenvalues"]
            want["case"] = want["case"] or "0"
            for column in folds.dtype.names:
                agree(REAL, column, fold[column], want[column])
        machine = twofold.Machine(scene, real=REAL, rule="random", dt=2e-3)
        for i in range(300):  # futures are the modes of the step that comes
            scheme = (0, 2, scene in ("chaos", "driven"))[i % 3]
            futures = machine.futures(twofold.Scheme(scheme))
            step, = machine.copy().run(2e-3, 1, twofold.Scheme(scheme))[1:]
            modes = {step["mode"], *(m for m in Mode if step["set"] >> m & 1)}
            assert {step["mode"]} <= {*futures} <= modes
            assert len(futures) == len(modes) or scheme == 1
            machine = [*futures.values()][i % len(futures)]
    for scheme in twofold.Scheme:
        same(twofold.simulate("chaos", 0.3, 1, scheme, real=REAL, h=0, r=0.19),
             REAL, "run", "chaos", "--t-end", 0.3, "--scheme", scheme, "--set",
             "h=0", "--set", "r=0.19")
    for rule, mode in (("slip+", Mode.SLIP_PLUS), ("slip-", Mode.SLIP_MINUS),
                       ("persist", Mode.STICK_PLUS)):
        machine = twofold.Machine(real=REAL, rule=rule, omega=-1.02, h=0)
        futures = machine.futures()
        assert len(futures) == 3 and machine.state.tick == 0
        same(futures[mode].run(0.4999), REAL, "run", "chaos", "--t-end", 0.5,
             "--set", "omega=-1.02", "--set", "h=0", "--select", rule, behind=1)
    for axes, options in (
            ({"kappa": np.linspace(0.25, 0.3, 3), "r": [0.18, 0.19]},
             ["kappa=0.25:0.3:3", "--over", "r=0.18:0.19:2"]),
            ({"gamma": [-0.5, 0, 0.5]}, ["gamma=-0.5:0.5:3"]),
            ({"dt": [0.01, 0.1]}, ["dt=0.01:0.1:2"])):
        for scheme in (None, "located"):  # which changes modes within a step
            same(twofold.sweep("chaos", axes, 4, scheme, real=REAL), REAL,
                 "sweep", "chaos", "--t-end", 4, "--over", *options,
                 *["--scheme", "located"] * (scheme is not None), "--outcome",
                 ",".join(twofold._ensemble.OUTCOMES))
    same(twofold.Machine(real=REAL).regions(
        np.linspace(0, 0.25, 9), np.linspace(-1.5, -0.5, 9)), REAL, "regions",
         "chaos", "--r", "0:0.25:9", "--omega=-1.5:-0.5:9")
