"""What the page computes and how one acts on it."""
import json
import random

from page import TWO_FOLD, check, command, go, opened, settled


def same_csv(address, steps, every, *words):
    tab = opened(address)
    tab.value(f"twofold.play(false); twofold.motion.advance({steps // 2})")
    got = tab.value(f"twofold.motion.csv({every}, {steps})")
    want = command("run", *words, "--every", str(every))
    rows = zip(got.splitlines(), want.splitlines())
    differing = [f"{a}\n{b}" for a, b in rows if a != b]
    check(got == want, f"{len(differing)} rows differ, the first:\n"
          + "".join(differing[:1]))
    check(len(want.splitlines()) > 100, "too few rows to tell")


def csv_of_every_scene():
    """Byte for byte, also after the page has been ahead and back."""
    for line in command("scenes").splitlines():
        scene = line.split()[0]
        same_csv(f"scene={scene}", 30000, 7, scene, "--t-end", "3")


def csv_of_other_set_ups():
    same_csv("scene=chaos&kappa=0.3&h=0&dt=0.001&omega=-1.02", 4000, 3, "chaos",
             "--t-end", "4", "--set", "kappa=0.3", "--set", "h=0", "--set",
             "omega=-1.02", "--dt", "1e-3")
    same_csv("rule=random&seed=7&h=0&omega=-1.02", 20000, 10, "chaos",
             "--t-end", "2", "--select", "random:7", "--set", "h=0", "--set",
             "omega=-1.02")
    same_csv("law=smooth&epsilon=1e-9&m=1e-7&v=-3e-9", 2000, 1, "chaos",
             "--t-end", "0.2", "--set", "law=smooth", "--set", "epsilon=1e-9",
             "--set", "m=1e-7", "--set", "v=-3e-9")
    same_csv("scene=driven&rule=slip%2B", 70000, 100, "driven", "--t-end", "7",
             "--select", "slip+")


def in_range(draw, low, high):
    """Any number between two, of any size."""
    while True:
        value = draw.choice((1, -1)) * draw.random() \
            * 10 ** draw.randint(-300, 15)
        if low <= value <= high:
            return value


def address_there_and_back():
    """Two hundred set-ups of random bits, each of them with a log."""
    tab = opened("scene=gamma_zero")
    draw = random.Random(16)
    ranges = {name: tab.value("(({ low, high }) => [low, high])("
                              f"twofold.core.ranges.get('{name}'))")
              for name in ("m", "kappa", "gamma", "r0", "r", "omega", "beta",
                           "c2")}
    for _ in range(200):
        numbers = {name: in_range(draw, *ranges[name])
                   for name in draw.sample(sorted(ranges), 4)}
        numbers[draw.choice("hv")] = draw.choice((-0.0, 5e-324, 0.1 + 0.2))
        sets = "".join(f"core.set('{name}', {value!r});"
                       for name, value in numbers.items())
        scene = draw.randrange(9)
        why = tab.value(f"""(() => {{
          const {{ core, motion }} = twofold;
          core.c.load({scene});
          {sets}
          core.set('rule', {draw.randrange(4)});
          core.set('seed', {draw.randrange(2 ** 32)});
          const log = [{{ tick: 3, mode: {draw.randrange(5)} }},
            {{ tick: {draw.randrange(2 ** 50)}, force: {draw.random()!r},
            torque: {-draw.random()!r} }}];
          const all = () => core.names.map((_, i) => core.c.get(i));
          const before = all(), text = twofold.writeOf({scene}, log, 12);
          if (!all().every((x, i) => Object.is(x, before[i])))
            return 'writing has changed the set-up';
          core.c.load(0);
          const got = twofold.read(text);
          const off = all().findIndex((x, i) => !Object.is(x, before[i]) &&
            !(core.names[i] === 'h' && before[core.at['v is given']]) &&
            !(core.names[i] === 'v' && !before[core.at['v is given']]));
          if (off >= 0) return core.names[off] + ' in ' + text;
          return got.scene === {scene} && got.tick === 12 &&
            got.told.length === 0 &&
            JSON.stringify(got.log) === JSON.stringify(log) ? '' : text;
        }})()""")
        check(why == "", why)


