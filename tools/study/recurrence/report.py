#!/usr/bin/python3 -B
"""What `make recurrence` found, as Markdown, and its picture (picture.py).

A machine is *lasting* where every cycle that was followed returned, in the
first pass and in the long one, *partly* where some did, *never* where none
did; where some did not, the pass that waits decides. Shares have Wilson's 95 %
interval. Whatever the page says of the result is written from the rows.
"""
from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path
from typing import Iterable, Optional, Sequence

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import machines  # noqa: E402
import regions  # noqa: E402
import resonance  # noqa: E402
from machines import ENDINGS, KINDS, LOST, PASSES, SPACES, WAITS  # noqa: E402
from resonance import wrapped  # noqa: E402
from tables import markdown, read, statistics  # noqa: E402

CLASSES = "lasting", "partly", "never"
WAIT = "random_wait"
REASONS = "no design", "not case 1", "not followed"
RATIOS = 1, 2, 3, 4, 6, 8, 16, 32, 2048
QUARTERED = "r", "omega", *machines.SETTINGS, "kappa", "k2"

ABOUT = """\
Made by `make recurrence`; what a machine is, and how it is followed, is in
`tools/study/recurrence/machines.py`. {all} machines: {designs} designs of the paper's
figure 4, (r\\*, omega\\*) on a grid over all of it ({wide}) and all else as in
`chaos`; {near} more on a finer grid around `chaos` ({fine}); {random} drawn at
random, log-uniform in {drawn}, and gamma uniform in {gamma}. kappa and k2
follow from the place of the two-fold (`twofold design`). A machine whose
two-fold is of case 1 is followed from there."""
CLASSES_ARE = """\
Each run of a machine has a seed of its own: 4 N + 1 to 4 N + 4 for machine N,
and {waiting} + N for the pass that waits. A machine is *lasting* where no
cycle of either pass is lost: by the exact 95 % interval it then loses fewer
than {bound_random} of its cycles by exits at random ({cycles_random} cycles),
and fewer than {bound_noise} by noise ({cycles_noise}). It is *partly* where
some cycle returned, *never* where none did. A cycle longer than the pass waits
is lost; by exits at random a machine of which some cycles return and some are
lost is followed once more, and for longer, and that pass alone decides (fewer
than {bound_wait} are lost where none of {cycles_wait} is). Each of these bounds
is of one machine by itself, not of all at once.
`tools/study/recurrence/recurrence machine N` prints a machine and its commands.
{example}"""
PICTURE = """\
![Maps over the designs, shares over the ratio of eigenvalues and over the
parameters](recurrence.png)
"""


def ends(row: read.Row, name: str) -> list[int]:
    """Cycles of a pass, by how they ended."""
    return [row.count(f"{name}_{ending}") for ending in ENDINGS]


def passes_of(kind: str) -> list[str]:
    """The first pass and the long one."""
    return [name for name, run in PASSES.items()
            if run.kind == kind and run.after != WAITS]


def waiting(kind: str) -> list[str]:
    """The pass that waits, if there is one."""
    return [name for name, run in PASSES.items()
            if run.kind == kind and run.after == WAITS]


def class_of(row: read.Row, kind: str) -> str:
    """What became of a machine that was followed."""
    waited = [name for name in waiting(kind) if sum(ends(row, name))]
    found = np.array([ends(row, name) for name in waited or passes_of(kind)])
    if found[:, 0].sum() == 0:
        return "partly" if waited else "never"
    return "partly" if found[:, 1:].sum() else "lasting"


def bound(cycles: int) -> float:
    """The share of lost cycles that none of so many leaves possible."""
    return statistics.clopper_pearson(0, cycles).high


def share(k: int, n: int) -> str:
    """A share with its interval."""
    return markdown.estimate(*statistics.wilson(k, n), 3) if n else "-"


def window(space: machines.Space) -> str:
    (low, high), (slow, fast) = space.window
    return f"{low:g} < r\\* < {high:g} m, {slow:g} < omega\\* < {fast:g} rad/s"


def command(row: read.Row, name: str) -> str:
    """`twofold diverge` of a machine in a pass."""
    settings = machines.settings_of(row)
    seed = machines.seed_of(row.count("machine"), name)
    return " ".join(["twofold", *machines.follow_words(name, settings, seed)])


