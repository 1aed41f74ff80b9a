"""How the page looks, what it weighs and what it asks for."""
import gzip
import re

from page import (PAGE, TWO_FOLD, URL, check, go, opened, settled, step,
                  visit)

MOST = 79_000  # bytes gzipped
SIZES = [{"width": width, "height": height, "phone": width < 400} for width,
         height in ((1440, 780), (1024, 768), (768, 1000), (390, 844))]


def test_no_request_to_anywhere():
    """Of all that the page does, opening its own file is the only request; its
    policy would not let it ask for more."""
    tab = opened("scene=driven", 30000)
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


def test_size():
    bytes_ = len(gzip.compress(PAGE.read_bytes(), 9, mtime=0))
    files = [p.name for p in PAGE.parent.iterdir() if p.suffix in
             (".html", ".js", ".css")]
    print(f"# {bytes_} bytes gzipped, at most {MOST}")
    check(files == ["index.html"] and bytes_ <= MOST, f"{bytes_} B, {files}")


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
EMPTY = """[...document.querySelectorAll('section, aside')].filter((e) =>
  e.checkVisibility() && (e.clientHeight < 90 || e.clientWidth < 200))
  .map((e) => e.id)"""


STRIPS = {"r [m]", "ω [rad/s]", "h [m/s]", "g [m/s]", "F [N]", "M [N m]"}
NEXT = """(() => {
  const [card, map] = ['tour', 'map'].map((id) =>
    document.getElementById(id).getBoundingClientRect());
  return [card.bottom, map.top, map.bottom];
})()"""


def test_steps_of_the_tour_are_seen():
    """No words lie on others or over an edge, no panel is empty, and on a phone
    the space is under the steps that are about it."""
    for options in SIZES:
        for dark in (False, True):
            tab = opened("", dark=dark, **options)
            for number in (*range(6), None):
                step(tab, number)
                tab.value("twofold.draw()")
                name = f"{options['width']}{'-dark' * dark}-{number}.png"
                (PAGE.parent / name).write_bytes(tab.picture())
                missing = STRIPS - {*words_of(tab, 2)}
                check(not missing, f"{name}: strips without {missing}")
                for found in (CROWDED, CUT, EMPTY):
                    check(not tab.value(found), [name, tab.value(found)])
                if options["width"] < 400 and number in (3, 4, 5):
                    card, top, end = tab.value(NEXT)
                    check(0 < top - card < 20 and end <= 844,
                          f"{name}: {card}, {top}, {end}")


BOXES = """(() => {
  const box = (id) => document.getElementById(id).getBoundingClientRect();
  return [...document.querySelectorAll('#row, #choices, #choices button')]
    .map((e) => e.getBoundingClientRect().bottom)
    .concat(box('strips').top, box('clock').right, box('row').right);
})()"""


def test_futures_cover_nothing():
    """They have a row above the ribbon, of one height whether it is empty or
    not, so that the mark stays where the pointer is."""
    for options in SIZES:
        tab = opened("scene=chaos", TWO_FOLD + 9000, **options)
        tops, most = set(), 0
        for tick in (None, *tab.value("twofold.motion.openings()")[:40]):
            tab.value(f"twofold.showFan({'null' if tick is None else tick})")
            *bottoms, top, clock, row = tab.value(BOXES)
            tops.add(top)
            most = max(most, len(bottoms) - 2)
            check(max(bottoms) <= top and row <= clock, f"{tick}: {options}")
        check(len(tops) == 1, f"the strips move: {tops}")
        check(most >= 3, f"{most} futures at most")


REGIONS = ["sliding", "escaping", "up", "down"]
MODES = ["slip-plus", "slip-minus", "stick-plus", "stick-minus", "pinned"]
LEAST_CONTRAST = 2.0    # WCAG, of a pattern or a path to what it is drawn on
LEAST_TO_PANEL = 1.25   # WCAG, of a region to the panel


def luminance(colour):
    parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return sum(weight * (c / 12.92 if c <= 0.04045
                         else ((c + 0.055) / 1.055) ** 2.4)
               for weight, c in zip((0.2126, 0.7152, 0.0722), parts))


def contrast(a, b):
    low, high = sorted(map(luminance, (a, b)))
    return (high + 0.05) / (low + 0.05)


def style(tab, names):
    return {name: tab.value("getComputedStyle(document.documentElement)"
                            f".getPropertyValue('--{name}').trim()")
            for name in names}