def refused(tab):
    return tab.value("document.getElementById('refusal').textContent")


def said(tab):
    """The line that is in sight wherever one looks."""
    return tab.value("document.getElementById('said').textContent")


SEEDED = "rule=random&seed=7&"
MANY = "&".join(f"no{i}=1" for i in range(20))
# Addresses of which not all is done: words that must be told, and numbers that
# hold; all else is as in the scene.
STRANGE = [
    ("kapa=1", ["kapa=1: unknown name"], {}),
    ("constructor=5&toString=1&__proto__=2&v%20is%20given=1&length=1",
     ["constructor=5: unknown name", "toString=1: unknown", "__proto__=2: un",
      "v%20is%20given=1: unknown", "length=1: unknown"], {}),
    ("kappa=0.3&kappa=0.2", ["kappa=0.2: already given by kappa=0.3"],
     {"kappa": 0.3}),
    ("h=0&v=1", ["v=1: already given by h=0"], {"h": 0}),
    ("scene=coulomb&scene=chaos", ["scene=chaos: already given by scene=cou"],
     {"law": 1}),
    ("tick=4&tick=5", ["tick=5: already given by tick=4"], {}),
    ("hand=4:1:1&hand=4:2:2&take=4:slip%2B&take=4:slip-",
     ["hand=4:2:2: already given", "take=4:slip-: already given"], {}),
    ("mu=x", ["mu=x: 'x' is not a number"], {}),
    ("mu=1x", ["'1x' is not a number"], {}),
    ("mu=%201", ["' 1' is not a number"], {}),
    ("mu=1%00", ["is not a number"], {}),
    ("mu=1,5", ["'1,5' is not a number"], {}),
    ("mu=0b1", ["'0b1' is not a number"], {}),
    ("mu=" + "1" * 2000, ["is not a number"], {}),
    ("mu=1e-999", ["too small"], {}),
    ("mu=", ["mu=: expected a value"], {}),
    ("mu", ["mu: expected name=value"], {}),
    ("kappa=0.3&&", [": expected name=value"], {"kappa": 0.3}),
    ("mu=nan", ["mu = NaN must lie in [0, 1000000000] N"], {}),
    ("mu=1e999", ["mu = Infinity must lie in"], {}),
    ("kappa=-1&mu=2", ["kappa = -1 must lie in [1e-9, 1000000] m"],
     {"mu": 2}),
    ("r=2e9", ["r = 2000000000 must lie in [-1000000000, 1000000000] m"], {}),
    ("kappa=0x1p-2", [], {"kappa": 0.25}),
    ("mu=0x10", [], {"mu": 16}),
    ("law=glue", ["law=glue: unknown law; there are jump, coulomb,"], {}),
    ("law=1", ["law=1: unknown law"], {}),
    ("rule=slip%2", ["rule=slip%2: % is not followed by a code"], {}),
    ("%zz", ["%zz: expected name=value"], {}),
    ("%zz=%ff", ["%zz=%ff: % is not"], {}),
    ("scene=nowhere&mu=2", ["scene=nowhere: unknown scene; there are chaos,"],
     {"mu": 2}),
    ("file=a.scene", ["file=a.scene: expected NAME:TEXT"], {}),
    ("file=a.scene:law%20glue:x", ["expected NAME:TEXT"], {}),
    ("file=a.scene:law%20glue", ["a.scene:1: law: unknown", "'glue'"], {}),
    (SEEDED + "seed=8", ["seed=8: already given"], {"seed": 7, "rule": 3}),
    ("rule=random&seed=-1", ["seed = -1 must be a whole number in [0, 42949"],
     {"rule": 3}),
    ("rule=random&seed=1.5", ["seed = 1.5 must be a whole number"],
     {"rule": 3}),
    ("seed=7", ["seed has no effect: rule persist"], {"seed": 7}),
    ("rate=3", ["rate has no effect: rule persist"], {"rate": 3}),
    ("epsilon=0.5", ["epsilon has no effect: law jump does not use it"],
     {"epsilon": 0.5}),
    ("epsilon=-1", ["epsilon = -1 must lie in [1e-12, 1000000] m/s"], {}),
    ("tolerance=0", ["tolerance has no effect: only scheme located"],
     {"tolerance": 0}),
    ("law=coulomb&rest=square", ["rest has no effect: law coulomb"],
     {"law": 1, "rest": 1}),
    ("law=smooth&mu=2", ["epsilon = 0 must lie in [1e-12, 1000000] m/s: law "
                         "smooth needs it; scene chaos is shown as it comes"],
     {}),
    ("gamma=0", ["gamma = 0: with a start by h, |sin(gamma)| must be"], {}),
    ("r=9e8&omega=9e8", ["|r| + |v| + |omega| must be at most 1000000000"], {}),
    ("take=5:slide", ["take=5:slide: expected TICK:MODE, MODE one of slip+"],
     {}),
    ("take=x:slip-", ["take=x:slip-: 'x' must be a whole number in [0, 90"],
     {}),
    ("take=5:slip-:x", ["take=5:slip-:x: expected TICK:MODE"], {}),
    ("hand=a:1:2", ["hand=a:1:2: 'a' must be a whole number"], {}),
    ("hand=1:2", ["hand=1:2: expected TICK:FORCE:TORQUE"], {}),
    ("hand=1:x:2", ["hand=1:x:2: 'x' is not a number"], {}),
    ("hand=1:inf:2", ["force and torque must lie in [-1000000000, 1000000000"],
     {}),
    ("tick=-4", ["tick=-4: '-4' must be a whole number in [0, 900719925474"],
     {}),
    ("tick=0x10", ["'0x10' must be a whole number"], {}),
    ("tick=1e3", ["'1e3' must be a whole number"], {}),
    ("tick=99999999999999999999", ["must be a whole number in [0, 90071992"],
     {}),
    ("scene%3Dchaos%26mu%3D2", ["scene%3Dchaos%26mu%3D2: expected name="], {}),
    (MANY, ["no0=1: unknown", "no7=1: unknown", "and 12 more"], {}),
    ("kappa=0.3&mu=2", [], {"kappa": 0.3, "mu": 2}),
    ("", [], {}),
]


