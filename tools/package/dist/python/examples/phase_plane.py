#!/usr/bin/python3
"""Draws the phase plane (r, omega) of scene `chaos`, coloured by the mode of
contact: phase_plane.py [FILE.png]"""
import sys

import matplotlib

matplotlib.use("Agg")

import twofold

axes = twofold.simulate("chaos", t_end=10, every=10).plot("r", "omega")
path = sys.argv[1] if len(sys.argv) > 1 else "phase_plane.png"
axes.figure.savefig(path, dpi=150)
print(f"The phase plane is in {path}.")
