"""The futures that the page shows, against those of the command line: of random
machines, laws, rules, laws of rest and starts, and of scenes from files."""
import json
import random
import re
import tempfile
import zlib
from pathlib import Path
from urllib.parse import quote

from page import check, command, go, opened

ADDRESSES, PLAIN, STEPS, AHEAD = 20, 6, 1500, 150
RULES = ("persist", "slip+", "slip-", "random")
MODES = ("slip+", "slip-", "stick+", "stick-", "pinned")
START = ("r", "omega", "h")
NUMBER = "(x) => Object.is(x, -0) ? '-0' : String(x)"


def drawn(at):
    """A scene as NAME, or a file of it, and {name: value} that differ."""
    scene = at.choice(["chaos"] * 7 + ["driven"] * 2 + ["coulomb", "gamma_zero",
                                                       "smooth", "string"])
    values = dict(line.split()[:2] for line in
                  command("scene", scene).splitlines() if " " in line)
    words = {name: repr(float(values[name]) * at.uniform(0.75, 1.3))
             for name in ("m", "d", "beta", "k2", "r0", "c1", "c2", "mu",
                          "kappa", "gamma", "omega0", "epsilon", "k", "delta",
                          "a", "rho")
             if float(values.get(name, 0))}
    if scene in ("chaos", "driven"):  # more of h = 0 escapes
        words["kappa"] = repr(float(words["kappa"]) * at.uniform(1, 5))
    words["theta"] = repr(at.uniform(0.5, 1))
    words["dt"] = repr(at.choice([0.5e-4, 1e-4, 2e-4]))
    words["rate"] = repr(at.uniform(0, 500))
    words["rest"] = at.choice(["hull", "square", "bow_tie"])
    if scene in ("chaos", "driven"):
        words["law"] = at.choice(["jump", "jump", "jump", "coulomb"])
    words["r"] = repr(at.choice([-1, 1, 1, 1]) * at.uniform(0.05, 0.3))
    omega0 = float(words.get("omega0", values["omega0"]))
    words["omega"] = repr(omega0 + at.choice([0, 1, 1]) * at.uniform(-0.4, 0.2))
    if scene != "gamma_zero":
        words["h"] = at.choice(["0", "0", repr(at.uniform(-0.01, 0.01))])
    return scene, words


class Runs:
    """Of the command line. Where it has to branch, a saved state goes on under
    another rule, or in another mode."""

    def __init__(self, folder, scene, words, rule, seed):
        self.scene, self.words = scene, words
        self.state, self.dt = str(folder / "state"), float(words["dt"])
        self.rule, self.seed = rule, seed
        self.rows = self.run(STEPS)

    def run(self, steps, *more, rule=None):
        rule = rule or self.rule
        chosen = f"random:{self.seed}" if rule == "random" else rule
        sets = [word for name, value in self.words.items()
                if not (name in START and "--from" in more)
                for word in ("--set", f"{name}={value}")]
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
        one."""
        self.run(tick - 1, "--save", self.state)
        text = Path(self.state).read_text().rsplit("crc32", 1)[0]
        for rule, start in ((self.rule, None), ("slip+", None), ("slip-", None),
                            ("persist", None), ("persist", mode)):
            new = re.sub(r"(?m)^(rule +).*", rf"\g<1>{rule}", text)
            if start:
                new = re.sub(r"(?m)^mode .*", f"mode {MODES.index(start)}", new)
            crc = zlib.crc32(new.encode())
            Path(self.state).write_text(f"{new}crc32 {crc:08x}\n")
            rows = self.run(tick + AHEAD, "--from", self.state, rule=rule)
            if same(rows[1], row):
                end = len(rows)
                if rule != self.rule:
                    end = next((i for i in range(2, end)
                                if int(rows[i][9]) > 1), end)
                return rule, rows[:end]
        return None


def futures_of(tab, tick):
    """Each future of the page: its mode and its rows, [] where it is closed."""
    return json.loads(tab.value(f"""(() => {{
      const {{ motion, core }} = twofold, text = {NUMBER};
      return JSON.stringify(motion.futures({tick}, {AHEAD} * motion.dt,
        {AHEAD}).map(({{ mode, rows }}) => [core.modes[mode],
        rows.map((row) => Array.from(row.subarray(0, 10), (x, i) =>
          i === 8 ? core.modes[x] : text(x)))]));
    }})()"""))


def same(row, want):
    """Numbers by their bits: both sides write what reads back to them."""
    return all(a == b or (i != 8 and float(a).hex() == float(b).hex())
               for i, (a, b) in enumerate(zip(row, want)))


def compare(runs, tick, mode, rows, told):
    taken = runs.of(tick, mode, rows[1])
    check(taken, f"{told}: no run ends step {tick} in {mode} like {rows[1]}")
    rule, want = taken
    check(len(rows) == AHEAD + 2, f"{told}: {len(rows)} rows")
    for row, line in list(zip(rows, want))[1:]:
        check(same(row, line), f"{told}: {mode} in step {tick} is not that of "
              f"--select {rule}:\npage {row}\nrun  {line}")


def address_of(scene, words, rule, seed):
    first = f"scene={scene}"
    if "/" in scene:
        path = Path(scene)
        first = f"file={path.name}:{quote(path.read_text())}"
    return "&".join([first, *(f"{name}={value}" for name, value in
                              words.items()),
                     f"rule={quote(rule)}", f"seed={seed}", "end"])


def futures_are_those_of_the_command_line():
    """Of twenty addresses, one opened after the other in one tab."""
    at, tab, plain, branched = random.Random(31), opened(), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        while plain + branched < ADDRESSES:
            scene, words = drawn(at)
            rule, seed = at.choice(RULES), at.randrange(2 ** 32)
            if at.random() < 0.3:
                text = command("scene", scene, "--set", "m=0.7")
                scene = f"{folder}/own.scene"
                Path(scene).write_text(text)
            runs = Runs(Path(folder), scene, words, rule, seed)
            openings = runs.openings()
            if len(openings) == 1 and plain == PLAIN:
                continue
            plain += len(openings) == 1
            branched += len(openings) > 1
            address = address_of(scene, words, rule, seed)
            tab.value(f"location.hash = '#{address}'")
            go(tab, STEPS)
            for tick in openings:
                open_ones = [(mode, rows) for mode, rows in
                             futures_of(tab, tick) if rows]
                check(open_ones, f"{address}: none in step {tick}")
                for mode, rows in open_ones:
                    compare(runs, tick, mode, rows, address)


TESTS = [futures_are_those_of_the_command_line]
