#!/usr/bin/python3 -B
"""Where the two-fold of case 1 is, as gnuplot assignments.

usage: twofold singularities SCENE | two_fold.py
"""
import json
import sys


def main() -> int:
    for place in json.load(sys.stdin)["two_folds"]:
        if place["case"] == 1:
            print(f"r_star = {place['r']}\nw_star = {place['omega']}")
            return 0
    print("two_fold.py: the scene has no two-fold of case 1", file=sys.stderr)
    return 3


if __name__ == "__main__":
    sys.exit(main())
