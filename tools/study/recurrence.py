"""`make recurrence`: where in the space of machines the motion returns to its
two-fold, docs/RECURRENCE.md.

What the machines are, and how each is followed: space.py. A machine is
*lasting* where every cycle that was followed returned, in the first pass and
in the long one, *partly* where some did, *never* where none did; where some did
not, the pass that waits decides. Shares have Wilson's 95 % interval.
"""
import json
import math
import sys
import time
import zlib
from collections import Counter
from pathlib import Path
from typing import Iterator, Optional, Sequence

import numpy as np
import pandas as pd
from scipy import ndimage

import driven
import maps
import space
import table
from space import (CLASSES, ENDINGS, LOST, PASSES, SPACES, USUAL, WAIT,
                   classes, ends, most)

PAGE = "docs/RECURRENCE.md"
PART = 100  # machines
REASONS = "no design", "not case 1", "not followed"
RATIOS = 1, 2, 3, 4, 6, 8, 16, 32, 2048
REGION = ("space", "lasting", "r_low", "r_high", "omega_low", "omega_high",
          "chaos")
FEWEST = 3  # machines of a region that is listed


# Following.

class Twofold:
    """The command line."""

    def __init__(self, program: str) -> None:
        self.program = program

    def cycles(self, words: list[str], patience: int
               ) -> Optional[Counter[str]]:
        """The number of cycles by how they ended, and of late ones; None where
        the two-fold cannot be followed. What diverge calls `timeout` is told
        by what came before it."""
        text = table.said(self.program, *words, "--returns", "-")
        if text is None:
            return None
        count: Counter[str] = Counter()
        for cycle in table.parsed(text.encode()).itertuples():
            end = cycle.outcome
            if end == "timeout":
                end = "landed" if cycle.landings > 0 else \
                    "sticking" if math.isnan(cycle.exit_r) else "slipping"
            count[end] += 1
            count["late"] += end == "returned" and cycle.time > patience / 2
        return count

    def row(self, number: int) -> dict[str, object]:
        """What becomes of a machine; what is not known is left out."""
        name, r, omega, settings = space.drawn(number)
        found = {"machine": number, "space": name, "r": r, "omega": omega,
                 **settings}
        text = table.said(
            self.program, "design", "chaos", *space.set_words(settings),
            "--r", repr(r), f"--omega={omega!r}")
        if text is None:
            return {**found, "reason": "no design"}
        design = json.loads(text)
        fold = design["two_fold"]
        settings.update(kappa=design["kappa"], k2=design["k2"])
        found.update(settings)
        if fold["case"] != 1 or not fold["directions"][0]["sticks"]:
            return {**found, "reason": "not case 1"}
        found["ratio"] = fold["eigenvalues"][1] / fold["eigenvalues"][0]
        found["seed"] = space.seed_of(number, "first")
        for name, run in PASSES.items():
            count: Optional[Counter[str]] = Counter()
            if space.is_followed(name, lambda other: [
                    found[f"{other}_{end}"] for end in ENDINGS]):
                count = self.cycles(space.follow_words(
                    name, settings, space.seed_of(number, name)), run.patience)
            if count is None:
                return {**found, "reason": "not followed"}
            found.update((f"{name}_{what}", count[what])
                         for what in (*ENDINGS, "late"))
        return found


def line_of(found: dict[str, object]) -> str:
    return ",".join(str(found.get(name, "")) for name in space.COLUMNS)


def follow(work: Path, twofold: str) -> None:
    """All machines, in parts that end with a line that counts their rows; one
    that is whole is not done again. Then recurrence.csv."""
    program = Twofold(twofold)
    parts = math.ceil(space.MACHINES / PART)
    run = zlib.crc32(repr((
        space.MACHINES, space.SEED, SPACES, space.DRAWN, space.GAMMA, PASSES,
        space.COLUMNS, table.said(twofold, "--version"))).encode())
    begin, done = time.time(), 0

    def part(i: int) -> None:
        nonlocal done
        path = work / f"{i}.csv"
        if not path.exists() or not path.read_text("ascii").endswith(
                f", run {run:08x}\n"):
            head = [",".join(space.COLUMNS)] if i == 1 else []
            rows = [line_of(program.row(number)) for number in range(
                PART * (i - 1), min(PART * i, space.MACHINES))]
            text = "".join(f"{line}\n" for line in head + rows)
            text += (f"# shard {i}/{parts}: {len(rows)} rows, crc32 "
                     f"{zlib.crc32(text.encode()):08x}, run {run:08x}\n")
            beside = path.with_suffix(".part")
            beside.write_text(text, "ascii")
            beside.rename(path)
        done += 1
        took = time.time() - begin
        print(f"  {done} of {parts} parts after {took:.0f} s, "
              f"{took * (parts - done) / done:.0f} s left", file=sys.stderr)

    driven.side_by_side(part, range(1, parts + 1))
    (work / "recurrence.csv").write_text(
        "".join((work / f"{i}.csv").read_text("ascii")
                for i in range(1, parts + 1)), "ascii")


