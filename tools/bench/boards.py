"""What a firmware with text telemetry needs on a board.

Make builds it and tells what the board's board.mk says of tools and emulator.
What cannot be had (no emulator, no call graph by that compiler) is None.
"""
import re
import shutil
import subprocess
import sys
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple, Optional

import numpy as np

import driven
from callgraph import Graph
from measure import BUILD

TESTS = Path(__file__).resolve().parents[2] / "tests"
sys.path += [str(TESTS / "support"), str(TESTS / "target")]
import board as tested  # noqa: E402

# A function that takes an interrupt, and what a Cortex-M with FPU saves.
HANDLER = re.compile(r"cortex_m_systick|cortex_m_interrupt|riscv_trap")
SAVED = 108
GRAPH = "-fcallgraph-info=su"


def plugin() -> Path:
    """The part of the emulator that counts."""
    path = BUILD / "count.so"
    path.parent.mkdir(parents=True, exist_ok=True)
    driven.output("cc", "-std=c99", "-O2", "-fPIC", "-shared",
                  "tools/bench/count.c", "-o", path)
    return path


def boards() -> list[str]:
    """The names of all boards."""
    return tested.make("boards-list").stdout.split()


class Sizes(NamedTuple):
    """Bytes: code and constants, static data, worst stack of main by the call
    graph without interrupts, and what an interrupt takes of it."""
    flash: Optional[int]
    ram: Optional[int]
    stack: Optional[int]
    interrupt: Optional[int]


class Board(tested.Board):
    """A board, as its board.mk describes it."""

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

    @lru_cache(maxsize=None)
    def has_graph(self) -> bool:
        """Whether its compiler writes call graphs (gcc from 10 on)."""
        return subprocess.run(
            [self.fact("CC"), GRAPH, "-E", "-x", "c", "/dev/null"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            check=False).returncode == 0


class Firmware:
    """A board's firmware of one scene in one real type."""

    def __init__(self, board: Board, real: str, scene: str) -> None:
        self.board, self.real, self.scene = board, real, scene
        self.place = BUILD / "boards" / board.name / \
            f"{Path(scene).name}-{real}"

    def __str__(self) -> str:
        return f"{self.board.name} {self.real} {self.scene}"

    def _make(self, program: str, *more: str) -> str:
        """Builds a program of it. Returns what the compiler said against it,
        nothing where all is well."""
        return self.board.make(self.real, program, *more, scene=self.scene)[1]

    def _emulate(self, elf: Path, seconds: int, *options: str) -> str:
        """What a program prints in the emulator, until it is stopped."""
        done = subprocess.run(
            ["timeout", "-k", "5", str(seconds),
             *self.board.command(elf, *options)],
            stdin=subprocess.DEVNULL, text=True, stdout=subprocess.PIPE,
            errors="replace", stderr=subprocess.DEVNULL, check=False)
        return done.stdout

    def sizes(self) -> Sizes | str:
        """Flash, RAM and stack, or why it does not build."""
        if why := self._graphed("firmware-sized"):
            return why
        said = subprocess.run(
            [self.board.tool("size"), str(self.place / "firmware-sized.elf")],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            check=False).stdout.splitlines()
        if len(said) < 2:
            return Sizes(None, None, None, None)
        text, data, bss = (int(word) for word in said[1].split()[:3])
        return Sizes(text + data, data + bss, *self._stack("firmware-sized"))

    def _graphed(self, program: str, *more: str) -> str:
        """Builds a program, with its call graph where that can be had."""
        for old in self.place.glob(f"{program}.elf*"):
            old.unlink()
        # Not EXTRA, by which the host's programs would be compiled anew.
        flags = [f"BOARD_OPT={self.board.fact('OPT')} {GRAPH}"]
        return self._make(program, *flags * self.board.has_graph(), *more)

    def stack(self) -> tuple[Optional[int], Optional[int]]:
        """Worst of main and of an interrupt, in the program of painted()."""
        return self._stack("stack", "firmware_main")

    def _stack(self, program: str, main: str = "main"
               ) -> tuple[Optional[int], Optional[int]]:
        """Worst of main and of an interrupt, by the call graph; a function of
        the C library or of soft float counts 32."""
        if not self.board.has_graph():
            return None, None
        graph = Graph(sorted(self.place.glob(f"{program}.elf*.ci")))
        worst = {name: most for name, most, _ in graph.depths}
        handlers = [most for name, most in worst.items()
                    if HANDLER.fullmatch(name)]
        return worst[main], max(handlers, default=0) + SAVED

    def painted(self, steps: int) -> Optional[int]:
        """How deep the stack got in the emulator (tests/target/stack.c),
        interrupts included."""
        if not self.board.emulated():
            return None
        rate, options = 1000, ["-icount", "shift=1,sleep=off"]
        if "qemu-system-avr" in self.board.fact("RUN"):
            # Its time is that of this machine.
            rate, steps, options = 100, 200, []
        if self._graphed("stack", f"RATE={rate}", f"STEPS={steps}", "EVERY=10"):
            return None
        said = self._emulate(self.place / "stack.elf", 60, *options)
        found = re.findall(r"^stack (\d+)", said, re.MULTILINE)
        return int(found[-1]) if found else None

    def instructions(self, counter: Path, steps: int,
                     scheme: str = "moreau") -> Optional[list[int]]:
        """Least, median and most of a step, inputs included."""
        found = self.windows(counter, steps, scheme)
        if found is None:
            return None
        costs = np.sort(found[0])
        return [int(costs[i]) for i in (0, len(costs) // 2, -1)]

    def windows(self, counter: Path, steps: int, scheme: str
                ) -> Optional[tuple[np.ndarray, list[float]]]:
        """The instructions of each step, inputs included; and r, v and w at the
        end."""
        counted = self.counted(counter, "window", f"STEPS={steps}",
                               f"SCHEME={scheme}")
        if counted is None:
            return None
        of = np.float32 if self.real == "float" else np.float64
        end = [float(np.array([int(word, 16)], "<u8").view(of)[0]) for word in
               re.findall(r"^end (.*)", counted[1], re.MULTILINE)[0].split()]
        return counted[0], end

    def counted(self, counter: Path, program: str, *make: str
                ) -> Optional[tuple[np.ndarray, str]]:
        """The instructions in each window of a program but the first, which is
        empty; and what the program prints."""
        if not self.board.emulated() or self._make(program, *make):
            return None
        elf, out = self.place / f"{program}.elf", BUILD / "counted"
        out.unlink(missing_ok=True)
        at = {line.split()[-1]: line.split()[0] for line in
              driven.output(self.board.tool("nm"), elf).splitlines()}
        marks = f"open=0x{at['window_open']},close=0x{at['window_close']}"
        said = self._emulate(elf, 300, "-plugin",
                             f"{counter},{marks},out={out}")
        windows = np.fromfile(out, np.uint32) if out.exists() else []
        if len(windows) < 2:
            return None
        return windows[1:].astype(np.int64) - windows[0], said
