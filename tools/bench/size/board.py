"""What a firmware with text telemetry needs on a board.

Make builds it and tells what the board's board.mk says of tools and emulator.
What cannot be had (no emulator, no call graph by that compiler) is None.
"""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple, Optional

MAKE = os.environ.get("MAKE", "make").split()
BUILD = os.environ.get("BUILD", "build")
# A function that takes an interrupt, and what a Cortex-M with FPU saves.
HANDLER = re.compile(r"cortex_m_systick|cortex_m_interrupt|riscv_trap")
SAVED = 108


COMMAND = [*MAKE, "-s", "--no-print-directory", f"BUILD={BUILD}"]
# What a make that started this says to its own parts is not for another one.
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("MAKEFLAGS", "MAKELEVEL")}


def plugin() -> Path:
    """The part of the emulator that counts."""
    path = Path(BUILD, "count.so")
    path.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["cc", "-std=c99", "-O2", "-fPIC", "-shared",
                    "tools/bench/size/count.c", "-o", str(path)], check=True)
    return path


def make(*arguments: str, quiet: bool = True) -> bool:
    """Runs make; its output goes to standard error, or nowhere."""
    out = subprocess.DEVNULL if quiet else sys.stderr
    return subprocess.run([*COMMAND, *arguments], stdout=out, stderr=out,
                          env=ENVIRONMENT, check=False).returncode == 0


def told(*arguments: str) -> str:
    """What make prints."""
    return subprocess.run([*COMMAND, *arguments], stdout=subprocess.PIPE,
                          env=ENVIRONMENT, text=True,
                          check=True).stdout.strip()


def boards() -> list[str]:
    """The names of all boards."""
    return told("boards-list").split()


class Stack(NamedTuple):
    """Bytes: worst of main without interrupts, what one takes, and painted."""
    worst: Optional[int]
    interrupt: Optional[int]
    painted: Optional[int]


class Sizes(NamedTuple):
    """Bytes of code and constants, and of static data."""
    flash: Optional[int]
    ram: Optional[int]


class Board:
    """A board, as its board.mk describes it."""

    def __init__(self, name: str) -> None:
        self.name = name

    def fact(self, what: str) -> str:
        """What its board.mk says."""
        return told(f"BOARD={self.name}", f"board-{what}")

    def tool(self, name: str) -> str:
        """A program of its tool chain."""
        return self.fact("TOOLS") + name

    def emulated(self) -> bool:
        """Whether an emulator runs its programs."""
        return "qemu" in self.fact("RUN")

    def missing(self) -> str:
        """The compiler, where it is missing, and where to get it."""
        compiler = self.fact("CC")
        if shutil.which(compiler):
            return ""
        return (f"{compiler} is missing (Debian: apt-get install "
                f"{self.fact('PACKAGES')})")


class Firmware:
    """A board's firmware of one scene in one real type."""

    def __init__(self, board: Board, real: str, scene: str) -> None:
        self.board, self.real, self.scene = board, real, scene
        self.place = Path(BUILD, "boards", board.name,
                          f"{Path(scene).name}-{real}")

    def _make(self, target: str, *more: str, quiet: bool = True) -> bool:
        return make(f"BOARD={self.board.name}", target, f"SCENE={self.scene}",
                    f"REAL={self.real}", *more, quiet=quiet)

    def _emulate(self, elf: Path, seconds: int, *options: str) -> str:
        """What a program prints in the emulator, until it is stopped."""
        command = [*self.board.fact("RUN").split(), *options,
                   *self.board.fact("LOADS").split(), str(elf)]
        done = subprocess.run(["timeout", "-k", "5", str(seconds), *command],
                              stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, errors="replace",
                              stderr=subprocess.DEVNULL, check=False)
        return done.stdout

    def sizes(self) -> Optional[Sizes]:
        """Flash and RAM; None where it does not build."""
        if not self._make("elf"):
            return None
        said = subprocess.run(
            [self.board.tool("size"), str(self.place / "firmware.elf")],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            check=False).stdout.splitlines()
        if len(said) < 2:
            return Sizes(None, None)
        text, data, bss = (int(word) for word in said[1].split()[:3])
        return Sizes(text + data, data + bss)

    def claimed(self) -> tuple[Optional[int], Optional[int]]:
        """Worst of main and of an interrupt, by the call graph."""
        place = self.place / "stack"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        self._make("call-graph", f"GRAPH={place}")
        graphs = sorted(str(path) for path in place.rglob("*.ci"))
        if not graphs:
            return None, None
        said = subprocess.run(["tools/bench/callgraph.py", *graphs],
                              stdout=subprocess.PIPE, text=True,
                              check=False).stdout
        worst = {line.split()[0]: int(line.split()[1])
                 for line in said.splitlines()}
        handlers = [most for name, most in worst.items()
                    if HANDLER.fullmatch(name)]
        return worst.get("main"), max(handlers, default=0) + SAVED

    def painted(self, steps: int) -> Optional[int]:
        """How deep the stack got in the emulator (tests/target/stack.c)."""
        if not self.board.emulated():
            return None
        rate, options = 1000, ["-icount", "shift=1,sleep=off"]
        if "qemu-system-avr" in self.board.fact("RUN"):
            # Its time is that of this machine.
            rate, steps, options = 100, 200, []
        if not self._make("elf", "PROGRAM=stack", f"RATE={rate}",
                          f"STEPS={steps}", "EVERY=10", quiet=False):
            return None
        said = self._emulate(self.place / "stack.elf", 60, *options)
        found = re.findall(r"^stack (\d+)", said, re.MULTILINE)
        return int(found[-1]) if found else None

    def stack(self, steps: int) -> Stack:
        """All three figures."""
        return Stack(*self.claimed(), self.painted(steps))

    def instructions(self, plugin: Path, steps: int, scheme: str = "moreau",
                     *more: str, quiet: bool = True) -> Optional[list[int]]:
        """Least, median and most of a step, inputs included. quiet: nothing is
        told of how it builds, not even where it does not."""
        if not self.board.emulated() or not self._make(
                "elf", "PROGRAM=window", f"STEPS={steps}",
                f"SCHEME={scheme}", *more, quiet=quiet):
            return None
        elf, counted = self.place / "window.elf", Path(BUILD, "counted")
        counted.unlink(missing_ok=True)
        symbols = subprocess.run([self.board.tool("nm"), str(elf)],
                                 stdout=subprocess.PIPE, text=True,
                                 check=True).stdout
        at = {line.split()[-1]: line.split()[0]
              for line in symbols.splitlines()}
        marks = f"open=0x{at['window_open']},close=0x{at['window_close']}"
        self._emulate(elf, 300, "-plugin", f"{plugin},{marks},out={counted}")
        if not counted.exists() or not counted.stat().st_size:
            return None
        return [int(word) for word in
                counted.read_text(encoding="ascii").split()[1:4]]
