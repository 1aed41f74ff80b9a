"""Laws of the motions of tools/study/finer.c, in x87's long double: they
converge to those of the core's law `smooth`, and the layer next to the two-fold
is as theory says.

Environment: FINER the program, by default that of `make`.
"""
import importlib
import os
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from tap import ROOT, TWOFOLD, call, check, lacks  # noqa: E402

FINER = str(Path(os.environ.get("FINER") or
                 ROOT / "build/study/finer-64").resolve())


def study(name):
    """A module of the study."""
    sys.path[:0] = [str(ROOT / "tools/study"), str(ROOT / "tools")]
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        return lacks(f"python3-{missing.name}")
    finally:
        del sys.path[:2]


def near(got, want, off, what):
    check(abs(got - want) <= off, f"{what}: {got}, not {want} +- {off}")


def motion(*words):
    """The columns of one motion."""
    head, row = call(*words, program=FINER)[0].splitlines()
    return dict(zip(head.split(","), row.split(",")))


def agreement(_):
    """The core's law `smooth` comes to the same motion, at order 2."""
    errors = [error for _, error in
              study("families").core_agreement(TWOFOLD, FINER)]
    check(errors[-1] < 1e-7, f"the core is off by {errors[-1]}")
    for coarse, fine in zip(errors, errors[1:]):
        near(coarse / fine, 4, 0.05, "error by half the step")


def contraction(folder):
    """Width times contraction tends to C of the set-valued stick."""
    C = study("finer").contraction(TWOFOLD, "algebraic", folder)
    wide, narrow = (
        -float(motion(f"width={width}", "until=0.13")["before"]) * width / C
        - 1 for width in (1e-5, 1e-6))
    check(abs(narrow) < 0.005, f"a width of 1e-6 is off by {narrow}")
    near(wide / narrow, 10, 2, "error by ten times the width")


def growth(_):
    """A kick at the two-fold leaves where Kummer's function says."""
    finer = study("finer")
    fold = finer.TwoFold(study("families").two_fold(TWOFOLD))
    width = fold.width("algebraic", 1e-7)
    for kick in 1e-13, 1e-15:
        found = float(motion(f"width={width}", f"kick={kick}")["behind"])
        want = fold.exponent(finer.EXIT * 1e-7 / kick)
        near(found, want, 0.03 * want, f"exponent of a kick of {kick}")


def starts(_):
    """What the start was is forgotten at the two-fold, a kick is not."""
    plain, moved, kicked = (
        float(motion("width=1e-5", word)["exit_r"])
        for word in ("x=0", "w=-1.0533", "kick=1e-10"))
    check(abs(moved - plain) < 1e-6, f"the start moves the exit: {moved}")
    check(abs(kicked - plain) > 2e-4, f"a kick does not: {kicked}")


TESTS = [("finer: the core's law smooth comes to its motion", agreement),
         ("finer: contraction tends to that of the stick", contraction),
         ("finer: a kick grows by Kummer's function", growth),
         ("finer: the start is forgotten, a kick is not", starts)]