def test_icon_has_the_colours_of_the_modes():
    tab = opened()
    icon = tab.value("document.querySelector('[rel=icon]').href")
    drawn = {f"#{x}" for x in re.findall("%23([0-9a-f]{6})", icon)}
    modes = {*style(tab, MODES).values(), *style(tab, ["soft"]).values()}
    check(len(drawn) == 4 and drawn <= modes, drawn)


def test_regions_are_seen():
    """In light and dark, by luminance: regions on the panel, and on regions
    their patterns, by which they are known, and the paths."""
    for dark in (False, True):
        tab = opened(dark=dark)
        fill = style(tab, REGIONS)
        panel = style(tab, ["panel"])["panel"]
        check((luminance(panel) < 0.2) == dark, f"{dark}: a panel of {panel}")
        paths = style(tab, MODES)
        lines = style(tab, [f"{name}-lines" for name in REGIONS[1:]])
        for name, colour in fill.items():
            check(contrast(colour, panel) >= LEAST_TO_PANEL,
                  f"{dark}: {name} on the panel")
            for on, it in paths.items():
                check(contrast(it, colour) >= LEAST_CONTRAST,
                      f"{dark}: {on} on {name}")
        for name, line in lines.items():
            ratio = contrast(line, fill[name.removesuffix("-lines")])
            check(ratio >= LEAST_CONTRAST, f"{dark}: {name}: {ratio}")


# The pixels of the map by region: how many have its colour, how many the one of
# its pattern, and for these the sum of (distance from the middle of the nearest
# arrowhead - 1.1) times (height on it - 3.75): > 0 where arrows point upwards.
PATTERNED = """(colours) => {
  const { map: { image }, ranges: { r: x, omega: y } } = twofold.views[1];
  const { core } = twofold, { width, height } = image;
  const data = image.getContext('2d').getImageData(0, 0, width, height).data;
  const columns = 200, rows = 120;
  const regions = core.regions(x.low, x.high, columns, y.low, y.high, rows);
  const near = (at, hex) => [0, 1, 2].every((i) => Math.abs(data[at + i] -
    parseInt(hex.slice(2 * i + 1, 2 * i + 3), 16)) < 12);
  const found = colours.map(() => ({ all: 0, fill: 0, lines: 0, up: 0 }));
  for (let j = 0; j < height; j++) {
    for (let i = 0; i < width; i++) {
      const cell = (dx, dy) => regions[
        Math.floor((height - 1 - j + 0.5) / height * rows + dy) * columns +
        Math.floor((i + 0.5) / width * columns + dx)];
      const region = cell(0, 0), at = 4 * (j * width + i);
      if (!colours[region] || [-3, 3].some((d) => cell(d, 0) !== region ||
        cell(0, d) !== region)) continue;
      const got = found[region], [fill, lines] = colours[region];
      got.all++;
      got.fill += near(at, fill);
      if (!lines || !near(at, lines)) continue;
      got.lines++;
      const away = Math.min(Math.abs((i + 0.5) % 16 - 4.25),
        Math.abs((i + 0.5) % 16 - 12.25));
      got.up += (away - 1.1) * ((j + 0.5) % 8 - 3.75);
    }
  }
  return found;
}"""


def test_map_of_regions():
    """Each point of the map has the colour and the pattern of its region, and
    arrowheads point the way that the slip crosses."""
    tab = opened(f"tick={TWO_FOLD}", TWO_FOLD, width=1600, height=1200)
    colours = style(tab, REGIONS + [f"{name}-lines" for name in REGIONS])
    pairs = [[colours[name], colours[f"{name}-lines"]] for name in REGIONS]
    found = tab.value(f"({PATTERNED})({pairs})")
    for name, got in zip(REGIONS, found):
        print(f"# {name}: {got}")
        check(got["all"] > 2000, f"{name} is not in the map")
        lines, fill = (got[part] / got["all"] for part in ("lines", "fill"))
        check(lines == 0 and fill > 0.999 if name == "sliding"
              else 0.01 < lines < 0.3 < fill, f"{name}: {got}")
    check(found[2]["up"] > 0 > found[3]["up"], "which way the arrows point")


