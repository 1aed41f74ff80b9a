#!/usr/bin/python3 -B
"""Starts a board again and again: starts.py COMMAND..., whose input and output
are the line of a board with the key of the tests.

In the first start a `stop` with the tag of the key acts, and is recorded. To
each other start it is played as soon as the board listens. No session comes
twice, the stop is foreign and the machine goes on."""
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from boards import Board, Line
from decode import STATE, STOP, framed, tagged
from tap import check, same

KEY = bytes(0x1f * i % 256 for i in range(16))
DIGITS = KEY.hex()
STARTS = 60
FOREIGN = -21


def keyed(port="pty"):
    """A board with the key of the tests, 50 records a second and a line of
    115200 baud; and in files that key and another one."""
    for name, text in ("key", DIGITS), ("wrong", DIGITS[:-1] + "0"):
        Path(name).write_text(text + "\n")
        Path(name).chmod(0o600)
    os.environ["TWOFOLD_BOOT"] = "count"
    return Board("double", "keyed", port)


def is_running(line):
    """Whether its machine steps, by three states."""
    ticks = [line.listen(lambda frame: frame[0] == STATE)[2] for _ in range(3)]
    return ticks[0] < ticks[1] < ticks[2]


def played(line, stop):
    """To a start: its session, and the stop, made where there is none."""
    if stop:
        same(line.answer(STOP, stop), FOREIGN)
    line.describe()
    check(is_running(line), "the machine stands")
    if not stop:
        stop = framed(STOP, 0, 0, tagged(KEY, STOP, 0, 0, line.session))
        same(line.answer(STOP, stop), 0)
        check(not is_running(line), "the stop does nothing")
    return line.session, stop


def starts(command):
    """No session comes twice, and what was recorded acts once."""
    sessions, stop = set(), None
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(STARTS):
            near, far = socket.socketpair()
            with far, Line(near.detach()) as line, subprocess.Popen(
                    command, stdin=far, stdout=far, cwd=folder,
                    stderr=subprocess.DEVNULL,
                    env={**os.environ, "TWOFOLD_BOOT": "count",
                         "TWOFOLD_PORT": "-"}) as process:
                try:
                    session, stop = played(line, stop)
                finally:
                    process.kill()
            sessions.add(session)
    same(len(sessions), STARTS)


if __name__ == "__main__":
    starts(sys.argv[1:])
    print(f"{STARTS} starts, no session twice, the recorded stop acted once")
