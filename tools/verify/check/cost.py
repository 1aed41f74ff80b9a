#!/usr/bin/python3 -B
"""The most expensive calls of the public functions that were ever found
(tools/verify/cost/worst.*) are counted again, and a short search goes on from
them: none takes more than bounds.SLACK times the figure of docs/bench/worst.csv
and no figure is more than bounds.STALE times what its call takes now. The steps
among them are counted on boards, too, in the emulator. A public function has a
kept call, or is plain; each is named in a test.
EVALUATIONS calls of each function (300; with FULL=yes 20000).
"""
import os
import platform
import re
import sys
from pathlib import Path

from findings import (BUILD, FULL, ROOT, build, checked, need,
                      public_functions, wrong)

sys.path.insert(0, str(ROOT / "tools/verify/cost"))
import bounds  # noqa: E402

# Look-ups, and straight code: loops run as often whatever is given, but for
# those of a kept function that it calls.
PLAIN = re.compile(r"""tf_(?:\w+_name|wire_\w+|send_\w+|read_\w+|slip|energy|
    decoder_init|link_open|link_(?:add_entropy|begin_session)|params_hash|
    mode_is_slip|is_vouched_for|run_hash|line_\w+|frame_chain|
    tyre_is_set_valued|contacts?_(?:prepare|modes|choose|force)|philox|
    step_located_changes|
    input_default|turntable_to|speed_for_slip(?:_compensated)?|tally_count|
    ensemble_(?:run|put|get|report)|arithmetic|design_two_fold|
    begin_with_slip|scene_start|
    simulation_(?:set_input|pass|start|open))""", re.X)
EVALUATIONS = int(os.environ.get("EVALUATIONS") or (20000 if FULL else 300))
PLACE = BUILD / "costs"
FIGURES = bounds.kept()


def judge(column, now):
    """Figures that are kept, and what calls take now."""
    was, now = FIGURES[column].dropna(), bounds.named(now).dropna()
    for key in was.index.union(now.index):
        figure, count = was.get(key, 0), now.get(key, 0)
        if count > bounds.SLACK * figure or count < figure / bounds.STALE:
            wrong(f"{key[0]}({key[1]}), {column}: {figure:.0f} instructions "
                  f"are kept, a call takes {count:.0f}")


def judge_real(real):
    """All calls in one real type. Returns: how many functions."""
    path = BUILD / f"cost.{real}"
    path.write_text(bounds.Calls(PLACE, real, bounds.HERE).search(EVALUATIONS))
    now = bounds.most(path)
    names = set(now.index.unique("name"))
    for name in sorted(public_functions() - names):
        if not PLAIN.fullmatch(name):
            wrong(f"{name}: no call of it is kept in worst.{real}")
    judge(f"x86-64 {real}", now)
    return len(names)


need("gcc", "gcc")
need("arm-none-eabi-gcc", "gcc-arm-none-eabi libnewlib-arm-none-eabi")
need("qemu-system-arm", "qemu-system-arm")
if platform.machine() != "x86_64":
    print("missing: a processor of type x86-64, of which the figures speak")
    sys.exit(3)
if not build("CC=gcc", f"BUILD={PLACE}", "OPT=-O2", "EXTRA=-Werror",
             *(PLACE / real / "cost" for real in bounds.REALS)):
    wrong("tools/verify/cost does not build")
    checked("nothing")
functions = max(judge_real(real) for real in bounds.REALS)
for board, counts in bounds.emulate(PLACE, bounds.HERE).items():
    judge(board, counts)
tests = "\n".join(path.read_text() for path in Path("tests").rglob("*.[ch]"))
for one in sorted(public_functions()):
    if not re.search(rf"\b{one}\b", tests):
        wrong(f"{one}: is named in no test")
checked(f"{functions} functions, {EVALUATIONS} calls each beside the most "
        "expensive known; gcc -O2, both real types; steps on two boards; each "
        "public function is named in a test")
