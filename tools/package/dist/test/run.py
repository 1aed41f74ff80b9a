#!/usr/bin/python3 -B
"""Tests of the packages, each as its user would try it: run.py [WORD...], those
whose names contain one of the words, as many at a time as there are processors.
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
sys.exit(run([*in_c.TESTS.items(), *installed.TESTS.items(),
              *in_python.TESTS.items(), *for_boards.TESTS.items()],
             jobs=len(os.sched_getaffinity(0))))
