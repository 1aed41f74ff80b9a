"""What the page shows is what acts: after each control, step of the tour and
scene."""
from page import (arrived, check, command, leads_there, opened, settled, shown,
                  step)
from tap import until
from test_setup import ENTER

# What is shown and does not act. The hand's numbers are held against those of
# the next step, which is taken for it.
UNLIKE = """(() => {
  twofold.draw();
  const { core, motion, fan, tour, AT } = twofold, off = [], $ = (id) =>
    document.getElementById(id);
  const same = (name, is, acts) => is === acts ||
    off.push(`${name}: ${is}, not ${acts}`);
  const is = core.modes[motion.now[8]];
  same('mode', document.querySelector('#state .mode').textContent,
    is.replace('-', '\\u2212'));
  same('time', $('time').textContent, `t = ${motion.now[0].toFixed(4)} s`);
  same('scene', $('command').textContent.split(' ')[2],
    $('scene').selectedOptions[0].text);
  same('futures', document.querySelectorAll('#choices button').length,
    fan.futures.length);
  for (const field of document.querySelectorAll('#setup input[type=text]')) {
    const name = field.ariaLabel.split(':')[0];
    same(name, Number(field.value), Number(core.get(name).toPrecision(6)));
  }
  same('pace', Number($('pace').value.slice(2)),
    Number((10 ** $('speed').value).toPrecision(2)));
  same('window', twofold.views[2].span, Number($('span').value));
  same('dt', motion.dt, core.get('dt'));
  for (const name of ['law', 'rule', 'rest'])
    same(name, $(`list-${name}`).selectedIndex, core.get(name));
  if (tour.number === 1) {
    same('says', $('says').textContent.includes('slips sideways'),
      motion.now[8] < 2);
    same('then', $('then').textContent.includes('It slips'),
      motion.now[8] < 2 && tour.isDone);
  }
  const hands = [...document.querySelectorAll('input[aria-label*="by hand"]')]
    .flatMap((slider) => [slider.value, slider.nextSibling.value].map(Number));
  const before = motion.tick;
  motion.advance(before + 1);
  const acts = motion.now.slice(AT.force, AT.torque + 1);
  motion.seek(before);
  same('by hand', hands.join(), [acts[0], acts[0], acts[1], acts[1]].join());
  return off;
})()"""
SLIDE = """((name, value) => {
  const slider = document.querySelector(
    `input[type=range][aria-label^="${name}:"]`);
  slider.value = value;
  slider.dispatchEvent(new Event('input'));
})"""


SET = """((name, value) => {
  const control = document.getElementById(name);
  if (control.options) control.selectedIndex = value;
  else control.value = value;
  for (const kind of ['input', 'change'])
    control.dispatchEvent(new Event(kind));
})"""


def click(name):
    return f"document.getElementById('{name}').click()"


SCENE = """(({ scene }) => { scene.selectedIndex = 2; scene.onchange(); })(
  document.all)"""
WAYS = [click("after"), click("before"), click("again"), click("leave"), SCENE,
        click("home"), click("back"), click("next"), click("fan"),
        f"{SLIDE}('torque', 0.4)", f"{SLIDE}('kappa', 300)",
        f"{SLIDE}('r', 120)", f"({ENTER})('mu', '2')", f"{SET}('list-law', 5)",
        f"{SET}('list-rule', 1)", f"{SET}('speed', -1)", f"{SET}('span', 3)",
        click("fan") + "; document.querySelector('#choices button').click()",
        "location.hash = '#scene=driven'",
        "location.hash = '#scene=chaos&hand=0:-1:0.2&tick=40&end'"]


def test_what_is_shown_acts():
    """A push of 2 N, and then another control."""
    tab = opened("")
    for way in WAYS:
        step(tab, 1)
        tab.value(f"{SLIDE}('force', 2)")
        until(lambda: tab.value("twofold.motion.now[8]") < 2, "it slips")
        tab.value("twofold.play(false)")
        off = tab.value(UNLIKE)
        check(not off and shown(tab, "then"), f"2 N: {off}")
        tab.value(way)
        arrived(tab)
        tab.value("twofold.play(false)")
        off = tab.value(UNLIKE)
        check(not off, f"{way}: {off}")
        leads_there(tab).close()
    check(not tab.complaints(), tab.complaints())


