"""The sections of the boards: sizes, with their check, and budgets."""
from __future__ import annotations

import os
from typing import Iterable, Optional

import pandas as pd

import driven
from boards import Board, Firmware, boards, plugin
from measure import (BUILD, COLUMNS, KEPT, OUT, REALS, load, save,
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


def all_firmware(names: list[str]) -> Iterable[Firmware]:
    """Of each board whose compiler is here: what it has room for."""
    for board in map(Board, names or boards()):
        if missing := board.missing():
            say(f"skipped {board.name}: {missing}")
            continue
        if not board.tool("") and board.name != "host":
            continue  # no file of sections to ask
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
    for one in all_firmware(names):
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
        print("If that is meant: tools/bench/run sizes && make keep-bench, and "
              "the commit says why.")
    return 1 if wrong or not seen else 0


def print_stack(board: str, real: str, scene: str) -> None:
    """Worst of main, an interrupt's and painted, "-" for what cannot be had."""
    one = Firmware(Board(board), real, scene)
    sizes = one.sizes()
    figures: list[Optional[int]] = [None, None]
    if not isinstance(sizes, str):
        figures = [sizes.stack, sizes.interrupt]
    figures.append(one.painted(int(os.environ.get("STEPS") or 2000)))
    print(*("-" if one is None else one for one in figures))


def budgets(names: list[str]) -> pd.DataFrame:
    """Instructions of a step of 1 ms of `chaos`: plain, and located within
    budgets of segments."""
    steps, counter = int(os.environ.get("STEPS") or 10000), plugin()
    rows: list[list[object]] = []
    work = BUILD / "budgets"
    work.mkdir(parents=True, exist_ok=True)
    for board in map(Board, names or ["stm32f405", "mps2-an500"]):
        if missing := board.missing():
            say(f"skipped {board.name}: {missing}")
            continue
        for real in REALS:
            for budget in 0, 1, 2, 4, 8:
                scene = work / f"budget_{budget}.scene"
                scene.write_text("based-on chaos\ndt 0.001\n"
                                 + f"segments {budget}\n" * (budget > 0),
                                 encoding="ascii")
                counts = Firmware(board, real, str(scene)).instructions(
                    counter, steps, "located" if budget else "moreau")
                if counts is None:
                    say(f"{board.name} in {real}: nothing was counted")
                    continue
                solver = f"located segments={budget}" if budget else "moreau"
                rows += [["chaos", f"{board.name} {real}", f"{solver}: {name}",
                          None, None, count, ""] for name, count
                         in zip(("least", "median", "most"), counts)]
    return pd.DataFrame(rows, columns=COLUMNS)
