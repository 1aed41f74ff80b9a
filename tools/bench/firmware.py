"""The sections of the boards: sizes, with their check."""
import itertools
import os
import re
from typing import Iterable, Optional

import numpy as np
import pandas as pd

import driven
from boards import Board, Firmware, boards, plugin
from measure import (BUILD, COLUMNS, KEPT, OUT, REALS, load, problems, save,
                     say)

TABLE = KEPT / "sizes.csv"
FIRMWARE = ["board", "real", "scene"]
HELD = ["flash", "ram", "stack"]
COUNTED = ["painted", "least", "median", "most"]
SCENES = ("generic chaos gamma_zero gamma_right coulomb frictionless smooth "
          "rolling string driven").split()
PAINTED_STEPS = 2000
MOST = 0.02  # that a figure may grow
# Of each compiler and of each kind of memory that is short, about a minute.
FEW = [("uno", "float", "string"), ("mega", "float", "driven"),
       ("microbit", "float", "generic"), ("stm32f405", "float", "chaos"),
       ("stm32f405", "double", "generic"), ("hifive1", "float", "driven"),
       ("rv32fd", "double", "chaos")]


def here(names: Iterable[str]) -> Iterable[Board]:
    """Those boards whose compiler is."""
    for board in map(Board, names):
        if missing := board.missing():
            say(f"skipped {board.name}: {missing}")
        else:
            yield board


def all_firmware(names: list[str]) -> Iterable[Firmware]:
    """Of each board whose compiler is here: what it has room for."""
    for board in here(names or boards()):
        if not board.tool("") and board.name != "host" or \
                re.match("qemu-(?!system)", board.fact("RUN")):
            continue  # no file of sections to ask, or no board
        room = board.fact("SCENES").split() or SCENES
        for real in board.fact("REALS").split() or REALS:
            for scene in SCENES:
                if scene in room and not (scene == "generic" and
                                          board.fact("SMALL")):
                    yield Firmware(board, real, scene)


def measure(names: list[str]) -> pd.DataFrame:
    """Sizes, and instructions of a step in the emulator, in a table of their
    own, in which boards that were not asked keep their lines."""
    steps = int(os.environ.get("STEPS") or 30000)
    counter, found = plugin(), []
    for one in driven.shown([*all_firmware(names)]):
        sizes = one.sizes()
        if isinstance(sizes, str):
            say(f"{one}: does not build: {sizes}")
            continue
        counts = one.instructions(counter, steps) or [None] * 3
        found.append([one.board.name, one.real, one.scene, *sizes[:3],
                      one.painted(PAINTED_STEPS), *counts])
        say(" ".join("-" if n is None else str(n) for n in found[-1]))
    table = pd.DataFrame(found, columns=[*FIRMWARE, *HELD, *COUNTED])
    core, (of, old) = driven.output("tools/stamp", "core").strip(), load(TABLE)
    if names:
        core = f"{of[0]} {', '.join(names)}: {core}"
    whole = pd.concat([old[~old.board.isin(table.board)], table])
    save(OUT / TABLE.name, [core],
         whole.sort_values("board", kind="stable").convert_dtypes())
    return pd.DataFrame()


def grown(one: Firmware, kept: pd.DataFrame) -> list[str]:
    """What has grown by more than may be, and by how much."""
    row = kept[(kept.board == one.board.name) & (kept.real == one.real)
               & (kept.scene == one.scene)]
    sizes = one.sizes()
    if isinstance(sizes, str):
        return [f"{one}: does not build or has no room:\n{sizes}"]
    if len(row) != 1:
        return [f"{one}: {TABLE} has no row of it"]
    said = []
    for name, now in zip(HELD, sizes):
        before = row[name].iloc[0]
        if now is None or pd.isna(before):
            continue
        if now > before * (1 + MOST):
            said.append(f"{one}: {name} {before:.0f} -> {now} B, "
                        f"{100 * (now / before - 1):+.1f} %")
    return said


