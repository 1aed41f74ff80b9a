"""What the tests of the packages share."""
import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[4]
sys.path.append(str(ROOT / "tests/support"))
from tap import check, lacks  # noqa: E402

BUILD = (ROOT / os.environ.get("BUILD", "build")).resolve()
DIST = BUILD / "dist"
WORK = BUILD / "test-dist"
MAKE = os.environ.get("MAKE", "make")
TWOFOLD = BUILD / "double/twofold"
REALS = {"double": [], "float": ["-DTF_REAL_FLOAT"]}
STRICT = ["-Wall", "-Wextra", "-pedantic", "-Werror"]


def need(tool, package):
    """The name of a tool, without which there is no test."""
    return tool if shutil.which(tool) else lacks(package)


def run(*command, cwd=None, env=None, codes=(0,)):
    """What a command prints, which has to end with one of these codes."""
    said = subprocess.run([str(word) for word in command], cwd=cwd, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**os.environ, **(env or {})}, check=False)
    check(said.returncode in codes, " ".join(map(str, command)) + "\n"
          + "\n".join(line[:200] for line in said.stdout.splitlines()[-8:]))
    return said.stdout


def rows_of(real, *arguments):
    """Rows of `twofold run` by tf_step, as lists of words, without the header.
    Code 5 says that steps were degraded, which is no failure here."""
    said = subprocess.run([BUILD / real / "twofold", "run",
                           *map(str, arguments), "--scheme", "moreau"],
                          text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    check(said.returncode in (0, 5), said.stderr)
    return [line.split(",") for line in said.stdout.splitlines()[1:]]


def equal(what, got, want):
    """Fails where they differ."""
    check(got == want, f"{what}: {got!r}, not {want!r}")


def folder(name):
    """An empty folder of a test."""
    path = WORK / name
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    return path


def version():
    """TF_VERSION, as the program prints it."""
    return run(TWOFOLD, "--version").split()[1].rstrip(",")


@functools.cache
def ends_at(real):
    """What the demos print: r after 10 s of chaos, by the tree's library."""
    place = folder(f"tree-{real}")
    demo = ROOT / "tools/package/dist/cmake/examples/demo/demo.c"
    run("gcc", "-std=c99", "-O1", *REALS[real], "-I", ROOT / "include", demo,
        BUILD / real / "libtwofold.a", "-lm", "-o", place / "demo")
    return run(place / "demo")
