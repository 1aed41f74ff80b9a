"""Firmware of the host port, which `make test` has made, on a pseudo-terminal:
what the tests of the line share.

Environment: FIRMWARE the beginning of the path of its folders; REALS the real
types that are tested."""
import os
import subprocess
import sys
import zlib
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / place)
                for place in ("tests/support", "tools/board/protocol")]
from tap import TWOFOLD  # noqa: E402  (the paths come first)

BUILD = Path(TWOFOLD).parents[1]
FIRMWARE = str(Path(os.environ.get("FIRMWARE") or
                    BUILD / "boards/host/chaos").resolve())
REALS = (os.environ.get("REALS") or "double float").split()
RUN = [TWOFOLD, "run", "chaos", "--t-end", "0.5", "--dt", "1e-3"]


def program(real, name):
    return f"{FIRMWARE}-{real}/firmware-{name}.elf"


def stuffed(body):
    """COBS of a body without a block of 254."""
    return b"".join(bytes([len(part) + 1]) + part
                    for part in body.split(b"\0"))


def sealed(code):
    """With its CRC, which is right whatever the bytes are."""
    crc = zlib.crc32(code)
    return code + bytes(128 | crc >> 7 * i & 127 for i in range(5))


class Board:
    """`with Board(real) as board:` one that takes commands, on board.name."""

    def __init__(self, real=REALS[0]):
        self.run = subprocess.Popen(
            [program(real, "line")], stdin=subprocess.DEVNULL,
            stderr=subprocess.PIPE, env={**os.environ, "TWOFOLD_PORT": "pty"})
        self.name = self.run.stderr.readline().decode().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.run.terminate()
        self.run.communicate()
