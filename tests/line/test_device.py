#!/usr/bin/python3 -B
"""The firmware of the host port at the end of a real line, a pseudo-terminal: a
reader that stalls, leaves, comes back, a device that is unplugged, a pipe that
is closed. Whatever the line does, every state that comes is that of the same
step of a run of the command line, bit for bit, and what did not come is
counted. Then `twofold monitor` there: rows arrive, commands are answered, and
when the device goes away the program says so or, under --follow, waits until it
is back."""
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import tty
from pathlib import Path

import starts
from boards import RUN, Board, Line, program, relayed, says
from decode import (ANSWER, DESCRIBE, HEARTBEAT, INPUT, STATE, STOP, breaks,
                    framed, frames, tagged)
from starts import KEY, keyed
from tap import ROOT, TWOFOLD, call, check, main, output, same, until


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

    def frames(self, seconds=None):
        found = super().frames(seconds)
        for kind, _, tick, payload in found:
            if kind == STATE:
                self.last = tick
                same(motion(payload), self.states.get(tick))
        return found

    def comes_to(self, tick):
        while self.last < tick:
            check(self.frames(), f"the line ends before step {tick}")


def test_reader_leaves_and_comes_back():
    states = truth()
    with Board("double") as board:
        with Listener(board.name, states) as line:
            line.comes_to(100)
        with Listener(board.name, states) as again:
            again.comes_to(line.last + 100)
        same(board.end()[0], 0)


def test_speeds_of_boards_are_known():
    """To monitor and to the host port, if this system has them."""
    speeds = {getattr(termios, f"B{speed}"): speed
              for path in ROOT.glob("port/*/*.mk") for found in re.findall(
                  "^BOARD_BAUDS :=(.*)", path.read_text(), re.M)
              for speed in found.split() if hasattr(termios, f"B{speed}")}
    check({termios.B115200, termios.B2000000} <= {*speeds}, speeds)
    near, far = pty.openpty()
    tty.setraw(near)
    name, how = os.ttyname(far), termios.tcgetattr(near)
    for code, speed in speeds.items():
        for start in (lambda: Board("double", port=f"{name}:{speed}").run,
                      lambda: follow(name, "--baud", speed)):
            termios.tcsetattr(near, termios.TCSANOW, how)
            run = start()
            until(lambda: code == termios.tcgetattr(near)[4],
                  f"{speed} baud", run)
            run.kill()


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


def rows(path):
    return Path(path).read_bytes().count(b"\n") if Path(path).exists() else 0


def follow(name, *more):
    """monitor, whose rows go to rows.part and whose words to the file said."""
    with open("said", "wb") as said:
        return subprocess.Popen(
            [TWOFOLD, "monitor", name, "--format", "csv", "--out", "rows",
             *more],
            stderr=said, stdin=subprocess.DEVNULL)


def heard(text, monitor):
    until(lambda: text in Path("said").read_text(), text, monitor)


def test_a_device_that_leaves_is_told():
    with Board("double") as board:
        monitor = follow(board.name)
        until(lambda: rows("rows.part") > 100, "rows", monitor)
    same(monitor.wait(), 4)
    check("the device went away" in Path("said").read_text(), "not told")
    found = re.search(r"(\d+) rows", Path("said").read_text())
    same(int(found[1]), rows("rows.part") - 1)


def test_a_followed_device_comes_back():
    with Board("double") as board:
        Path("device").symlink_to(board.name)
        monitor = follow("device", "--follow")
        until(lambda: rows("rows.part") > 100, "rows", monitor)
        Path("device").unlink()
    heard("waiting", monitor)
    with Board("double") as board:
        Path("new").symlink_to(board.name)
        Path("new").rename("device")
        heard("back", monitor)
        before = rows("rows.part")
        until(lambda: rows("rows.part") > before + 100, "rows again", monitor)
        monitor.send_signal(signal.SIGTERM)
        # 5, 6: a busy computer may be late and lose frames, and the new line
        # begins in one.
        check(monitor.wait() in (0, 5, 6), monitor.returncode)


def test_what_came_before_a_device_was_heard_is_no_loss():
    near, far = pty.openpty()
    tty.setraw(near)
    monitor = follow(os.ttyname(far))
    until(lambda: rows("rows.part") > 0, "the header", monitor)
    stream = output(*RUN, "--every", "50", "--format", "frames")
    os.write(near, b"half a frame\0" + stream)
    until(lambda: rows("rows.part") == 12, "all rows", monitor)
    monitor.send_signal(signal.SIGTERM)
    same(monitor.wait(), 0)
    # Without a schema no loss is counted: the message names the schema.
    monitor = follow(os.ttyname(far), "--record", "commands")
    until(lambda: Path("commands.part").exists(), "that it begins", monitor)
    os.write(near, b"\0\0".join(stream.split(b"\0\0")[5:-2]) + b"\0")
    while select.select([far], [], [], 0)[0]:
        pass
    monitor.send_signal(signal.SIGTERM)
    same(monitor.wait(), 6)
    heard("no schema has come", monitor)


def test_a_line_that_nobody_read_is_no_damage():
    """Old bytes fill the line, and the board has dropped the rest. On a busy
    computer it drops more: code 6, with a sentence of its own."""
    with Board("double") as board:
        for _ in range(3):
            board.stop_a_while()
            monitor = follow(board.name)
            until(lambda: rows("rows.part") > 100, "rows", monitor)
            monitor.send_signal(signal.SIGTERM)
            check(monitor.wait() in (0, 5, 6), monitor.returncode)
            said = Path("said").read_text()
            check("were lost or broken" not in said, said)
            check(monitor.returncode < 6 or "the board dropped" in said, said)
            Path("rows.part").unlink(missing_ok=True)


