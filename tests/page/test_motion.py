"""What the page computes and how one acts on it."""
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


def address_there_and_back():
    """Two hundred set-ups of random bits, each of them with a log."""
    tab = opened("scene=gamma_zero")
    draw = random.Random(16)
    for _ in range(200):
        numbers = {name: draw.choice((1, -1)) * draw.random()
                   * 10 ** draw.randint(-300, 300)
                   for name in draw.sample(["m", "kappa", "gamma", "r0", "r",
                                            "omega", "beta", "c2"], 4)}
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
            got.refused.length === 0 &&
            JSON.stringify(got.log) === JSON.stringify(log) ? '' : text;
        }})()""")
        check(why == "", why)


def address_that_nobody_wrote():
    """What is not understood is reported, the rest holds."""
    tab = opened("scene=chaos&kapa=1&mu=x&law=glue&take=5:slide&hand=a:1:2&"
                 "tick=-4&%zz&kappa=0.31")
    told = tab.value("document.getElementById('refusal').textContent")
    for word in ("kapa=1", "mu=x", "law=glue", "take=5:slide", "hand=a:1:2",
                 "tick=-4", "%zz"):
        check(word in told, f"{word} is not in: {told}")
    check("kappa" not in told, told)
    check(tab.value("twofold.core.get('kappa')") == 0.31, "kappa")
    tab = opened("scene=nowhere&kappa=-1")
    told = tab.value("document.getElementById('refusal').textContent")
    check("kappa = -1 must lie in [1e-9, 1000000] m" in told, told)
    check(not tab.complaints(), tab.complaints())


def refusal_by_name():
    """A bad number is refused with its range, and the motion goes on."""
    tab = opened()
    go(tab, 500)
    before = tab.value("Array.from(twofold.motion.now)")
    told = tab.value("""(() => {
      const field = document.querySelector(
        'input[aria-label^="kappa:"][type=text]');
      field.focus();
      field.value = '-1';
      field.dispatchEvent(new Event('change'));
      return [field.getAttribute('aria-invalid'),
        document.getElementById('refusal').textContent,
        getComputedStyle(document.getElementById('refusal')).display];
    })()""")
    check(told == ["true", "kappa = -1 must lie in [1e-9, 1000000] m", "block"],
          told)
    check(tab.value("Array.from(twofold.motion.now)") == before, "moved")
    check(tab.value("twofold.motion.advance(600)"), "does not go on")
    check(tab.value("twofold.core.get('kappa')") > 0.27, "kappa stays")


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
         address_there_and_back, address_that_nobody_wrote, refusal_by_name,
         scrubbing_has_the_same_bits, futures_fan_out, by_hand, keyboard,
         reduced_motion]
