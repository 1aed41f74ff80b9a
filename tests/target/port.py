"""What is wrong with a board's port, by name: variables of board.mk that are
empty, functions of port.h that are not written, memory that is not as C wants
it, arithmetic with other bits than this computer's, a tick or a clock at a
wrong rate, waiting that misses a tick, bytes that are lost either way, an exit
code that does not arrive. kit.c runs on the board and sends what is judged."""
from __future__ import annotations

import re
import statistics
import subprocess
from pathlib import Path
from typing import Iterator

from board import Board, LIMIT, Ran
from tap import ROOT

PORT = re.findall(r"^[a-z].*\b(port_\w+)\(",
                  (ROOT / "port/port.h").read_text(encoding="ascii"), re.M)
CODE, LINES, TICKS = 7, 48, 16
HEARD = bytes(range(ord("A"), ord("A") + 32))
FLOOD = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
REMEDY = ("; where that is libgcc's addition of doubles for Arm, add"
          " port/arch/double_add.c to BOARD_SOURCES and -Wl,--wrap="
          "__aeabi_dadd,--wrap=__aeabi_dsub,--wrap=__aeabi_drsub to BOARD_LINK")
WHOLE = [f"flood {i:04} {FLOOD}" for i in range(LINES)]


def kit(board: Board, path: Path, options: list[str]) -> Ran:
    """Runs the kit, which gets bytes when it says that it listens."""
    said = []
    with subprocess.Popen(
            ["timeout", "-k", "5", str(LIMIT),
             *board.command(path, *options)], cwd=ROOT, stdin=subprocess.PIPE,
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
    return Ran(None if code in (124, 137) else code, "\n".join(said), "")


def unbuilt(board: Board, said: str) -> str:
    """What keeps it from being built."""
    written = "\n".join(file.read_text("utf-8") for file in sorted(
        (ROOT / "port" / board.name).glob("*.c")))
    unwritten = re.findall(r'^#error ".*"\n.*\b(port_\w+)\(', written, re.M)
    missing = [name for name in PORT
               if re.search(rf"(?:reference to|symbol:?) .?{name}\b", said)]
    return (f"functions of port.h: {', '.join(missing)}: not there" if missing
            else f"functions of port.h: {', '.join(unwritten)}: not written"
            if unwritten else f"build: {said.strip()}")


def arithmetic(ran: Ran, host: Ran) -> Iterator[str]:
    """By operation. A line that is not whole says something of the line."""
    line = re.compile(r"^bits (\w+) ([0-9A-F]{16})$", re.M)
    here = dict(line.findall(host.out))
    wrong = [name for name, bits in line.findall(ran.out)
             if here.get(name) not in (None, bits)]
    if wrong:
        yield (f"arithmetic: other bits than this computer's in: "
               f"{', '.join(wrong)}{REMEDY if 'borrow' in wrong else ''}")


def time(ran: Ran, rate: int, shared: bool) -> str:
    """What is wrong with the tick and the clock."""
    if not ran.line("started 1"):
        return f"port_tick_start: refuses {rate} Hz"
    said = ran.pairs("time")
    if not said:
        return "port_ticks: no tick comes"
    if said["back"]:
        return f"port_clock: goes back, {said['back']} times in {TICKS} ticks"
    got = statistics.median(map(int, re.findall(r"^tick (\d+)$", ran.out,
                                                re.M)))
    want = said["rate"] / rate
    # Where the emulator has the time of this computer, ticks are late by what
    # else that does: a busy one doubles them, a wrong unit is a factor of 1000.
    early, late = (0.5, 7) if shared else (0.01, 0.01)
    factor = max(got, want) / max(min(got, want), 1e-9)
    return (f"rate: a tick of {rate} Hz lasts {got:.1f} units of port_clock,"
            f" and by port_clock_rate it would be {want:.1f}: one of the three"
            f" is wrong by a factor of {factor:.3g}"
            if not -early * want - 2 <= got - want <= late * want + 2 else "")


def idle(ran: Ran) -> str:
    """What is wrong with waiting."""
    missed = ran.pairs("idle").get("missed")
    return ("port_idle: does not come back" if missed is None else
            "port_idle: waits although the tick has come, "
            f"{missed} times of {TICKS}" if missed > 2 else "")


def serial_line(board: Board, ran: Ran) -> Iterator[str]:
    """Bytes in both directions."""
    heard = ran.pairs("heard")
    if not heard:
        yield "port_get: does not come back"
    elif not board.fact("DEAF") and (heard["count"] != len(HEARD) or
                                     heard["wrong"]):
        yield (f"port_get: {heard['count']} of {len(HEARD)} bytes that came"
               f" while the program was busy are kept, {heard['wrong']} of"
               " them wrong")
    got = [line for line in ran.out.splitlines() if line.startswith("flood")]
    if got != WHOLE:
        yield (f"port_put: of {LINES} lines {len(set(WHOLE) & set(got))} arrive"
               f" whole, {sum(map(len, WHOLE)) - sum(map(len, got))} bytes are"
               " lost")


def wrong(board: Board, real: str, *words: str) -> Iterator[str]:
    """All of it, one text each; made with these variables."""
    empty = [f"BOARD_{name}" for name in
             ("CC", "REALS", "RUN", "STEPS", "RATES_float")
             if not board.fact(name)]
    if empty:
        yield f"board.mk: {', '.join(empty)}: empty"
        return
    rates = (board.fact(f"RATES_{real}") or board.fact("RATES_float")).split()
    rate, _, shift = min(rates, key=lambda one: int(
        one.split(":")[0])).partition(":")
    path, said = board.make(real, f"kit-{rate}", f"RATE={rate}",
                            *words, scene=board.fact("SCENE"))
    if said:
        yield unbuilt(board, said)
        return
    ran = kit(board, path, ["-icount", f"shift={shift}"] if shift else [])
    ended = "it does not end" if ran.code is None else \
        f"it ends with code {ran.code}"
    memory = ran.pairs("memory")
    if not memory:
        yield f"port_init: nothing is sent; {ended}"
        return
    if not memory.get("initialised") or not memory.get("cleared"):
        yield ("memory: variables do not begin with their values: data is not"
               " copied or bss not cleared")
    host = Board("host")
    yield from arithmetic(ran, kit(host, host.elf(
        real, "kit-1000", "RATE=1000"), []))
    late = time(ran, int(rate), bool(board.fact("SHARED"))) or idle(ran)
    yield from [late] if late else serial_line(board, ran)
    if ran.code != CODE:
        yield (f"port_halt: {ended}, not with {CODE}; it was in "
               f"{ran.line('part ')[5:]}")
