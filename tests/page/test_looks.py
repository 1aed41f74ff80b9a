"""How the page looks, what it weighs and what it asks for."""
import gzip
import io
import subprocess

from page import (COMMAND, PAGE, ROOT, TWO_FOLD, URL, check, go, opened,
                  settled, tab as empty_tab)

MOST = 70_000  # bytes gzipped


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
  if (box.width === 0 || e.closest('svg, [hidden]')) return false;
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
    tab = empty_tab(calm=False)
    tab.call("Page.navigate", url=kept.as_uri())
    looks = set()
    for time in (0, 500, 2000, 4000):
        tab.value("document.getAnimations().forEach((one) => { one.pause(); "
                  f"one.currentTime = {time}; }})")
        tab.value("new Promise((done) => setTimeout(done, 200))")
        looks.add(tab.picture())
    check(len(looks) == 3, f"{len(looks)} different pictures, not 3: it waits, "
          "then it moves")


TESTS = [no_request_to_anywhere, size, frame_time, picture_of_a_desk,
         picture_of_a_phone, moving_picture_of_this_core]
