#!/usr/bin/python3 -B
"""The page in headless Chromium, beside the command line.

usage: test_page.py [WORD]...    tests whose names contain one of the words

BUILD is the folder with page/index.html and double/twofold, which `make
test-page` makes. The pictures are left in BUILD/page."""
import sys

import page
import test_board
import test_futures
import test_looks
import test_motion
import test_scene
import test_setup
from tap import run


def main():
    if not page.PROGRAM:
        print("missing: chromium (apt-get install chromium)")
        return 3
    return run([(test.__name__, page.alone(test)) for test in
                test_motion.TESTS + test_futures.TESTS + test_setup.TESTS
                + test_scene.TESTS + test_looks.TESTS + test_board.TESTS])


if __name__ == "__main__":
    sys.exit(main())
