#!/usr/bin/python3 -B
"""The page in headless Chromium, beside the command line.

usage: test_page.py [WORD]...    tests whose names contain one of the words

BUILD is the folder with page/index.html and double/twofold, which `make
test-page` makes. The pictures are left in BUILD/page."""
import base64
import gzip
import io
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "fmu"))
from browser import Browser, Tab  # noqa: E402
from tap import check, run  # noqa: E402

BUILD = (ROOT / os.environ.get("BUILD", "build")).resolve()
COMMAND = BUILD / "double" / "twofold"
PAGE = BUILD / "page" / "index.html"
URL = PAGE.as_uri()
MOST = 70_000  # bytes gzipped
TWO_FOLD = 20473  # the step of `chaos` from which on three futures are open
browser = None


def opened(address="", **options):
    tab = Tab(browser, **options)
    tab.open(f"{URL}#{address}" if address else URL)
    return tab


def command(*words):
    got = subprocess.run([COMMAND, *words], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, text=True, check=False)
    check(got.returncode in (0, 5), f"{words}: {got.stderr}")
    return got.stdout


def settled(tab):
    """When all frames that were asked for are drawn."""
    tab.value("new Promise((done) => requestAnimationFrame(() => "
              "requestAnimationFrame(() => setTimeout(done, 60))))")


def go(tab, tick):
    tab.value(f"twofold.play(false); twofold.seek({tick}); "
              f"twofold.motion.seek({tick})")
    settled(tab)


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
    """What is not understood is told, the rest holds."""
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
      const field = document.querySelector('input[aria-label^="kappa:"][type=text]');
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


