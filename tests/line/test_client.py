#!/usr/bin/python3 -B
"""The clients for a board, in Python (twofold.serial) and in C (loop), at the
host port on a pseudo-terminal: the loop of docs/USE.md; setpoints that act at
their ticks; either side that stands still for a while; a key."""
import contextlib
import functools
import io
import re
import signal
import subprocess
import sys
import termios
import time
import types
from concurrent.futures import ThreadPoolExecutor

from boards import BUILD, Board as Firmware, says
from decode import HEARTBEAT, decode, framed, sealed, stuffed
from starts import KEY, keyed
from tap import ROOT, check, main, same

# The package without its library, which needs a build of its own.
package = types.ModuleType("twofold")
package.__path__ = [str(ROOT / "tools/package/dist/python/twofold"),
                    str(ROOT / "tools/board/protocol")]
sys.modules["twofold"] = package
from twofold.serial import Board, BoardError, _Device  # noqa: E402  (now)


def test_loop_of_the_manual():
    text = (ROOT / "docs/USE.md").read_text()
    code = re.search(r"```python loop\n(.*?)```", text, re.S)[1]
    check(code.count("\n") <= 20, "more than 20 lines")
    said = io.StringIO()
    with Firmware("double") as firmware, contextlib.redirect_stdout(said):
        exec(code.replace("PORT", firmware.name), {})
    about, speeds, rows, counts = said.getvalue().splitlines()
    same(about, "chaos double 0.001")
    # How far the motion comes depends on the load; it stays near the turntable.
    first, last = (float(part) for part in speeds.split(" -> "))
    check(-2 < last < 0.5 and last != first, speeds)
    check(re.fullmatch(r"-?0\.\d+ \{.*\} \{.*\}", rows), rows)
    same(len(counts.split()), 3)


def test_setpoints_act_at_their_ticks():
    """They are sent while the machine stands: none can be late."""
    with Firmware("double") as firmware, Board(firmware.name) as board:
        board.every(1)
        board.stop()
        board.describe()  # which forgets earlier rows
        board.reset()
        for tick, force in (5, 0.5), (10, 0.25), (20, -0.5):
            board.setpoint(-1, force=force, tick=tick)
        board.setpoint(-1, force=0.125, tick=15)  # replaces that of 20
        board.start()
        rows = [*board.states(1)]
        while rows[-1].tick < 40 or board.heartbeat.get("superseded") != 1:
            rows += board.states(1)
        of = {row.tick: row for row in rows if row.tick > 0}
        same([(tick, of[tick].input) for tick in range(1, 41) if tick in of],
             [(tick, int(tick > 5)) for tick in range(1, 41) if tick in of])
        same((board.heartbeat["late"], board.heartbeat["lost"]), (0, 0))


def test_either_side_may_stand_still():
    """It goes on: states come, setpoints act, commands are answered."""
    with Firmware("float") as firmware, Board(firmware.name) as board:
        board.every(1)
        for pause in time.sleep, firmware.stop_a_while:
            pause(0.2)
            before = next(board.states(newest=True)).tick
            for state in board.states(500, newest=True):
                board.setpoint(-1, tick=state.tick + 2)
            check(state.tick > before, "it stands")
            same((state.input, board.set("mu", 1.25)[0]), (1, 1.25))


def refused(call, said, code=None):
    try:
        call()
        check(False, f"not refused: {said}")
    except BoardError as error:
        check(re.search(said, str(error)), error)
        same(error.code, code)


def steers(board, **inputs):
    """With a setpoint, of which an answer says that it is refused."""
    board.setpoint(**inputs)
    board.record(9999)


def test_errors_say_why():
    with Firmware("double") as firmware, Board(firmware.name) as board:
        board.every(1)
        for call, said, code in (
                (lambda: board.set("mu", -1), "out of range", -1),
                (lambda: board.every(0), "out of range", -1),
                (lambda: board.command(0x60), "unknown to the board", -16),
                (lambda: steers(board, omega0=float("nan")), "not finite", -2),
                (lambda: steers(board, omega0=0, tick=2**40), "too far", -19)):
            refused(call, said, code)
        same(board.set("mu", 0.5)[:2], (0.5, 0.0))
        with Board(firmware.name) as other:
            other.setpoint(-1)
        refused(lambda: board.record(1500), "another host commands", -20)
        firmware.run.kill()
        refused(lambda: board.record(1000), "the line fails")
        refused(board.stop, "the line fails")
    for said, words in (("no serial line", {}), ("not 16", {"key": b"short"}),
                        ("1234567: not a speed", {"baud": 1234567})):
        try:
            Board("/dev/null", **words)
            check(False, words)
        except (ValueError, OSError) as error:
            check(said in str(error), error)


def test_threads_may_send():
    with Firmware("float") as firmware, Board(firmware.name) as board:
        board.every(1)

        def steer():
            for _ in range(300):
                board.setpoint(-1)
                time.sleep(0.001)
        with ThreadPoolExecutor() as pool:
            jobs = [pool.submit(steer), pool.submit(
                lambda: [board.set("mu", 1 + i / 64)[0] for i in range(50)])]
            ticks = [state.tick for state in board.states(1000)]
            same([job.result() for job in jobs],
                 [None, [1 + i / 64 for i in range(50)]])
        check(ticks == sorted(set(ticks)), ticks)


