"""What the figures compute by themselves is the core's: the surface h = 0, and
two-folds of random machines."""
import csv
import os
import re
from pathlib import Path

import numpy as np
from tap import ROOT, TWOFOLD, call, check
from test_finer import near, study

os.environ["TWOFOLD"] = str(TWOFOLD)


def surface(_):
    """Region, lambda and Delassus scalar over r and omega."""
    field = study("chaos").field()
    rows = list(csv.DictReader(call(
        "regions", "chaos", "--r", "0.1:0.28:19",
        "--omega=-1.159:-0.88:18")[0].splitlines()))
    place = np.array([[float(row["r"]), float(row["omega"])] for row in rows])
    plus, minus, _, _ = field.surface(*place.T)
    share = (plus + minus) / (minus - plus)
    names = np.where(plus < 0, np.where(minus > 0, "sliding", "crossing_down"),
                     np.where(minus < 0, "escaping", "crossing_up"))
    for row, name, force, A in zip(rows, names, share * field.mu,
                                   (minus - plus) / (2 * field.mu)):
        check(name == row["region"], f"{name}: {row}")
        near(A, float(row["delassus"]), 1e-12, f"A at {row}")
        near(force, float(row["lambda"]), 1e-9 / abs(A) ** 2, f"F at {row}")


def two_folds(_):
    """The shares that tf_two_folds and tf_normal_form found in a million."""
    found = study("exits").two_folds(20000).set_index("two_folds")
    for column, n, want in (("machines", 0, 0.637738), ("machines", 1,
                                                        0.074548),
                            ("machines", 4, 0.065696),
                            ("of_case_1", 1, 0.016818)):
        spread = np.sqrt(want * (1 - want) / 20000)
        near(found[column][n] / 20000, want, 4.5 * spread, f"{column} {n}")


def channels(colour):
    return np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)])


def palette(_):
    """Where a mode is drawn, its colour is the page's, and none is like it."""
    modes = {colour: name for name, colour in study("pictures").MODES.items()
             if name != "pinned"}  # which has that of ink
    for path in [ROOT / "docs/futures.svg", *ROOT.glob("docs/figures/*.svg")]:
        found = set(re.findall("#[0-9a-f]{6}", path.read_text("utf-8")))
        for colour in found - {*modes} if found & {*modes} else ():
            for mode, name in modes.items():
                off = np.abs(channels(colour) - channels(mode)).max()
                check(off > 50, f"{path}: {colour} is like {name}")


def labels(folder):
    """Numbers that are read keep their digits."""
    pictures, path = study("pictures"), Path(folder, "a.svg")
    figure, axes = pictures.pyplot.subplots()
    axes.plot([0.18123, 0.18389], [0, 1])
    axes.set(xticks=(0.182, 0.183), title="r = 0.1859 m")
    pictures.save(figure, path)
    for words in ("0.182", "0.183", "r = 0.1859 m"):
        check(f">{words}<" in path.read_text("utf-8"), words)


TESTS = [("figures: one palette", palette), ("figures: numbers", labels),
         ("figures: the surface h = 0 is the core's", surface),
         ("statistics: two-folds of machines are the core's", two_folds)]
