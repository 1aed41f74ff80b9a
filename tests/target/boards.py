"""Runs every board, or those named, in its emulator and checks what its serial
line sends: tools/run boards [BOARD...]. Tests of a board whose port is wrong
(port.py) are left out; where a board has no room for `chaos` its own scene is
taken. A board whose compiler or emulator is missing is skipped by name, or
fails where the file REQUIRED lists it (.ci/required).

What two boards compile to the same code (BOARD_TWIN) is tested on one of them.
With FEW=yes a board runs one loop, and generic firmware in one real type.
Environment: MAKE BUILD JOBS SCENES FEW SECONDS_OF_LOOP.
"""
from __future__ import annotations

import filecmp
import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Callable, Iterator

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / place)
                for place in ("support", "target")]
import driven  # noqa: E402  (the paths come first)
import port  # noqa: E402
from board import BUILD, LIMIT, Board, make, run, scratch  # noqa: E402
from tap import ROOT, Tally, check, lacks, same  # noqa: E402

SHOWN = os.environ.get("SCENES") or \
    "chaos gamma_zero gamma_right coulomb frictionless smooth rolling string " \
    "driven"
SECONDS = int(os.environ.get("SECONDS_OF_LOOP") or "3")
FEW = bool(os.environ.get("FEW"))
NAMES: list[str] = []  # of the boards under test
READ_BACK = ROOT / BUILD / "boards/read-back"
PAIR = re.compile(r"[a-z]+:-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?")


# What a board should send.

def golden(start: str, real: str, table: str = "golden") -> str:
    """A hash of the library: of the row that begins so."""
    found = re.search(
        rf"^{{{re.escape(start)},\s+0x([0-9A-F]+)u, 0x([0-9A-F]+)u}}",
        (ROOT / f"tests/golden/{table}.inc").read_text("ascii"), re.M)
    return found[1 if real == "double" else 2] if found else ""


def trajectory_hash(scene: str, real: str, steps: str) -> str:
    """The golden hash after 1e5 steps, or that of the host port."""
    if steps == "100000":
        return golden(f'"{scene}", TF_RULE_PERSIST, MOREAU', real)
    elf = Board("host").elf(real, f"trajectory-{steps}", f"STEPS={steps}",
                            scene=scene)
    return run(elf).line("trajectory ").rpartition(" ")[2]


def judge_loop(text: str, rate: int, shared: bool) -> str:
    """Every line consists of label:value pairs; the last heartbeat counts all
    ticks, and no overruns, skipped ticks or dropped records, of which 50 go out
    in a second, or as many as there are steps. On a computer with other work
    (shared) those are printed and not judged: its steps end after its ticks.
    Returns: the last heartbeat."""
    lines = [line for line in map(str.strip, text.splitlines())
             if line and not line.startswith("EXIT")]
    strange = [line for line in lines
               if not all(map(PAIR.fullmatch, line.split()))]
    same(strange, [])
    beats = [n for n, line in enumerate(lines) if line.startswith("steps:")]
    check(beats, "no heartbeat")
    last = lines[beats[-1]]
    count = {name: float(value) for name, value in
             (pair.split(":") for pair in last.split())}
    records = [n for n, line in enumerate(lines) if line.startswith("r:")]
    check(count["steps"] <= rate * SECONDS <= count["steps"] + count["skipped"],
          f"not {rate * SECONDS} steps: {last}")
    same(count["sent"], len(beats) + sum(n < beats[-1] for n in records))
    if not shared:
        same(len(records), SECONDS * min(rate, 50) + 1)
        same(len(beats), SECONDS + 1)
        same([count[name] for name in ("overruns", "skipped", "dropped")],
             [0, 0, 0])
    check(count["min"] <= count["mean"] <= count["max"], f"times: {last}")
    return last


# The tests of a board; what one returns is printed.

def test_port(board: Board, real: str) -> None:
    """Each function of port.h, alone."""
    board.need()
    found = [*port.wrong(board, real)]
    check(not found, "\n".join(found))


def test_wrong_sum(board: Board, real: str) -> None:
    """Without an addition of its own the kit names the one of libgcc."""
    found = [*port.wrong(board, real, f"ADD_{real}=", f"WRAP_{real}=")]
    same(found, ["arithmetic: other bits than this computer's in: borrow"
                 f"{port.REMEDY}"])


def hashed(board: Board, real: str, name: str, wants: list[str], *words: str,
           scene: str = "chaos") -> None:
    """The program that sends lines with hashes and ends."""
    ran = board.run(board.elf(real, f"trajectory-{name}", *words, scene=scene))
    same(([line for line in ran.out.splitlines() if line in wants or
           re.match("trajectory |population ", line)], ran.code), (wants, 0))


