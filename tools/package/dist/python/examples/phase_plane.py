#!/usr/bin/python3
"""Draws the phase plane (r, omega) of scene `chaos`, coloured by the mode of
contact: phase_plane.py [FILE.png]"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import twofold

rows = twofold.Machine("chaos").run(t_end=10, every=10)
figure, axes = plt.subplots(figsize=(6, 4.5))
for index, name in enumerate(twofold.MODES):
    part = rows[rows["mode"] == index]
    if part.size:
        axes.plot(part["r"], part["omega"], ".", markersize=1, label=name)
axes.set(xlabel="r [m]", ylabel="omega [rad/s]")
axes.legend(markerscale=8)
figure.tight_layout()
path = sys.argv[1] if len(sys.argv) > 1 else "phase_plane.png"
figure.savefig(path, dpi=150)
print(f"The phase plane is in {path}.")
