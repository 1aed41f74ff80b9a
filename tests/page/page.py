"""What the tests of the page share: the browser, a tab with the page in it,
and the command line beside it."""
import functools
import os
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from browser import Browser, Tab  # noqa: E402
from tap import call, check, until  # noqa: E402

BUILD = (ROOT / os.environ.get("BUILD", "build")).resolve()
COMMAND = BUILD / "double" / "twofold"
PAGE = BUILD / "page" / "index.html"
URL = PAGE.as_uri()
TWO_FOLD = 20473  # the step of `chaos` from which on three futures are open
PROGRAM = shutil.which("chromium-headless-shell")  # half as much work


@functools.cache
def browser():
    return Browser(PROGRAM)


def tab(**options):
    return Tab(browser(), **options)


def alone(test):
    """The test in a browser of its own, which goes with it."""
    def perform():
        try:
            test()
        finally:
            browser().close()
    return perform


def opened(address="scene=chaos", at=None, **options):
    """A tab with the page at an address that is whole, and at a tick of it; an
    empty one opens the story."""
    if address and not address.endswith("&end"):
        address += "&end"
    made = tab(**options)
    made.open(f"{URL}#{address}" if address else URL)
    if at is not None:
        go(made, at)
    return made


def command(*words):
    return call(*words, code=(0, 5), program=COMMAND)[0]


def settled(page):
    """When all frames that were asked for are drawn."""
    page.value("new Promise((done) => requestAnimationFrame(() => "
               "requestAnimationFrame(() => setTimeout(done, 60))))")


def go(page, tick):
    page.value(f"twofold.play(false); twofold.seek({tick}); "
               f"twofold.motion.seek({tick})")
    settled(page)


def visit(page, scene):
    page.value(f"location.hash = '#scene={scene}&end'")
    settled(page)


def arrived(page):
    """When what the address says is reached, and futures are out."""
    until(lambda: page.value("twofold.arrived()"), "it arrives")
    settled(page)


def step(page, number):
    """The tour at a step as it begins, or left for None."""
    page.value(f"twofold.goTo({'null' if number is None else number})")
    arrived(page)


WRITTEN = """new Promise((done) => {
  URL.createObjectURL = (blob) => { blob.text().then(done); return '#'; };
  HTMLAnchorElement.prototype.click = () => {};
  document.getElementById('csv').click();
})"""


def csv(page):
    """The file of rows that the page writes, and the command beside it."""
    words = page.value("twofold.play(false), twofold.draw(), "
                       "document.getElementById('command').textContent")
    return page.value(WRITTEN), words.split()


def leads_there(page):
    """What the page writes as its address, which has the row of its motion.
    Returns: a tab there."""
    tick, row = page.value("[twofold.motion.tick, twofold.motion.now.join()]")
    again = opened(page.value("twofold.write()"), tick)
    check(again.value("twofold.motion.now.join()") == row, "another motion")
    return again


def shown(page, name):
    """The text of an element."""
    return page.value(f"document.getElementById('{name}').textContent")
