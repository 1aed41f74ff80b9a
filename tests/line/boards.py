"""Firmware of the host port, which `make test` has made, on a pseudo-terminal:
what the tests of the line share.

Environment: FIRMWARE the beginning of the path of its folders; REALS the real
types that are tested."""
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
import time
import tty
import zlib
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / place)
                for place in ("tests/support", "tests/cli",
                               "tools/board/protocol")]
from decode import (  # noqa: E402  (the paths come first)
    ANSWER, DESCRIBE, HEARTBEAT, SCHEMA, decode, framed)
from tap import TWOFOLD, call, check  # noqa: E402

BUILD = Path(TWOFOLD).parents[1]
FIRMWARE = str(Path(os.environ.get("FIRMWARE") or
                    BUILD / "boards/host/chaos").resolve())
REALS = (os.environ.get("REALS") or "double float").split()
RUN = [TWOFOLD, "run", "chaos", "--t-end", "0.5", "--dt", "1e-3"]


def says(said, *patterns):
    for pattern in patterns:
        check(re.search(pattern, said), f"no {pattern}: {said}")


def program(real, name):
    return f"{FIRMWARE}-{real}/firmware-{name}.elf"


def chained(sent):
    """The bytes of frames of (type, tick, payload), numbered from 0, in which
    heartbeats have their chain."""
    chain, stream = 0, b""
    for number, (kind, tick, payload) in enumerate(sent):
        if kind == HEARTBEAT:
            payload = payload[:84] + struct.pack("<I", chain)
        stream += framed(kind, number, tick, payload)
        chain = zlib.crc32(stream[-6:-1], chain)
    return stream


class Board:
    """`with Board(real) as board:` one that takes commands, on board.name."""

    def __init__(self, real=REALS[0], name="line", port="pty", **options):
        self.run = subprocess.Popen(
            [program(real, name)], stdin=subprocess.DEVNULL,
            stderr=subprocess.PIPE, env={**os.environ, "TWOFOLD_PORT": port},
            **options)
        self.name = self.run.stderr.readline().decode().strip() \
            if port == "pty" else port

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def send(self, *commands, code=(0, 5, 6), key=()):
        """What is said of commands. Where the computer is busy ticks get no
        step (5) or rows are lost (6), which is another matter."""
        words = [word for one in commands for word in ("--send", one)]
        return call("monitor", self.name, *words, *key, code=code)[1]

    def stop_a_while(self, seconds=0.08):
        """And lets it go on for 20 ms."""
        self.run.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        self.run.send_signal(signal.SIGCONT)
        time.sleep(0.02)

    def end(self):
        """Its exit code, and what it says in the end."""
        if not self.run.stderr.closed:
            self.run.terminate()
            self.said = self.run.communicate()[1].decode()
        return self.run.returncode, self.said


class Line:
    """The host's end of a line, by its name or as what is open, and what came
    over it."""

    def __init__(self, name):
        self.line = name
        if isinstance(name, str):
            self.line = os.open(name, os.O_RDWR | os.O_NOCTTY)
            tty.setraw(self.line, termios.TCSANOW)
        self.rest, self.broken, self.session, self.number = b"", 0, bytes(4), 0
        self.next = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.line)

    def frames(self, seconds=None):
        """Those that are there, or of the next bytes that end one."""
        found, self.next = self.next, []
        while not found and select.select([self.line], [], [], seconds)[0]:
            came = os.read(self.line, 4096)
            if not came:
                break
            *pieces, self.rest = (self.rest + came).split(b"\0")
            whole = [decode(piece) for piece in pieces if piece]
            self.broken += whole.count(None)
            found = [frame for frame in whole if frame is not None]
        return found

    def listen(self, wanted):
        """The first frame for which wanted(frame) holds."""
        while found := self.frames():
            for i, frame in enumerate(found):
                if wanted(frame):
                    self.next = found[i + 1:]
                    return frame
        sys.exit("the line ends")

    def answer(self, kind, command):
        """The code of the answer to a command."""
        os.write(self.line, command)
        payload = self.listen(lambda frame: frame[0] == ANSWER and
                              frame[3][4] == kind)[3]
        return struct.unpack_from("b", payload, 5)[0]

    def describe(self):
        """Asks the board who it is: its session and our next number."""
        self.answer(DESCRIBE, framed(DESCRIBE, 0, 0, b""))
        schema = self.listen(lambda frame: frame[0] == SCHEMA)[3]
        self.session = schema[13:17]
        self.number = struct.unpack_from("<I", schema, 17)[0]


def pass_on(line, came):
    """Whoever does not read any more misses it."""
    try:
        os.write(line, came)
    except BlockingIOError:
        pass


def relayed(up, board, *words, down=lambda kind, number: b"",
            lose=lambda kind: False, carries=None):
    """A program with the words, of which LINE is the name of a line to a board
    on which each frame up becomes what up(type, frame) returns, and after what
    down(type, number) comes down. It loses frames of which lose(type) says so,
    and carries so many bytes a second each way. Returns: the program's exit
    code, and all that it says."""
    near, far = pty.openpty()
    tty.setraw(near)
    tty.setraw(far)
    os.set_blocking(near, False)
    name = os.ttyname(far)
    with Line(board.name) as other, subprocess.Popen(
            [name if word == "LINE" else word for word in words],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT) as process:
        to = {near: other.line, other.line: near}
        rest, waits = dict.fromkeys(to, b""), dict.fromkeys(to, b"")
        since = dict.fromkeys(to, time.monotonic())
        while process.poll() is None:
            for line in select.select([line for line in to
                                       if len(waits[to[line]]) < 512], [], [],
                                      0.002 if carries else 0.05)[0]:
                *pieces, rest[line] = (rest[line] + os.read(
                    line, 64 if carries else 4096)).split(b"\0")
                for piece in filter(None, pieces):
                    kind, number = (decode(piece) or (0, 0))[:2]
                    frame = b"" if lose(kind) else b"\0" + piece + b"\0"
                    if line == near:
                        waits[near] += down(kind, number)
                        frame = up(kind, frame)
                    waits[to[line]] += frame
            for line, came in waits.items():
                if carries:
                    came = came[:int((time.monotonic() - since[line])
                                     * carries)]
                    since[line] = since[line] + len(came) / carries \
                        if len(came) < len(waits[line]) else time.monotonic()
                pass_on(line, came)
                waits[line] = waits[line][len(came):]
        said = process.stdout.read().decode()
    os.close(near)
    os.close(far)
    return process.returncode, said