def trajectory(board: Board, real: str, scene: str) -> str:
    """What it sends of a scene."""
    steps = board.fact("STEPS")
    return (f"trajectory {scene} {real} {steps} "
            f"{trajectory_hash(scene, real, steps)}")


def test_trajectory(board: Board, real: str, scene: str) -> None:
    """A scene, compiled alone."""
    hashed(board, real, scene, [trajectory(board, real, scene)],
           f"STEPS={board.fact('STEPS')}", scene=scene)


def test_scheme(board: Board, real: str, scheme: str) -> None:
    want = golden(f'"chaos", TF_RULE_PERSIST, {scheme.upper()}', real)
    hashed(board, real, scheme, [f"trajectory chaos {real} 100000 {want}"],
           "STEPS=100000", f"SCHEME={scheme}")


def test_split(board: Board, real: str) -> None:
    """Without the split: the bits of the host port, and not the golden ones."""
    words = ["STEPS=100000", "SPLIT=no"]
    host = Board("host").elf(real, f"trajectory-as-{board.name}", *words)
    want = run(host).line("trajectory ")
    check(want and want != trajectory(Board("host"), real, "chaos"), want)
    hashed(board, real, "unsplit", [want], *words)


def test_generic(board: Board, real: str, scheme: str, key: str,
                 *scenes: str, words: tuple[str, ...] = ()) -> None:
    """Scenes one after the other, the first of them by START, and steps of
    random machines, in one program that has all scenes."""
    steps = golden(f'"{key}"', real, "population")
    others = sum(1 << int(run(f"{BUILD}/{real}/constants", "--number",
                              scene).out) for scene in scenes[1:])
    start = [f"START={scenes[0]}", f"OTHERS={others}"] if scenes else []
    hashed(board, real, scheme + "-only" * bool(words), [
        *(trajectory(board, real, scene) for scene in scenes),
        f"population {real} {steps}"], f"STEPS={board.fact('STEPS')}",
        f"SCHEME={scheme}", *start, *words, scene="generic")


def test_double_only(board: Board, *words: str) -> None:
    """With another compiler or precision of float, which is then refused."""
    for tool in re.findall("BOARD_CC=(.+)", "\n".join(words)):
        if not shutil.which(tool):
            lacks(tool, f"{tool} (Debian: apt-get install {tool})")
    test_generic(board, "double", "moreau", "step on a board",
                 *["chaos"] * (not FEW), words=words)
    why = board.make("float", "trajectory-only", *words, scene="generic")[1]
    check('#error "float needs' in why, why)


def test_loop(board: Board, real: str, rate: int, shift: str) -> str:
    """Firmware takes all steps, without overruns or lost records."""
    ran = board.counted(board.elf(
        real, f"firmware-{rate}", f"RATE={rate}", f"STEPS={rate * SECONDS}",
        f"EVERY={(rate + 49) // 50}", scene=board.fact("SCENE")), shift)
    same(ran.code, 0)
    return judge_loop(ran.out, rate, bool(board.fact("SHARED")))


def test_module(board: Board, real: str) -> str:
    """The simulator as a module, row by row as `twofold run`."""
    elf = board.elf(real, "module", scene="generic")
    rows = scratch() / "run.csv"
    # Code 5: some steps stall in float, and the module has their rows as well.
    check(run(f"{BUILD}/{real}/twofold", "run", "chaos", "--t-end", 2,
              "--scheme", "moreau", "--out", rows).code in (0, 5), "run")
    with open(rows, "rb") as given:
        ran = run(*board.fact("CHECK_MODULE").split(), elf, "chaos", real,
                  stdin=given)
    same(ran.code, 0)
    return ran.out.splitlines()[-1]


def test_frames(board: Board, real: str, shift: str) -> None:
    """Every step as frames at 1 kHz, read by `twofold monitor`: the rows are
    those of `twofold run`, byte for byte."""
    work, twofold = scratch(), f"{BUILD}/{real}/twofold"
    elf = board.elf(real, "firmware-frames", "RATE=1000", "STEPS=2000",
                    "EVERY=1", "FORMAT=frames", "SCHEME=moreau",
                    f"BAUD={board.fact('BAUDS').rpartition(' ')[2]}")
    with open(work / "frames", "wb") as sent:
        subprocess.run(board.command(elf, "-icount",
                                     f"shift={shift},sleep=off"),
                       stdin=subprocess.DEVNULL, stdout=sent, check=False,
                       timeout=LIMIT)
    same(run(twofold, "run", "chaos", "--t-end", 2, "--dt", "1e-3", "--out",
             work / "run.csv").code, 0)
    same(run(twofold, "monitor", work / "frames", "--format", "csv", "--out",
             work / "monitor.csv").code, 0)
    check(filecmp.cmp(work / "run.csv", work / "monitor.csv", shallow=False),
          "other rows")


