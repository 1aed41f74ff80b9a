"""The Python package, from its source archive, without a network."""
import importlib.util
import re

from harness import BUILD, DIST, ROOT, equal, folder, lacks, run, version

PROGRAM = """\
import contextlib, signal, sys
import numpy as np
import twofold
from twofold import _core

signal.signal(signal.SIGALRM, signal.default_int_handler)
slices = _core.SLICE
assert twofold.__version__ == sys.argv[1]
for real, scene in ("double", "chaos"), ("float", "driven"):
    # An ensemble has the bits of single steps.
    machine = twofold.Machine(scene, real=real, rule="random")
    start = np.repeat([0.1, 0.18, 0.3], [3, 40, 4])
    many = twofold.Ensemble(machine, start, -1.037, h=1e-10, seed=range(7, 54))
    many.step(20000)
    for i, r in enumerate(start):
        machine.seed = 7 + i
        machine.place(r, -1.037, h=1e-10)
        last = machine.run(20000 * machine["dt"], 20000, "moreau")[-1]
        for name in ("r", "v", "omega", "h", "g", "F", "M", "mode", "set"):
            assert last[name] == many[name][i], (name, i)
    assert len(set(many["r"][3:43])) > 1 or scene == "driven"
    # A ramp of one step, behind which the turntable keeps its speed. Slices of
    # a run are seen neither in its rows nor in its end.
    ends = set()
    for _core.SLICE, parts in ((slices, (8,)), (3, (8,)), (2, (1, 7)),
                               (1, (3, 5))):
        machine.place(0.18, -1.037, v=0)
        many = twofold.Ensemble(machine, 0.18, -1.037, v=0)
        for step in (lambda n: machine.run(n * machine["dt"], 1, "moreau",
                                           inputs),
                     lambda n: many.step(n, inputs)):
            inputs = machine.input()
            machine.turntable_to(inputs, -0.99)
            for part in parts:
                step(part)
                assert inputs.alpha == 0
        places = {(machine.state.r, machine.state.v),
                  (many["r"][0], many["v"][0])}
        ends.add((*places, *(machine.run(50 * machine["dt"], every).tobytes()
                             for every in (1, 3, 20, 100))))
    assert len(places) == 1 == len(ends), ends
    _core.SLICE = slices
    # What is interrupted has the same steps in all states, and no alpha left.
    many = twofold.Ensemble(machine, np.linspace(0.1, 0.3, 37), -1.037, v=0)
    machine.start()
    for step, ticks in ((lambda: many.step(10**7, inputs),
                         lambda: many["tick"]),
                        (lambda: machine.run(10**8 * machine["dt"], 10**6,
                                             inputs=inputs),
                         lambda: [machine.state.tick])):
        inputs = machine.input(alpha=0.1)
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with contextlib.suppress(KeyboardInterrupt):
            step()
        tick, = set(ticks())
        assert tick < 10**7 and (inputs.alpha == 0) == (tick > 0), tick
"""


# No network, no settings of this machine, no wheel of an earlier run.
ALONE = {"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": "/dev/null",
         "PIP_NO_CACHE_DIR": "1", "PYTHONPATH": ""}


def test_python():
    """README.md's line installs the archive; runs have the bits of the command
    line; each bad argument is refused; the notebook can be executed and shows
    its pictures."""
    for module in ("ensurepip", "setuptools", "wheel", "numpy", "matplotlib",
                   "nbconvert", "ipykernel", "pandas", "xarray", "tqdm"):
        if importlib.util.find_spec(module) is None:
            lacks("python3-" + module.replace("ensurepip", "venv"))
    place = folder("python")
    line, = re.findall(r"^\| Python \| `make dist && (.*)` \|$",
                       (ROOT / "README.md").read_text(), re.M)
    run("sh", "-c", line.replace("build/venv", f"{place}/venv").replace(
        "build/dist", str(DIST)), env={**ALONE, "HOME": str(place)})
    python3 = place / "venv/bin/python"
    # The kernel of the notebook is Debian's, and not that of the environment.
    site, = (place / "venv").glob("lib/*/site-packages")
    env = {"PYTHONPATH": str(site)}
    run(python3, "-c", PROGRAM, version(), env=env)
    for name, *words in (("numbers", BUILD, place), ("objects", place)):
        run(python3, ROOT / f"tests/package/python_{name}.py", *words, env=env)
    run(python3, ROOT / "tests/package/python_arguments.py", env=env)
    run(python3, "-m", "nbconvert", "--to", "notebook", "--execute",
        "--output-dir", place, DIST / f"python/twofold-{version()}/examples/"
        "figures.ipynb", env=env)
    equal("pictures", (place / "figures.ipynb").read_text().count(
        '"image/png":'), 3)
