#!/usr/bin/python3 -B
"""The clients for a board, in Python (twofold.serial) and in C (loop), at the
host port on a pseudo-terminal: the loop of docs/USE.md; setpoints that act at
their ticks; either side that stands still for a while; a key."""
import contextlib
import io
import os
import re
import signal
import subprocess
import sys
import termios
import time
import types

from boards import BUILD, Board as Firmware
from starts import KEY, keyed
from tap import ROOT, check, main, same

# The package without its library, which needs a build of its own.
package = types.ModuleType("twofold")
package.__path__ = [str(ROOT / "tools/package/dist/python/twofold"),
                    str(ROOT / "tools/board/protocol")]
sys.modules["twofold"] = package
from twofold.serial import Board, BoardError  # noqa: E402  (it is there now)


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
    check(-1.5 < last < -0.5 and last != first, speeds)
    check(re.fullmatch(r"0\.\d+ \{.*\} \{.*\}", rows), rows)
    same(len(counts.split()), 3)


def test_setpoints_act_at_their_ticks():
    """They are sent while the machine stands: none can be late."""
    with Firmware("double") as firmware, Board(firmware.name) as board:
        board.every(1)
        board.stop()
        board.reset()
        for tick, force in (5, 0.5), (10, 0.25), (20, -0.5):
            board.setpoint(-1, force=force, tick=tick)
        board.setpoint(-1, force=0.125, tick=15)  # replaces that of 20
        board.start()
        rows = []
        while not rows or rows[-1].tick < 40:
            rows += board.states(1)
        of = {row.tick: row for row in rows if row.tick > 0}
        same([(tick, of[tick].input) for tick in range(1, 41) if tick in of],
             [(tick, int(tick > 5)) for tick in range(1, 41) if tick in of])
        while board.heartbeat.get("superseded") != 1:
            board.states(1).__next__()
        same((board.heartbeat["late"], board.heartbeat["lost"]), (0, 0))


def test_either_side_may_stand_still():
    """It goes on: states come, setpoints act, commands are answered."""
    with Firmware("float") as firmware, Board(firmware.name) as board:
        board.every(1)
        for pause in lambda: time.sleep(0.2), firmware.stop_a_while:
            pause()
            before = next(board.states(newest=True)).tick
            for state in board.states(500, newest=True):
                board.setpoint(-1, tick=state.tick + 2)
            check(state.tick > before, "it stands")
            same((state.input, board.set("mu", 1.25)[0]), (1, 1.25))


def test_errors_say_why():
    with Firmware("double") as firmware, Board(firmware.name) as board:
        for call, code in ((lambda: board.set("mu", -1), -1),
                           (lambda: board.every(0), -1),
                           (lambda: board.command(0x60), -16)):
            try:
                call()
                check(False, "not refused")
            except BoardError as error:
                same(error.code, code)
        same(board.set("mu", 0.5)[:2], (0.5, 0.0))


class Port:
    """As pyserial's objects are."""

    def __init__(self, name):
        self.device = Board.__init__.__globals__["_Device"](name, 1, None)
        self.in_waiting = 0
        self.write, self.close = self.device.write, self.device.close
        self.read = lambda count: os.read(self.device.line, count)


def test_a_path_has_a_speed():
    with Firmware("float") as firmware:
        for baud, speed in ((None, None), (1000000, termios.B1000000)):
            with Board(firmware.name, baud=baud):
                line = os.open(firmware.name, os.O_RDWR | os.O_NOCTTY)
                got = termios.tcgetattr(line)[4:6]
                os.close(line)
                check(speed is None or got == [speed, speed], got)
        try:
            Board(firmware.name, baud=1234567)
            check(False, "no speed of this system")
        except ValueError as error:
            check("1234567" in str(error), error)


def test_an_object_is_a_port():
    with Firmware("float") as firmware, Board(Port(firmware.name)) as board:
        rows = board.record(50)
        same((board.schema["real"], len(rows)), ("float", 50))
        check((rows["tick"][1:] > rows["tick"][:-1]).all(), rows["tick"])
        check((rows["set"] >> rows["mode"] & 1).all(), rows["set"])


def test_a_board_that_breaks_is_heard():
    line = "fault: stack overflow at 00000000 cause 00000092"
    with Firmware("float") as firmware, Board(Port(firmware.name)) as board:
        board._port.read = lambda _: f"\0\r\n{line}\r\n\0".encode()
        try:
            board.record(10)
            check(False, "it goes on")
        except BoardError as error:
            check(line in str(error), error)


def test_only_the_key_is_answered():
    with keyed() as firmware:
        with Board(firmware.name, key=KEY) as board:
            board.stop()
            board.setpoint(-1)
            same(board.set("mu", 1.25)[0], 1.25)
        for key, said in (bytes(16), "with the tag of the key"), \
                (None, "wants its key"):
            try:
                with Board(firmware.name, key=key, timeout=5) as board:
                    board.stop()
                check(False, "it is taken")
            except BoardError as error:
                check(said in str(error), error)


def test_loop_in_c():
    with Firmware("double") as firmware:
        process = subprocess.Popen([BUILD / "double/loop", firmware.name,
                                    "3000"], stdout=subprocess.PIPE, text=True)
        time.sleep(0.3)
        process.send_signal(signal.SIGSTOP)
        time.sleep(0.2)
        process.send_signal(signal.SIGCONT)
        firmware.stop_a_while()
        said = process.communicate()[0]
    same(process.returncode, 0)
    check(re.match(r"setpoints  3000 sent; 0 lost, \d+ superseded, ", said),
          said)
    counts = [(int(ticks), int(count)) for ticks, count in
              re.findall(r"(\d+): (\d+)", said.splitlines()[1])]
    check(sum(count for _, count in counts) > 100, said)
    several = re.fullmatch(r"possible   several modes in (\d+) steps:(.*)",
                           said.splitlines()[2])
    same(several[1] != "0", len(several[2].split()) > 1)


main(globals(), jobs=4)
