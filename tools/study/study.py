"""The studies of the paper's machine, and what shows them.

usage: tools/run study SECTION          follows what is to be followed, makes
                                        tables and pictures in BUILD/study
       tools/run study SECTION count    them again, of what was followed
       tools/run study SECTION keep     puts tables into docs/STUDIES.md
                                        or NOISE.md and pictures into docs
       tools/run study machine N        of recurrence: the row of a machine, and
                                        the commands for it

SECTION is statistics, recurrence, noise, fold, corner, halfrange, finer,
sides, mechanisms, several, trolley, cart or figures.
Environment: BUILD, TWOFOLD, JOBS; CYCLES=1000 of statistics and noise,
SAMPLES=10000 of corner, MACHINES of statistics and recurrence,
MECHANISMS=10000 of mechanisms (2000 of several).
"""
import importlib
import os
import shutil
import sys
from pathlib import Path

import driven
import table

SECTIONS = {"statistics": "exits", **{name: name for name in (
    "recurrence noise fold corner halfrange finer sides mechanisms several "
    "trolley cart figures").split()}}
BUILD = Path(os.environ.get("BUILD") or "build")
TWOFOLD = os.environ.get("TWOFOLD") or f"{BUILD}/double/twofold"


def keep(name: str, kept: Path) -> None:
    """Copies tables and pictures to where git has them."""
    table.publish(kept / "tables.md")
    for path in kept.iterdir():
        if path.suffix != ".md":
            to = next(Path("docs").rglob(path.name), "docs")
            print(shutil.copy(path, to))


def make(name: str, follows: bool) -> None:
    """A section, or its tables and pictures alone."""
    section = importlib.import_module(SECTIONS[name])
    work = BUILD / "study" / name
    kept = work / "kept"
    kept.mkdir(parents=True, exist_ok=True)
    if follows and hasattr(section, "follow"):
        section.follow(work, TWOFOLD)
    parts = {"of": driven.output("tools/stamp", "core").strip(),
             **section.count(work, kept)}
    table.write(kept / "tables.md", {f"{SECTIONS[name]}-{part}": what
                                     for part, what in parts.items()})
    print(kept / "tables.md")


def chosen(name: str, what: str = "") -> None:
    """What the words ask for."""
    if name == "machine":
        importlib.import_module("recurrence").show(int(what), TWOFOLD)
    elif name in SECTIONS and what == "keep":
        keep(name, BUILD / "study" / name / "kept")
    elif name in SECTIONS and what in ("", "count"):
        make(name, not what)
    else:
        sys.exit(__doc__)


def main() -> None:
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    table.run_script(lambda: chosen(*sys.argv[1:]))
