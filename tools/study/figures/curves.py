#!/usr/bin/python3 -B
"""Curves for the figures, as gnuplot reads them.

usage: curves.py FIGURE FOLDER                      picks them out of data
       curves.py LIST FOLDER TWOFOLD DT THIN        follows them

FOLDER has the data of the command line, whose columns are read by name. Each
curve is written behind a line `# NAME` and before two empty lines, so that
gnuplot finds it by `index 'NAME'`; an empty line within it is a gap.

Trajectories are t,r,omega,h,g,mode by `twofold run` with steps of DT; mode is
its number, 1 to 5. One that has reached the two-fold again ends there: behind
it all is open. THIN: 0 for every row, else as few as leave no other one more
than so many windows off the lines between them, the window being what figure
`set` shows of r, omega and h. LIST is one of
  fans      starts near h = 0 at three places of the surface of the scene
            `chaos` near its two-fold, over 2 ms
  futures   branches from the two-fold back to it: exits 60 ms apart, to either
            side, and from each the fewest choices at h = g = 0 that lead back
  loop      two cycles that begin at the two-fold: `straight` is the first
            future that lands so far down that it comes back to the two-fold at
            once, `winding` one that winds much and lands higher
"""
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, Iterator

import pandas as pd

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])
import table  # noqa: E402

Curves = Iterator[tuple[str, list[str]]]
Start = tuple[str, float, float, str, str, str]
MODES = {"slip+": 1, "slip-": 2, "stick+": 3, "stick-": 4, "pinned": 5}
PATH = ["t", "r", "omega", "h", "g", "mode"]
WINDOW = {"r": 0.007, "omega": 0.07, "h": 3.6e-4}
SHEET = (0.1812, 0.188), (-1.056, -0.99)  # of h = 0 that is drawn: r, omega
OFF = 1e-12  # so far beside the surface a slip begins [m/s]
END = 2e-3   # of the fans [s]
EXITS = 6    # of the futures, to either side
# From h = g = 0: omega and h next to it, of slip- along its limit direction.
AWAY = {"slip-": ("-1.0000001", "-1e-10"), "stick-": ("-0.9999999", "0")}


def read(folder: Path, name: str) -> pd.DataFrame:
    """Data, as they are written."""
    return table.read(folder / f"{name}.csv", text=True,
                      counted=name.startswith(("exits-", "returns-")))


def branches_of(folder: Path) -> pd.DataFrame:
    """Of `twofold diverge chaos --exhaustive`; stick is a number."""
    rows = read(folder, "branches")
    return rows.assign(stick=pd.to_numeric(rows.stick_time))


def side(modes: pd.Series) -> pd.Series:
    """The sign of h in a slip."""
    return modes.map(lambda mode: "1" if mode == "slip+" else "-1")


def joined(*columns: pd.Series) -> list[str]:
    """Some columns, as they are written in the data."""
    return [" ".join(fields) for fields in zip(*columns)]


# Trajectories.

def fans(folder: Path) -> Iterator[Start]:
    """Starts on either side of the surface, and on it."""
    del folder
    for i in range(-4, 5):
        if i != 0:
            yield "sliding", 0, END, "0.188", "-1.059", f"{i * 2e-6:g}"
            # Off the escaping surface one after the other, from either side.
            yield ("escaping", (abs(i) - 1) * 4e-4, END, "0.1838", "-1.016",
                   f"{OFF if i > 0 else -OFF:g}")
        yield "crossing", 0, END, "0.183", "-1.058", f"{-i * 2e-6 - 6e-6:g}"
    yield "stays", 0, END, "0.188", "-1.059", "0"
    yield "stays", 0, END, "0.1838", "-1.016", "0"


def start(name: str, end: float, row: tuple) -> Start:
    """What one branch begins with: a slip, or a motion away from h = g = 0."""
    omega, h = AWAY[row.mode] if row.kind == "codim2" else (
        row.exit_omega, f"{OFF if row.mode == 'slip+' else -OFF:g}")
    return name, 0, end, row.exit_r, omega, h


def futures(folder: Path) -> Iterator[Start]:
    """The branches that lead back, each once: they join."""
    rows = read(folder, "futures")
    rows = rows[rows.to != ""]
    inner, level, back = rows[rows.node != "0"], {"0"}, {}
    while level:  # nodes from which so many branches lead back
        found = inner[inner.to.isin(level) & ~inner.node.isin(back)]
        found = found.drop_duplicates("node")
        back.update((row.node, row) for row in found.itertuples())
        level = set(found.node)
    drawn = set()
    for row in rows[rows.node == "0"][:2 * EXITS].itertuples():
        while row and row.node not in drawn:
            yield start(row.mode, float(row.time), row)
            drawn |= {row.node} - {"0"}
            row = back.get(row.to)


