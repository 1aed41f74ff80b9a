"""The Python package, from its source archive, without a network."""
import importlib.util
import sys
import tarfile

from harness import (BUILD, DIST, ROOT, check, equal, folder, lacks, run,
                     version)

PROGRAM = """\
import signal, sys
import numpy as np
import twofold
from twofold import _core

def interrupt(*_):
    raise KeyboardInterrupt

signal.signal(signal.SIGALRM, interrupt)
slices = _core.SLICE
assert twofold.__version__ == sys.argv[1]
for real in ("double", "float"):
    # An ensemble has the bits of single steps.
    machine = twofold.Machine("chaos", real=real)
    start = np.linspace(0.1, 0.3, 37)
    many = twofold.Ensemble(machine, r=start, omega=-1.037, h=1e-10)
    many.step(500)
    for i in (0, 17, 36):
        machine.place(r=start[i], omega=-1.037, h=1e-10)
        last = machine.run(0.05, 500, "moreau")[-1]
        assert last["r"] == many["r"][i] and last["omega"] == many["omega"][i]
        assert last["mode"] == many["mode"][i] and many["status"][i] >= 0
    machine = twofold.Machine("chaos", real=real, rule="random")
    many = twofold.Ensemble(machine, 0.18, -1.037, h=1e-10,
                            seed=range(7, 57))
    many.step(20000)
    for i in range(50):
        machine.seed = 7 + i
        machine.place(r=0.18, omega=-1.037, h=1e-10)
        last = machine.run(20000 * machine["dt"], 20000, "moreau")[-1]
        for name in ("r", "v", "omega", "h", "g", "F", "M", "mode", "set"):
            assert last[name] == many[name][i], (name, i)
    assert len(set(many["r"])) > 1
    # A ramp of one step, behind which the turntable keeps its speed.
    places = set()
    for _core.SLICE, parts in ((slices, (8,)), (3, (8,)), (2, (1, 7)),
                                 (4, (3, 5))):
        machine.place(0.18, -1.037, v=0)
        many = twofold.Ensemble(machine, 0.18, -1.037, v=0)
        for step in (lambda n: machine.run(n * machine["dt"], 1, "moreau", inputs),
                     lambda n: many.step(n, inputs)):
            inputs = machine.input()
            machine.turntable_to(inputs, -0.99)
            for part in parts:
                step(part)
                assert inputs.alpha == 0
        places |= {(machine.state.r, machine.state.v), (many["r"][0],
                                                        many["v"][0])}
    assert len(places) == 1, places
    # Slices of a run are seen neither in its rows nor in its end.
    runs = []
    for _core.SLICE in (slices, 7, 1):
        machine.start()
        for every in (1, 3, 20, 100):
            runs.append(machine.run(50 * machine["dt"], every).tobytes())
    assert runs[:4] == runs[4:8] == runs[8:]
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
        try:
            step()
        except KeyboardInterrupt:
            pass
        tick, = set(ticks())
        assert tick < 10**7 and (inputs.alpha == 0) == (tick > 0), tick
"""


# No network, no settings of this machine, no wheel of an earlier run.
ALONE = {"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": "/dev/null",
         "PIP_NO_CACHE_DIR": "1", "PYTHONPATH": ""}


def environment(place, archive, of_venv, of_pip):
    """The python of a new environment that has the archive; with an option of
    venv and one of pip."""
    run(sys.executable, "-m", "venv", of_venv, place)
    # An old setuptools there is not asked for; newer Pythons bring none.
    run(place / "bin/pip", "uninstall", "--yes", "setuptools", "wheel",
        env=ALONE)
    run(place / "bin/pip", "install", of_pip, archive, env=ALONE, cwd=place)
    return place / "bin/python"


def judge_archive(place, archive):
    """What its backend packs again are the same files."""
    def files(path):
        with tarfile.open(path) as tar:
            return {one.name: tar.extractfile(one).read()
                    for one in tar.getmembers() if one.isfile()}

    with tarfile.open(archive) as tar:
        tar.extractall(place)
    again = run(sys.executable, "-c", "import backend; "
                f"print(backend.build_sdist({str(place)!r}))",
                cwd=place / archive.name.removesuffix(".tar.gz"))
    check(files(place / again.strip()) == files(archive),
          "build_sdist packs other files")
    said = run(sys.executable, "-c", "import backend; "
               f"backend.build_wheel({str(place)!r})", codes=(1,),
               cwd=place / archive.name.removesuffix(".tar.gz"),
               env={"CC": "no-such-cc -g"})
    check("needs a C compiler" in said and "no-such-cc" in said,
          f"without a compiler it says: {said}")


def python():
    """pip installs the archive in a bare environment, without a network,
    setuptools and wheel; runs have the bits of the command line; each bad
    argument is refused; the example draws."""
    for module, package in (("ensurepip", "python3-venv"),
                            ("numpy", "python3-numpy"),
                            ("matplotlib", "python3-matplotlib")):
        if importlib.util.find_spec(module) is None:
            lacks(package)
    place = folder("python")
    archive = DIST / f"python/twofold-{version()}.tar.gz"
    judge_archive(place, archive)
    environment(place / "bare", archive, "--clear", "--no-deps")
    python3 = environment(place / "venv", archive, "--system-site-packages",
                          "--no-index")
    program = place / "program.py"
    program.write_text(PROGRAM)
    env = {"PYTHONPATH": str(place / "site")}
    run(python3, program, version(), env=env)
    run(python3, ROOT / "tests/package/python_numbers.py", BUILD, env=env)
    said = run(python3, ROOT / "tools/package/dist/test/arguments.py", env=env)
    check(said.endswith("bad values are refused\n"), f"arguments.py: {said}")
    print(f"# {said.strip()}")
    example = DIST / f"python/twofold-{version()}/examples/phase_plane.py"
    run(python3, example, place / "plane.png", env=env)
    equal("first bytes of the picture",
          (place / "plane.png").read_bytes()[:4], b"\x89PNG")


TESTS = {"python": python}
