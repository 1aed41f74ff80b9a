#!/usr/bin/python3 -B
"""The firmware of the host port at the end of a real line, a pseudo-terminal: a
reader that stalls, leaves, comes back, a device that is unplugged, a pipe that
is closed. Whatever the line does, every state that comes is that of the same
step of a run of the command line, bit for bit, and what did not come is
counted."""
import contextlib
import os
import pty
import re
import struct
import subprocess
import termios
import tty

from boards import (ANSWER, DEADMAN, DESCRIBE, EXPIRED, HEARTBEAT, INPUT, RUN,
                    STATE, Board, Line, framed)
from decode import frames
from tap import check, main, output, same, until


@contextlib.contextmanager
def busy(processes):
    """Other work beside what is tested. It starts processes: two that only
    count can keep a kernel from passing on what terminals were written."""
    others = [subprocess.Popen(["sh", "-c", "while :; do (:); done"])
              for _ in range(processes)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def motion(payload):
    """Of a state: r, v, omega, phi and the mode, without the seed."""
    return payload[:32] + payload[36:]


def truth():
    """States of a run, by their ticks."""
    words = [*RUN[:3], "--t-end", "10", "--dt", "1e-3", "--format", "frames"]
    return {tick: motion(payload) for kind, _, tick, payload in
            frames(output(*words)) if kind == STATE}


class Listener(Line):
    """It judges what comes."""

    def __init__(self, name, states):
        super().__init__(name)
        self.states, self.last = states, 0

    def frames(self, seconds=20):
        found = super().frames(seconds)
        for kind, _, tick, payload in found:
            if kind == STATE:
                self.last = tick
                same(motion(payload), self.states.get(tick))
        return found

    def comes_to(self, tick):
        until(lambda: self.frames() and self.last >= tick, f"step {tick}")


def beat_in(frame):
    """The step of a heartbeat, and its ticks of the clock that got none."""
    return [(frame[2], *struct.unpack_from("<I", frame[3], 60))] \
        if frame[0] == HEARTBEAT else []


def test_ticks_without_a_step_are_told():
    """A board that is stopped for 80 ms of every 100 is late, and says so as
    often as one that is not: a second of its clock is 1000 ticks."""
    with Board("double") as board, Line(board.name) as line:
        told = []
        line.listen(lambda frame: frame[0] == STATE)
        while len(told) < 4:
            board.stop_a_while()
            told += [beat for frame in line.frames() for beat in beat_in(frame)]
        clock = [sum(beat) for beat in told]
        check(all(two - one >= 1000 for one, two in zip(clock, clock[1:])),
              told)
        check(told[-1][1] > told[1][1], told)


def hold(board, line, stops):
    """Inputs hold for 2000 ticks. Returns: for how many steps they did, and how
    many ticks there were meanwhile, as the heartbeats within count them."""
    line.describe()
    line.command(DEADMAN, struct.pack("<I", 2000))
    beats, ended = [], None
    begun = line.command(INPUT, struct.pack("<5d", -1, 0.1, 0, 0, 0))
    while ended is None:
        if stops:
            board.stop_a_while()
        for frame in line.frames():
            beats += beat_in(frame)
            if frame[0] == EXPIRED:
                ended = frame[2]
    within = [sum(beat) for beat in beats if begun < beat[0] < ended]
    return ended - begun, within[-1] - within[0] if within else None


def test_inputs_expire_by_the_clock():
    """Of a board that is stopped for 80 ms of every 100 long before it has
    taken so many steps, and of one beside other work after as many at most."""
    for stops in True, False:
        with Board("double") as board, Line(board.name) as line, \
                busy(0 if stops else 2):
            ticks = None
            while ticks is None:  # all of the computer may stand for seconds
                steps, ticks = hold(board, line, stops)
            check(steps <= 2000 - 60 * stops and ticks < 2000, (steps, ticks))


def test_reader_leaves_and_comes_back():
    states = truth()
    with Board("double") as board:
        with Listener(board.name, states) as line:
            line.comes_to(100)
        with Listener(board.name, states) as again:
            again.comes_to(line.last + 100)
        same(board.end()[0], 0)


def test_device_that_is_unplugged_ends_it():
    near, far = pty.openpty()
    tty.setraw(near)
    with Board("double", port=f"{os.ttyname(far)}:57600") as board:
        with Listener(os.ttyname(far), truth()) as line:
            os.close(line.line)
            line.line = os.dup(near)
            line.comes_to(100)
            same((line.broken, termios.tcgetattr(near)[4]),
                 (0, termios.B57600))
            os.write(near, framed(DESCRIBE, 0, 0, b""))
            line.listen(lambda frame: frame[0] == ANSWER)
        os.close(far)
        os.close(near)
        same(board.run.wait(), 4)


def test_closed_pipe_ends_it():
    with Board("double", port="-", stdout=subprocess.PIPE) as board:
        check(board.run.stdout.read(1000), "no record")
        board.run.stdout.close()
        board.run.stdout = None
        same(board.run.wait(), 4)


def test_wrong_ports_are_told():
    for port, code, text in (("/dev/null:12345", 2, "12345"),
                             ("/dev/null:9600", 4, "ioctl"),
                             ("/dev/there/is/none:9600", 4, "/is/none")):
        board = Board("double", port=port)
        board.run.wait()
        got, said = board.end()
        check((got, text in said) == (code, True), f"{port}: {got}, {said}")


def test_lateness_is_told():
    with Board("double") as board, Listener(board.name, truth()) as line:
        line.comes_to(200)
        said = board.end()[1]
    found = re.search(
        r"host: woke for [1-9]\d* ticks of 1000 us; late by (\S+) us at least, "
        r"(\S+) in the mean, (\S+) at most", said)
    late = [float(number) for number in found.groups()]
    check(0 <= late[0] and late == sorted(late), said)


main(globals(), jobs=6)
