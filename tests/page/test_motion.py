"""What the page computes and how one acts on it."""
import re
import time

from page import (TWO_FOLD, arrived, check, command, csv, go, leads_there,
                  opened, settled, shown, visit)
from tap import until

CHOICES = """[...document.querySelectorAll('#choices button')]
  .map((button) => button.firstChild.data)"""


def test_csv_of_every_scene():
    """Byte for byte what the command at the foot of the set-up writes, for
    other set-ups too; the motion stays where it is."""
    scenes = [line.split()[0] for line in command("scenes").splitlines()]
    for address, steps in (
            *((f"scene={name}", 30000) for name in scenes),
            ("scene=chaos&kappa=0.3&h=0&dt=0.001&omega=-1.02", 4000),
            ("rule=random&seed=7&h=0&omega=-1.02", 20000),
            ("r=0.17986265324413&h=0&omega=-1", 1000),  # at h = g = 0
            ("law=smooth&epsilon=1e-9&m=1e-7&v=-3e-9", 2000),
            ("scene=driven&rule=random&seed=3", 70007)):
        tab = opened(address, steps)
        got, words = csv(tab)
        want = command(*words[1:])
        check(tab.value("twofold.motion.tick") == steps, "it has moved")
        rows = zip(got.splitlines(), want.splitlines())
        differing = [f"{a}\n{b}" for a, b in rows if a != b]
        check(got == want, f"{len(differing)} rows of {words} differ, the "
              "first:\n" + "".join(differing[:1]))
        check(len(want.splitlines()) > 100, "too few rows to tell")


def test_scrubbing_has_the_same_bits():
    """Rows, and regions: the turntable of `driven` speeds up till 2 s. Where a
    row is kept, none of its steps are taken again."""
    for scene, ticks in (("chaos", "[20473, 93, 20500, 0, 24999]"), (
            "driven", "[motion.every, 25000 - 25000 % motion.every]")):
        tab = opened(f"scene={scene}")
        there, fresh = tab.value(f"""(() => {{
          const {{ motion }} = twofold, {{ core }} = motion;
          twofold.play(false);
          const look = () => [motion.now.join(), core.bytes(
            core.c.regions(-0.3, 0.3, 60, -3, 1, 60), 3600).join()];
          motion.seek(0);
          motion.advance(30000);
          return [{ticks}.map((tick) => (motion.seek(tick), look())),
            {ticks}.map((tick) => {{
              motion.begin();
              motion.advance(tick);
              return look();
            }})];
        }})()""")
        check(there == fresh, f"{scene}: another row or other regions")
        check(scene == "chaos" or there[0][1] != there[1][1], "one map")
    tab = opened()
    phi, table = tab.value("(twofold.play(false), twofold.motion.seek(25000), "
                           "['phi', 'table'].map((name) => "
                           "twofold.motion.now[twofold.AT[name]]))")
    check(abs(phi + 2.5) < 0.05 and abs(table + 2.5) < 1e-9,
          f"the disc has turned by {phi}, the turntable by {table}")


def test_futures_fan_out():
    """The three of the two-fold; a chosen one goes on, also by its address."""
    tab = opened(f"tick={TWO_FOLD + 500}", TWO_FOLD + 500)
    tab.key("f")
    settled(tab)
    names = tab.value(CHOICES)
    check(names == ["1  slip+", "2  slip−", "3  stick+"], names)
    ends = set()
    for key, mode in (("1", 0), ("2", 1), ("3", 2)):
        tab.value(f"twofold.showFan(null); twofold.showFan({TWO_FOLD})")
        tab.key(key)
        now = tab.value("[twofold.motion.tick, twofold.motion.now[8]]")
        check(now == [TWO_FOLD, mode], f"{now} after {key}")
        tab.value(f"twofold.motion.advance({TWO_FOLD + 300})")
        ends.add(tab.value("twofold.motion.now.join()"))
        leads_there(tab)
    check(len(ends) == 3, f"{len(ends)} ends")
    # Pointing at a mark is enough.
    tab.value("twofold.showFan(null); twofold.seek(20600)")
    settled(tab)
    x, y = tab.value("""(() => {
      const strips = twofold.views[2];
      const box = strips.sheet.canvas.getBoundingClientRect();
      const mark = strips.marks[strips.marks.length - 1];
      return [box.left + mark.x + 2, box.top + 8];
    })()""")
    tab.mouse("Moved", x, y)
    check(len(tab.value(CHOICES)) == 3, "another mark under the pointer")
    # A slip passes by h = g = 0 and sticks. Rest is possible, too.
    visit(tab, "driven&tick=84000")
    go(tab, 84000)
    tab.value("twofold.showFan(83829)")
    names = tab.value(CHOICES)
    check(names == ["1  stick−", "2  pinned"], names)


def test_futures_of_the_start():
    """A start with several modes has a mark, that of the first step, and what
    is chosen there goes on, also by its address."""
    tab = opened("h=0&omega=-1.02")
    tab.key("f")
    settled(tab)
    check(tab.value("twofold.motion.tick") == 1, "not the first step")
    check(len(tab.value(CHOICES)) == 3, shown(tab, "said"))
    tab.key("2")
    tab.value("twofold.motion.advance(300)")
    check(tab.value("twofold.motion.changes[1][2]") == 1, "no slip-")
    leads_there(tab)


TOLD = """(() => {
  const row = document.getElementById('row');
  return row.className !== 'far' ? null : { tick: twofold.motion.tick,
    done: document.getElementById('done').value,
    left: document.getElementById('left').textContent,
    seen: document.getElementById('stop').checkVisibility() };
})()"""


