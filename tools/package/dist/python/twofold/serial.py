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
input; in SI units. docs/PROTOCOL.md says what goes over the line."""
from __future__ import annotations

import collections
import itertools
import os
import select
import struct
import time
import zlib

from .decode import decode, siphash

__all__ = ["Board", "BoardError"]
SCHEMA, LAYOUT, STATE, REPORT, HEARTBEAT, ANSWER, EXPIRED = 1, 2, 3, 4, 6, 8, 9
TAGGED = SCHEMA, HEARTBEAT, ANSWER, EXPIRED
PARAMETER, START, STOP, RESET = 0x42, 0x44, 0x45, 0x46
DESCRIBE, DEADMAN, EVERY, SETPOINT = 0x4A, 0x4B, 0x4C, 0x4D
PARAMETERS = ("m d beta k2 c1 c2 r0 omega0 mu kappa gamma epsilon k delta "
              "sigma rho a theta dt rate tolerance segments").split()
REASONS = {-1: "out of range", -2: "not finite or out of range",
           -16: "the board does not know it", -17: "its length is wrong",
           -19: "dated too far ahead", -20: "another host commands the board",
           -21: "the board was started anew", -22: "the board wants its key",
           -23: "more than the line carries"}
TRIES = 4


class BoardError(Exception):
    """A command was refused (`code`, as in docs/PROTOCOL.md), or the board does
    not answer (code None)."""

    def __init__(self, what, code=None):
        super().__init__(what)
        self.code = code


class _Device:
    """A device by its path, as far as pyserial's objects are used here."""

    def __init__(self, path, timeout, baud):
        import termios
        import tty
        speed = getattr(termios, f"B{baud}", None)
        if baud and speed is None:
            raise ValueError(f"baud={baud!r}: not a speed of this system")
        self.timeout = timeout
        self.line = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.line, termios.TCSANOW)
        if baud:
            of = termios.tcgetattr(self.line)
            of[4:6] = speed, speed
            termios.tcsetattr(self.line, termios.TCSANOW, of)

    def read(self, _):
        there = select.select([self.line], [], [], self.timeout)[0]
        return os.read(self.line, 65536) if there else b""

    def write(self, wire):
        while wire:
            wire = wire[os.write(self.line, wire):]

    def close(self):
        os.close(self.line)