def address_that_nobody_wrote():
    """All that is not done is told by name, in the set-up and in the line that
    is in sight; the rest holds, and numbers are those of the command line."""
    tab = opened()
    for address, words, hold in STRANGE:
        tab.value(f"history.replaceState(null, '', '#'); location.hash = "
                  f"{'#' + address + '&end' if address else ''!r}")
        tab.value("dispatchEvent(new Event('hashchange')), 0")
        settled(tab)
        told = refused(tab)
        for word in words:
            check(word in told, f"{address}: {word} is not in: {told}")
        check(bool(words) == (told != ""), f"{address}: {told}")
        check(not words or said(tab) == told, f"{address}: {said(tab)}")
        scene = tab.value("document.getElementById('scene').selectedIndex")
        off = tab.value(f"""(() => {{
          const {{ core }} = twofold, now = core.names.map((n) => core.get(n));
          const hold = {json.dumps(hold)};
          core.c.load({scene});
          return core.names.filter((name, i) =>
            !Object.is(now[i], hold[name] ?? core.get(name)));
        }})()""")
        off = [name for name in off if name != "v is given"]
        check(not off, f"{address} sets {off}")
    check(not tab.complaints(), tab.complaints())


def address_that_was_cut_off():
    """However short: what the page writes ends in a word that is then missing,
    or the word before is no word."""
    tab = opened()
    text = tab.value("""(() => {
      const { core } = twofold;
      core.set('kappa', 0.30000000000000004);
      core.set('rule', 1);
      return twofold.writeOf(0, [{ tick: 3, mode: 1 },
        { tick: 40, force: 1.5, torque: -2 }], 1234);
    })()""")
    check(text.endswith("&tick=1234&end"), text)
    told = tab.value(f"""Array.from({{ length: {len(text)} }}, (_, i) =>
      twofold.read({text!r}.slice(0, i)).told.length)""")
    check(told[0] == 0 and all(told[1:]), f"not told: {told}")
    check(tab.value(f"twofold.read({text!r}).told.length") == 0, text)


