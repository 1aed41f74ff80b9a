#!/usr/bin/python3 -B
"""Tests under valgrind's memcheck: what the sanitizers of gcc do not see is a
decision by a value that was never set. These are the quick tests below in
double, of the line, the session, the step and what is beside it; with FULL=yes
(`make valgrind`) every program in both real types. Those that are not done in
LIMIT seconds, as orbits of 1e6 steps and sweeps of random machines, are stopped
and named. The programs are those of check `gcc`.
"""
import os
import subprocess
import sys
from pathlib import Path

from findings import (DEFINES, FULL, asked, checked, in_common, need, place_of,
                      wrong)
import driven

# Program, or program:test.
FEW = """unit/link/test_protocol unit/link/test_link unit/link/test_text
  unit/scene/test_simulation unit/scene/test_scene unit/model/test_prepare
  unit/friction/test_select unit/friction/test_slip_residual
  unit/link/test_frame:frames_survive_the_line
  unit/link/test_frame:long_runs_stay_in_the_buffer
  unit/link/test_frame:lost_frames_are_counted
  unit/link/test_frame:other_versions_and_lengths_are_counted
  unit/moreau/test_begin:begin_at_codimension_two_has_every_future
  unit/moreau/test_ensemble:ensemble_of_any_size
  law/test_located_report:located_residual_is_that_of_the_law
  law/test_located_report:located_event_at_the_end_of_a_step
  law/test_extremes:overflow_of_a_slope_keeps_every_number_finite
  regress/test_no_friction
  regress/test_degraded:degraded_step_reports_the_consistent_set""".split()
ROOM = place_of("gcc", "-O3")
LIMIT = os.environ.get("LIMIT") or "60"
MEMCHECK = ["valgrind", "-q", "--error-exitcode=99"]


def run(real, test):
    """Whether a test was stopped; what is found is printed."""
    program, _, name = test.partition(":")
    only = ["--only", name] if name else []
    said, code = asked(
        "timeout", LIMIT, *MEMCHECK, "--leak-check=full",
        ROOM / real / "tests" / program, *only, stdin=subprocess.DEVNULL,
        stderr=subprocess.STDOUT)
    lines = said.splitlines()
    if code not in (0, 124) or any(line.startswith("==") for line in lines):
        wrong("\n".join([f"{real}: {test}: found by memcheck, or failed",
                         *lines[-40:]]))
        return False
    if code == 124:
        print(f"stopped after {LIMIT} s, nothing found: {real} {test}")
    return code == 124


need("valgrind", "valgrind")
tests, reals = FEW, ["double"]
if FULL:
    reals = list(DEFINES)
    tests = sorted(str(path.relative_to("tests").with_suffix(""))
                   for path in Path("tests").rglob("test_*.c"))
runs = [(real, test) for real in reals for test in tests]
if not in_common("gcc", "-O3", *sorted({
        f"{ROOM}/{real}/tests/{test.partition(':')[0]}"
        for real, test in runs})):
    sys.exit(1)
stopped = sum(driven.side_by_side(lambda pair: run(*pair), runs))
if stopped == len(runs):
    wrong("nothing was done in time")
checked(f"{len(runs)} runs of tests under memcheck, {' and '.join(reals)}; "
        f"{stopped} stopped after {LIMIT} s")
