#!/usr/bin/python3 -B
"""The page in headless Chromium, beside the command line.

usage: test_page.py [WORD]...    tests whose names contain one of the words

BUILD is the folder with page/index.html and double/twofold, which `make
test-page` makes. The pictures are left in BUILD/page."""
import os
import sys

import page
import test_board
import test_futures
import test_looks
import test_motion
import test_owners
import test_scene
import test_setup
import test_tour
from tap import run


def main():
    if not page.PROGRAM:
        print("missing: chromium (apt-get install chromium)")
        return 3
    return run([(name[5:], page.alone(test)) for room in (
        test_motion, test_owners, test_futures, test_setup, test_scene,
        test_looks, test_tour, test_board) for name, test in vars(room).items()
        if name.startswith("test_")], jobs=len(os.sched_getaffinity(0)))


if __name__ == "__main__":
    sys.exit(main())
