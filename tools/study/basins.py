"""Of `make recurrence`: what share of starts reaches the two-fold.

Starts lie on a grid over (r, omega), on both sides of h = 0; each is followed
by `twofold sweep` until it reaches the two-fold, or for 20 s. Of scene `chaos`
the grid has SIDE by SIDE points; of DESIGNS of those around `chaos` that were
followed, spread over all, 8 by 8.
"""
import os
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

import driven
import pictures
import space
import table
from pictures import pyplot

SIDE = int(os.environ.get("SIDE") or 100)
DESIGNS = int(os.environ.get("DESIGNS") or 300)
R, OMEGA, H = (-0.5, 0.5), (-2.5, 0.5), (0.05, -0.05)
TIMES = 5, 10, 20  # [s]


def arrivals(twofold: str, side: int, h: float, until: float,
             *words: str) -> np.ndarray:
    """The first arrival of each start [s], infinite where there is none; rows
    are those of r."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "starts.csv")
        driven.output(
            twofold, "sweep", "chaos", *words, "--set", f"h={h}", "--set",
            "dt=1e-3", "--over", f"r={R[0]}:{R[1]}:{side}", "--over",
            f"omega={OMEGA[0]}:{OMEGA[1]}:{side}", "--scheme", "located",
            "--t-end", str(until), "--outcome", "arrival", "--out", path,
            stderr=-3)
        found = table.read(path, ["arrival"], counted=True)["arrival"]
    return found.fillna(np.inf).to_numpy(float).reshape(side, side)


def follow(work: Path, twofold: str, rows: pd.DataFrame) -> None:
    """Arrivals of both grids of `chaos`, and the share of the starts of each
    of some machines."""
    rows = rows.iloc[np.unique(np.linspace(
        0, len(rows) - 1, min(DESIGNS, len(rows))).astype(int))]

    def of_machine(row: pd.Series) -> float:
        words = [f"--set={name}={float(row[name])!r}"
                 for name in ("kappa", "k2")]
        return float(np.mean([arrivals(twofold, 8, h, TIMES[-1], *words)
                              < np.inf for h in H]))

    found = driven.side_by_side(
        lambda h: arrivals(twofold, SIDE, h, TIMES[-1]), H)
    shares = driven.side_by_side(of_machine, [row for _, row in
                                              rows.iterrows()])
    np.savez(work / "basins.npz", *found, shares=shares,
             classes=rows.became.to_numpy(str))


def draw(path: Path, chaos: list[np.ndarray]) -> None:
    """Time over the starts of `chaos`."""
    figure, panels = pyplot.subplots(1, 2, figsize=(9, 4.2))
    for axes, h, found in zip(panels, H, chaos):
        shown = axes.imshow(np.ma.masked_invalid(found).T, origin="lower",
                            extent=(*R, *OMEGA), aspect="auto", vmin=0,
                            vmax=10, cmap="viridis_r")
        axes.set(title=f"chaos, h = {h} m/s", xlabel="r [m]",
                 ylabel="omega [rad/s]")
        axes.plot(*space.CHAOS, "+", color="red", ms=9)
    figure.colorbar(shown, ax=panels[1], label="time to the two-fold [s]")
    pictures.save(figure, path, 100)


def count(work: Path, kept: Path) -> None:
    """How many starts arrive within a time; and of the designs the shares."""
    found = np.load(work / "basins.npz")
    grids = [found[f"arr_{i}"] for i in range(2)]
    of = {one: found["shares"][found["classes"] == one] for one in
          space.CLASSES}
    draw(kept / "basins.png", grids)
    pd.DataFrame([
        {"h": h, "starts": grid.size, **{
            f"within_{t}": (grid <= t).sum() for t in TIMES}}
        for h, grid in zip(H, grids)]).to_csv(
            kept / "recurrence-basins.csv", index=False)
    pd.DataFrame([
        {"designs": one, "number": len(shares), "mean":
         f"{shares.mean():.3f}", **{name: f"{x:.3f}" for name, x in zip(
             ("least", "median", "largest"), np.quantile(shares, [0, .5, 1]))}}
        for one, shares in of.items() if len(shares)]).to_csv(
            kept / "recurrence-designs.csv", index=False)


def parts(kept: Path) -> dict[str, str]:
    """What the page has of it."""
    chaos = table.read(kept / "recurrence-basins.csv")
    designs = table.read(kept / "recurrence-designs.csv")
    return {
        "basins": table.markdown(
            ["`chaos`", "starts", *(f"within {t} s" for t in TIMES)],
            [[f"h = {row.h} m/s", f"{row.starts:.0f}", *(
                table.share(k, row.starts).text(3) for k in row[2:])]
             for _, row in chaos.iterrows()]),
        "designs": table.markdown(
            ["designs", "number", "mean share", "least", "median", "largest"],
            [[row.designs, row.number, *(f"{x:.3f}" for x in row[2:])]
             for _, row in designs.iterrows()])}
