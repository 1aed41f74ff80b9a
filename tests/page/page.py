"""What the tests of the page share: the browser, a tab with the page in it,
and the command line beside it."""
import atexit
import functools
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from browser import Browser, Tab  # noqa: E402
from tap import check  # noqa: E402

BUILD = (ROOT / os.environ.get("BUILD", "build")).resolve()
COMMAND = BUILD / "double" / "twofold"
PAGE = BUILD / "page" / "index.html"
URL = PAGE.as_uri()
TWO_FOLD = 20473  # the step of `chaos` from which on three futures are open
PROGRAM = shutil.which("chromium")
_tabs = []


@functools.cache
def browser():
    made = Browser(PROGRAM)
    atexit.register(made.close)
    return made


def tab(**options):
    _tabs.append(Tab(browser(), **options))
    return _tabs[-1]


def alone(test):
    """The test, which leaves no tab behind that would slow the next one."""
    def perform():
        try:
            test()
        finally:
            while _tabs:
                _tabs.pop().close()
    return perform


def opened(address="", **options):
    """A tab with the page at an address that is whole."""
    if address and not address.endswith("&end"):
        address += "&end"
    made = tab(**options)
    made.open(f"{URL}#{address}" if address else URL)
    return made


def command(*words):
    got = subprocess.run([COMMAND, *words], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, text=True, check=False)
    check(got.returncode in (0, 5), f"{words}: {got.stderr}")
    return got.stdout


def settled(page):
    """When all frames that were asked for are drawn."""
    page.value("new Promise((done) => requestAnimationFrame(() => "
               "requestAnimationFrame(() => setTimeout(done, 60))))")


def go(page, tick):
    page.value(f"twofold.play(false); twofold.seek({tick}); "
               f"twofold.motion.seek({tick})")
    settled(page)


def shown(page, name):
    """The text of an element."""
    return page.value(f"document.getElementById('{name}').textContent")