def test_closed_loop(board: Board, real: str) -> str:
    """A controller on this computer. With a setpoint a tick none is lost. Late
    and in lockstep, one after the other with one firmware: the bits of a run
    here alone. Those in lockstep are kept to be compared with other boards."""
    env = {**os.environ, "REAL": real, "BUILD": BUILD}
    ran = run("tools/run", "hil", board.name, 300,
              env={**env, "WITH": "loop", "RATE": "100", "EVERY": "1"})
    said = ran.out
    check(ran.code == 0 and "300 sent; 0 lost, " in said, f"loop: {ran}")
    for how in (["--delay", "20"], ["--lockstep"]):
        ran = run("tools/run", "hil", board.name, "--steps", 1000, "--csv",
                  READ_BACK / f"{real}-{board.name}", *how, env=env)
        check(ran.code == 0, f"{how}: {ran.code}: {ran.out}{ran.errors}")
        said += ran.out
    return said.strip()


def test_stack(board: Board, real: str) -> str:
    """The painted stack is not deeper than the call graph says."""
    ran = run("tools/run", "bench", "stack", board.name, real, "chaos",
              env={**os.environ, "BUILD": BUILD})
    words = ran.out.split()
    check(len(words) == 3, ran.errors)
    if "-" not in words:
        worst, interrupt, painted = map(int, words)
        check(worst // 4 <= painted <= worst + interrupt, ran.out)
    return f"worst, of an interrupt, painted: {ran.out.strip()}"


def test_overrun(board: Board, rate: str, shift: str) -> None:
    """A step that is too late ends the loop, or is counted."""
    for policy, pattern in (("skip", "0 .*overruns:[1-9].*skipped:[1-9]"),
                            ("stop", "2 ")):
        ran = board.counted(board.elf(
            "float", f"firmware-{policy}", f"RATE={rate}", "STEPS=500",
            "EVERY=50", f"OVERRUN={policy}"), shift)
        beat = ran.line("steps")
        check(re.match(pattern, f"{ran.code} {beat}"), f"{policy}: {ran}")


def test_dead_man(board: Board, rate: str, shift: str) -> str:
    """Inputs hold for half a second of the clock, not for so many steps."""
    ran = board.counted(board.elf(
        "float", "deadman", f"RATE={rate}", "FORMAT=frames", "UPLINK=yes"),
        shift)
    said = ran.line("deadman ")
    ticks, held, safe, steps = map(int, said.split()[1::2])
    check(ran.code == 0 and 3 * steps < 2 * held
          and held < ticks == (int(rate) + 1) // 2 <= safe, said)
    return said


FAULTS = {"stack": "stack overflow at", "hang": "watchdog, or another NMI at",
          "bus": r"(bus|hard|trap) at (?!0{8})"}


def test_fault(board: Board, kind: str) -> str:
    """What breaks in a step ends the program: safe, with its reason."""
    ran = board.counted(board.elf(
        "float", f"fault-{kind}", "RATE=100", f"FAULT={kind}",
        *["WATCHDOG=100"] * (kind == "hang"), scene=board.fact("SCENE")), "")
    # AVR has one digit of the code.
    code = int(ran.line("EXIT ")[5:] or ran.code or 0)
    check(code in (99, 9) and re.search(
        rf"^safe\s+fault: {FAULTS[kind]}", ran.out, re.M), str(ran))
    return ran.line("fault")


def test_watchdog(board: Board, emulator: str) -> None:
    """Another emulator than the board's has one: what hangs says so and is
    started again."""
    if not shutil.which("simavr"):
        lacks(board.name, "simavr")
    path = board.elf("float", "fault-dog", "RATE=100", "FAULT=hang",
                     "WATCHDOG=100", scene=board.fact("SCENE"))
    said = run("sh", "-c", "\"$@\" 2>&1 | grep -am 2 'fault: watchdog at'",
               "sh", *emulator.split(), path).out
    check(said.count("\n") == 2, said)


def test_starts(board: Board, real: str) -> str:
    """With a key no session comes twice, and a recorded stop acts once; where
    the emulator lacks what the board needs for that, it does not start."""
    make(f"{BUILD}/tests/key")
    elf = board.elf(real, "firmware-starts", f"KEY={BUILD}/tests/key",
                    "FORMAT=frames", "UPLINK=yes")
    if not board.fact("STARTS"):
        same(board.run(elf)[:2], (1, ""))
        return f"none without its {board.fact('BOOT')}"
    ran = run("tests/line/starts.py", *board.command(elf))
    check(ran.code == 0, ran.out + ran.errors)
    return ran.out.splitlines()[-1]


def test_too_large(board: Board, larger: str) -> None:
    """What has no room is refused in one line, which names a board that has."""
    why = board.make(os.environ.get("REAL") or "float", "firmware")[1]
    check(re.search(rf"^{board.name}: .*SCENE=chaos is .*too large.*; "
                    rf"BOARD={larger} has", why, re.M), why)


def tests_of_real(board: Board, real: str) -> Iterator[tuple[Callable, list]]:
    """What is tested of each real type, but for the code of a twin."""
    schemes = board.fact("SCHEMES").split()
    one = [*schemes, *board.fact("REALS").split()[::-1]][0]
    if board.fact("TWIN") not in NAMES:
        for scene in board.scene(SHOWN):
            yield test_trajectory, [scene]
        if not board.fact("SMALL") and (real == one or not FEW):
            yield test_generic, ["moreau", "step on a board", *(
                ["string"] * bool(schemes) if FEW else ["string", "chaos"])]
    for rate in board.fact(f"RATES_{real}").split()[-1 if FEW else 0:]:
        hertz, _, shift = rate.partition(":")
        yield test_loop, [int(hertz), shift]
    if real in schemes[:1 if FEW else None]:
        yield test_scheme, ["located"]
        yield test_scheme, ["compensated"]
        yield test_split, []
        yield test_generic, ["located", "locate on a board"]
    for what, test in (("LOOP", test_closed_loop),
                       ("CHECK_MODULE", test_module), ("PAINT", test_stack)):
        if board.fact(what):
            yield test, []
    if "--wrap" in make(f"BOARD={board.name}", f"REAL={real}",
                        "board-LINK").stdout:
        yield test_wrong_sum, []
    if board.fact("FRAMES"):
        yield test_frames, [board.fact("FRAMES")]


def tests_of(board: Board) -> Iterator[tuple[Callable, list]]:
    """All that the board can do."""
    reals = board.fact("REALS").split()
    for real in reals:
        for test, words in tests_of_real(board, real):
            yield test, [real, *words]
    if board.fact("DOUBLE_ONLY"):
        yield test_double_only, board.fact("DOUBLE_ONLY").split()
    if board.fact("BOOT"):
        yield test_starts, [reals[0]]
    for kind in board.fact("FAULTS").split():
        yield test_fault, [kind]
    if board.fact("WATCHED"):
        yield test_watchdog, [board.fact("WATCHED")]
    if board.fact("LARGER"):
        yield test_too_large, [board.fact("LARGER")]
    if board.fact("LATE"):
        yield test_overrun, board.fact("LATE").split(":")
        yield test_dead_man, board.fact("LATE").split(":")


def named(board: Board, test: Callable, words: list) -> tuple[str, Callable]:
    name = test.__name__.removeprefix("test_").replace("_", " ")
    return (" ".join(map(str, [board.name, name, *words])),
            functools.partial(test, board, *words))


def compare_loops(real: str) -> None:
    """What is read in lockstep depends on no clock: all boards of a real type
    send the same bits."""
    first, *others = sorted(READ_BACK.glob(f"{real}-*")) or [None]
    for other in others:
        check(filecmp.cmp(first, other, shallow=False),
              f"{first} and {other} differ")


def main() -> None:
    # Builds that boards share are made before they start.
    shutil.rmtree(READ_BACK, ignore_errors=True)
    READ_BACK.mkdir(parents=True)
    done = make(*(f"{BUILD}/{real}/{program}" for real in ("double", "float")
                  for program in ("twofold", "hil", "constants")))
    if done.returncode:
        sys.exit(done.stdout)
    NAMES.extend(sys.argv[1:] or make("boards-list").stdout.split())
    boards = [Board(name) for name in NAMES]
    # Emulators in their own time and loops in that of this computer wait: twice
    # as many keep the processors busy.
    tally, jobs = Tally(), 2 * driven.processors()
    ports = [(board, named(board, test_port, [real])) for board in boards
             for real in board.fact("REALS").split() or ["float"]]
    words = tally.run([test for _, test in ports], jobs)
    bad = {board.name for (board, _), word in zip(ports, words)
           if word != "ok"}
    tally.run([named(board, *test) for board in boards
               if board.name not in bad for test in tests_of(board)], jobs)
    tally.run([(f"{real} loops in lockstep",
                functools.partial(compare_loops, real))
               for real in ("double", "float")
               if len([*READ_BACK.glob(f"{real}-*")]) > 1])
    sys.exit(tally.end())
