#!/usr/bin/python3
"""The closed loop of `hil`, and commands of `monitor`, over a line that repeats
or loses frames, and over the end of the numbers of commands. Between a firmware
of the host and its driver stands a relay that knows where frames begin.

usage: relays.py NAME    one test; without a name their names
Environment: TWOFOLD the command line, HIL the driver, FIRMWARE the program of a
board that takes commands."""
import os
import pty
import select
import struct
import subprocess
import sys
import tty
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools/board/protocol"), str(ROOT / "tests/support")]
import decode  # noqa: E402  (the paths come first)
from named import main, same  # noqa: E402

SCHEMA, ANSWER = 0x01, 0x08
INPUT, STOP, DESCRIBE = 0x41, 0x45, 0x4A
LOCKSTEP = ["--steps", "600", "--every", "10", "--lockstep"]


class Board:
    """A firmware on a pseudo-terminal."""

    def __enter__(self):
        self.run = subprocess.Popen(
            [os.environ["FIRMWARE"]], stdin=subprocess.DEVNULL,
            stderr=subprocess.PIPE, env={**os.environ, "TWOFOLD_PORT": "pty"})
        self.name = self.run.stderr.readline().decode().strip()
        self.line = os.open(self.name, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.line)
        return self

    def __exit__(self, *_):
        os.close(self.line)
        self.run.kill()
        self.run.communicate()

    def listen(self, wanted):
        """The first frame for which wanted(frame) holds."""
        heard = b""
        while select.select([self.line], [], [], 20)[0]:
            heard += os.read(self.line, 4096)
            for frame in decode.frames(heard):
                if wanted(frame):
                    return frame
        sys.exit("the board is silent")

    def session(self):
        """That of its next schema, as four bytes."""
        os.write(self.line, framed(struct.pack("<BBBIQ", 2, DESCRIBE, 0, 0, 0)))
        return self.listen(lambda frame: frame[0] == SCHEMA and
                           any(frame[3][13:17]))[3][13:17]

    def use_up_to(self, number):
        """A stop with that number, as another host would send it."""
        session = self.session()
        os.write(self.line, framed(
            struct.pack("<BBBIQ", 2, STOP, 4, number, 0) + session))
        same(self.listen(lambda frame: frame[0] == ANSWER and
                         frame[3][4] == STOP)[3][5], 0)


def framed(body):
    """The bytes of a frame on the line (docs/PROTOCOL.md, section 1)."""
    stuffed = b"".join(bytes([len(part) + 1]) + part
                       for part in body.split(b"\0"))
    crc = zlib.crc32(stuffed)
    return (b"\0" + stuffed +
            bytes(128 | crc >> 7 * i & 127 for i in range(5)) + b"\0")


def pass_on(line, came):
    """Whoever does not read any more misses it."""
    try:
        os.write(line, came)
    except BlockingIOError:
        pass


def relayed(change, *words):
    """hil over a line on which each frame up becomes what change(type, frame)
    returns. Returns: its exit code, and all that it says."""
    with Board() as board:
        near, far = pty.openpty()
        tty.setraw(near)
        tty.setraw(far)
        os.set_blocking(near, False)
        with subprocess.Popen([os.environ["HIL"], os.ttyname(far), *words],
                              stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT) as hil:
            rest = b""
            while hil.poll() is None:
                for line in select.select([near, board.line], [], [], 0.05)[0]:
                    came = os.read(line, 4096)
                    if line == board.line:
                        pass_on(near, came)
                        continue
                    *pieces, rest = (rest + came).split(b"\0")
                    for piece in filter(None, pieces):
                        kind = decode.decode(piece)[0]
                        os.write(board.line,
                                 change(kind, b"\0" + piece + b"\0"))
            said = hil.stdout.read().decode()
        os.close(near)
        os.close(far)
        return hil.returncode, said


class Losing:
    """The Nth frame of a type is lost."""

    def __init__(self, kind, number):
        self.kind, self.left = kind, number

    def __call__(self, kind, frame):
        self.left -= kind == self.kind
        return b"" if kind == self.kind and self.left == 0 else frame


def rows(path):
    return Path(path).read_bytes()


def test_doubled_commands_change_nothing():
    same(relayed(lambda _, frame: frame, *LOCKSTEP, "--csv", "one")[0], 0)
    code, said = relayed(lambda _, frame: frame + frame, *LOCKSTEP, "--csv",
                         "two")
    same((code, "0 late, 0 without an answer" in said), (0, True))
    same(rows("one") == rows("two"), True)


def test_a_stop_that_is_lost_ends_the_lockstep():
    """The first stop is that before the reset, which is sent again."""
    for number in 2, 3, 9:
        code, said = relayed(Losing(STOP, number), *LOCKSTEP, "--csv", "rows")
        same((code, " was lost" in said), (4, True))
        same(Path("rows").exists(), False)


def test_an_input_that_is_lost_is_sent_again():
    same(relayed(lambda _, frame: frame, *LOCKSTEP, "--csv", "one")[0], 0)
    for number in 1, 5:
        same(relayed(Losing(INPUT, number), *LOCKSTEP, "--csv", "two")[0], 0)
        same(rows("one") == rows("two"), True)


def test_inputs_that_never_come_end_the_lockstep():
    code, said = relayed(lambda kind, frame: b"" if kind == INPUT else frame,
                         *LOCKSTEP)
    same((code, "step 0: its input was lost" in said), (4, True))


def test_numbers_end_within_a_loop():
    with Board() as board:
        same(subprocess.call([os.environ["HIL"], board.name, *LOCKSTEP, "--csv",
                              "one"], stdout=subprocess.DEVNULL), 0)
    for left in 2, 3, 4, 30, 31:
        with Board() as board:
            board.use_up_to(2**32 - left)
            same((left, subprocess.call(
                [os.environ["HIL"], board.name, *LOCKSTEP, "--csv", "two"],
                stdout=subprocess.DEVNULL)), (left, 0))
            same(rows("one") == rows("two"), True)


def test_numbers_end_within_commands():
    sent = [word for command in ("snapshot", "start", "stop", "start", "stop")
            for word in ("--send", command)]
    for left in range(2, 8):
        with Board() as board:
            board.use_up_to(2**32 - left)
            done = subprocess.run([os.environ["TWOFOLD"], "monitor", board.name,
                                   *sent], capture_output=True, text=True,
                                  check=False)
            same((left, done.returncode, done.stderr.count("took effect")),
                 (left, 0, 6))  # the question who the board is, too


def test_the_dead_man_is_given_back():
    with Board() as board:
        for words in ["--deadman", "0"], []:
            done = subprocess.run([os.environ["HIL"], board.name, *LOCKSTEP,
                                   *words], capture_output=True, text=True,
                                  check=False)
            same(done.returncode, 0)
            same("held without end" in done.stdout, bool(words))


def test_closed_descriptors_are_not_the_line():
    """What would be written there goes nowhere, and certainly not up."""
    with Board() as board:
        shell = f'"$HIL" {board.name} {" ".join(LOCKSTEP)}'
        same(subprocess.call(["sh", "-c", shell + " >&- 2>&-"]), 4)
        said = subprocess.run(["sh", "-c", shell], capture_output=True,
                              text=True, check=False)
        same((said.returncode, " 0 broken" in said.stdout), (0, True))


main(globals())