def test_push_of_the_past():
    """The sliders follow the log where time does, without a hand on them; a
    wheel that sticks again is not said to slip."""
    tab = opened("tick=2000&tour=1&hand=2100:2:0&hand=2200:0:0.1")
    for tick in (2150, 2050, 2400, 2100, 2000):
        tab.value(f"twofold.play(false); twofold.seek({tick})")
        arrived(tab)
        off = tab.value(UNLIKE)
        check(not off, f"{tick}: {off}")
    tab = opened("tick=2000&tour=1&hand=2100:2:0&hand=2110:0:0")
    tab.value("twofold.seek(30000)")
    arrived(tab)
    check(tab.value("twofold.motion.now[8]") >= 2, "it does not stick again")
    check("sticks again" in shown(tab, "then") and not tab.value(UNLIKE),
          shown(tab, "then"))


def test_what_was_told_stays_true():
    """Of the instant that the tour stopped at, wherever the time is."""
    tab = opened("tour=3")
    step(tab, 3)
    tab.key(" ")
    until(lambda: shown(tab, "then"), "it is there")
    said = shown(tab, "then")
    check("3 futures" in said, said)
    for way in ("twofold.seek(twofold.motion.tick + 200)",
                "twofold.seek(twofold.motion.tick - 400)"):
        tab.value(way)
        arrived(tab)
        check(shown(tab, "then") == said, shown(tab, "then"))


FOCUS = """(name) => {
  const field = document.querySelector(`input[aria-label^="${name}:"]` +
    (name === 'mu' ? '[type=text]' : ''));
  field.focus();
  return document.activeElement === field;
}"""


def test_keys_where_a_field_has_the_focus():
    """A slider keeps the keys that move it; a field all but Escape, which
    leaves it as it was."""
    tab = opened("")
    for key, holds in (
            ("n", "twofold.tour.number === 2"),
            ("P", "twofold.tour.number === 0"),
            (" ", "document.getElementById('play').ariaLabel === 'Pause'"),
            ("f", "twofold.fan.tick !== null"),
            ("?", "document.getElementById('said').textContent !== ''")):
        for leave in (False, True):
            step(tab, 1)
            check(tab.value(f"({FOCUS})('force')"), "no slider")
            if leave:
                tab.key("Escape")
            tab.key(key)
            settled(tab)
            check(tab.value(holds), f"{key} does nothing, after Escape {leave}")
    step(tab, 1)
    tab.value(f"({FOCUS})('force')")
    tab.key("ArrowRight")
    check(tab.value("twofold.motion.held.force") == 0.05, "the slider's key")
    tab.value(f"({FOCUS})('mu'); document.activeElement.value = '7n'")
    tab.key("n")
    check(tab.value("twofold.tour.number") == 1, "a field's letter")
    tab.key("Escape")
    check(tab.value("twofold.core.get('mu')") == 1
          and shown(tab, "refusal") == "", "Escape takes what was typed")
    tab.key("n")
    check(tab.value("twofold.tour.number") == 2, "Escape does not leave it")


def test_tooltips_say_what_it_is():
    """In the words of the command line."""
    tab = opened()
    titles = tab.value("""[...document.querySelectorAll('#numbers span[title]')]
      .map(({ title }) => title.split(/: (.*); /))""")
    check(len(titles) > 10, titles)
    for name, words, _ in titles:
        check(words in " ".join(command("help", name).split()), words)
    bare = tab.value("""[...document.querySelectorAll('#setup span')].filter(
      (e) => !e.title && !e.closest('h2') && e.className !== 'unit')
      .map((e) => e.outerHTML)""")
    check(not bare, bare)