def loop(folder: Path) -> Iterator[Start]:
    """One branch of each kind, in the order of the branches."""
    rows = branches_of(folder)
    rows = rows[rows.end == "codim2"]
    winds = pd.to_numeric(rows.windings)
    straight = (winds > 0) & (pd.to_numeric(rows.end_r) < 0.1821)
    found = [(rows[hit].index[0], name, end, next(rows[hit].itertuples()))
             for name, end, hit in (("winding", 2.1, winds == 7),
                                    ("straight", 4, straight))]
    for _, name, end, row in sorted(found):
        yield start(name, end, row)


def thinned(rows: pd.DataFrame, thin: float) -> pd.DataFrame:
    """Ends of modes, and rows between which lines are off all others by `thin`
    windows at most."""
    at = (rows[list(WINDOW)] / pd.Series(WINDOW)).to_numpy()
    ends = (rows["mode"] != rows["mode"].shift(-1)).to_numpy().nonzero()[0]
    begins = [0, *ends[:-1] + 1]
    kept, open_ = {*begins, *ends}, list(zip(begins, ends))
    while open_:  # Douglas and Peucker
        first, last = open_.pop()
        off = at[first:last + 1] - at[first]
        way = off[-1] / max(math.hypot(*off[-1]), 1e-9)
        off = ((off - (off @ way)[:, None] * way) ** 2).sum(axis=1)
        if off.max() > thin ** 2:
            far = first + int(off.argmax())
            kept.add(far)
            open_ += [(first, far), (far, last)]
    return rows.iloc[sorted(kept)]


