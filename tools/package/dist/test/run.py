#!/usr/bin/python3 -B
"""Tests of the packages, each as its user would try it: run.py [WORD...], those
whose names contain one of the words."""
import sys

import for_boards
import in_c
import in_python
import installed
from tap import run

sys.exit(run([*in_c.TESTS.items(), *installed.TESTS.items(),
              *in_python.TESTS.items(), *for_boards.TESTS.items()]))
