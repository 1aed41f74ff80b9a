#!/usr/bin/python3 -B
"""Hostile frames against the running firmware of the host port, over a
pseudo-terminal: noise, frames with one wrong bit, whole frames of every type
and length with any payload and any tick, commands with raw bits for numbers,
frames that were sent before. Whatever comes, the firmware goes on, all that it
sends is whole and finite, and it still answers.

Environment: HOSTILE_FRAMES (default 20000) of them are sent, drawn from SEED
(default 1)."""
import functools
import math
import os
import random
import struct
import sys
import time
from collections import deque

from boards import REALS, Board, Line
from decode import ANSWER, DESCRIBE, SCHEMA, STATE, framed
from tap import check, run, same, until

FRAMES = int(os.environ.get("HOSTILE_FRAMES") or 20000)
SEED = int(os.environ.get("SEED") or 1)
BYTES = {"double": 8, "float": 4}
# A third of the bytes.
MANY_ZEROS = bytes(0 if byte % 3 == 0 else byte for byte in range(256))


def lengths(size):
    """That of the data of each command, for reals of so many bytes."""
    return dict(zip(range(0x41, 0x4C), (5 * size, 1 + size, 5, 0, 0, 0, 0,
                                        13 + 4 * size, 0, 0, 4)))


class Victim(Line):
    """The line to a board that is attacked."""

    def __init__(self, name, real):
        super().__init__(name)
        os.set_blocking(self.line, False)
        self.rng, self.real, self.kept = random.Random(SEED), real, deque(
            maxlen=64)
        self.came = self.answers = self.states = 0

    def frames(self, seconds=None):
        found = super().frames(seconds)
        self.came += len(found)
        for kind, _, _, payload in found:
            self.answers += kind == ANSWER
            if kind == SCHEMA:
                self.session = payload[13:17]
            if kind == STATE:
                self.states += 1
                values = struct.unpack_from(f"<4{self.real[0]}", payload)
                check(all(map(math.isfinite, values)), f"no state: {values}")
        return found

    def put(self, data):
        """All bytes, while the line is listened to."""
        def written():
            try:
                return os.write(self.line, data)
            except BlockingIOError:
                self.frames(0.01)
                return 0

        while data:
            data = data[until(written, "it takes bytes"):]

    def whole(self, is_command):
        """A whole frame. A command has the length that it should have, and most
        name the session of the board and a number that it still takes."""
        rng = self.rng
        right = lengths(BYTES[self.real])
        kind = rng.choice(list(right)) if is_command else rng.randrange(256)
        length = rng.randrange(max(right.values()))
        if is_command and rng.randrange(8):
            length = right[kind]
        session, number = self.session, self.number
        if rng.randrange(8) == 0:
            session = rng.randbytes(4)
        if rng.randrange(8) == 0:
            number = rng.randrange(number + 1)
        else:
            self.number += 1
        tick = rng.choice((0, rng.getrandbits(64), 2**64 - 1 - rng.randrange(4),
                           rng.randrange(100000)))
        return framed(kind, number, tick,
                      session + rng.randbytes(length).translate(MANY_ZEROS))

    def hostile(self):
        rng = self.rng
        kind = rng.randrange(8)
        if kind < 2:  # noise, of which some is longer than any frame
            return rng.randbytes(1 + rng.randrange(40 if kind else 400))
        if kind == 2 and len(self.kept) == self.kept.maxlen:
            return rng.choice(self.kept)
        frame = bytearray(self.whole(kind > 4))
        if kind == 3:
            frame[1 + rng.randrange(len(frame) - 2)] ^= rng.randrange(256)
        self.kept.append(bytes(frame))
        return frame

    def still_answers(self):
        """Zeros end what the noise left open, then it listens again."""
        before = self.answers

        def answers():
            self.put(framed(DESCRIBE, 0, 0, b""))
            self.frames(0.1)
            return self.answers > before
        until(answers, "it answers")


def hostile_frames_cost_no_firmware(real):
    with Board(real) as board, Victim(board.name, real) as line:
        line.describe()
        begun = time.monotonic()
        for sent in range(FRAMES):
            line.put(line.hostile())
            if sent % 16 == 0:
                line.frames(0)
        print(f"# {real}, seed {SEED}: {FRAMES} hostile frames in "
              f"{time.monotonic() - begun:.1f} s; {line.came} frames came back,"
              f" {line.answers} answers, {line.states} states", flush=True)
        line.still_answers()
        same((line.broken, line.states > 0), (0, True))
        same(board.end()[0], 0)


sys.exit(run([(f"hostile_frames_cost_no_firmware {real}", functools.partial(
    hostile_frames_cost_no_firmware, real)) for real in REALS], jobs=2))
