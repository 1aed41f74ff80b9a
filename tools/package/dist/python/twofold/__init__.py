"""A wheel on a turntable whose friction is not always deterministic.

The core is twofold's, in C, called by ctypes: in fixed steps it finds every
mode of contact that is possible, reports them, and takes one by a declared
rule. Results have the bits of the command line `twofold`.

    import twofold
    rows = twofold.simulate("chaos", t_end=2.0, every=10, kappa=0.3)
    rows["t"], rows["r"], rows["mode"] == "pinned", rows.words("set")
    rows.to_pandas(), rows.to_xarray()
    rows.plot("r", "omega"), rows.strips()      # by matplotlib
    machine = twofold.Machine("chaos", omega=-1.02, h=0)
    machine.r, machine.mode, machine.set, machine.step()
    machine.futures()["slip+"]                  # one for each mode
    twofold.simulate("my.scene", inputs="push.csv", between="linear")
    twofold.sweep("chaos", {"kappa": [0.25, 0.3]}, t_end=2.0).to_xarray()
    twofold.diverge("chaos", samples=100)
    machine.two_folds(), machine.regions(r, omega)
    twofold.read_csv("chaos.csv")               # of `twofold run`

`python3 -m twofold` is the command line; `python3 -m twofold plot FILE.csv`
draws a run. `twofold.serial` drives a board. All numbers are in SI units.
`parameters()` lists names, units and ranges.
"""
from ._core import parameters, scenes
from ._diverge import diverge
from ._ensemble import Ensemble, sweep
from ._machine import INPUTS, Machine, simulate
from ._names import Folds, Law, Mode, Region, Rest, Rule, Scheme, Status
from ._table import UNITS, Table, read_csv

__all__ = ["Ensemble", "Folds", "INPUTS", "Law", "Machine", "Mode", "Region",
           "Rest", "Rule", "Scheme", "Status", "Table", "UNITS", "diverge",
           "parameters", "read_csv", "scenes", "simulate", "sweep"]
__version__ = "@VERSION@"