ENTER = """(name, text) => {
  const field = document.querySelector(
    `input[aria-label^="${name}:"][type=text]`);
  field.focus();
  field.value = text;
  field.dispatchEvent(new Event('change'));
  return [document.getElementById('refusal').textContent,
    Number(field.value), twofold.core.get(name)];
}"""


def refusal_by_name():
    """A bad number is refused with its range, the field shows the one that
    holds, and the motion goes on."""
    tab = opened()
    go(tab, 500)
    before = tab.value("Array.from(twofold.motion.now)")
    kappa = tab.value("twofold.core.get('kappa')")
    for name, text, words in (
            ("kappa", "-1", "kappa = -1 must lie in [1e-9, 1000000] m"),
            ("kappa", "x", "kappa: 'x' is not a number; it takes [1e-9, 10"),
            ("kappa", "", "kappa: '' is not a number; it takes [1e-9, 1000"),
            ("mu", "inf", "mu = Infinity must lie in [0, 1000000000] N"),
            ("theta", "0.4", "theta = 0.4 must lie in [0.5, 1]"),
            ("r", "2e9", "r = 2000000000 must lie in [-1000000000, 1000000"),
            ("gamma", "0", "gamma = 0: with a start by h, |sin(gamma)| mus"),
            ("omega", "1e9", "|r| + |v| + |omega| must be at most 10000000")):
        held = tab.value(f"twofold.core.get('{name}')")
        got = tab.value(f"({ENTER})('{name}', '{text}')")
        check(words in got[0], f"{name} {text}: {got[0]}")
        check(got[1] == got[2] == held, f"{name} {text}: {got}")
        check(words in said(tab), said(tab))
        check(tab.value("Array.from(twofold.motion.now)") == before, "moved")
    check(tab.value("getComputedStyle(document.getElementById('refusal'))"
                    ".display") == "block", "the refusal is hidden")
    check(tab.value("twofold.motion.advance(600)"), "does not go on")
    check(tab.value("twofold.core.get('kappa')") == kappa, "kappa stays")
    got = tab.value(f"({ENTER})('kappa', '0x1p-2')")
    check(got == ["", 0.25, 0.25], f"hexadecimal: {got}")


CHOOSE = """(name, word) => {
  const list = () => document.getElementById(`list-${name}`);
  list().value = word;
  list().focus();
  list().dispatchEvent(new Event('change'));
  const shown = [...document.querySelectorAll('#numbers input[type=text]')];
  return { holds: twofold.core.lists[name][twofold.core.get(name)],
    menu: list().value, focus: document.activeElement === list(),
    refusal: document.getElementById('refusal').textContent,
    said: document.getElementById('said').textContent,
    rest: document.getElementById('list-rest').checkVisibility(),
    names: shown.map((field) => field.ariaLabel.split(':')[0]),
    numbers: shown.map((field) => Number(field.value)) };
}"""


def every_law_from_every_law():
    """The menu leads from each scene to each law and on to each other one. The
    parameters of the law are shown, within the range of the core."""
    tab = opened()
    laws = tab.value("twofold.core.lists.law")
    table = {p["name"]: p for p in tab.value("twofold.core.parameters")}
    for scene in tab.value("twofold.core.scenes"):
        tab.value(f"location.hash = '#scene={scene}&end'")
        settled(tab)
        home = tab.value("twofold.write()")
        own = laws[tab.value("twofold.core.get('law')")]
        for law in [law for one in laws for law in (one, own, one)] + [own]:
            got = tab.value(f"({CHOOSE})('law', '{law}')")
            step = f"{scene}, {law}: {got}"
            check(got["holds"] == got["menu"] == law and got["focus"], step)
            check(got["refusal"] == "", step)
            check(got["rest"] == (law == "jump"), step)
            check(tab.value("twofold.motion.advance(20)"), step)
            needed = [name for name, p in table.items()
                      if p["laws"] >> laws.index(law) & 1
                      and name not in ("rate", "tolerance", "segments")]
            check(got["names"] == needed, step)
            for name, number in zip(got["names"], got["numbers"]):
                low, high = table[name]["low"], table[name]["high"]
                check(low <= number <= high, f"{name}, {step}")
        back = tab.value("twofold.seek(0), twofold.write()")
        check(back == home, f"{back} is not {home}")
    check(not tab.complaints(), tab.complaints())


