"""A board whose firmware was built with FORMAT=frames UPLINK=yes, at the end of
a serial line.

    from twofold.serial import Board
    with Board("/dev/ttyACM0") as board:        # or an open serial.Serial(...)
        board.set("mu", 1.25)
        for state in board.states(1000):
            board.setpoint(-1, torque=-0.1 * state.omega, tick=state.tick + 2)
        rows = board.record(1000)               # a numpy array
        board.heartbeat["late"], board.heartbeat["superseded"]

A state has the fields tick, t and those of the layouts that the board sends: r,
v, omega, phi, seed, mode, h, g, F, M, delassus, residual, set, choices, status,
input; in SI units. Another thread may send meanwhile. docs/PROTOCOL.md says
what goes over the line."""
from __future__ import annotations

import collections
import itertools
import os
import select
import struct
import threading
import time

from .decode import (ANSWER, DEADMAN, DESCRIBE, EVERY, EXPIRED, HEARTBEAT,
                     LAYOUT, PARAMETER, PARAMETERS, REPORT, RESET, SCHEMA,
                     SETPOINT, START, STATE, STOP, Line, decode, framed, sealed,
                     tagged)

__all__ = ["Board", "BoardError"]
TAGGED = SCHEMA, HEARTBEAT, ANSWER, EXPIRED
REASONS = {-1: "out of range", -2: "not finite or out of range",
           -16: "unknown to the board", -17: "of a wrong length",
           -19: "dated too far ahead", -20: "another host commands the board",
           -21: "the board was restarted", -22: "the board requires its key",
           -23: "more than the line carries"}
TRIES = 4
SILENCE = 5.0  # of heartbeats, which come each second [s]


class BoardError(Exception):
    """A refused command (`code`, as in docs/PROTOCOL.md), or no answer (code
    None)."""

    def __init__(self, what, code=None):
        super().__init__(what)
        self.code = code


class _Device:
    """A device by its path, with the used methods of pyserial's objects."""

    def __init__(self, path, timeout, baud):
        import termios
        import tty
        speed = getattr(termios, f"B{baud}", None)
        if baud and speed is None:
            raise ValueError(f"baud={baud!r}: not a speed of this system")
        self.timeout = timeout
        self.line = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            tty.setraw(self.line, termios.TCSANOW)
            of = termios.tcgetattr(self.line)
        except termios.error as error:
            self.close()
            raise OSError(error.args[0], "no serial line", path) from None
        of[0] &= ~termios.IXOFF
        of[2] &= ~(termios.CSTOPB | termios.CRTSCTS)
        of[2] |= termios.CREAD | termios.CLOCAL
        if baud:
            of[4:6] = speed, speed
        termios.tcsetattr(self.line, termios.TCSANOW, of)
        termios.tcflush(self.line, termios.TCIFLUSH)

    def read(self, _):
        there = select.select([self.line], [], [], self.timeout)[0]
        came = os.read(self.line, 65536) if there else b""
        if there and not came:
            raise OSError("the device went away")
        return came

    def write(self, wire):
        while wire:
            if not select.select([], [self.line], [], TRIES * self.timeout)[1]:
                raise OSError("the line accepts nothing")
            wire = wire[os.write(self.line, wire):]

    def close(self):
        line, self.line = self.line, None
        if line is not None:
            os.close(line)