def trajectory(twofold: str, dt: str, thin: float,
               begun: Start) -> Iterator[str]:
    """One trajectory, by `twofold run`."""
    _, begin, end, r, omega, h = begun
    with tempfile.NamedTemporaryFile(suffix=".csv") as out:
        done = subprocess.run(
            [twofold, "run", "chaos", "--scheme", "located", "--dt", dt,
             "--set", f"r={r}", "--set", f"omega={omega}", "--set", f"h={h}",
             "--out", out.name, "--events", "1000000", "--t-end",
             f"{end - begin:.6g}"],
            stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise table.TableError(done.stderr.strip())
        rows = table.read(out.name)[PATH]
    # When the two-fold was reached behind the start.
    again = re.findall(r"^ *(\d\S*) .*two-fold reached", done.stderr, re.M)
    last = min((float(t) for t in again if float(t) > 0), default=math.inf)
    rows = rows[rows.t <= last + 1e-9]
    for row in (thinned(rows, thin) if thin else rows).itertuples():
        yield (f"{begin + row.t:.6g} {row.r:.6g} {row.omega:.6g} {row.h:.4g} "
               f"{row.g:.4g} {MODES[row.mode]}")


def trajectories(path: Path) -> Iterator[tuple[str, list[list[str]]]]:
    """Name and rows of each trajectory that was written before."""
    for block in path.read_text(encoding="utf-8").split("\n\n\n"):
        name, *lines = block.strip().splitlines() or [""]
        if lines:
            yield name[2:], [line.split() for line in lines]


# Figures. Of many points some are drawn, so that a picture stays small.

def exits(folder: Path) -> Curves:
    """When, where and in which phase trajectories leave."""
    rows = read(folder, "exits-random")
    times = rows.time.iloc[pd.to_numeric(rows.time).argsort(kind="stable")]
    yield "when", [f"{time} {i / len(times):.6g}"
                   for i, time in enumerate(times, 1) if i % 40 == 1]
    some = rows[8::20]
    yield "where", joined(some.time, some.r, side(some.side))
    passed = rows[rows.phase != ""]
    some = passed[::3]
    yield "phase", joined(some.time, some.phase, side(some.side))
    bins = (pd.to_numeric(passed.phase) * 10).astype(int)
    n, lines = len(passed), []
    for i in range(10):
        p = (bins == i).sum() / n
        lines.append(f"{i / 10 + 0.05:.6g} {p:.6g} "
                     f"{1.96 * math.sqrt(p * (1 - p) / n):.6g}")
    yield "bins", lines
    stick = branches_of(folder).query("mode == 'slip+'")
    yield "stick", joined(stick.stick_time, stick.exit_r)


def regions(folder: Path) -> Curves:
    """Where the stick from the two-fold ends."""
    stick = branches_of(folder).query("mode == 'slip+'")
    yield "stick", joined(stick.exit_r, stick.exit_omega)


def normal(folder: Path) -> Curves:
    """The stick from the two-fold up to its last exit that is drawn."""
    rows = branches_of(folder)
    early = rows[rows.stick <= 0.28]
    yield "stick", joined(rows.r[:1], rows.omega[:1]) + joined(
        early.exit_r, early.exit_omega)


def returns(folder: Path) -> Curves:
    """From an exit to the first landing, and from there to the two-fold."""
    left, came = read(folder, "exits-random"), read(folder, "returns-random")
    both = came[:len(left)].assign(exit=left.time)[3::8]
    both = both[both.landing_r != ""]
    yield "sampled", joined(both.exit, both.landing_r, both.time, both.landings)
    rows = branches_of(folder)
    ends = rows[rows.end == "codim2"]
    yield "branches", joined(ends.stick_time, side(ends["mode"]), ends.end_r)
    # Where stick from the two-fold tends to rest: one curve of a family.
    yield "rest", list(rows[rows["mode"] == "slip+"].exit_r)[-1:]


def motions(folder: Path) -> Curves:
    """The trajectories of the set by mode, each with the row it ends in; the
    stick from the two-fold that they leave; regions."""
    paths = list(trajectories(folder / "set.dat"))
    for mode in "1234":
        lines = []
        for _, rows in paths:
            last = None
            for _, r, omega, h, _, now in rows:
                if mode in (now, last):
                    lines.append(f"{r} {omega} {h}")
                if last == mode != now:
                    lines.append("")
                last = now
            lines.append("")
        yield f"mode {mode}", lines
    stick = read(folder, "futures").query(
        "node == '0' and mode == 'slip+'")[:EXITS]
    yield "stick", joined(stick.r[:1], stick.omega[:1]) + joined(
        stick.exit_r, stick.exit_omega)
    yield from sheet(folder, float(stick.r[0]), float(stick.omega[0]))


def sheet(folder: Path, r: float, omega: float) -> Curves:
    """The regions of h = 0 around the two-fold, as polygons."""
    (left, right), (bottom, top) = SHEET
    parts = (folder / "borders.dat").read_text(encoding="utf-8").split("\n\n\n")
    plus, minus = (
        [at for at in (tuple(map(float, line.split()))
                       for line in part.splitlines())
         if left < at[0] < right and at[1] > bottom] for part in parts[:2])
    fold = [(r, omega)]
    west = [at for at in minus if at[0] < r] + fold
    east = fold + [at for at in minus if at[0] > r]
    north = fold + [at for at in plus if at[1] > omega]
    south = [at for at in plus if at[1] < omega] + fold
    for name, outline in (
            ("sliding", east + [(right, bottom)] + south),
            ("escaping", west + north + [(left, -1)]),
            ("crossing_up", west + south[::-1] + [(left, bottom)]),
            ("crossing_down", north[::-1] + east + [(right, -1)]),
            ("sliding", [(left, -1), (right, -1), (right, top), (left, top)])):
        yield name, [f"{x:.6g} {y:.6g}" for x, y in outline]


def surface(folder: Path) -> Curves:
    """Trajectories near h = 0, on either side of it; those that cross whole."""
    paths = list(trajectories(folder / "fans.dat"))
    for what, sign in (("crossing", 0), ("crossing", -1), ("sliding", 1),
                       ("sliding", -1), ("escaping", 1), ("escaping", -1)):
        lines = []
        for name, rows in paths:
            if name == what:
                lines += [f"{t} {h}" if sign == 0 or sign * float(h) > 1e-11
                          else "" for t, _, _, h, *_ in rows] + [""]
        yield f"{what} {sign}", lines


FIGURES: dict[str, Callable[[Path], Curves]] = {
    "exits": exits, "normal": normal,
    "regions": regions, "return": returns, "set": motions, "surface": surface}
LISTS: dict[str, Callable[[Path], Iterator[Start]]] = {
    "fans": fans, "futures": futures, "loop": loop}


def main() -> int:
    name, folder, *how = sys.argv[1:] if len(sys.argv) > 2 else ("", "")
    if name in FIGURES and not how:
        curves = FIGURES[name](Path(folder))
    elif name in LISTS and len(how) == 3:
        curves = ((begun[0], list(trajectory(how[0], how[1], float(how[2]),
                                             begun)))
                  for begun in LISTS[name](Path(folder)))
    else:
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    for title, lines in curves:
        gap = ""
        print(f"# {title}")
        for line in lines:  # two gaps in a row would end the curve
            if line or gap:
                print(line)
            gap = line
        print("\n")
    return 0


if __name__ == "__main__":
    table.run_script(main)