def a_law_brings_its_parameters():
    """With values that are those of a scene, which is told; what was entered
    for one law stays for the next."""
    tab = opened()
    for law, names, told in (
            ("smooth", ["epsilon"], "law smooth: epsilon = 0.0001 m/s as in "
                                    "scene smooth"),
            ("two_piece", ["k"], "law two_piece: k = 1 1/m^2 as in scene"),
            ("string", ["k", "delta", "sigma", "rho", "a"],
             "law string: delta = 1 1/m, sigma = 1 m, rho = 0.66666666")):
        got = tab.value(f"({CHOOSE})('law', '{law}')")
        check(told in got["said"], got["said"])
        for name in names:
            check(name in got["names"], got)
            check(tab.value(f"({ENTER})('{name}', '0.5')") == ["", 0.5, 0.5],
                  f"{name} is not taken")
        tab.value(f"({CHOOSE})('law', 'jump')")
    # Where the core refuses a law, its menu shows the one that holds.
    tab.value("twofold.core.set('mu', 2e9)")
    for name, word in (("law", "none"), ("rule", "slip+"), ("rest", "square")):
        got = tab.value(f"({CHOOSE})('{name}', '{word}')")
        check(got["menu"] == got["holds"] != word, got)
        check("mu = 2000000000 must lie in [0, 1000000000] N"
              in got["refusal"], got)


def scrubbing_has_the_same_bits():
    tab = opened()
    check(tab.value("""(() => {
      const { motion } = twofold;
      twofold.play(false);
      motion.seek(0);
      const at = (tick) => (motion.seek(tick), motion.now.join());
      motion.advance(25000);
      const there = [20473, 93, 20500, 0, 24999].map(at);
      const fresh = [20473, 93, 20500, 0, 24999].map((tick) => {
        motion.begin();
        motion.advance(tick);
        return motion.now.join();
      });
      return there.every((row, i) => row === fresh[i]);
    })()"""), "another row")
    phi, table = tab.value("(twofold.motion.seek(25000), "
                           "[twofold.motion.now[13], twofold.motion.now[14]])")
    check(abs(phi + 2.5) < 0.05 and abs(table + 2.5) < 1e-9,
          f"the disc has turned by {phi}, the turntable by {table}")


def futures_fan_out():
    """The three of the two-fold; a chosen one goes on, also by its address."""
    tab = opened(f"tick={TWO_FOLD + 500}")
    go(tab, TWO_FOLD + 500)
    tab.key("f")
    settled(tab)
    names = tab.value("[...document.querySelectorAll('#choices button')]"
                      ".map((button) => button.textContent)")
    check(names == ["1  slip+", "2  slip−", "3  stick+"], names)
    ends = set()
    for key, mode in (("1", 0), ("2", 1), ("3", 2)):
        tab.value(f"twofold.showFan(null); twofold.showFan({TWO_FOLD})")
        tab.key(key)
        now = tab.value("[twofold.motion.tick, twofold.motion.now[8]]")
        check(now == [TWO_FOLD, mode], f"{now} after {key}")
        tab.value(f"twofold.motion.advance({TWO_FOLD + 300})")
        row = tab.value("Array.from(twofold.motion.now).join()")
        ends.add(row)
        again = opened(tab.value("twofold.write()"))
        go(again, TWO_FOLD + 300)
        check(again.value("Array.from(twofold.motion.now).join()") == row,
              "the address leads elsewhere")
    check(len(ends) == 3, f"{len(ends)} ends")
    # Pointing at a mark is enough.
    tab.value("twofold.showFan(null); twofold.seek(20600)")
    settled(tab)
    x, y = tab.value("""(() => {
      const strips = twofold.views[3];
      const box = strips.sheet.canvas.getBoundingClientRect();
      const mark = strips.marks[strips.marks.length - 1];
      return [box.left + mark.x + 2, box.top + 8];
    })()""")
    tab.mouse("Moved", x, y)
    count = tab.value("document.querySelectorAll('#choices button').length")
    check(count == 3, f"{count} futures under the pointer")
    # A slip meets h = g = 0 and may stick or rest; a step later rest and a
    # slip are possible too, but a step into them ends as a stick: they are
    # shown, but cannot be chosen.
    tab.value("location.hash = '#scene=driven&tick=84000'")
    go(tab, 84000)
    for tick, expected in (
            (83827, ["1  stick−false", "2  pinnedfalse"]),
            (83828,
             ["slip−true", "1  stick−false", "pinnedtrue"])):
        tab.value(f"twofold.showFan({tick})")
        names = tab.value(
            "[...document.querySelectorAll('#choices button')]"
            ".map((button) => button.textContent + button.disabled)")
        check(names == expected, f"{tick}: {names}")