def show(number: int, twofold: str) -> None:
    """A machine, as a row and as commands."""
    found = Twofold(twofold).row(number)
    print(",".join(space.COLUMNS), line_of(found), sep="\n")
    if "reason" in found:
        return
    settings = {name: found[name] for name in (*space.SETTINGS, "kappa", "k2")
                if name in found}
    for name in PASSES:
        print(twofold, *space.follow_words(name, settings,
                                           space.seed_of(number, name)))


# Counting.

def rows_of(work: Path) -> pd.DataFrame:
    return table.read(work / "recurrence.csv", space.COLUMNS, counted=True)


def followed_of(work: Path) -> pd.DataFrame:
    """Machines that were followed, with their classes."""
    rows = rows_of(work)
    rows = rows[rows.reason.isna()]
    return rows.assign(became=classes(rows))


def per_space(rows: pd.DataFrame, followed: pd.DataFrame
              ) -> Iterator[dict[str, object]]:
    """What became of the machines of a space, and of how many the long pass
    loses cycles of which the first one loses none."""
    for name in SPACES:
        drawn, here = (one[one.space == name] for one in (rows, followed))
        above = drawn[drawn.omega >= space.OMEGA0]
        first, second = (ends(here, one) for one in USUAL)
        kept = first[:, 1:].sum(1) == 0
        lost = second[kept, 1:].sum(1)
        yield {"space": name, "drawn": len(drawn),
               **{one: (drawn.reason == one).sum() for one in REASONS},
               "followed": len(here),
               **{one: (here.became == one).sum() for one in CLASSES},
               "above": len(above), "above_of_case_1":
                   (~above.reason.isin(REASONS[:2])).sum(),
               "kept_in_first": kept.sum(), "lost_in_long":
                   (lost > 0).sum(), "long_cycles": second[kept].sum(),
               "long_lost": lost.sum(),
               "returned": first[:, 0].sum() + second[:, 0].sum(),
               "late": sum(here[f"{one}_late"].sum() for one in USUAL)}


def per_wait(rows: pd.DataFrame) -> Iterator[dict[str, object]]:
    """What waiting brings back."""
    for name in SPACES:
        here = rows[(rows.space == name) & (ends(rows, WAIT).sum(1) > 0)]
        found = ends(here, WAIT)
        yield {"space": name, "machines": len(here),
               "lasting": (here.became == "lasting").sum(),
               "cycles": found.sum(), "lost": found[:, 1:].sum(),
               "late": here[f"{WAIT}_late"].sum()}


def per_ending(rows: pd.DataFrame) -> Iterator[dict[str, object]]:
    """Machines that never return, by how most of their cycles end; and all
    cycles of the first passes that did not."""
    for name in SPACES:
        here = rows[rows.space == name]
        never = ends(here[here.became == "never"], "first")
        of = Counter(most(never))
        yield {"space": name, "of": "machines",
               **{end: of[end] for end in LOST},
               "several": ((never[:, 1:] > 0).sum(1) > 1).sum()}
        yield {"space": name, "of": "cycles",
               **dict(zip(LOST, ends(here, "first")[:, 1:].sum(0)))}


def in_bins(rows: pd.DataFrame, column: str, edges: np.ndarray
            ) -> Iterator[dict[str, object]]:
    """Classes of machines in bins of a column."""
    for low, high in zip(edges, edges[1:]):
        here = rows[(rows[column] >= low) & (rows[column] < high)]
        yield {"low": f"{low:.6g}", "high": f"{high:.6g}",
               "followed": len(here), **{one: (here.became == one).sum()
                                         for one in CLASSES}}


