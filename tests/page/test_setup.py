"""The set-up: the address that holds it, and what is refused of it."""
import json
import random

from page import check, opened, settled, shown, visit


def in_range(draw, low, high):
    """Any number between two, of any size."""
    while True:
        value = draw.choice((1, -1)) * draw.random() \
            * 10 ** draw.randint(-300, 15)
        if low <= value <= high:
            return value


def test_address_there_and_back():
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
          const all = () => core.setup.slice();
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
    ("hand=4:1:1&hand=4:2:2&take=4:slip%2B&take=4:slip-",
     ["hand=4:2:2: already given", "take=4:slip-: already given"], {}),
    ("mu=1x", ["'1x' is not a number"], {}),
    ("mu=%201", ["' 1' is not a number"], {}),
    ("mu=1%00", ["is not a number"], {}),
    ("mu=" + "1" * 2000, ["is not a number"], {}),
    ("mu=1e-999", ["too small"], {}),
    ("mu=", ["mu=: expected a value"], {}),
    ("kappa=0.3&&", [": expected name=value"], {"kappa": 0.3}),
    ("mu=nan", ["mu = NaN must lie in [0, 1000000000] N"], {}),
    ("mu=1e999", ["mu = Infinity must lie in"], {}),
    ("kappa=-1&mu=2", ["kappa = -1 must lie in [1e-9, 1000000] m"],
     {"mu": 2}),
    ("segments=2.5", ["segments = 2.5 must be a whole number in [0, 1000]"],
     {}),
    ("kappa=0x1p-2", [], {"kappa": 0.25}),
    ("law=glue", ["law=glue: unknown law; there are jump, coulomb,"], {}),
    ("rule=slip%2", ["rule=slip%2: % is not followed by a code"], {}),
    ("scene=nowhere&mu=2", ["scene=nowhere: unknown scene; there are chaos,"],
     {"mu": 2}),
    ("file=a.scene", ["file=a.scene: expected NAME:TEXT"], {}),
    ("file=a.scene:law%20glue", ["a.scene:1: law: unknown", "'glue'"], {}),
    ("rule=random&seed=-1", ["seed = -1 must be a whole number in [0, 42949"],
     {"rule": 3}),
    ("seed=7", ["seed has no effect: rule persist"], {"seed": 7}),
    ("epsilon=0.5", ["epsilon has no effect: law jump does not use it"],
     {"epsilon": 0.5}),
    ("tolerance=0", ["tolerance has no effect: only scheme located"],
     {"tolerance": 0}),
    ("law=coulomb&rest=square", ["rest has no effect: law coulomb"],
     {"law": 1, "rest": 1}),
    ("law=smooth&mu=2", ["epsilon = 0 must lie in [1e-12, 1000000] m/s: law "
                         "smooth needs it; scene chaos is shown unchanged"],
     {}),
    ("gamma=0", ["gamma = 0: with a start by h, |sin(gamma)| must be"], {}),
    ("r=9e8&omega=9e8", ["|r| + |v| + |omega| must be at most 1000000000"], {}),
    ("take=5:slide", ["take=5:slide: expected TICK:MODE, MODE one of slip+"],
     {}),
    ("hand=1:2", ["hand=1:2: expected TICK:FORCE:TORQUE"], {}),
    ("hand=1:inf:2", ["force and torque must lie in [-1000000000, 1000000000"],
     {}),
    ("tick=-4", ["tick=-4: '-4' must be a whole number in [0, 900719925474"],
     {}),
    ("tick=99999999999999999999", ["must be a whole number in [0, 90071992"],
     {}),
    (MANY, ["no0=1: unknown", "no7=1: unknown", "and 12 more"], {}),
    ("kappa=0.3&mu=2", [], {"kappa": 0.3, "mu": 2}),
    ("scene=chaos&tour=6", ["tour=6: no such step"], {}),
    ("scene=chaos", [], {}),
]


def test_address_that_nobody_wrote():
    """All that is not done is told by name, in the set-up and in the line that
    is in sight; the rest holds, and numbers are those of the command line."""
    tab = opened()
    for address, words, hold in STRANGE:
        tab.value("history.replaceState(null, '', '#'); location.hash = "
                  f"'#{address}&end'; dispatchEvent(new Event('hashchange'))")
        settled(tab)
        told = shown(tab, "refusal")
        for word in words:
            check(word in told, f"{address}: {word} is not in: {told}")
        check(bool(words) == (told != ""), f"{address}: {told}")
        said = shown(tab, "said")
        check(not words or said == told, f"{address}: {said}")
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


def test_address_that_was_cut_off():
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
    plain = told.pop(len("scene=chaos"))  # which people write
    check(plain == told[0] == 0 and all(told[1:]), f"not told: {told}")
    tab.value("location.hash = '#scene=driven'")
    settled(tab)
    check(shown(tab, "refusal") == shown(tab, "said") == "", "it nags")
    check(tab.value(f"twofold.read({text!r}).told.length") == 0, text)


def test_address_of_no_motion():
    """A mode that the step does not end in stops the motion, and is named."""
    tab = opened("take=5:pinned&tick=10")
    settled(tab)
    said = shown(tab, "said")
    check("no step from here ends in pinned" in said, said)
    check(tab.value("twofold.motion.tick") == 5, "goes on")


ENTER = """(name, text) => {
  const field = document.querySelector(
    `input[aria-label^="${name}:"][type=text]`);
  field.focus();
  field.value = text;
  field.dispatchEvent(new Event('change'));
  return [document.getElementById('refusal').textContent,
    Number(field.value), twofold.core.get(name)];
}"""


def test_refusal_by_name():
    """A bad number is refused with its range, the field shows the one that
    holds, and the motion goes on."""
    tab = opened(at=500)
    before = tab.value("Array.from(twofold.motion.now)")
    kappa = tab.value("twofold.core.get('kappa')")
    for name, text, words in (
            ("kappa", "-1", "kappa = -1 must lie in [1e-9, 1000000] m"),
            ("kappa", "x", "kappa: 'x' is not a number; it takes [1e-9, 10"),
            ("mu", "inf", "mu = Infinity must lie in [0, 1000000000] N"),
            ("gamma", "0", "gamma = 0: with a start by h, |sin(gamma)| mus"),
            ("omega", "1e9", "|r| + |v| + |omega| must be at most 10000000")):
        held = tab.value(f"twofold.core.get('{name}')")
        got = tab.value(f"({ENTER})('{name}', '{text}')")
        check(words in got[0], f"{name} {text}: {got[0]}")
        check(got[1] == got[2] == held, f"{name} {text}: {got}")
        check(words in shown(tab, "said"), shown(tab, "said"))
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


def test_every_law_from_every_law():
    """The menu leads from each scene to each law and on to each other one. The
    parameters of the law are shown, within the range of the core."""
    tab = opened()
    laws = tab.value("twofold.core.lists.law")
    table = {p["name"]: p for p in tab.value("twofold.core.parameters")}
    for scene in tab.value("twofold.core.scenes"):
        visit(tab, scene)
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


def test_a_law_brings_its_parameters():
    """With values that are those of a scene, which is told; what was entered
    for one law stays for the next."""
    tab = opened()
    for law, names, told in (
            ("smooth", ["epsilon"], "law smooth: epsilon = 0.0001 m/s as in "
                                    "scene smooth"),
            ("string", ["k", "delta", "sigma", "rho", "a"],
             "law string: k = 1 1/m^2, delta = 1 1/m, sigma = 1 m, rho = 0.")):
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