def by_hand():
    """A pulled slider is a force in the log; its address has the same bits."""
    tab = opened()
    go(tab, 100)
    x, y, r = tab.value("""(() => {
      const box = document.getElementById('mechanism').getBoundingClientRect();
      const ring = [...document.querySelectorAll('#mechanism')][0];
      return [box.left + box.width * 0.78, box.top + box.height * 0.78,
        twofold.motion.now[1]];
    })()""")
    tab.mouse("Pressed", x, y, held=True)
    tab.mouse("Moved", x + 40, y, held=True)
    tab.value("new Promise((done) => setTimeout(done, 700))")
    force = tab.value("twofold.motion.log.map((entry) => entry.force)")
    tab.mouse("Released", x + 40, y)
    tab.value("twofold.play(false)")
    check(force and max(map(abs, force)) > 0.1, f"forces {force}")
    check(tab.value("twofold.motion.now[1]") != r, "the slider stays")
    check(tab.value("twofold.motion.log.at(-1).force") == 0, "still pulled")
    tick, row = tab.value("[twofold.motion.tick, twofold.motion.now.join()]")
    again = opened(tab.value("twofold.write()"))
    go(again, tick)
    check(again.value("twofold.motion.now.join()") == row, "another motion")


def keyboard():
    tab = opened(calm=True)
    go(tab, 50)
    tab.key("ArrowRight")
    settled(tab)
    check(tab.value("twofold.motion.tick") == 51, "one step on")
    tab.key("ArrowLeft", shift=True)
    settled(tab)
    check(tab.value("twofold.motion.tick") == 0, "100 back, not before 0")
    tab.key(" ")
    check(tab.value("document.getElementById('play').ariaLabel") == "Pause",
          "plays")
    tab.value("new Promise((done) => setTimeout(done, 300))")
    tab.key(" ")
    check(tab.value("twofold.motion.tick") > 100, "has moved")
    unnamed = tab.value("""[...document.querySelectorAll(
      'button, input, select, canvas')].filter((e) => !(
      e.getAttribute('aria-label') || e.ariaLabel || e.labels?.length ||
      e.textContent.trim() || e.closest('[aria-label]')))
      .map((e) => e.outerHTML)""")
    check(not unnamed, f"without a name: {unnamed}")


def lists_of_the_command_line():
    """Laws, rules and laws of rest have the names that `run` takes."""
    told = command("help", "run")
    tab = opened()
    for name in ("law", "rest"):
        names = tab.value(f"[...document.getElementById('list-{name}').options]"
                          ".map((option) => option.text)")
        check(f"  {name:9} {', '.join(names)}\n" in told
              or f"  {name:9} {', '.join(names)}, " in told, names)
    for rule in tab.value("[...document.getElementById('list-rule').options]"
                          ".map((option) => option.text)"):
        command("run", "chaos", "--t-end", "0", "--select", rule)


def reduced_motion():
    """Nothing moves by itself where the reader asks for calm."""
    for calm in (True, False):
        tab = opened(calm=calm)
        tab.value("new Promise((done) => setTimeout(done, 300))")
        check((tab.value("twofold.motion.tick") == 0) == calm, f"calm {calm}")


TESTS = [csv_of_every_scene, csv_of_other_set_ups, lists_of_the_command_line,
         address_there_and_back, address_that_nobody_wrote,
         address_that_was_cut_off, refusal_by_name, every_law_from_every_law,
         a_law_brings_its_parameters,
         scrubbing_has_the_same_bits, futures_fan_out, by_hand, keyboard,
         reduced_motion]