def told_of(tab):
    """What is said of work that takes long, as soon as it is."""
    return until(lambda: tab.value(TOLD), "it is said")


def test_far_goal_has_a_time_and_an_end():
    """Of a tick that is far away it is told how long that takes; the button
    ends it where the motion is, and then the address says that."""
    tab = opened("tick=8000000000000000")
    first = told_of(tab)
    check(re.fullmatch(r"to t = 8e11 s, \S+ years left", first["left"])
          and first["seen"], first)
    later = until(lambda: (told := tab.value(TOLD))["tick"] > first["tick"]
                  and told, "it goes on")
    check(0 < first["done"] < later["done"] < 1e-4, [first, later])
    check(tab.value("location.hash")
          == "#scene=chaos&tick=8000000000000000&end",
          "the address has lost its tick")
    tab.value("document.getElementById('stop').click()")
    settled(tab)
    tick = tab.value("twofold.motion.tick")
    check(tab.value(TOLD) is None, "it is said on")
    time.sleep(0.5)
    check(tab.value("twofold.motion.tick") == tick, "it goes on")
    check(tab.value("location.hash") == f"#scene=chaos&tick={tick}&end",
          tab.value("location.hash"))
    # The time is that of the rest, and at the goal nothing is said.
    tab = opened("tick=12000000")
    shares = [told_of(tab)["done"]]
    while (told := tab.value(TOLD)) is not None:
        check(re.fullmatch(r"to t = 1200 s, \d+ (s|min) left", told["left"]),
              told)
        shares.append(told["done"])
        time.sleep(0.1)
    check(shares == sorted(shares) and len(shares) > 3, shares)
    check(tab.value("twofold.motion.tick") == 12000000, "not the goal")


def test_far_file_can_be_stopped():
    """A file that takes long shows the time left; Escape writes none."""
    tab = opened("scene=driven")
    tab.value("""window.made = 0; URL.createObjectURL = () => ++made;
      twofold.motion.advance(4e6); twofold.seek(4e6);
      document.getElementById('csv').click()""")
    told = told_of(tab)
    check(re.fullmatch(r"driven.csv, \d+ (s|min) left", told["left"]), told)
    tab.key("Escape")
    settled(tab)
    time.sleep(0.3)
    check(tab.value(TOLD) is None and tab.value("made") == 0, "not stopped")


def test_by_hand():
    """A pulled slider is a force in the log; its address has the same bits."""
    tab = opened(at=100)
    x, y, r = tab.value("""(() => {
      const box = document.getElementById('mechanism').getBoundingClientRect();
      return [box.left + box.width * 0.78, box.top + box.height * 0.78,
        twofold.motion.now[1]];
    })()""")
    tab.mouse("Pressed", x, y, held=True)
    tab.mouse("Moved", x + 40, y, held=True)
    until(lambda: tab.value("twofold.motion.log.some(({ force }) => "
                            "Math.abs(force) > 0.1)"), "it is pulled")
    until(lambda: tab.value("twofold.motion.now[1]") != r, "it moves")
    tab.mouse("Released", x + 40, y)
    tab.value("twofold.play(false)")
    check(tab.value("twofold.motion.log.at(-1).force") == 0, "still pulled")
    leads_there(tab)


def test_choice_keeps_the_hand():
    """A future that is chosen where a pull begins is the one that was shown."""
    tab = opened()
    why = tab.value(f"""(() => {{
      const {{ motion }} = twofold, tick = {TWO_FOLD};
      motion.advance(tick - 1);
      motion.drive(1e-9, 0);
      motion.advance(tick + 400);
      const futures = motion.futures(tick, 0.03, 3);
      if (futures.length < 2) return `${{futures.length}} futures`;
      for (const {{ mode, rows }} of futures) {{
        const shown = rows.at(-1);
        motion.choose(tick, mode);
        motion.advance(shown[12]);
        if (motion.now[twofold.AT.force] !== 1e-9) return 'the pull has ended';
        if (motion.now.join() !== shown.join()) return `another ${{mode}}`;
      }}
      return '';
    }})()""")
    check(why == "", why)


def test_keyboard():
    tab = opened(at=50, calm=True)
    tab.key("ArrowRight")
    settled(tab)
    check(tab.value("twofold.motion.tick") == 51, "one step on")
    tab.key("ArrowLeft", shift=True)
    settled(tab)
    check(tab.value("twofold.motion.tick") == 0, "100 back, not before 0")
    tab.key(" ")
    check(tab.value("document.getElementById('play').ariaLabel") == "Pause",
          "plays")
    until(lambda: tab.value("twofold.motion.tick") > 100, "it moves")
    tab.key(" ")
    unnamed = tab.value("""[...document.querySelectorAll(
      'button, input, select, canvas')].filter((e) => !(
      e.getAttribute('aria-label') || e.ariaLabel || e.labels?.length ||
      e.textContent.trim() || e.closest('[aria-label]')))
      .map((e) => e.outerHTML)""")
    check(not unnamed, f"without a name: {unnamed}")


def test_reduced_motion():
    """Nothing moves by itself where the reader asks for calm."""
    head = "twofold.fan.futures[0].head[12]"
    tabs = [opened("", calm=calm) for calm in (True, False)]
    for tab in tabs:
        arrived(tab)
    still, moving = (tab.value(head) for tab in tabs)
    until(lambda: tabs[1].value(head) != moving, "the other one moves")
    check(tabs[0].value(head) == still, "it moves by itself")