def head(rows: Sequence[read.Row]) -> str:
    """What was done, with an example."""
    count = Counter(row["space"] for row in rows)
    names = {"r": "r\\*", "below": "omega0 - omega\\*"}
    one = next((row for row in rows if not row["reason"] and
                class_of(row, "random") == "lasting"), None)
    example = [] if one is None else [f"    {command(one, 'random')}", ""]
    of = {kind: sum(PASSES[name].all_cycles() for name in passes_of(kind))
          for kind in KINDS}
    about = ABOUT.format(
        all=len(rows), wide=window(SPACES["designs"]),
        fine=window(SPACES["near"]),
        drawn=", ".join(f"{names.get(name, name)} from {a:g} to {b:g}"
                        for name, (a, b) in machines.DRAWN.items()),
        gamma=f"{machines.GAMMA[0]:.3f} to {machines.GAMMA[1]:.3f}",
        **{name: count[name] for name in SPACES})
    classes = CLASSES_ARE.format(
        waiting=machines.WAITING_SEEDS,
        bound_wait=f"{100 * bound(PASSES[WAIT].all_cycles()):.2g} %",
        cycles_wait=PASSES[WAIT].all_cycles(),
        example="No machine is lasting." if one is None else
        f"Of machine {one['machine']}, which is lasting, the first is:",
        **{f"bound_{kind}": f"{100 * bound(of[kind]):.2g} %"
           for kind in KINDS},
        **{f"cycles_{kind}": of[kind] for kind in KINDS})
    passes = markdown.table(
        ["pass", "exits", "samples", "cycles of each, at most",
         "longest cycle", "machines"],
        [[f"`{name}`", run.options or "at random", run.samples, run.cycles,
          f"{run.patience} s", "all" if run.after is None else
          "those of which some cycles are lost and some not"
          if run.after == WAITS else
          f"those of which `{run.after}` loses no cycle"]
         for name, run in PASSES.items()], [2, 3, 4])
    return "\n".join(["# Where the motion returns", "", *wrapped(about), "",
                      passes, "", *wrapped(classes), "", *example, PICTURE])


def overview(rows: Sequence[read.Row]) -> str:
    """Each space: what could be followed, and what became of it."""
    lines = []
    for name, space in SPACES.items():
        here = [row for row in rows if row["space"] == name]
        followed = [row for row in here if not row["reason"]]
        why = Counter(row["reason"] for row in here)
        for kind in KINDS:
            classes = Counter(class_of(row, kind) for row in followed)
            lines.append([space.title, kind, len(here),
                          *(why[reason] for reason in REASONS), len(followed),
                          *(share(classes[one], len(followed))
                            for one in CLASSES)])
    return markdown.table(["machines", "exits by", "drawn", *REASONS,
                           "followed", *CLASSES], lines, range(2, 7))


def second_pass(rows: Sequence[read.Row]) -> str:
    """How many machines lose a cycle only in the long pass."""
    lines = []
    for name, space in SPACES.items():
        for kind in KINDS:
            first, second = passes_of(kind)
            here = [ends(row, second) for row in rows
                    if row["space"] == name and not sum(ends(row, first)[1:])]
            lost = [found for found in here if sum(found[1:])]
            cycles = sum(map(sum, here))
            lines.append([space.title, kind, len(here), len(lost), cycles,
                          sum(sum(found[1:]) for found in lost)])
    return markdown.table(
        ["machines", "exits by", "none lost in the first pass",
         "of these, some lost in the long one", "cycles of it", "lost"], lines,
        range(2, 6))


def waits(rows: Sequence[read.Row]) -> str:
    """What waiting brings back."""
    lines = []
    for name, space in SPACES.items():
        here = [row for row in rows
                if row["space"] == name and sum(ends(row, WAIT))]
        kept = [row for row in here if class_of(row, "random") == "lasting"]
        cycles = [sum(column) for column in
                  zip(*(ends(row, WAIT) for row in here))] or [0]
        lines.append([space.title, len(here), len(kept), sum(cycles),
                      sum(cycles[1:]),
                      share(back := sum(row.count(f"{WAIT}_late")
                                        for row in here),
                            back + sum(cycles[1:]))])
    return markdown.table(
        ["machines", "some lost, some not", f"of these, none lost in `{WAIT}`",
         "cycles of it", "lost",
         f"of those still out after {PASSES[WAIT].patience // 2} s, back by "
         f"{PASSES[WAIT].patience} s"], lines, range(1, 5))


def late(rows: Sequence[read.Row]) -> str:
    """How much waiting longer might change."""
    said = []
    for kind in KINDS:
        back = sum(ends(row, name)[0] for row in rows
                   for name in passes_of(kind))
        found = sum(row.count(f"{name}_late") for row in rows
                    for name in passes_of(kind))
        said.append(f"{found} of {back} by {kind}")
    return "\n".join(wrapped(
        "Of the cycles that returned, in the first pass and the long one, so "
        f"many took more than half of the longest cycle: {', '.join(said)}. So "
        "those who lose some by exits at random are waited for; what waiting "
        "would bring back under noise, and of machines that lose all, is "
        "counted as lost:") + [""])


