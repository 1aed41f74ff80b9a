#!/usr/bin/python3 -B
"""The page in headless Chromium, beside the command line.

usage: test_page.py [WORD]...    tests whose names contain one of the words

BUILD is the folder with page/index.html and double/twofold, which `make
test-page` makes. The pictures are left in BUILD/page."""
import importlib
import os
import sys

import page
from tap import ROOT, run


def main():
    if not page.PROGRAM:
        print("missing: chromium-headless-shell (apt-get install it)")
        return 3
    rooms = sorted(path.stem for path in ROOT.glob("tests/page/test_*.py")
                   if path.stem != "test_page")
    return run([(name[5:], page.alone(test)) for room in rooms
                for name, test in vars(importlib.import_module(room)).items()
                if name.startswith("test_")],
               jobs=len(os.sched_getaffinity(0)))


if __name__ == "__main__":
    sys.exit(main())
