"""What follows a two-fold."""
from __future__ import annotations

import io
import os

import numpy as np

from ._check import number, word
from ._command import output
from ._core import CORES, parameters
from ._machine import START
from ._table import Table, read_csv

OPTIONS = ("by rate size spread codim2 samples cycles patience seed dt near "
           "fine shard grid depth count").split()


def diverge(scene: str | os.PathLike = "chaos", rows: str = "returns",
            real: str = "double", **options) -> Table:
    """Follows many motions from the two-fold, or from a start with several
    futures. Returns the rows of `twofold diverge`.

    rows: "returns", "exits", or "branches", which follows every future.
    options: the options of `python3 -m twofold help diverge` by name, such as
      by="noise", size=1e-3, samples=1000, seed=7; also what --set takes: any
      parameter, r, omega, h, v.
    Raises ValueError with the message of the command line."""
    core = CORES[word("real", real, CORES)]
    word("rows", rows, ("returns", "exits", "branches"))
    words = ["diverge", os.fspath(scene), f"--{rows}", "-"]
    words += ["--exhaustive"] * (rows == "branches")
    known = *OPTIONS, *parameters(), *START, "law", "rest"
    for name, value in options.items():
        word("name of an option", name, known, error=TypeError)
        text = str(value if isinstance(value, (str, int, np.integer)) else
                   number(name, value))
        words += [f"--{name}", text] if name in OPTIONS else [
            "--set", f"{name}={text}"]
    return read_csv(io.StringIO(output(core.path, words)))
