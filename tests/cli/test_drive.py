#!/usr/bin/python3 -B
"""What is interrupted leaves nothing: no process, however it was started and
whatever it ignores, and nothing temporary."""
import functools
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tap import ROOT, TWOFOLD, check, lacks, run, same, until  # noqa: E402

DRIVE = str(ROOT / "tools/drive")
# Without what make hands to its recipes: this is no part of it.
CLEAN = {name: value for name, value in os.environ.items() if name not in (
    "MAKEFLAGS", "MAKELEVEL", "MFLAGS", "MAKEOVERRIDES", "DRIVEN")}
# In the background, in a group of their own, deaf, and deaf in another driver.
MANY = """touch "$(mktemp)"
sleep 1000 &
timeout 1000 sleep 1000 &
sh -c 'trap "" TERM INT HUP; sleep 1000; sleep 1000' &
"$1" sh -c 'sleep 1000 & mktemp; exec timeout 1000 sleep 1000'
"""
SLOW = f""". {ROOT}/tests/support/tap.sh
sleep 1000 &
"$T" run chaos --t-end 1e9 --out "$D/x" &
wait
"""


def mark():
    return f"MARKED={os.getcwd()}"


def left():
    """The processes that were started here, by their environment."""
    found = []
    for path in Path("/proc").glob("[0-9]*/environ"):
        try:
            if mark().encode() in path.read_bytes().split(b"\0"):
                found.append(path.parent.name)
        except OSError:  # another one's, or it has ended
            pass
    return found


def begin(*command, **options):
    if not shutil.which("setsid"):
        lacks("util-linux")
    Path("tmp").mkdir(exist_ok=True)
    return subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL, **options,
        env={**CLEAN, "MARKED": os.getcwd(), "TMPDIR": f"{os.getcwd()}/tmp",
             "GRACE": "2", "BUILD": f"{os.getcwd()}/build",
             "TWOFOLD": TWOFOLD})


def stopped(number, code, count, *command):
    """The signal comes when `count` processes run, and ends them all."""
    child = begin(*command)
    until(lambda: len(left()) >= count, "processes run", every=0.1)
    child.send_signal(number)
    same(child.wait(), code)
    until(lambda: not left(), "no process is left", every=0.1)
    same(os.listdir("tmp"), [])


def a_script(number):
    Path("many").write_text(MANY)
    stopped(number, 128 + number, 10, DRIVE, "sh", "many", DRIVE)


def checks(number):
    """Where they are in the middle of a build."""
    stopped(number, 128 + number, 8, ROOT / "tools/verify/run",
            "sanitize-gcc", "gcc")


def tests(number):
    Path("slow.sh").write_text(SLOW)
    stopped(number, 130, 5, ROOT / "tests/run", "slow.sh")


def a_command_that_ends():
    """Its code, its files, and a process that it leaves behind."""
    same(begin(DRIVE, "sh", "-c", "mktemp >name; sleep 1000 & exit 7").wait(),
         7)
    check(not Path(Path("name").read_text().strip()).exists(), "its files")
    check(not left(), "its process")


TESTS = [(a_command_that_ends, ())]
TESTS += [(a_script, (number,)) for number in (
    signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT,
    signal.SIGUSR1)]
TESTS += [(checks, (number,)) for number in (signal.SIGTERM, signal.SIGINT)]
TESTS += [(tests, (number,)) for number in (
    signal.SIGTERM, signal.SIGINT, signal.SIGHUP)]
sys.exit(run([(" ".join([test.__name__, *(one.name for one in values)]),
               functools.partial(test, *values)) for test, values in TESTS],
             jobs=len(TESTS)))