def check(every: bool) -> int:
    """Compares with the table. Returns: an exit code."""
    (_, kept), wrong, seen = load(TABLE), [], 0
    for one in all_firmware([] if every else
                            list(dict.fromkeys(few[0] for few in FEW))):
        if every and one.board.name == "host":
            continue  # its C library is the machine's
        if every or (one.board.name, one.real, one.scene) in FEW:
            wrong += grown(one, kept)
            seen += 1
    for text in wrong:
        print(text)
    print(f"sizes: {seen} firmwares, {len(wrong)} figures above {TABLE} by "
          f"more than {100 * MOST:.0f} %")
    if wrong:
        print("If that is meant: tools/run bench sizes && make keep-bench, and "
              "the commit says why.")
    return 1 if wrong or not seen else 0


def stack_of(board: str, real: str, scene: str) -> list[Optional[int]]:
    """Worst of main, an interrupt's and painted; None without an emulator."""
    one = Firmware(Board(board), real, scene)
    painted = one.painted(int(os.environ.get("STEPS") or 2000))
    return [None] * 3 if painted is None else [*one.stack(), painted]


# Problems of problem.c, by what differs from scene `chaos`.
RACED = {"chaos": "",
         "crossings": "beta 0.3\nk2 30\nmu 0.2\nr 0.6\nomega 0.5\nh -0.01\n",
         "stickslip": "beta 0.2\nk2 20\nmu 3\nr 0.5\nomega -0.8\nh -0.01\n"}
RACERS = {("stm32f405", "float"): 168e6, ("stm32f405", "double"): 168e6,
          ("microbit", "float"): 16e6, ("mega", "float"): 16e6}  # [Hz]
# Scheme, step [s] and tolerance; in float nothing below 8e-6 is asked for.
PLAIN = [("moreau", dt, 0) for dt in (1e-2, 2e-3, 4e-4, 1e-4)]
SETTINGS = {
    "float": [*PLAIN, ("compensated", 4e-4, 0), ("compensated", 1e-4, 0),
              ("located", 1e-2, 1e-3), ("located", 1e-2, 1e-5)],
    "double": [*PLAIN, *(("located", 1e-2, tolerance)
                         for tolerance in (1e-3, 1e-5, 1e-8))]}


def scene_of(name: str, text: str) -> str:
    """A file of a scene that differs from `chaos`."""
    path = BUILD / "scenes" / f"{name}.scene"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"based-on chaos\n{text}", encoding="ascii")
    return str(path)


def race(names: list[str]) -> pd.DataFrame:
    """Error at the end of three problems, and instructions of a simulated
    second, by scheme and step; and how many steps a second the board carries at
    its clock if an instruction takes a cycle, by the dearest one."""
    counter, rows, ends = plugin(), [], problems()
    for (name, real), clock in RACERS.items():
        board = next(iter(here([name])), None)
        if not board or names and name not in names:
            continue
        for problem, (i, (scheme, dt, tolerance)) in itertools.product(
                RACED, enumerate(SETTINGS[real])):
            length, *end = ends.loc[problem]
            scene = scene_of(f"{problem}_{real}_{i}",
                             f"{RACED[problem]}dt {dt}\n"
                             + f"tolerance {tolerance}\n" * (tolerance > 0))
            found = Firmware(board, real, scene).windows(
                counter, round(length / dt), scheme)
            if found is None:
                say(f"{name} {real} {scheme}: nothing was counted")
                continue
            costs, now = found
            dial = f"tol={tolerance:.0e}" if tolerance else f"dt={dt:.3e}"
            rows.append([problem, f"{name} {real} {scheme}", dial,
                         np.abs(np.subtract(now, end)).max(), None,
                         costs.sum() / length,
                         f"carries {clock / costs.max():.0f} Hz"])
            say(rows[-1])
    return pd.DataFrame(rows, columns=COLUMNS)
