#!/usr/bin/python3 -B
"""What is wrong with a board's port, by name: kit.py BOARD REAL.

Builds tests/target/kit.c for the board, runs it in its emulator, and judges
what it says: variables of board.mk that are empty, functions of port.h that are
not written, memory that is not as C wants it, arithmetic with other bits than
this computer's, a tick or a clock at a wrong rate, waiting that misses a tick,
bytes that are lost either way, an exit code that does not arrive. Prints
"ok WHAT" or "FAILED WHAT: WHY" for each. Environment: MAKE BUILD.
"""
from __future__ import annotations

import os
import re
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Optional

ROOT = Path(__file__).resolve().parents[2]
MAKE = os.environ.get("MAKE", "make").split()
BUILD = os.environ.get("BUILD", "build")
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("MAKEFLAGS", "MAKELEVEL")}
PORT = re.findall(r"^[a-z].*\b(port_\w+)\(",
                  (ROOT / "port/port.h").read_text(encoding="ascii"), re.M)
CODE = 7
HEARD = bytes(range(ord("A"), ord("A") + 32))
FLOOD = ("ABCDEFGHIJKLMNOPQRSTUVWXYZ"
         "abcdefghijklmnopqrstuvwxyz")
LINES = 48
TICKS = 16
TIMEOUT = 60
failures = 0


def verdict(what: str, why: Optional[str]) -> bool:
    """Prints it; `why` is what is wrong."""
    global failures
    failures += why is not None
    print(f"ok {what}" if why is None else f"FAILED {what}: {why}",
          flush=True)
    return why is None