class Board:
    """A board on a serial port: a path, or an object with read, write and
    close, such as pyserial's, whose timeout is not None. key: the 16 bytes of
    the board's key, if it has one; answers and counts are then proved to be the
    board's. baud: the speed, for a path; None: unchanged. `line.lost` counts
    frames from the board that were lost or damaged."""

    def __init__(self, port, key=None, timeout=1.0, baud=None):
        if key is not None and len(key) != 16:
            raise ValueError(f"key has {len(key)} bytes, not 16")
        self._port = _Device(port, timeout, baud) \
            if isinstance(port, (str, os.PathLike)) else port
        self._key, self._timeout = key, timeout
        self._rest, self._nonce, self._trusts = b"", b"", False
        self._answers, self._rows = {}, collections.deque()
        self._sends, self._reads = threading.RLock(), threading.Lock()
        self.line = Line()
        self.schema, self.heartbeat, self._layouts = None, {}, {}
        self._session, self._number, self._state = bytes(4), 0, None
        try:
            self.describe()
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._port.close()

    def describe(self):
        """Returns scene, build, real, dt, seed, deadman, the hash of the
        parameters, and whether the board has a key."""
        self._nonce, self._trusts = os.urandom(8), False
        self._mute, self._silent, self._looked = bool(self._key), 0.0, 0.0
        self._asks, = struct.unpack("I", os.urandom(4))  # for an answer to us
        self.command(DESCRIBE, bytes(4) + self._nonce if self._key else b"")
        self._rows.clear()
        until = time.monotonic() + TRIES * self._timeout
        while self.schema is None or len(self._layouts) < 3:
            self._read(until, "does not describe itself")
        return self.schema

    def states(self, count=None, newest=False):
        """Yields `count` states, or all that arrive. newest: skips states that
        a newer one has overtaken, for a controller that was late."""
        for _ in itertools.repeat(None) if count is None else range(count):
            until = time.monotonic() + max(TRIES * self._timeout,
                                           2 * SILENCE * self._mute)
            while not self._rows:
                self._read(until, "sends no state")
            if newest:
                while len(self._rows) > 1:
                    self._rows.popleft()
            yield self._rows.popleft()

    def record(self, count):
        """Returns `count` states as a numpy array with the fields of a
        state."""
        import numpy as np
        rows = list(self.states(count))
        return np.array(rows, np.dtype([
            (name, "u8" if name == "tick" else np.result_type(type(value)))
            for name, value in zip(rows[0]._fields, rows[0])]))

    def setpoint(self, omega0, r0=0.0, force=0.0, torque=0.0, alpha=0.0,
                 tick=0):
        """Sets inputs from a tick on; 0: from the next step on. No answer: the
        newest wins; `heartbeat` counts those superseded and late."""
        data = struct.pack("<5" + self._real, omega0, r0, force, torque, alpha)
        with self._sends:
            self._send(SETPOINT, data, tick, self._number)
            self._number += 1

    def set(self, name, value):
        """Sets a parameter. Returns its value in effect, smallest, largest."""
        if name not in PARAMETERS:
            raise ValueError(f"{name!r} is not one of {' '.join(PARAMETERS)}")
        payload = self.command(PARAMETER, struct.pack(
            "<B" + self._real, PARAMETERS.index(name), value))[1]
        return struct.unpack_from("<3" + self._real, payload, 8)

    def start(self):
        return self.command(START)[0]

    def stop(self):
        return self.command(STOP)[0]

    def reset(self):
        """Returns to the start of the scene."""
        return self.command(RESET)[0]

    def every(self, steps):
        """Sets the number of steps from record to record."""
        return self.command(EVERY, struct.pack("<I", steps))[0]

    def deadman(self, ticks):
        """Sets for how many ticks inputs hold; 0: without end."""
        return self.command(DEADMAN, struct.pack("<I", ticks))[0]

    def command(self, kind, data=b"", tick=0):
        """Sends it until it is answered. Returns the tick at which it took
        effect, and the payload of the answer."""
        with self._sends:
            return self._command(kind, data, tick)

    def _command(self, kind, data, tick):
        number = self._asks if kind == DESCRIBE else self._number
        self._number += kind != DESCRIBE
        self._answers.clear()
        for again in range(TRIES):
            self._send(kind, data, tick, number)
            until = time.monotonic() + self._timeout
            while (kind, number) not in self._answers and \
                    time.monotonic() < until:
                self._read()
            if found := self._answers.pop((kind, number), None):
                break
        else:
            raise BoardError("no answer" + (
                " with the tag of the key" if self._key and not self._trusts
                else ": does the board take commands?"))
        code, = struct.unpack_from("b", found[1], 5)
        if not (code == -20 and again):  # only its answer was lost
            self._judge(kind, code)
        return found

    @staticmethod
    def _judge(kind, code):
        if code:
            raise BoardError(f"command {kind:02X} refused: "
                             f"{REASONS.get(code, code)}", code)

    def _send(self, kind, data, tick, number):
        if kind != DESCRIBE:
            data = self._session + data
            if self._key:
                data = tagged(self._key, kind, number, tick, data)
        try:
            self._port.write(framed(kind, number, tick, data))
        except OSError as error:
            raise BoardError(f"the line fails: {error}") from error

    def _read(self, until=None, what=""):
        """Reads what arrives, at least something within the timeout."""
        if until is not None and time.monotonic() > until:
            raise BoardError(f"the board {what}")
        if not self._reads.acquire(timeout=0.001):
            return  # another thread takes it
        try:
            # More than 0.2 s between two reads is a pause of the caller.
            began = max(self._looked, time.monotonic() - 0.2)
            came = self._port.read(max(1, getattr(self._port, "in_waiting", 1)))
            self._looked = time.monotonic()
            self._silent += self._trusts and self._looked - began
            *pieces, self._rest = (self._rest + came).split(b"\0")
            for piece in filter(None, pieces):
                self._take_piece(piece)
            if self._silent > SILENCE:
                raise BoardError("no heartbeat with the tag of the key")
        except OSError as error:
            raise BoardError(f"the line fails: {error}") from error
        finally:
            self._reads.release()

    def _take_piece(self, piece):
        if piece.startswith(b"\r\nfault: "):  # it broke (port_fault)
            raise BoardError("the board says: " +
                             piece.decode("ascii", "replace").strip())
        frame = decode(piece)
        if frame is None:
            if len(piece) > 20 and piece[1] != 5 and \
                    piece == sealed(piece[:-5]):
                raise BoardError(f"its protocol is version {piece[1]}, here it "
                                 "is 5: rebuild the sender")
            return
        back = self.line.back
        try:
            if self.line.breaks(piece, frame) and self._trusts:
                raise BoardError("frames were inserted, or of another run")
            if self._is_ours(frame):
                self._take(*frame)
        except (struct.error, ValueError, LookupError) as error:
            raise BoardError(f"no frame of type {frame[0]:02X} of this "
                             "protocol") from error
        if self._key and self._trusts and back < self.line.back:
            raise BoardError("numbers go back: somebody else sends")

    def _is_ours(self, frame):
        """With a key a frame needs the tag for the nonce. A row needs a tagged
        heartbeat before it, a layout any tagged frame before it."""
        kind, number, tick, payload = frame
        if not self._key or kind not in TAGGED:
            return not self._mute or (self._trusts and kind == LAYOUT)
        right = payload == tagged(self._key, kind, number, tick, payload[:-8],
                                  self._nonce)
        if self._trusts and not right:
            raise BoardError("a frame without the tag of the key: somebody "
                             "else sends, or the board was restarted")
        self._trusts |= right
        if right and kind == HEARTBEAT:
            self._mute, self._silent = False, 0.0
        return right

    def _take(self, kind, _, tick, payload):
        if kind == STATE and STATE in self._layouts:
            self._state = tick, self._layouts[STATE][1].unpack(payload)
        elif kind == REPORT and self._state and self._state[0] == tick and \
                REPORT in self._layouts:
            report = self._layouts[REPORT][1].unpack(payload)
            self._rows.append(self._row(tick, tick * self.schema["dt"],
                                        *self._state[1], *report[:6],
                                        *report[7:]))
            self._state = None
        elif kind == ANSWER:
            number, of, code = struct.unpack_from("<IBb", payload)
            self._answers[of, number] = tick, payload
            if of == DESCRIBE and number == self._asks:
                # What came before may be of another.
                self.schema, self._layouts, self._asks = None, {}, None
            elif of == SETPOINT and code != -20:  # a line may double frames
                self._judge(of, code)
        elif kind == SCHEMA and self._asks is None:
            self._take_schema(payload)
        elif kind == LAYOUT and self.schema:
            self._take_layout(payload)
        elif kind == HEARTBEAT and HEARTBEAT in self._layouts:
            names, form = self._layouts[HEARTBEAT]
            self.heartbeat = dict(zip(names, form.unpack_from(payload)))

    def _take_schema(self, payload):
        self._real = {4: "f", 8: "d"}[payload[0]]
        seed, parameters, session, number, deadman, _, dt = struct.unpack_from(
            "<6I" + self._real, payload, 5)
        first = self.schema is None
        if not first and payload[13:17] != self._session:
            raise BoardError(REASONS[-21], -21)
        if not first and number > self._number:
            raise BoardError(REASONS[-20], -20)
        scene, build = payload[29 + payload[0]:].split(b"\0")[:2]
        self._session = payload[13:17]
        if first:
            self._number = number
        self.schema = {
            "scene": scene.decode(), "build": build.decode(), "dt": dt,
            "real": "float" if payload[0] == 4 else "double", "seed": seed,
            "parameters": parameters, "deadman": deadman,
            "has_key": bool(payload[4] & 16), "session": session}

    def _take_layout(self, payload):
        fields = [(*text.split(","), "u32")[:2]
                  for text in payload[1:].decode().split(";")]
        letters = {"real": self._real, "u8": "B", "i8": "b", "u32": "I"}
        self._layouts[payload[0]] = [name for name, _ in fields], struct.Struct(
            "<" + "".join(letters[type_] for _, type_ in fields))
        if STATE in self._layouts and REPORT in self._layouts:
            report = self._layouts[REPORT][0]  # its mode is the state's
            self._row = collections.namedtuple("State", [
                "tick", "t", *self._layouts[STATE][0], *report[:6],
                *report[7:]])
