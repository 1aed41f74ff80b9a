"""The futures that the page shows, against those of the command line: of all
that an address may say, drawn from the lists that the page has of it, and of
scenes from files."""
import math
import random
import re
import tempfile
import zlib
from pathlib import Path
from urllib.parse import quote

from page import check, command, go, opened

ADDRESSES, STEPS, AHEAD = 20, 1500, 150
MODES = ("slip+", "slip-", "stick+", "stick-", "pinned")
START = ("r", "omega", "h", "v")
WIDER = {"kappa": (1, 5), "rate": (0, 25)}  # more of h = 0 escapes
NUMBER = "((x) => Object.is(x, -0) ? '-0' : String(x))"
ROW = f"""(row) => Array.from(row.subarray(0, 10), (x, i) =>
  i === 8 ? twofold.core.modes[x] : {NUMBER}(x))"""


def facts_of(tab):
    """What an address may say: scenes, lists of words, and numbers, those of
    the machine with their ranges and the laws that use them."""
    return tab.value("""(({ core }) => ({
      scenes: core.scenes.slice(0, core.ownScene),
      lists: core.lists, parameters: core.parameters,
      others: [...core.ranges.keys()].filter((name) =>
        !core.parameters.some((p) => p.name === name)) }))(twofold)""")


def number_of(at, p, of_scene, is_needed):
    """A value of a parameter near that of the scene, or of one that uses it;
    that is often 0 where it may be."""
    base = of_scene
    if base == 0 and is_needed or not p["low"] <= base <= p["high"]:
        base = p["there"]
    if base == 0 and (at.random() < 0.5 or not p["low"] <= 0):
        base = at.uniform(p["low"], min(p["high"], 1))
    elif p["low"] == 0 and at.random() < 0.1:
        base = 0
    low, high = WIDER.get(p["name"], (0.75, 1.3))
    value = min(max(base * at.uniform(low, high), p["low"]), p["high"])
    return str(round(value)) if p["isWhole"] else repr(value)


def law_of(facts, i):
    """Each once, and then the one whose futures branch."""
    laws = facts["lists"]["law"]
    return laws[i] if i < len(laws) else "jump"


def drawn(at, facts, i):
    """A scene as NAME, {name: value} of all numbers and words, and inputs by
    hand, (tick, force, torque) each. Each word of a list comes."""
    scene = at.choice(facts["scenes"] + ["chaos"] * 9 + ["driven"] * 2)
    values = dict(line.split()[:2] for line in
                  command("scene", scene).splitlines() if " " in line)
    law = law_of(facts, i)
    bit = 1 << facts["lists"]["law"].index(law)
    words = {p["name"]: number_of(at, p, float(values[p["name"]]),
                                  p["laws"] & bit)
             for p in facts["parameters"]}
    words.update((name, words_of[i % len(words_of)]) for name, words_of in
                 facts["lists"].items())
    words["law"] = law
    check(sorted(facts["others"]) == sorted((*START, "seed")),
          f"not drawn: {facts['others']}")
    words["seed"] = str(at.randrange(2 ** 32))
    words["r"] = repr(at.choice([-1, 1, 1, 1]) * at.uniform(0.05, 0.3))
    words["omega"] = repr(float(words["omega0"]) +
                          at.choice([0, 1, 1]) * at.uniform(-0.4, 0.2))
    if abs(math.sin(float(words["gamma"]))) > 0.1 and at.random() < 0.8:
        words["h"] = at.choice(["0", "0", repr(at.uniform(-0.01, 0.01))])
    else:
        words["v"] = repr(at.uniform(-0.3, 0.3))
    hands = [(tick, at.uniform(-0.3, 0.3), at.uniform(-0.01, 0.01)) for tick in
             sorted(at.sample(range(STEPS + AHEAD), at.choice([0, 0, 1, 3])))]
    return scene, words, hands


class Runs:
    """Of the command line. Where it has to branch, a saved state goes on under
    another rule, or in another mode."""

    def __init__(self, folder, scene, words, hands, in_file=()):
        """in_file: names of the words that a scene from a file has."""
        self.scene, self.words, self.hands = scene, words, hands
        self.given = {name: value for name, value in words.items()
                      if name not in in_file}
        self.state, self.table = str(folder / "state"), folder / "table"
        self.dt, self.rule = float(words["dt"]), words["rule"]
        self.rows = self.run(STEPS)

    def run(self, steps, *more, rule=None, driven=STEPS + AHEAD, **changed):
        """driven: inputs by hand are those up to that step."""
        rule = rule or self.rule
        chosen = f"random:{self.words['seed']}" if rule == "random" else rule
        sets = [word for name, value in {**self.given, **changed}.items()
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
                              runs.given.items()),
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


def runs_of(at, facts, i, folder):
    """Of an address that is drawn; some have a part of it in a file."""
    scene, words, hands = drawn(at, facts, i)
    in_file = []
    if at.random() < 0.3:
        every = (1 << len(facts["lists"]["law"])) - 1
        names = [p["name"] for p in facts["parameters"] if p["laws"] == every]
        in_file = at.sample(names + ["r", "omega"], len(names) // 2)
        text = command("scene", scene, *(word for name in in_file for word in
                                         ("--set", f"{name}={words[name]}")))
        scene = f"{folder}/own.scene"
        Path(scene).write_text(text)
    return Runs(Path(folder), scene, words, hands, in_file)


def test_futures_are_those_of_the_command_line():
    """Of twenty addresses, one opened after the other in one tab."""
    at, tab = random.Random(31), opened()
    facts = facts_of(tab)
    with tempfile.TemporaryDirectory() as folder:
        for i in range(ADDRESSES):
            runs = runs_of(at, facts, i, folder)
            while i >= len(facts["lists"]["law"]) and \
                    len(runs.openings()) == 1:
                runs = runs_of(at, facts, i, folder)
            address, every = address_of(runs), []
            open_at(tab, runs, address, STEPS)
            for tick in runs.openings():
                all_ = futures_of(tab, tick)
                check(len(all_) == int(runs.rows[tick][9]), f"{address}: "
                      f"{[mode for mode, _ in all_]} in step {tick}")
                for mode, rows in all_:
                    compare(runs, tick, mode, rows, address, all_)
                every += [(tick, *one) for one in all_]
            compare_taken(tab, runs, *at.choice(every))