def futures_fan_out():
    """The three of the two-fold; a chosen one goes on, and the address has it."""
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
    # At h = g = 0 four modes are possible; whatever the core does not enter is
    # shown, but cannot be chosen.
    tab.value("location.hash = '#scene=driven&tick=84000'")
    go(tab, 84000)
    tab.value("twofold.showFan(83827)")
    names = tab.value("[...document.querySelectorAll('#choices button')]"
                      ".map((button) => button.textContent + button.disabled)")
    check(names == ["slip−true", "stick+true", "1  stick−false",
                    "2  pinnedfalse"], names)


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
    tab.mouse("Pressed", x, y)
    tab.mouse("Moved", x + 40, y)
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
      'button, input, select, canvas')].filter((e) => !(e.ariaLabel ||
      e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim() ||
      e.closest('[aria-label]'))).map((e) => e.outerHTML)""")
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


def no_request_to_anywhere():
    """Of all that the page does, opening its own file is the only request; its
    policy would not let it ask for more."""
    tab = opened("scene=driven")
    go(tab, 30000)
    tab.key("f")
    tab.value("document.getElementById('csv').click()")
    settled(tab)
    asked = [url for url in tab.requests()
             if not url.startswith(("blob:", "data:"))]
    check(asked == [URL], f"asked for {asked}")
    refused = tab.value("fetch('https://example.org/').then(() => 'got', "
                        "(error) => error.name)")
    check(refused == "TypeError", refused)
    check("default-src 'none'" in PAGE.read_text(), "no policy")


def size():
    bytes_ = len(gzip.compress(PAGE.read_bytes(), 9, mtime=0))
    files = [p.name for p in PAGE.parent.iterdir() if p.suffix in
             (".html", ".js", ".css")]
    print(f"# {bytes_} bytes gzipped, at most {MOST}")
    check(files == ["index.html"] and bytes_ <= MOST, f"{bytes_} B, {files}")


COUNT_FRAMES = """(async () => {
  const frames = async (count) => {
    const first = await new Promise(requestAnimationFrame);
    let last = first;
    for (let i = 0; i < count; i++)
      last = await new Promise(requestAnimationFrame);
    return (last - first) / count;
  };
  twofold.play(false);
  const empty = await frames(60);
  twofold.play(true);
  const playing = await frames(60);
  twofold.play(false);
  const { tick } = twofold.motion;
  const begun = performance.now();
  for (let i = 0; i < 20; i++) twofold.draw();
  return { empty, playing, drawn: (performance.now() - begun) / 20, tick };
})()"""


def frame_time():
    """Printed, not judged: what a frame costs beside one that does nothing."""
    tab = opened("tick=20000")
    go(tab, 20000)
    got = tab.value(COUNT_FRAMES)
    print(f"# a frame while playing takes {got['playing'] / got['empty']:.2f} "
          f"times an empty one ({got['empty']:.1f} ms); drawing all of it "
          f"takes {got['drawn'] / got['empty']:.2f} of one")
    check(got["tick"] > 20000, "nothing moved")


INK = """['mechanism', 'plane', 'surface', 'strips'].map((id) => {
  const canvas = document.getElementById(id);
  const { width, height } = canvas;
  const data = canvas.getContext('2d').getImageData(0, 0, width, height).data;
  const colours = new Set();
  const quarter = [0, 0, 0, 0];
  let edge = 0;
  for (let y = 0, i = 0; y < height; y++) {
    for (let x = 0; x < width; x++, i += 4) {
      if (data[i + 3] === 0) continue;
      colours.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
      quarter[2 * (2 * y >= height) + (2 * x >= width)]++;
      edge += x === 0 || y === 0 || x === width - 1 || y === height - 1;
    }
  }
  return { id, width, height, colours: colours.size, quarter, edge };
})"""
CUT = """[...document.querySelectorAll('body *')].filter((e) => {
  const box = e.getBoundingClientRect();
  if (box.width === 0 || e.closest('svg') || e.closest('[hidden]')) return false;
  const isText = e.children.length === 0 && e.textContent.trim() !== '';
  const scrolls = e.closest('#setup');
  return box.left < -0.5 || box.right > innerWidth + 0.5 ||
    isText && e.tagName !== 'OPTION' && e.scrollWidth > e.clientWidth + 1 &&
    getComputedStyle(e).display !== 'inline' ||
    e.tagName === 'INPUT' && e.type === 'text' &&
    e.scrollWidth > e.clientWidth + 1 ||
    !scrolls && box.bottom > document.documentElement.scrollHeight + 0.5;
}).map((e) => e.outerHTML.slice(0, 120))"""


def whole(name, **options):
    """A picture with something in every corner of every drawing, and nothing
    that runs over an edge of it, of its drawing or of its box."""
    tab = opened(f"tick={TWO_FOLD + 300}", **options)
    go(tab, TWO_FOLD + 300)
    tab.value(f"twofold.showFan({TWO_FOLD})")
    settled(tab)
    (PAGE.parent / f"{name}.png").write_bytes(tab.picture())
    for drawing in tab.value(INK):
        check(drawing["colours"] > 20, f"blank: {drawing}")
        check(min(drawing["quarter"]) > 0.002 * drawing["width"]
              * drawing["height"], f"a corner is empty: {drawing}")
        check(drawing["edge"] == 0, f"ink on the edge: {drawing}")
    check(not tab.value(CUT), f"cut off: {tab.value(CUT)}")
    wide = tab.value("[document.documentElement.scrollWidth, innerWidth]")
    check(wide[0] <= wide[1], f"wider than the window: {wide}")
    check(not tab.complaints(), tab.complaints())
    return tab.picture()


def picture_of_a_desk():
    light = whole("desk", width=1280, height=860)
    dark = whole("desk-dark", width=1440, height=900, dark=True)
    check(brightness(light) > 0.8 > 0.3 > brightness(dark), "light and dark")


def picture_of_a_phone():
    whole("phone", width=390, height=844, phone=True)
    whole("phone-dark", width=360, height=740, phone=True, dark=True)


def brightness(picture):
    # Only here, so that the other tests do without it.
    import matplotlib.image  # pylint: disable=import-outside-toplevel
    return float(matplotlib.image.imread(io.BytesIO(picture))[..., :3].mean())


def moving_picture_of_this_core():
    """docs/futures.svg is what its script makes, and it moves."""
    made = PAGE.parent / "futures.svg"
    subprocess.run([ROOT / "tools/figures/futures.py", COMMAND, made],
                   check=True)
    kept = ROOT / "docs/futures.svg"
    check(made.read_bytes() == kept.read_bytes(),
          "docs/futures.svg is of another core: make keep-futures")
    tab = Tab(browser, calm=False)
    tab.call("Page.navigate", url=kept.as_uri())
    looks = set()
    for time in (0, 500, 2000, 4000):
        tab.value("document.getAnimations().forEach((one) => { one.pause(); "
                  f"one.currentTime = {time}; }})")
        tab.value("new Promise((done) => setTimeout(done, 200))")
        looks.add(tab.picture())
    check(len(looks) == 3, f"{len(looks)} different pictures, not 3: it waits, "
          "then it moves")


BOARD = """
const put = [];
const flush = () => postMessage(put.splice(0));
const started = performance.now();
onmessage = async ({ data }) => {
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const { instance } = await WebAssembly.instantiate(bytes, { port: {
    put: (byte) => { if (put.push(byte) >= 100) flush(); },
    get: () => -1,
    now: () => performance.now() - started,
    halt: () => { throw 'halt'; },
  } });
  try { instance.exports.main(); } catch (end) { if (end !== 'halt') throw end; }
  flush();
  postMessage('end');
};
"""


def board_in_a_worker():
    """Firmware for wasm32 sends from a Worker in real time. All of its frames
    decode, and its rows are those of the command line."""
    make = os.environ.get("MAKE", "make")
    name = subprocess.run(
        [make, "-s", "--no-print-directory", f"BUILD={BUILD}", "elf",
         "BOARD=wasm32", "SCENE=chaos", "REAL=double", "RATE=1000", "EVERY=20",
         "STEPS=1500", "FORMAT=frames", "NAMED=-page"], cwd=ROOT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    check(name.returncode == 0, name.stdout)
    elf = BUILD / "boards/wasm32/chaos-double/firmware-page.elf"
    tab = Tab(browser)
    tab.call("Page.setBypassCSP", enabled=True)  # for the Worker alone
    tab.open(URL)
    tab.value("twofold.play(false)")
    firmware = base64.b64encode(elf.read_bytes()).decode()
    got = tab.value(f"""(async () => {{
      const worker = new Worker(URL.createObjectURL(new Blob([{BOARD!r}])));
      const readable = new ReadableStream({{ start(stream) {{
        worker.onmessage = ({{ data }}) => data === 'end' ? stream.close()
          : stream.enqueue(Uint8Array.from(data));
      }} }});
      worker.postMessage('{firmware}');
      const rows = [];
      const counters = await twofold.connect({{ readable }},
        (row) => rows.push(Array.from(row)));
      return {{ counters, rows }};
    }})()""")
    frames, damaged, lost, rows, incomplete, unknown, schema, is_float = \
        got["counters"]
    check((damaged, lost, incomplete, unknown, schema, is_float)
          == (0, 0, 0, 0, 1, 0), got["counters"])
    print(f"# {frames} frames, {rows} rows")
    want = [line.split(",") for line in command(
        "run", "chaos", "--dt", "1e-3", "--every", "20", "--t-end",
        "1.5").splitlines()[1:]]
    modes = tab.value("twofold.core.modes")
    want = [[float(x) for x in row[:8]] + [modes.index(row[8]), int(row[9])]
            for row in want]
    have = {row[0]: row for row in got["rows"]}
    check(len(have) >= 70, f"{len(have)} rows")
    for row in want:
        check(have.get(row[0], row) == row, f"{have.get(row[0])} not {row}")
    check(len(set(have) & {row[0] for row in want}) >= 70, "other instants")


TESTS = [csv_of_every_scene, csv_of_other_set_ups, lists_of_the_command_line, address_there_and_back,
         address_that_nobody_wrote, refusal_by_name,
         scrubbing_has_the_same_bits, futures_fan_out, by_hand, keyboard,
         reduced_motion, no_request_to_anywhere, size, frame_time,
         picture_of_a_desk, picture_of_a_phone, moving_picture_of_this_core,
         board_in_a_worker]


def main(words):
    global browser
    program = shutil.which("chromium")
    if not program:
        print("missing: chromium (apt-get install chromium)")
        return 3
    browser = Browser(program)
    try:
        return run([(test.__name__, test) for test in TESTS
                    if any(word in test.__name__ for word in words)])
    finally:
        browser.close()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [""]))
