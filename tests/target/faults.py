#!/usr/bin/python3 -B
"""Whether the kit for ports (kit.py) names what is wrong with one: faults.py.

Brings up a board `mine` in a copy of the tree, as docs/PORTS.md says: first the
template as it is, then step by step what a newcomer would write, then a whole
port with one mistake at a time (tests/target/mine). Ends with
"N passed, N failed". Environment: MAKE BUILD.
"""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("BUILD", "build")
# The number of a fault in mine/board.c.in, and what the kit has to say.
FAULTS = {
    0: None,
    1: "FAILED functions of port.h: port_room: not there",
    2: "FAILED rate: a tick of 1000 Hz lasts ",
    3: "FAILED port_put: of 48 lines ",
    4: "FAILED port_get: 1 of 32 bytes ",
    5: "FAILED arithmetic: other bits than this computer's in: addition",
    6: "FAILED port_idle: waits although the tick has come",
    7: "FAILED port_clock: goes back",
    8: "FAILED port_halt: code 0 where 7 was given",
    9: "FAILED board.mk: BOARD_STEPS: empty",
}


def copy_of_tree(place: Path) -> Path:
    """Links to all there is, so that a board can be added."""
    for name in ("Makefile", "src", "include", "tools", "tests"):
        (place / name).symlink_to(ROOT / name)
    (place / "port").mkdir()
    for part in (ROOT / "port").iterdir():
        (place / "port" / part.name).symlink_to(part)
    return place / "port" / "mine"


def kit(tree: Path, fault: int) -> str:
    """What the kit says of the board."""
    environment = dict(os.environ, BUILD=str(BUILD), FAULT=str(fault))
    for name in ("MAKEFLAGS", "MAKELEVEL"):
        environment.pop(name, None)
    return subprocess.run([tree / "tests/target/kit.py", "mine", "float"],
                          cwd=tree, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          check=False).stdout


def judged(what: str, said: str, want: str | None) -> bool:
    """Whether one thing is wrong, and it is named."""
    wrong = [line for line in said.splitlines() if not line.startswith("ok ")]
    good = (said and not wrong) if want is None else \
        (bool(wrong) and wrong[0].startswith(want) and len(wrong) == 1)
    print(f"{'ok    ' if good else 'FAILED'} kit: {what}:"
          f" {wrong[0] if wrong else 'nothing is wrong'}", flush=True)
    if not good:
        print(f"    want {want}\n    got  {said}")
    return bool(good)


def main() -> None:
    good = []
    with tempfile.TemporaryDirectory(prefix="twofold-faults.") as name:
        tree = Path(name)
        mine = copy_of_tree(tree)
        template, whole = ROOT / "port/template", ROOT / "tests/target/mine"
        shutil.copytree(template, mine)
        good.append(judged("the template as it is", kit(tree, 0),
                           "FAILED board.mk: port/template is a board to copy"))
        makefile = mine / "board.mk"
        makefile.write_text("".join(
            line for line in makefile.read_text().splitlines(True)
            if not line.startswith("$(error")))
        good.append(judged("without its error", kit(tree, 0),
                           "FAILED board.mk: BOARD_REALS, BOARD_RUN,"))
        shutil.copy(whole / "board.mk", makefile)
        good.append(judged("no function is written", kit(tree, 0),
                           "FAILED functions of port.h: port_init,"))
        shutil.copy(whole / "board.c.in", mine / "board.c")
        for fault, want in FAULTS.items():
            good.append(judged(f"fault {fault}", kit(tree, fault), want))
    shutil.rmtree(BUILD / "boards/mine", ignore_errors=True)
    print(f"{sum(good)} passed, {len(good) - sum(good)} failed")
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
