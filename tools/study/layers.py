"""The picture of `make finer`: what decides, over the width; and where motions
leave."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pictures
from pictures import pyplot

if TYPE_CHECKING:
    from finer import Study


def draw(study: Study, path: Path) -> None:
    """Both panels."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    exact = study.exact.reset_index()
    for form, rows in exact.groupby("form", sort=False):
        decided = rows.dropna(subset="disturbance")
        left.loglog(decided.effective, decided.disturbance, "o-", ms=3, lw=0.8,
                    label=form)
        out = rows[rows.side != 0]
        right.semilogx(out.effective, 1e3 * out.exit_r, "-", lw=0.6,
                       color="0.4")
    left.loglog(study.turned.width, study.turned.high, "s", ms=6, mfc="none",
                color="black", label="turns the exit")
    for bits, name in (24, "float"), (53, "double"), (64, "x87"):
        rows = study.of("bits", bits=bits).dropna(subset="disturbance")
        if len(rows):
            left.loglog(rows.effective, rows.disturbance, "x", ms=3,
                        color="0.5")
            left.annotate(name, (rows.effective.iloc[-1],
                                 rows.disturbance.iloc[-1]), fontsize=8)
    left.set(xlabel="effective width [m/s]",
             ylabel="kick at the two-fold that decides, from E [m/s]",
             title="binary128: the motion itself; grey: rounding")
    left.legend(fontsize=7)
    kicked = study.of("kicked")
    for kick, mark, alpha in (1e-8, "s", 0.25), (1e-12, "o", 0.6):
        for side, colour in (1, "#D55E00"), (-1, "#E69F00"):
            rows = kicked[(kicked.n == kick) & (kicked.side == side)]
            right.semilogx(rows.effective, 1e3 * rows.exit_r, mark, ms=3,
                           color=colour, alpha=alpha)
    right.axhline(1e3 * study.fold.r, lw=0.6, color="black")
    right.set(xlabel="effective width [m/s]", ylabel="r at the exit [mm]",
              title="lines: undisturbed; kicks of 1e-12 (o), 1e-8 (square)")
    pictures.save(figure, path, 90)