def regions(rows: pd.DataFrame, name: str,
            total: int) -> Iterator[dict[str, object]]:
    """Cells of the grid whose machines are lasting and that touch, by a side
    or a corner; the largest region first."""
    rows = rows[(rows.space == name) & (rows.became == "lasting")]
    if rows.empty:
        return
    (low, high), (slow, fast) = SPACES[name].window
    half = np.array([high - low, fast - slow]) / space.side(name, total) / 2
    cells = tuple(np.transpose([space.cell(number, name, total)
                                for number in rows.machine]))
    grid = np.zeros(np.max(cells, axis=1) + 1, bool)
    grid[cells] = True
    labels = ndimage.label(grid, np.ones((3, 3)))[0][cells]
    for label, n in Counter(labels).most_common():
        at = rows[["r", "omega"]].to_numpy()[labels == label]
        holds = (np.abs(at - space.CHAOS) <= half).all(axis=1).any()
        if n >= FEWEST or holds:
            (r, omega), (r_end, omega_end) = at.min(axis=0), at.max(axis=0)
            yield {"space": name, "lasting": n,
                   "r_low": f"{r:.3f}", "r_high": f"{r_end:.3f}",
                   "omega_low": f"{omega:.3f}", "omega_high":
                       f"{omega_end:.3f}", "chaos": "yes" if holds else "no"}


def count(work: Path, kept: Path, build: str) -> None:
    """Writes what the page is made of, and its pictures."""
    del build
    rows, followed = rows_of(work), followed_of(work)

    def keep(name: str, found: Iterator[dict[str, object]],
             columns: Optional[Sequence[str]] = None) -> None:
        pd.DataFrame(list(found), columns=columns).to_csv(
            kept / f"recurrence-{name}.csv", index=False)

    keep("machines", per_space(rows, followed))
    keep("waits", per_wait(followed))
    keep("endings", per_ending(followed))
    keep("regions", (one for name, of in SPACES.items() if of.window
                     for one in regions(followed, name, len(rows))),
         REGION)
    keep("ratios", ({"space": name, **one} for name in SPACES for one in
                    in_bins(followed[followed.space == name], "ratio",
                            np.array(RATIOS))))
    maps.draw(kept / "recurrence.png", followed, len(rows))


# The page.

def share(k: int, n: int) -> str:
    """A share with its interval."""
    return table.share(k, n).text(3)


def machines_table(frame: pd.DataFrame) -> str:
    return table.markdown(
        ["machines", "drawn", *REASONS, "followed", *CLASSES,
         "lost in the long pass alone"],
        [[SPACES[row.space].title, row.drawn,
          *(row[one] for one in REASONS), row.followed,
          *(share(row[one], row.followed) for one in CLASSES),
          f"{row.lost_in_long} of {row.kept_in_first}"]
         for _, row in frame.iterrows()])


def waits_said(frame: pd.DataFrame) -> str:
    """What waiting brings back."""
    return ("Of machines that lose some cycles and not all so many lose none "
            "where they are waited for:\n" + ", ".join(
                f"{row.lasting} of {row.machines} ({SPACES[row.space].title})"
                for _, row in frame.iterrows()) + ".")


def endings_table(frame: pd.DataFrame) -> str:
    """Of the machines; those of the cycles stand in the kept counts."""
    return table.markdown(
        ["machines", "in all", *LOST, "several"],
        [[SPACES[row.space].title, sum(row[end] for end in LOST),
          *(row[end] for end in LOST), f"{row.several:.0f}"]
         for _, row in frame[frame.of == "machines"].iterrows()])


def regions_table(frame: pd.DataFrame) -> str:
    return table.markdown(
        ["machines", "lasting", "r* [m]", "omega* [rad/s]",
         "has the cell of `chaos`"],
        [[SPACES[row.space].title, row.lasting,
          f"{row.r_low:.3f} to {row.r_high:.3f}",
          f"{row.omega_low:.3f} to {row.omega_high:.3f}", row.chaos]
         for _, row in frame.iterrows()])


def ratios_table(frame: pd.DataFrame) -> str:
    """The share that is lasting, of each space."""
    return table.markdown(
        ["ratio of eigenvalues", *(f"{one.title}, lasting"
                                   for one in SPACES.values())],
        [[f"{low:.3g} to {high:.3g}",
          *(share(row.lasting, row.followed) + f" of {row.followed}"
            for name in SPACES for _, row in here[here.space == name]
            .iterrows())]
         for (low, high), here in frame.groupby(["low", "high"])
         if here.followed.any()])


def parts(kept: Path) -> dict[str, str]:
    """What the page has of the counts."""
    made = {"machines": machines_table, "regions": regions_table,
            "waits": waits_said, "endings": endings_table,
            "ratios": ratios_table}
    return {name: write(table.read(kept / f"recurrence-{name}.csv"))
            for name, write in made.items()}
