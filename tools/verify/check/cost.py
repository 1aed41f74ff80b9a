#!/usr/bin/python3 -B
"""The most expensive calls of the public functions that were ever found
(tools/verify/cost/worst.*) are counted again, and a short search goes on from
them: none takes more than bounds.SLACK times the kept figure, no figure is more
than bounds.STALE times what its call takes now, and docs/bench/worst.csv has
the figures. A public function has a kept call, or is plain; each is named in a
test. EVALUATIONS calls of each function (300; with FULL=yes 20000).
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

# Look-ups, and straight code: loops run as often whatever is given.
PLAIN = re.compile(r"""tf_(?:\w+_name|wire_\w+|send_\w+|read_\w+|slip|energy|
    decoder_init|link_open|link_(?:add_entropy|begin_session)|params_hash|
    mode_is_slip|run_hash|line_\w+|frame_(?:tag|untag)|tyre_is_set_valued|
    philox|input_default|speed_for_slip|ensemble_(?:put|get|report)|
    tally_count|simulation_(?:set_input|pass))""", re.X)
EVALUATIONS = int(os.environ.get("EVALUATIONS") or (20000 if FULL else 300))
PLACE = BUILD / "costs"


def judge(real):
    """All calls in one real type. Returns: how many functions."""
    kept = bounds.most(bounds.HERE / f"worst.{real}")
    if real == "double":
        kept_names = set(kept.index.unique("name"))
        for name in sorted(public_functions() - kept_names):
            if not PLAIN.fullmatch(name):
                wrong(f"{name}: no call of it is kept in worst.{real}")
    path = BUILD / f"cost.{real}"
    path.write_text(bounds.cost(PLACE, real, EVALUATIONS, bounds.HERE))
    now = bounds.most(path)
    for (name, units), count in now.items():
        figure = kept.get((name, units), 0)
        if count > bounds.SLACK * figure or count < figure / bounds.STALE:
            wrong(f"{name}({units}), {real}: {figure} instructions are kept, a "
                  f"call takes {count}")
    return len(kept.index.unique("name"))


need("gcc", "gcc")
if platform.machine() != "x86_64":
    print("missing: a processor of type x86-64, of which the figures speak")
    sys.exit(3)
if not build("CC=gcc", f"BUILD={PLACE}", "OPT=-O2", "EXTRA=-Werror",
             *(PLACE / real / "cost" for real in bounds.REALS)):
    wrong("tools/verify/cost does not build")
    checked("nothing")
functions = max(judge(real) for real in bounds.REALS)
tests = "\n".join(path.read_text() for path in Path("tests").rglob("*.[ch]"))
for one in sorted(public_functions()):
    if not re.search(rf"\b{one}\b", tests):
        wrong(f"{one}: is named in no test")
if bounds.table(bounds.HERE).to_csv() != \
        Path("docs/bench/worst.csv").read_text().split("\n", 1)[1]:
    wrong("docs/bench/worst.csv has other figures than are kept: make bounds "
          "&& make keep-bounds")
checked(f"{functions} functions, {EVALUATIONS} calls each beside the most "
        "expensive known; gcc -O2, both real types; each public function is "
        "named in a test")
