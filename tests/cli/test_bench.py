#!/usr/bin/python3 -B
"""The page of `make bench`: what its pictures and tables may say."""
import importlib
import math
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tap import ROOT, check, lacks, main, same  # noqa: E402

sys.path[:0] = [str(ROOT / "tools" / room) for room in ("bench", "study", "")]


def bench(name):
    """A module, for which the folder of the test is the build's."""
    if Path.cwd() != ROOT:
        os.environ["BUILD"] = os.getcwd()
        os.chdir(ROOT)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        return lacks(f"python3-{missing.name}")


def test_cells_are_good_only_if_near_and_silent():
    charts, pandas = bench("charts"), bench("pandas")
    rows = pandas.DataFrame(
        [(error, verdict) for error in (0.001, 0.05, 0.93, math.nan)
         for verdict in ("ok", "coarse", "degraded", "refused")],
        columns=["error", "verdict"])
    same(charts.classes(rows).tolist(), [
        "within 1 %", *2 * ["TF_COARSE, within 10 %"], "refused",
        "within 10 %", *2 * ["TF_COARSE, within 10 %"], "refused",
        "worse, and silent", *2 * ["TF_COARSE, worse"], "refused",
        *3 * ["motion not known"], "refused"])


def test_a_lucky_setting_does_not_count():
    page, pandas = bench("page"), bench("pandas")
    errors = [1, 1e-4, 1, 1e-4, 1e-4, 1e-10]
    least = page.series(pandas.DataFrame({
        "problem": "chaos", "solver": "moreau", "verdict": "ok",
        "dial": [f"dt=1e-{i}" for i in range(1, 7)], "error": errors,
        "ns": range(1, 7), "instructions": range(11, 17)}))
    same(least.ns.tolist()[0], 4)
    same(least.instructions.tolist()[0], 14)
    check(math.isnan(least.ns.tolist()[2]), "one setting is no proof")


main(globals(), jobs=1)