class Board:
    """A board at a port: a path, or an object with read, write and close, as
    pyserial's, whose timeout is not None. baud: of a path, which keeps its
    speed without it. key: its 16 bytes, where it has one; then answers and
    counts are the board's, and none of a recording."""

    def __init__(self, port, key=None, timeout=1.0, baud=None):
        self._port = _Device(port, timeout, baud) \
            if isinstance(port, (str, os.PathLike)) else port
        self._key, self._timeout = key, timeout
        self._rest, self._nonce, self._trusts = b"", b"", False
        self._answers, self._rows = {}, collections.deque()
        self.schema, self.heartbeat, self._layouts = None, {}, {}
        self._session, self._number, self._state = bytes(4), 0, None
        self.describe()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._port.close()

    def describe(self):
        """What the board says of itself: scene, build, real, dt, seed, deadman,
        the hash of its parameters, whether it has a key."""
        self._nonce, self._trusts, self._asks = os.urandom(8), False, True
        self.command(DESCRIBE, bytes(4) + self._nonce if self._key else b"")
        self._rows.clear()
        until = time.monotonic() + TRIES * self._timeout
        while self.schema is None or len(self._layouts) < 3:
            self._read(until, "does not describe itself")
        return self.schema

    def states(self, count=None, newest=False):
        """So many states, or all that come. newest: leaves out those that were
        overtaken, as a controller wants it that was late."""
        for _ in itertools.repeat(None) if count is None else range(count):
            until = time.monotonic() + TRIES * self._timeout
            while not self._rows:
                self._read(until, "sends no state")
            if newest:
                while len(self._rows) > 1:
                    self._rows.popleft()
            yield self._rows.popleft()

    def record(self, count):
        """So many states as a numpy array with the fields of a state."""
        import numpy as np
        rows = list(self.states(count))
        return np.array(rows, np.dtype([
            (name, "u8" if name == "tick" else np.result_type(type(value)))
            for name, value in zip(rows[0]._fields, rows[0])]))

    def setpoint(self, omega0, r0=0.0, force=0.0, torque=0.0, alpha=0.0,
                 tick=0):
        """Inputs from a tick on; 0: from the next step on. Without an answer:
        the newest wins, and `heartbeat` counts those superseded and late."""
        self._send(SETPOINT, struct.pack("<5" + self._real, omega0, r0, force,
                                         torque, alpha), tick, self._number)
        self._number += 1

    def set(self, name, value):
        """A parameter. Returns: its value in effect, smallest, largest."""
        payload = self.command(PARAMETER, struct.pack(
            "<B" + self._real, PARAMETERS.index(name), value))[1]
        return struct.unpack_from("<3" + self._real, payload, 8)

    def start(self):
        return self.command(START)[0]

    def stop(self):
        return self.command(STOP)[0]

    def reset(self):
        """Back to the start of its scene."""
        return self.command(RESET)[0]

    def every(self, steps):
        """From record to record."""
        return self.command(EVERY, struct.pack("<I", steps))[0]

    def deadman(self, ticks):
        """How long inputs hold; 0: without end."""
        return self.command(DEADMAN, struct.pack("<I", ticks))[0]

    def command(self, kind, data=b"", tick=0):
        """Sends it until it is answered. Returns: the tick at which it took
        effect, and the payload of the answer."""
        number = 0 if kind == DESCRIBE else self._number
        self._answers.pop((kind, number), None)
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
        self._number += kind != DESCRIBE
        code, = struct.unpack_from("b", found[1], 5)
        if code and not (code == -20 and again):  # only its answer was lost
            raise BoardError(f"command {kind:02X} refused: "
                             f"{REASONS.get(code, code)}", code)
        return found

    def _send(self, kind, data, tick, number):
        payload = data if kind == DESCRIBE else self._session + data
        tags = self._key and kind != DESCRIBE
        body = struct.pack("<BBBIQ", 5, kind, len(payload) + 8 * bool(tags),
                           number, tick) + payload
        if tags:
            body += struct.pack("<Q", siphash(self._key, body))
        code = b"".join(bytes([len(part) + 1]) + part
                        for part in body.split(b"\0"))
        crc = zlib.crc32(code)
        self._port.write(b"\0" + code + bytes(
            128 | crc >> 7 * i & 127 for i in range(5)) + b"\0")

    def _read(self, until=None, what=""):
        """Takes what comes, at least something within the port's timeout."""
        if until is not None and time.monotonic() > until:
            raise BoardError(f"the board {what}")
        came = self._port.read(max(1, getattr(self._port, "in_waiting", 1)))
        *pieces, self._rest = (self._rest + came).split(b"\0")
        for piece in filter(None, pieces):
            if piece.startswith(b"\r\nfault: "):  # it broke (port_fault)
                raise BoardError("the board says: " +
                                 piece.decode("ascii", "replace").strip())
            frame = decode(piece)
            if frame is not None and self._is_ours(frame):
                self._take(*frame)

    def _is_ours(self, frame):
        """With a key: tagged for the nonce, or behind one that was."""
        kind, number, tick, payload = frame
        if not self._key or kind not in TAGGED:
            return self._trusts or not self._key
        body = struct.pack("<BBBIQ", 5, kind, len(payload), number, tick)
        right = payload[-8:] == struct.pack("<Q", siphash(
            self._key, body + payload[:-8] + self._nonce))
        if self._trusts and not right:
            raise BoardError("a frame without the tag of the key: somebody "
                             "else sends, or the board was started anew")
        self._trusts |= right
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
            number, = struct.unpack_from("<I", payload)
            self._answers[payload[4], number] = tick, payload
            if payload[4] == DESCRIBE:  # what came before may be of another
                self.schema, self._layouts, self._asks = None, {}, False
        elif kind == SCHEMA and not self._asks:
            self._take_schema(payload)
        elif kind == LAYOUT and self.schema:
            self._take_layout(payload)
        elif kind == HEARTBEAT and HEARTBEAT in self._layouts:
            names, form = self._layouts[HEARTBEAT]
            self.heartbeat = dict(zip(names, form.unpack_from(payload)))

    def _take_schema(self, payload):
        self._real = "f" if payload[0] == 4 else "d"
        seed, parameters, session, number, deadman, _, dt = struct.unpack_from(
            "<6I" + self._real, payload, 5)
        first = self.schema is None
        if not first and payload[13:17] != self._session:
            raise BoardError("the board was started anew", -21)
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
