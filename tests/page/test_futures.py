"""The futures that the page shows, against those of the command line: under
every law, rule and law of rest, with inputs by hand, of a scene from a file."""
import re
import tempfile
import zlib
from pathlib import Path
from urllib.parse import quote

from page import ROOT, check, command, go, opened

STEPS, AHEAD = 1500, 150
MODES = ("slip+", "slip-", "stick+", "stick-", "pinned")
START = ("r", "omega", "h", "v")
# A scene, what is set of it, and inputs by hand: (tick, force, torque) each.
CASES = [
    ("chaos", "kappa=1 r=0.3 omega=-1.3 h=0", [(1254, -0.0058, 0.0018)]),
    ("chaos", "rest=square rule=slip+ kappa=1 r=0.19 omega=-1.03 h=0",
     [(1044, -0.092, 0.0016)]),
    ("chaos", "rule=slip- kappa=0.45 r=0.136 omega=-1.15 h=0.0013 gamma=-2.1",
     []),
    ("chaos", "rest=bow_tie rule=slip- kappa=0.54 r=0.118 omega=-0.96 h=0 "
     "omega0=-0.96", [(340, -0.27, 0.0034), (1187, 0.14, -0.0058),
                      (1582, -0.15, 0.0076)]),
    ("chaos", "rest=square rule=slip+ kappa=1.1 r=0.244 omega=-0.91 h=0 "
     "gamma=-2.4 omega0=-0.8156", []),
    ("chaos", "rest=square rule=random seed=976897531 kappa=0.838 r=0.1817 "
     "omega=-1.27 h=0 gamma=-2.2 rate=287 dt=7.7e-5", [(612, 0.063, 0.0079)]),
    ("chaos", "kappa=0.54 r=-0.135 omega=-0.8 h=0 omega0=-0.8", []),
    ("driven", "rule=slip- kappa=1.3 r=0.2 omega=-1.3 h=0", []),
    ("gamma_zero", "rule=random seed=3854441041 kappa=0.8 gamma=-1.95 r=0.236 "
     "omega=-1.22 v=-0.13 rate=134", []),
    ("tests/data/own.scene", "kappa=0.8 r=0.2 omega=-1.1 h=0", []),
    ("coulomb", "omega=-0.9", [(556, -0.013, 0.0037)]),
    ("chaos", "law=two_piece k=0.8 sigma=0.2 rho=0.6 a=0.9", []),
    ("string", "rule=slip+", []), ("smooth", "rule=random seed=1", []),
    ("frictionless", "v=0.28", [(396, -0.1, 0.0064)])]
NUMBER = "((x) => Object.is(x, -0) ? '-0' : String(x))"
ROW = f"""(row) => Array.from(row.subarray(0, 10), (x, i) =>
  i === 8 ? twofold.core.modes[x] : {NUMBER}(x))"""


class Runs:
    """Of the command line. Where it has to branch, a saved state goes on under
    another rule, or in another mode."""

    def __init__(self, folder, scene, words, hands):
        self.scene = str(ROOT / scene) if "/" in scene else scene
        self.words = {"rule": "persist", "dt": "1e-4",
                      **dict(word.split("=") for word in words.split())}
        self.hands, self.state = hands, str(folder / "state")
        self.table, self.dt = folder / "table", float(self.words["dt"])
        self.rule = self.words["rule"]
        self.rows = self.run(STEPS)

    def run(self, steps, *more, rule=None, driven=STEPS + AHEAD, **changed):
        """driven: inputs by hand are those up to that step."""
        rule = rule or self.rule
        chosen = f"random:{self.words['seed']}" if rule == "random" else rule
        sets = [word for name, value in {**self.words, **changed}.items()
                if name not in ("rule", "seed") and
                not (name in START and "--from" in more)
                for word in ("--set", f"{name}={value}")]
        if self.hands:
            self.table.write_text("t,force,torque\n0,0,0\n" + "".join(
                f"{tick * self.dt!r},{force!r},{torque!r}\n" for
                tick, force, torque in self.hands if tick < driven))
            more += "--inputs", str(self.table), "--between", "held"
        text = command("run", self.scene, *sets, "--select", chosen, "--every",
                       "1", "--t-end", repr(steps * self.dt), *more)
        return [line.split(",") for line in text.splitlines()[1:]]

    def openings(self):
        """Steps from which on several futures are open, the first of each row
        of such steps; and one more."""
        rows = self.rows
        found = [i for i in range(1, STEPS) if int(rows[i][9]) > 1
                 and (i == 1 or rows[i][8:] != rows[i - 1][8:])]
        return found[:4] + [STEPS - 7]

    def of(self, tick, mode, row):
        """A rule and the rows, from the step before on, of the first run that
        ends that step so, as far as its rule has no other say than the declared
        one. Inputs by hand are held from there on."""
        self.run(tick - 1, "--save", self.state, driven=tick)
        text = Path(self.state).read_text().rsplit("crc32", 1)[0]
        rate = "0" if mode == "pinned" else "1e9"
        for rule, start in ((self.rule, None), ("slip+", None), ("slip-", None),
                            ("persist", None), ("persist", mode),
                            *((f"random:{i}", "pinned") for i in range(64))):
            name, _, seed = rule.partition(":")
            new = re.sub(r"(?m)^(rule +).*", rf"\g<1>{name}", text)
            if start:
                new = re.sub(r"(?m)^mode .*", f"mode {MODES.index(start)}", new)
            if seed:
                new = re.sub(r"(?m)^seed .*", f"seed {seed}", new)
                new = re.sub(r"(?m)^(rate +)\S+", rf"\g<1>{rate}", new)
            crc = zlib.crc32(new.encode())
            Path(self.state).write_text(f"{new}crc32 {crc:08x}\n")
            rows = self.run(tick + AHEAD, "--from", self.state, rule=rule,
                            driven=tick, **({"rate": rate} if seed else {}))
            if same(rows[1], row):
                end = len(rows)
                if rule != self.rule:
                    end = next((i for i in range(2, end)
                                if int(rows[i][9]) > 1), end)
                return rule, rows[:end]
        return None