def make(board: str, *arguments: str) -> subprocess.CompletedProcess:
    """Of a board one at a time: boards are tested side by side, and share the
    host's."""
    os.makedirs(ROOT / BUILD / "boards", exist_ok=True)
    return subprocess.run(
        ["flock", f"{BUILD}/boards/{board}.lock", *MAKE, "-s",
         "--no-print-directory", f"BUILD={BUILD}",
         f"BOARD={board}", *arguments], cwd=ROOT, env=ENVIRONMENT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


class Board:
    """A board in one real type."""

    def __init__(self, name: str, real: str) -> None:
        self.name, self.real = name, real

    def fact(self, what: str) -> str:
        return make(self.name, f"board-{what}").stdout.strip()

    def rate(self) -> tuple[int, list[str]]:
        """Of the slowest loop that the board is tested with, and how the
        emulator is set to count time by instructions."""
        rates = self.fact(f"RATES_{self.real}") or self.fact("RATES_float")
        rate, _, shift = min(rates.split(), key=lambda one:
                             int(one.split(":")[0])).partition(":")
        return int(rate), ["-icount", f"shift={shift}"] if shift else []

    def build(self, rate: int) -> tuple[Path, str]:
        """The program, and what is said where it cannot be made."""
        done = make(self.name, "elf", f"REAL={self.real}", "PROGRAM=kit",
                    f"RATE={rate}", f"NAMED=-{rate}")
        scene = self.fact("SCENE")
        path = Path(ROOT, BUILD, "boards", self.name, f"{scene}-{self.real}",
                    f"kit-{rate}.elf")
        return path, "" if done.returncode == 0 else done.stdout

    def run(self, program: Path,
            *options: str) -> tuple[list[str], Optional[int]]:
        """What it sends, line by line, and its exit code; None: it did not
        end. It gets the bytes when it asks for them."""
        said: list[str] = []
        with subprocess.Popen(
                ["timeout", "-k", "5", str(TIMEOUT),
                 *self.fact("RUN").split(), *options,
                 *self.fact("LOADS").split(), str(program)],
                cwd=ROOT, stdin=subprocess.PIPE,
                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
            for line in process.stdout:
                said.append(line.decode("ascii", "replace").strip())
                if said[-1] == "part port_get":
                    try:
                        process.stdin.write(HEARD)
                        process.stdin.flush()
                    except BrokenPipeError:
                        pass
            code = process.wait()
        return said, None if code in (124, 137) else code


def judge_makefile(board: Board) -> bool:
    """Whether board.mk says what make has to know."""
    said = make(board.name, "board-CC")
    if said.returncode:
        first = said.stdout.strip().splitlines()[0]
        return verdict("board.mk", re.sub(r".*\*\*\* |\.  Stop\.$", "", first))
    empty = [f"BOARD_{name}" for name in
             ("CC", "REALS", "RUN", "STEPS", "RATES_float")
             if not board.fact(name)]
    return verdict("board.mk", f"{', '.join(empty)}: empty" if empty else
                   None)


def judge_build(board: Board, said: str) -> bool:
    """What keeps it from being built."""
    unwritten = [name for file in sorted((ROOT / "port" / board.name).glob(
        "*.c")) for name in re.findall(r'^#error ".*"\n.*\b(port_\w+)\(',
                                       file.read_text(encoding="utf-8"), re.M)]
    missing = [name for name in PORT
               if re.search(rf"(?:reference to|symbol:?) .?{name}\b", said)]
    if missing:
        return verdict("functions of port.h",
                       f"{', '.join(missing)}: not there")
    if said and unwritten:
        return verdict("functions of port.h",
                       f"{', '.join(unwritten)}: not written")
    return verdict("build", said.strip() if said else None)


def pairs(said: list[str], word: str) -> Optional[dict[str, int]]:
    """The numbers of the line that begins with a word."""
    for line in said:
        if line.startswith(word + " "):
            return {name: int(value) for name, value in
                    re.findall(r"(\w+):(\d+)", line)}
    return None


def judge_arithmetic(said: list[str], host: list[str]) -> None:
    """By operation. A line that is not whole says something of the line."""
    line = re.compile(r"bits (\w+) ([0-9A-F]{16})")
    here = dict(found.groups() for found in map(line.fullmatch, host) if found)
    wrong = [found[1] for found in map(line.fullmatch, said)
             if found and here.get(found[1]) not in (None, found[2])]
    verdict("arithmetic", "other bits than this computer's in: " +
            ", ".join(wrong) if wrong else None)


def judge_time(said: list[str], rate: int, shared: bool) -> bool:
    """The tick and the clock."""
    if "started 1" not in said:
        return verdict("port_tick_start", f"refuses {rate} Hz")
    time = pairs(said, "time")
    if time is None:
        return verdict("port_ticks", "no tick comes")
    if not verdict("port_clock", f"goes back, {time['back']} times in"
                   f" {TICKS} ticks" if time["back"] else None):
        return False
    got = statistics.median(int(line[5:]) for line in said
                            if re.fullmatch(r"tick \d+", line))
    want = time["rate"] / rate
    # Where the emulator has the time of this computer its other work is in it.
    allowed = (0.5 if shared else 0.01) * want + 2
    factor = max(got, want) / max(min(got, want), 1e-9)
    return verdict("rate", f"a tick of {rate} Hz lasts {got:.1f} units of"
                   f" port_clock, and by port_clock_rate it would be"
                   f" {want:.1f}: one of the three is wrong by a factor of"
                   f" {factor:.3g}" if abs(got - want) > allowed else None)


def judge_idle(said: list[str]) -> bool:
    idle = pairs(said, "idle")
    if idle is None:
        return verdict("port_idle", "does not come back")
    return verdict("port_idle", f"waits although the tick has come,"
                   f" {idle['missed']} times of {TICKS}" if idle["missed"] > 2
                   else None)


def judge_line(board: Board, said: list[str]) -> None:
    """Bytes in both directions."""
    heard = pairs(said, "heard")
    if heard is None:
        verdict("port_get", "does not come back")
    elif not board.fact("DEAF"):
        verdict("port_get", f"{heard['count']} of {len(HEARD)} bytes that came"
                f" while the program was busy are kept, {heard['wrong']} of"
                " them wrong" if heard["count"] != len(HEARD) or heard["wrong"]
                else None)
    want = [f"flood {i:04} {FLOOD}" for i in range(LINES)]
    got = [line for line in said if line.startswith("flood")]
    bytes_lost = sum(map(len, want)) - sum(map(len, got))
    whole = len(set(want) & set(got))
    verdict("port_put", f"of {LINES} lines {whole} arrive whole,"
            f" {bytes_lost} bytes are lost" if got != want else None)


def judge(board: Board) -> None:
    if not judge_makefile(board):
        return
    rate, options = board.rate()
    program, said = board.build(rate)
    if not judge_build(board, said):
        return
    host = Board("host", board.real)
    lines, code = board.run(program, *options)
    if not any(line.startswith("memory") for line in lines):
        verdict("port_init", "nothing is sent" + (
            f"; it ends with code {code}" if code is not None else
            ", and it does not end"))
        return
    memory = pairs(lines, "memory")
    verdict("memory", None if memory.get("initialised") and
            memory.get("cleared") else "variables do not begin with their"
            " values: data is not copied or bss not cleared")
    compiled, trouble = host.build(1000)
    if trouble:
        sys.exit(f"kit.py: the host port does not build: {trouble}")
    judge_arithmetic(lines, host.run(compiled)[0])
    if judge_time(lines, rate, bool(board.fact("SHARED"))) and \
            judge_idle(lines):
        judge_line(board, lines)
    last = [line for line in lines if line.startswith("part ")][-1][5:]
    verdict("port_halt", None if code == CODE else
            f"code {code} where {CODE} was given" if code is not None else
            f"does not end; it was in {last}")


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit("usage: kit.py BOARD REAL")
    judge(Board(*sys.argv[1:]))
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
