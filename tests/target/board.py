"""A board under test: what make says of it, its programs, and what these send
in its emulator. Environment: MAKE BUILD LIMIT REQUIRED."""
from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from tap import ROOT, check, lacks

MAKE = [*(os.environ.get("MAKE") or "make").split(), "-s",
        "--no-print-directory"]
BUILD = os.environ.get("BUILD") or "build"
LIMIT = 600  # s, which end what hangs


class Ran(NamedTuple):
    """What became of a program: its exit code, None where it did not end; its
    output without carriage returns; its errors."""
    code: int | None
    out: str
    errors: str

    def line(self, word: str) -> str:
        """The last line that begins with a word."""
        return ([line for line in self.out.splitlines()
                 if line.startswith(word)] or [""])[-1]

    def pairs(self, word: str) -> dict[str, int]:
        """The name:number pairs of the line that begins with a word."""
        return {name: int(value) for name, value in re.findall(
            r"(\w+):(\d+)", self.line(f"{word} "))}


def make(*arguments: object) -> subprocess.CompletedProcess:
    return subprocess.run([*MAKE, f"BUILD={BUILD}", *map(str, arguments)],
                          cwd=ROOT, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)


@functools.lru_cache(maxsize=None)
def fact(board: str, what: str) -> str:
    """A variable of a board's board.mk; ends the program where make refuses
    the board."""
    done = make(f"BOARD={board}", f"board-{what}")
    if done.returncode:
        sys.exit(f"board {board}: {done.stdout.strip()}")
    return done.stdout.strip()


def run(*command: object, **options: object) -> Ran:
    """A program on this computer."""
    options.setdefault("stdin", subprocess.DEVNULL)
    done = subprocess.run(
        ["timeout", "-k", "5", str(LIMIT), *map(str, command)], check=False,
        cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
    code = None if done.returncode in (124, 137) else done.returncode
    return Ran(code, done.stdout.decode("ascii", "replace").replace("\r", ""),
               done.stderr.decode("ascii", "replace"))


class Board:
    """One board, in whichever real type."""

    def __init__(self, name: str) -> None:
        self.name = name

    def fact(self, what: str) -> str:
        return fact(self.name, what)

    def need(self) -> None:
        """Skips a test where a tool of the board is missing, or fails it where
        the board is required."""
        for tool in [*self.fact("CC").split(), *self.fact("RUN").split()[:1]]:
            if not shutil.which(ROOT / tool if "/" in tool else tool):
                lacks(self.name, f"{tool} (Debian: apt-get install "
                                 f"{self.fact('PACKAGES')})")
        # Where the emulator is more than a program: a command that says what
        # is not there.
        here = self.fact("HERE").split()
        if here and (ran := run(*here)).code:
            lacks(self.name, ran.out + ran.errors)

    def make(self, real: str, program: str, *arguments: object,
             scene: str = "chaos") -> tuple[Path, str]:
        """Builds PROGRAM-NAME.elf: its path, and what make says where it fails.
        One at a time, for tests run side by side and all share the host's."""
        name, _, named = program.partition("-")
        os.makedirs(ROOT / BUILD / "boards", exist_ok=True)
        done = subprocess.run(
            ["flock", f"{BUILD}/boards/{self.name}.lock", *MAKE,
             f"BUILD={BUILD}", f"BOARD={self.name}", "elf", f"SCENE={scene}",
             f"REAL={real}", f"PROGRAM={name}",
             *([f"NAMED=-{named}"] if named else []), *map(str, arguments)],
            cwd=ROOT, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, check=False)
        return (ROOT / Path(BUILD, "boards", self.name, f"{scene}-{real}",
                     f"{program}.elf"),
                (done.stdout or "make fails") if done.returncode else "")

    def elf(self, *words: object, **options: str) -> Path:
        """The same, of what has to be built."""
        path, why = self.make(*words, **options)
        check(not why, why)
        return path

    def command(self, path: Path, *options: str) -> list[str]:
        return [*self.fact("RUN").split(), *options,
                *self.fact("LOADS").split(), str(path)]

    def run(self, path: Path, *options: str) -> Ran:
        """Runs a program in the emulator."""
        return run(*self.command(path, *options))

    def counted(self, path: Path, shift: str) -> Ran:
        """In the emulator's own time, 2^shift ns an instruction, which other
        work on this computer does not disturb."""
        return self.run(path, *(["-icount", f"shift={shift},sleep=off"]
                                if shift else []))

    def scene(self, scenes: str) -> list[str]:
        """Those of some scenes that it has room for, or its own."""
        room = self.fact("SCENES").split()
        return [scene for scene in scenes.split()
                if not room or scene in room] or [self.fact("SCENE")]


def scratch() -> Path:
    """A new folder, which goes with all that drive makes."""
    return Path(tempfile.mkdtemp(prefix="twofold-board."))