def most(found: Sequence[int]) -> str:
    """How most of the cycles that did not return ended."""
    return max(zip(found[1:], LOST), key=lambda one: one[0])[1]


def endings(rows: Sequence[read.Row]) -> str:
    """Machines that never return, by how most of their cycles end; and all
    cycles of the first passes that did not."""
    lines = []
    for name, space in SPACES.items():
        here = [row for row in rows if row["space"] == name]
        for kind in KINDS:
            never = [ends(row, kind) for row in here
                     if class_of(row, kind) == "never"]
            of = Counter(most(found) for found in never)
            mixed = sum(sum(n > 0 for n in found[1:]) > 1 for found in never)
            cycles = np.sum([ends(row, kind) for row in here] or
                            [[0] * len(ENDINGS)], axis=0)
            lines.append([space.title, kind, "machines", len(never),
                          *(of[end] for end in LOST), mixed])
            lines.append([space.title, kind, "cycles", cycles[1:].sum(),
                          *cycles[1:], "-"])
    return markdown.table(["machines", "exits by", "of", "in all",
                           *LOST, "several"], lines,
                          range(3, 11))


def by_bins(rows: Sequence[read.Row], column: str,
            edges: Sequence[float]) -> Iterable[list[object]]:
    """Lines: a bin of a column and the shares in it."""
    for low, high in zip(edges, edges[1:]):
        here = [row for row in rows if low <= row.number(column) < high]
        classes = Counter(class_of(row, "random") for row in here)
        yield [f"{low:.3g} to {high:.3g}", len(here),
               *(share(classes[one], len(here)) for one in CLASSES)]


def ratios(rows: Sequence[read.Row]) -> str:
    """Shares by the ratio of the eigenvalues."""
    lines = [[space.title, *line] for name, space in SPACES.items()
             for line in by_bins([row for row in rows
                                  if row["space"] == name], "ratio", RATIOS)]
    return markdown.table(["machines", "ratio of eigenvalues", "followed",
                           *CLASSES], lines, [2])


def quarters(rows: Sequence[read.Row], column: str,
             parts: int = 4) -> list[float]:
    """The edges of bins with as many machines each."""
    values = [row.number(column) for row in rows] or [0]
    edges = list(np.quantile(values, np.linspace(0, 1, parts + 1)))
    edges[-1] = float(np.nextafter(edges[-1], np.inf))
    return edges


def parameters(rows: Sequence[read.Row]) -> str:
    """Shares by quarters of each parameter that was drawn."""
    lines = [[column, *line] for column in QUARTERED
             for line in by_bins(rows, column, quarters(rows, column))]
    return markdown.table(["parameter", "quarter", "followed", *CLASSES],
                          lines, [2])


def above(rows: Sequence[read.Row]) -> str:
    """What the half of figure 4 above omega0 is."""
    here = [row for row in rows if row["space"] == "designs" and
            row.number("omega") >= machines.OMEGA0]
    found = sum(row["reason"] in ("", "not followed") for row in here)
    return "\n".join(wrapped(
        f"At omega\\* >= omega0 = {machines.OMEGA0:g} rad/s {found or 'none'} "
        f"of the {len(here)} points of figure 4 "
        f"{'are designs' if found > 1 else 'is a design'} of case 1; the maps "
        "end there.") + [""])


def page(rows: Sequence[read.Row]) -> str:
    """All of it but the basins."""
    followed = [row for row in rows if not row["reason"]]
    told = "\n".join(f"* `{name}`: {text}" for name, text in
                     list(ENDINGS.items())[1:])
    return "\n".join([
        head(rows), overview(rows), "", above(rows),
        regions.section(followed, class_of, len(rows)),
        "## The long pass\n", second_pass(followed), "",
        late(followed), waits(followed), "",
        "## How it ends\n",
        *wrapped("Machines that never return, by how most of their cycles end "
                 "(`several`: those of more than one ending), and all cycles "
                 "of the first passes that did not return. When the time of a "
                 "cycle is over, it has"), "", told, "", endings(followed), "",
        "## By the ratio of the eigenvalues\n", "Exits at random.\n",
        ratios(followed), "",
        resonance.section(followed, class_of),
        "## By the parameters\n",
        *wrapped("Machines at random, exits at random, in quarters of each "
                 "parameter. The picture has maps over pairs of them."), "",
        parameters([row for row in followed if row["space"] == "random"])])


def main(words: Optional[Sequence[str]] = None) -> None:
    import picture
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", help="all parts, one after the other")
    parser.add_argument("picture", help="ends in .png or .svg")
    given = parser.parse_args(words)
    rows = read.read_csv(given.table, machines.COLUMNS, counted=True)
    picture.draw(given.picture, rows)
    print(page(rows))


if __name__ == "__main__":
    read.run_script(main)