def futures_of(tab, tick):
    """Each future of the page: its mode and its rows."""
    return tab.value(f"""(({{ motion, core }}) => motion.futures({tick},
      {AHEAD} * motion.dt, {AHEAD}).map(({{ mode, rows }}) =>
        [core.modes[mode], rows.map({ROW})]))(twofold)""")


def same(row, want):
    """Numbers by their bits: both sides write what reads back to them."""
    return all(a == b or (i != 8 and float(a).hex() == float(b).hex())
               for i, (a, b) in enumerate(zip(row, want)))


def is_entered(row, futures):
    """Whether a step ends in stick or rest, and by that in another mode: what
    no rule of a run does."""
    return any(mode in MODES[2:] and same(row[:8], other[1][:8])
               for mode, other in futures if mode != row[8])


def compare(runs, tick, mode, rows, told, futures):
    taken = runs.of(tick, mode, rows[1])
    if not taken:
        check(is_entered(rows[1], futures),
              f"{told}: no run ends step {tick} in {mode} like {rows[1]}")
        return
    rule, want = taken
    check(len(rows) == AHEAD + 2, f"{told}: {len(rows)} rows")
    for row, line in list(zip(rows, want))[1:]:
        check(same(row, line), f"{told}: {mode} in step {tick} is not that of "
              f"--select {rule}:\npage {row}\nrun  {line}")


def address_of(runs, *more):
    first = f"scene={runs.scene}"
    if "/" in runs.scene:
        path = Path(runs.scene)
        first = f"file={path.name}:{quote(path.read_text())}"
    return "&".join([first, *(f"{name}={quote(value)}" for name, value in
                              runs.words.items()),
                     *(f"hand={tick}:{force!r}:{torque!r}" for
                       tick, force, torque in runs.hands), *more, "end"])


def open_at(tab, runs, address, tick):
    """What the address says is in the core, also what no step asks for."""
    tab.value(f"location.hash = '#{address}'")
    go(tab, tick)
    found = tab.value(f"""(({{ core }}) => Object.fromEntries(
      core.names.map((name) => [name, core.lists[name]?.[core.get(name)] ??
        {NUMBER}(core.get(name))])))(twofold)""")
    for name, value in runs.words.items():
        check(found[name] == value or
              float(found[name]).hex() == float(value).hex(),
              f"{address}: {name} = {found[name]}, not {value}")


def compare_taken(tab, runs, tick, mode, rows):
    """An address that takes a future leads there, up to the next input."""
    address = address_of(runs, f"take={tick - 1}:{quote(mode)}")
    last = min([tick + AHEAD, *(at for at, *_ in runs.hands if at >= tick)])
    for end in tick, (tick + last) // 2, last:
        open_at(tab, runs, address, end)
        now = tab.value(f"({ROW})(twofold.motion.now)")
        check(same(now, rows[end - tick + 1]), f"{address}: at step {end}\n"
              f"{now}\n{rows[end - tick + 1]}")


def test_futures_are_those_of_the_command_line():
    """Of all cases, one opened after the other in one tab."""
    tab = opened()
    with tempfile.TemporaryDirectory() as folder:
        for i, case in enumerate(CASES):
            runs = Runs(Path(folder), *case)
            address, every = address_of(runs), []
            open_at(tab, runs, address, STEPS)
            for tick in runs.openings():
                all_ = futures_of(tab, tick)
                check(len(all_) == int(runs.rows[tick][9]), f"{address}: "
                      f"{[mode for mode, _ in all_]} in step {tick}")
                for mode, rows in all_:
                    compare(runs, tick, mode, rows, address, all_)
                every += [(tick, *one) for one in all_]
            compare_taken(tab, runs, *every[i % len(every)])