class Port:
    """As pyserial's objects are. change: what a frame from the board becomes,
    by its bytes and what they say."""

    def __init__(self, name, change=lambda wire, *_: wire):
        self.device = _Device(name, 1, None)
        self.change, self.rest, self.in_waiting = change, b"", 0
        self.write, self.close = self.device.write, self.device.close

    def read(self, _):
        *pieces, self.rest = (self.rest + self.device.read(0)).split(b"\0")
        return b"".join(self.change(b"\0" + piece + b"\0", *decode(piece))
                        for piece in pieces if decode(piece))


def test_nonsense_is_told():
    fault = "fault: stack overflow at 00000000 cause 00000092"
    wrong = [(framed(kind, 0, 0, data), f"no frame of type 0{kind}")
             for kind, data in ((1, b"\4" * 10), (1, b"\x09" * 40), (2, b""),
                                (2, b"\3r,quad"), (2, b"\3\xff"), (3, b"short"),
                                (6, b"short"), (8, b"short"))]
    wrong += ((b"\0" + sealed(stuffed(b"\4" + bytes(20))) + b"\0",
               "version 4, here it is 5"),
              (b"\0\r\n" + fault.encode() + b"\r\n\0", fault))
    with Firmware("float") as firmware:
        for bad, said in wrong:
            def put(wire, kind, *_, bad=bad):
                return wire + bad if kind == 3 else wire
            with Board(firmware.name) as board:
                board._port = Port(firmware.name, put)
                refused(lambda: board.record(100), said)


def test_what_is_put_between_is_told():
    """Behind the first heartbeat: a row in front of another or in its place;
    one that is missing counts."""
    def put(wire, kind, number, tick, _, how, seen):
        seen.append(kind)
        if kind != 3 or seen.count(3) != 60:
            return wire
        fake = framed(3, number, tick, bytes(37))
        return {"put": fake + wire, "replace": fake, "lose": b""}[how]
    with keyed() as firmware:
        for how, said in (("put", "numbers go back"), ("lose", ""),
                          ("replace", "were inserted")):
            with Board(Port(firmware.name, functools.partial(
                    put, how=how, seen=[])), key=KEY) as board:
                if said:
                    refused(lambda: board.record(200), said)
                else:
                    same((len(board.record(99)), board.line.lost > 0), (99, 1))


def test_a_key_gives_no_row_without_heartbeats():
    """None before the first one; 5 s after the last one an error."""
    rows = []
    with keyed() as firmware, Board(Port(
            firmware.name, lambda wire, kind, *_: wire if not rows
            or kind != HEARTBEAT else b""), key=KEY, timeout=0.2) as board:
        rows += board.states(1)
        check(board.heartbeat, "a row before a heartbeat")
        refused(lambda: board.record(9999), "no heartbeat with the tag")


def test_a_path_has_a_speed():
    with Firmware("float") as firmware, \
            Board(firmware.name, baud=1000000) as board:
        same(termios.tcgetattr(board._port.line)[4:6], 2 * [termios.B1000000])


def test_an_object_is_a_port():
    with Firmware("float") as firmware, Board(Port(firmware.name)) as board:
        rows = board.record(50)
        same((board.schema["real"], len(rows)), ("float", 50))
        check((rows["tick"][1:] > rows["tick"][:-1]).all(), rows["tick"])
        check((rows["set"] >> rows["mode"] & 1).all(), rows["set"])


def test_only_the_key_is_answered():
    with keyed() as firmware:
        with Board(firmware.name, key=KEY) as board:
            board.stop()
            board.setpoint(-1)
            same(board.set("mu", 1.25)[0], 1.25)
        refused(lambda: Board(firmware.name, key=bytes(16)),
                "with the tag of the key")
        with Board(firmware.name, timeout=5) as board:
            refused(board.stop, "requires its key", -22)


def test_loop_in_c_ends_where_no_board_of_its_kind_answers():
    with Firmware("float") as firmware:
        done = subprocess.run([BUILD / "double/loop", firmware.name],
                              capture_output=True, check=False)
    same(done.stderr, b"loop: no board of this real type answers\n")


def test_loop_in_c():
    with Firmware("double") as firmware:
        process = subprocess.Popen([BUILD / "double/loop", firmware.name,
                                    "3000"], stdout=subprocess.PIPE, text=True)
        time.sleep(0.3)
        process.send_signal(signal.SIGSTOP)
        time.sleep(0.2)
        process.send_signal(signal.SIGCONT)
        firmware.stop_a_while(0.2)
        said = process.communicate()[0]
    same(process.returncode, 0)
    says(said, r"^setpoints  3000 sent; 0 lost, \d+ superseded, ")
    counts = [(int(ticks), int(count)) for ticks, count in
              re.findall(r"(\d+): (\d+)", said.splitlines()[1])]
    check(sum(count for _, count in counts) > 100, said)
    several = re.fullmatch(r"possible   several modes in (\d+) steps:(.*)",
                           said.splitlines()[2])
    same(several[1] != "0", len(several[2].split()) > 1)


main(globals(), jobs=4)