def test_commands_are_sent_and_answered():
    with Board("double") as board:
        said = board.send("set:mu=1.25", "select:random:9", "stop",
                          "input:-1.5,0.1,0.25,-0.125", "deadman:123",
                          "every:7", "set:mu=-1", code=3)
        says(said, r"set:mu=1.25: took effect at step \d+; mu = 1.25, in \[0, ",
             "select:random:9: took effect", "stop: took effect",
             "input:-1.5,0.1,0.25,-0.125: took", "deadman:123: took effect",
             "every:7: took effect", "set:mu=-1: refused, parameter out of its "
             r"range at step \d+; mu = 1.25")


def test_answers_to_others_are_not_its_own():
    """Of another number or type, on the same line: the first that fits is."""
    def others(kind, number):
        if kind != STOP:
            return b""
        numbers = [number + sign * i * step for i in range(1, 40)
                   for sign in (1, -1) for step in (1, 65536)]
        return b"".join(
            framed(ANSWER, 0, 12345, struct.pack("<I4B", n % 2**32, other, 0, 0,
                                                 255))
            for n, other in [(n, STOP) for n in numbers] +
            [(number, other) for other in range(INPUT, INPUT + 11)
             if other != STOP])

    with Board("double") as board:
        code, said = relayed(lambda _, frame: frame, board, TWOFOLD, "monitor",
                             "LINE", "--send", "stop", down=others)
    check(code in (0, 5, 6) and "stop: took effect at step" in said, said)
    check("12345" not in said, said)


def test_a_keyed_board_takes_keyed_commands():
    with keyed() as board:
        says(board.send("stop", code=3), "stop: refused, its tag is not that")
        says(board.send("stop", code=4, key=["--key", "wrong"]),
             "no frame with the tag of --key")
        says(board.send("stop", key=["--key", "key"]), "stop: took effect")
        says(board.send("every:20", "every:10", code=3, key=["--key", "key"]),
             r"20: took effect at step \d+; it needs 9424 of 11520 "
             "bytes/s, a record every 20", "10: refused, more than the line "
             r"carries at step \d+; it needs 18174 of 11520 bytes/s, a "
             "record every 20 steps")
        call("monitor", board.name, "--send", "stop", "--key", "none", code=2)
        for mode in 0o640, 0o604, 0o620:
            Path("wrong").chmod(mode)
            says(call("monitor", board.name, "--key", "wrong", code=2)[1],
                 "--key wrong: others may read it")


def played(stream, *words):
    """What monitor, with the key, says of bytes that answer its question."""
    near, far = pty.openpty()
    tty.setraw(near)
    tty.setraw(far)
    with subprocess.Popen(
            [TWOFOLD, "monitor", os.ttyname(far), "--key", "key", *words],
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE) as monitor:
        os.read(near, 99)
        os.write(near, stream)
        said = monitor.communicate()[1].decode()
    os.close(near)
    os.close(far)
    return monitor.returncode, said


def test_a_key_is_satisfied_by_its_board_alone():
    """Not by a board without it, by a recording, by an answer put between."""
    with keyed() as board:
        with Line(board.name) as line:
            line.describe()
            stop = framed(STOP, 9, 0, tagged(KEY, STOP, 9, 0, line.session))
            os.write(line.line, framed(DESCRIBE, 0, 0, bytes(4) + b"a nonce!"))
            os.write(line.line, stop)
            recorded = b""
            while ANSWER not in [
                    frame[0] for frame in frames(recorded)
                    if frame[3][4] == STOP]:
                recorded += os.read(line.line, 4096)
        code, said = played(recorded[-3000:], "--send", "stop")
        same((code, "or a recording is played" in said), (4, True))

        def put(kind, number):
            return framed(ANSWER, 9, 12345, struct.pack(
                "<I4B", number, STOP, 0, 0, 255) + bytes(8)) \
                if kind == STOP else b""
        code, said = relayed(lambda _, frame: frame, board, TWOFOLD, "monitor",
                             "LINE", "--send", "stop", "--key", "key", down=put)
        same((code, "somebody else sends" in said, "12345" in said),
             (4, True, False))
    with Board("double") as other:
        says(other.send("stop", code=4, key=["--key", "key"]),
             "the board has another key or none")
    Path("stream").write_bytes(recorded)
    call("monitor", "stream", "--key", "key", code=4)


def test_a_key_gives_no_row_without_heartbeats():
    """Not before the first, with which rows come within a second."""
    with keyed() as board:
        code, said = relayed(lambda _, frame: frame, board, TWOFOLD, "monitor",
                             "LINE", "--key", "key", "--format", "csv",
                             lose=lambda kind: kind == HEARTBEAT)
        same((code, "no heartbeat with the tag of --key for 5 s" in said,
              re.findall("^[0-9].*", said, re.M)), (4, True, []))


def test_parts_of_two_starts_are_told():
    parts = []
    for _ in range(2):
        Path("stream").write_bytes(b"")
        with keyed(port="stream") as board:
            until(lambda: Path("stream").stat().st_size > 25000, "frames",
                  board.run)
        stream = Path("stream").read_bytes()
        same(breaks(stream), [])
        # On a busy computer the board drops frames, and this is told (6).
        said = call("monitor", "stream", code=(0, 5, 6))[1]
        check("another run" not in said, said)
        parts.append(stream.split(b"\0"))
    for at in 90, 171, 252:
        Path("stream").write_bytes(b"\0".join(parts[0][:at] + parts[1][at:]))
        # A late board may be cut between a state and its report, which is lost.
        says(call("monitor", "stream", code=6)[1], r"[1-9]\d* changes of")


def test_no_session_comes_again():
    starts.starts([program("double", "keyed")])


main(globals(), jobs=6)
