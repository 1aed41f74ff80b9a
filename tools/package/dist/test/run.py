#!/usr/bin/python3 -B
"""Tests of the packages, each as its user would try it, the longest first:
run.py [WORD...], those whose names contain one of the words.
"""
import os
import sys

import for_boards
import in_c
import installed
from harness import REALS, ROOT, ends_at
from tap import run

sys.path.append(str(ROOT / "tests/package"))
import in_python  # noqa: E402

for real in REALS:
    ends_at(real)  # before tests that share it go their ways
sys.exit(run([(name[5:].replace("_", "-"), test)
              for room in (in_python, in_c, installed, for_boards)
              for name, test in vars(room).items() if name.startswith("test_")],
             jobs=len(os.sched_getaffinity(0))))
