#!/usr/bin/python3 -B
"""`twofold monitor` on a device: a pseudo-terminal with the firmware of the
host port behind it. Rows arrive, commands are answered, and when the device
goes away the program says so or, under --follow, waits until it is back."""
import os
import pty
import re
import signal
import struct
import subprocess
import tty
from pathlib import Path

import starts
from boards import ANSWER, HEARTBEAT, INPUT, RUN, STATE, STOP, Board, framed, \
    program, relayed, says
from decode import breaks, frames
from starts import keyed
from tap import TWOFOLD, call, check, main, output, same, until


def rows(path):
    return Path(path).read_bytes().count(b"\n") if Path(path).exists() else 0


def follow(name, *more):
    """monitor, whose rows go to rows.part and whose words to the file said."""
    with open("said", "wb") as said:
        return subprocess.Popen(
            [TWOFOLD, "monitor", name, "--format", "csv", "--out", "rows",
             *more],
            stderr=said, stdin=subprocess.DEVNULL)


def heard(text):
    until(lambda: text in Path("said").read_text(), text)


def test_a_device_that_leaves_is_told():
    with Board("double") as board:
        monitor = follow(board.name)
        until(lambda: rows("rows.part") > 100, "rows")
    same(monitor.wait(), 4)
    heard("the device went away")
    found = re.search(r"(\d+) rows", Path("said").read_text())
    same(int(found[1]), rows("rows.part") - 1)


def test_a_followed_device_comes_back():
    with Board("double") as board:
        Path("device").symlink_to(board.name)
        monitor = follow("device", "--follow")
        until(lambda: rows("rows.part") > 100, "rows")
        Path("device").unlink()
    heard("waiting")
    with Board("double") as board:
        Path("new").symlink_to(board.name)
        Path("new").rename("device")
        heard("back")
        before = rows("rows.part")
        until(lambda: rows("rows.part") > before + 100, "rows again")
        monitor.send_signal(signal.SIGTERM)
        # 5, 6: a busy computer may be late and lose frames, and the new line
        # begins in one.
        check(monitor.wait() in (0, 5, 6), monitor.returncode)


def test_what_came_before_a_device_was_heard_is_no_loss():
    near, far = pty.openpty()
    tty.setraw(near)
    monitor = follow(os.ttyname(far))
    until(lambda: rows("rows.part") > 0, "the header")
    stream = output(*RUN, "--every", "50", "--format", "frames")
    os.write(near, b"half a frame\0" + stream)
    until(lambda: rows("rows.part") == 12, "all rows")
    monitor.send_signal(signal.SIGTERM)
    same(monitor.wait(), 0)


def sent(board, *commands, code=0, key=()):
    """What is said of commands. Where the computer is busy ticks get no step
    (5) or rows are lost (6), which is another matter."""
    words = [word for one in commands for word in ("--send", one)]
    return call("monitor", board.name, *words, *key,
                code=code or (0, 5, 6))[1]


def test_commands_are_sent_and_answered():
    with Board("double") as board:
        said = sent(board, "set:mu=1.25", "select:random:9", "stop",
                    "input:-1.5,0.1,0.25,-0.125", "deadman:123", "every:7",
                    "set:mu=-1", code=3)
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
        for key in [], ["--key", "wrong"]:
            said = sent(board, "stop", code=3, key=key)
            check("stop: refused, its tag is not that" in said, said)
        said = sent(board, "stop", key=["--key", "key"])
        check("stop: took effect" in said, said)
        said = sent(board, "every:20", "every:10", code=3,
                    key=["--key", "key"])
        says(said, r"20: took effect at step \d+; it asks 9020 bytes/s of "
             "11520, a record every 20", "10: refused, more than the line "
             r"carries at step \d+; it asks 17370 bytes/s of 11520, a record "
             "every 20 steps")
        call("monitor", board.name, "--send", "stop", "--key", "none", code=2)
        for mode in 0o640, 0o604, 0o620:
            Path("wrong").chmod(mode)
            said = call("monitor", board.name, "--key", "wrong", code=2)[1]
            check("--key wrong: others may read it" in said, said)


def test_a_frame_of_another_start_is_told():
    """One state between two heartbeats, with the number of that whose place it
    takes."""
    def beats():
        return [tick for kind, _, tick, _ in
                frames(Path("stream").read_bytes()) if kind == HEARTBEAT]

    Path("stream").write_bytes(b"")
    with Board("double", port="stream"):
        until(lambda: len(beats()) > 3, "heartbeats")
    stream = Path("stream").read_bytes()
    same(breaks(stream), [])
    # On a busy computer the board drops frames, and this is told (code 6).
    said = call("monitor", "stream", code=(0, 5, 6))[1]
    check("another run" not in said, said)
    last, after = beats()[1:3]
    one = next(frame for frame in frames(stream)
               if frame[0] == STATE and last < frame[2] < after)
    other = framed(*one[:3], bytes(8) + one[3][8:])
    Path("stream").write_bytes(stream.replace(framed(*one), other))
    same(breaks(Path("stream").read_bytes()), [after])
    said = call("monitor", "stream", code=6)[1]
    check(f"between steps {last} and {after} frames are of another run"
          in said, said)


def test_parts_of_two_starts_are_told():
    parts = []
    for _ in range(2):
        Path("stream").write_bytes(b"")
        with keyed(port="stream"):
            until(lambda: Path("stream").stat().st_size > 25000, "frames")
        parts.append(Path("stream").read_bytes().split(b"\0"))
    for at in 90, 171, 252:
        Path("stream").write_bytes(b"\0".join(parts[0][:at] + parts[1][at:]))
        said = call("monitor", "stream", code=6)[1]
        check("frames are of another run" in said, f"{at}: {said}")


def test_no_session_comes_again():
    starts.starts([program("double", "keyed")])


main(globals(), jobs=5)
