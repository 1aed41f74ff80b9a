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
from boards import ANSWER, INPUT, RUN, STATE, STOP, Board, framed, program, \
    relayed
from tap import TWOFOLD, call, check, main, output, same, until

KEY = starts.KEY.hex()


def rows(path):
    return Path(path).read_bytes().count(b"\n") if Path(path).exists() else 0


def follow(name, *more):
    """monitor, whose rows go to rows.part and whose words to the file said."""
    with open("said", "wb") as said:
        return subprocess.Popen(
            [TWOFOLD, "monitor", name, "--csv", "--out", "rows", *more],
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
    done = subprocess.run([TWOFOLD, "monitor", board.name, *words, *key],
                          stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, check=False)
    check(done.returncode in ((code,) if code else (0, 5, 6)), done.stderr)
    return done.stderr


def test_commands_are_sent_and_answered():
    with Board("double") as board:
        said = sent(board, "set:mu=1.25", "select:random:9", "stop",
                    "input:-1.5,0.1,0.25,-0.125", "deadman:123", "every:7",
                    "set:mu=-1", code=3)
        for text in (r"set:mu=1.25: took effect at step \d+; mu = 1.25, in "
                     r"\[0, ", "select:random:9: took effect",
                     "stop: took effect", "input:-1.5,0.1,0.25,-0.125: took",
                     "deadman:123: took effect", "every:7: took effect",
                     "set:mu=-1: refused, parameter out of its range at step "
                     r"\d+; mu = 1.25"):
            check(re.search(text, said), f"{text}: {said}")


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


def keyed(port="pty"):
    """A board with a key, that key and another one."""
    for name, text in ("key", KEY), ("wrong", KEY[:-1] + "0"):
        Path(name).write_text(text + "\n")
        Path(name).chmod(0o600)
    os.environ["TWOFOLD_BOOT"] = "count"
    return Board("double", "keyed", port)


def test_a_keyed_board_takes_keyed_commands():
    with keyed() as board:
        for key in [], ["--key", "wrong"]:
            said = sent(board, "stop", code=3, key=key)
            check("stop: refused, its tag is not that" in said, said)
        said = sent(board, "stop", key=["--key", "key"])
        check("stop: took effect" in said, said)
        said = sent(board, "every:20", "every:10", code=3,
                    key=["--key", "key"])
        for text in (r"20: took effect at step \d+; it asks 9006 bytes/s of "
                     "11520, a record every 20", "10: refused, more than the "
                     r"line carries at step \d+; it asks 17356 bytes/s of "
                     "11520, a record every 20 steps"):
            check(re.search(text, said), f"{text}: {said}")
        call("monitor", board.name, "--send", "stop", "--key", "none", code=2)
        for mode in 0o640, 0o604, 0o620:
            Path("wrong").chmod(mode)
            said = call("monitor", board.name, "--key", "wrong", code=2)[1]
            check("--key wrong: others may read it" in said, said)


def test_what_a_keyed_board_sends_has_its_tag():
    with keyed(port="stream"):
        until(lambda: rows("stream") > 500, "a stream")
    call("monitor", "stream", "--csv", "--out", "plain", code=(0, 5))
    verify = ["monitor", "stream", "--verify", "--key"]
    call(*verify, "key", "--csv", "--out", "checked", code=(0, 5))
    same(Path("plain").read_bytes(), Path("checked").read_bytes())
    said = call(*verify, "wrong", "--summary", "json", code=6)[1]
    check('"rows": 0,' in said and '"forged": 0' not in said, said)
    # A frame that somebody without the key sends, in the midst of them.
    stream = Path("stream").read_bytes()
    at = stream.index(b"\0\0", 20000) + 1
    Path("stream").write_bytes(stream[:at] + framed(STATE, 0, 0, bytes(49)) +
                               stream[at:])
    said = call(*verify, "key", "--summary", "json", code=6)[1]
    check('"forged": 1,' in said, said)


def test_no_session_comes_again():
    starts.starts([program("double", "keyed")])


main(globals(), jobs=5)