# Words of a drawing that overlap, or that run over its edge.
CROWDED = """(() => {
  const found = [];
  for (const { sheet } of twofold.views) {
    const { words } = sheet.ctx;
    words.forEach((a, i) => {
      if (a.left < 0 || a.top < 0 || a.right > sheet.width ||
        a.bottom > sheet.height) found.push(`${a.words} at the edge`);
      for (const b of words.slice(i + 1))
        if (a.left < b.right && b.left < a.right && a.top < b.bottom &&
          b.top < a.bottom) found.push(`${a.words} and ${b.words}`);
    });
  }
  const [{ sheet: { ctx }, lens, lensX, lensY }] = twofold.views;
  for (const { words, left, right, top, bottom } of ctx.words) {
    const far = (x, y) => Math.hypot(x - lensX, y - lensY) > lens + 0.5;
    if (!far((left + right) / 2, (top + bottom) / 2) && [left, right].some(
      (x) => far(x, top) || far(x, bottom))) found.push(`${words} in the lens`);
  }
  const shown = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (shown.nextNode()) {
    const node = shown.currentNode, range = document.createRange();
    if (!node.data.trim() || node.parentElement.closest(
      'option, script, noscript, svg, #choices, #said')) continue;
    range.selectNodeContents(node);
    for (const box of range.getClientRects())
      if (box.width > 0) texts.push([node.data, box]);
  }
  texts.forEach(([words, a], i) => {
    for (const [other, b] of texts.slice(i + 1))
      if (a.left < b.right - 1 && b.left < a.right - 1 &&
        a.top < b.bottom - 2 && b.top < a.bottom - 2)
        found.push(`${words} and ${other}`);
  });
  return found;
})()"""
# What is named in each drawing of `chaos`, whatever its size.
NAMED = [["F", "M", "0.2 m", "0.5 m", "9 times as large"],
         ["r [m]", "ω [rad/s]", "sliding", "escaping", "crossing ↑",
          "crossing ↓", "two-fold", "ω = ω₀", "−1"],
         ["slip+", "slip−", "stick+", "stick−", "pinned", "r [m]", "ω [rad/s]",
          "h [m/s]", "g [m/s]", "F [N]", "M [N m]", "t [s]", "0.196", "0.176",
          "−0.96", "−1.1", "0.03", "−0.01"]]


# What the map says where it has no regions.
LACKS = {"smooth": "this law has no stick", "string": "this law has no stick",
         "frictionless": "this law has no stick",
         "gamma_zero": "here v does not follow from r and ω"}


def words_of(tab, view):
    return tab.value(f"twofold.draw(), twofold.views[{view}].sheet.ctx.words"
                     ".map(({ words }) => words)")


def test_words_lie_in_the_lens():
    """Under pushes of all strengths, wherever the slider is."""
    for options in SIZES:
        for force in (-5, 2, 5):
            tab = opened(f"hand=0:{force}:0", **options)
            tab.value("twofold.play(false)")
            for tick in range(0, 8000, 500):
                crowded = tab.value(f"twofold.motion.seek({tick}), "
                                    f"twofold.draw(), {CROWDED}")
                check(not crowded, f"{force} N, {tick} {options}: {crowded}")
            tab.close()


def test_it_can_be_mailed():
    """No link leads to a file beside it, and what it is stands in it."""
    tab = opened()
    links = tab.value("[...document.links].map((a) => a.getAttribute('href'))")
    check(links and all(link.startswith("https:") for link in links), links)
    tab.value("document.getElementById('more').click()")
    check(tab.value("document.getElementById('about-this').checkVisibility()"),
          "it is not shown")


def test_words_lie_apart():
    """At each width, in every scene and at several instants."""
    for options in SIZES:
        tab = opened(f"tick={TWO_FOLD + 300}", TWO_FOLD + 300, **options)
        for i, names in enumerate(NAMED):
            missing = set(names) - {*words_of(tab, i)}
            check(not missing, f"{options}: {missing} not in drawing {i}")
        for scene in tab.value("twofold.core.scenes"):
            visit(tab, scene)
            for tick in (0, 300, 4000, 19000, 40000):
                go(tab, tick)
                crowded = tab.value(f"twofold.draw(), {CROWDED}")
                check(not crowded, f"{scene} {tick} {options}: {crowded}")
            said = [words for words in words_of(tab, 1)
                    if words in LACKS.values()]
            check(said == [LACKS.get(scene)] * (scene in LACKS), [scene, said])
