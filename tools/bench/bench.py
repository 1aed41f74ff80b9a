"""Measures: rows in BUILD/bench/results.csv, tables and pictures beside them.

  bench [SECTION...]      these sections, or those of USUAL: their rows take the
                          place of those that are there
  bench sizes [BOARD...]  the firmware of these boards
  bench sizes --check     compares flash, RAM and stack of a few of them with
                          docs/bench/sizes.csv and names what has grown by more
                          than 2 %; --all, FULL=yes: of all boards and scenes
  bench stack BOARD REAL SCENE   the stack of one: worst of main, an interrupt,
                          and painted in the emulator
  bench --keep            copies pictures and tables to docs/

What needs a tool that is missing is left out, with the reason. Environment:
BUILD CC OPT EXTRA, ROUNDS of the peers (5), STEPS of a firmware in the emulator
(30000), QUICK: every fourth setting of peers, one round.
"""
import argparse
import importlib
import os
import shutil
import sys
import time
from typing import Callable

import pandas as pd

sys.path.append("tools/study")  # table, pictures
import driven
import firmware
import page
import schemes
import table
from measure import KEPT, OUT, QUICK, say


def stability(name: str) -> Callable[[], pd.DataFrame]:
    """A section on the Python package, which only these need built."""
    return lambda: getattr(importlib.import_module("stability"), name)()


USUAL = {
    "peers": schemes.peers, "steps": schemes.steps,
    "ensemble": schemes.ensemble,
    "stability": stability("judged"), "map": stability("mapped")}
# These are measured when they are asked for; the last take boards behind their
# name.
OF_BOARDS = {"sizes": firmware.measure, "boards": firmware.race}
SECTIONS = {**USUAL, **OF_BOARDS}


def measure(name: str, boards: list[str]) -> None:
    """Measures a section. What finds no tool leaves no rows."""
    say(f"{name} ...")
    core = driven.output("tools/stamp", "core").strip()
    load, begin = os.getloadavg()[0], time.time()
    rows = SECTIONS[name](boards) if name in OF_BOARDS else SECTIONS[name]()
    if not rows.empty:
        less = "".join(f", without {what}" for what in schemes.missing)
        page.keep(name, f"{core} {time.time() - begin:.0f} s, load {load:.1f}"
                  f"{', quick' * QUICK}{less}.", rows)
    schemes.missing.clear()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="SECTION")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--all", action="store_true",
                        default=bool(os.environ.get("FULL")))
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    words, boards = given.words, []
    if words[:1] == ["stack"] and len(words) == 4:
        print(*("-" if one is None else one
                for one in firmware.stack_of(*words[1:])))
        return
    if given.check and words == ["sizes"]:
        sys.exit(firmware.check(given.all))
    if words and words[0] in OF_BOARDS:
        words, boards = words[:1], words[1:]
        for name in set(boards) - set(firmware.boards()):
            parser.error(f"{name}: boards are {' '.join(firmware.boards())}")
    if not set(words) <= set(SECTIONS):
        parser.error(f"sections are {' '.join(SECTIONS)}")
    OUT.mkdir(parents=True, exist_ok=True)
    if given.keep:
        table.publish(OUT / "tables.md")
        for path in OUT.iterdir():
            if (KEPT / path.name).exists():
                shutil.copy(path, KEPT)
        return
    for name in words or USUAL:
        measure(name, boards)
    page.write()
    print(f"Tables are in {OUT}/tables.md, rows and pictures beside them; "
          "`make keep-bench` copies them to docs/.")
