#!/usr/bin/python3 -B
"""Tests of the packages, each as its user would try it: run.py [NAME...]. What
a test needs and does not find is named, with its package; such a test counts
neither as passed nor as failed. The last line is the sum."""
import os
import sys

import for_boards
import in_c
import in_python
import installed
from harness import Missing, Wrong

TESTS = {**in_c.TESTS, **installed.TESTS, **in_python.TESTS,
         **for_boards.TESTS}


def main(names):
    for name in names:
        if name not in TESTS:
            sys.exit(f"no test is named {name}; there are: {' '.join(TESTS)}")
    passed, failed, missing = 0, 0, 0
    for name in names or TESTS:
        try:
            TESTS[name]()
        except Missing as error:
            missing += 1
            print(f"missing  {name}: {error}")
        except (Wrong, OSError) as error:
            failed += 1
            print(f"FAILED   {name}: {error}")
        else:
            passed += 1
            print(f"ok       {name}")
        sys.stdout.flush()
    if missing:
        print(f"{missing} not tried, because what is named above is missing")
    print(f"{passed} passed, {failed} failed")
    # Where .ci/required holds, nothing may be missing.
    sys.exit(failed > 0 or passed == 0
             or (missing > 0 and "REQUIRED" in os.environ))


main(sys.argv[1:])
