"""Runs a board's firmware in its emulator with a controller on this computer at
the other end of the serial line, and compares with a pure host run:

    tools/run hil BOARD [OPTION...]     options of the program `hil`

The emulator's line is a pseudo-terminal at the board's highest rate. A real
board is driven by BUILD/REAL/hil itself: see docs/PORTS.md. Environment: MAKE
BUILD REAL SCENE RATE EVERY; WITH=loop runs that instead. Exit code: its own."""
import os
import re
import subprocess
import sys

BUILD = os.environ.get("BUILD") or "build"


def given(name, usual):
    return os.environ.get(name) or usual


def make(*words, **options):
    """Ends all where it fails."""
    done = subprocess.run(
        [*given("MAKE", "make").split(), "-s", "--no-print-directory",
         f"BUILD={BUILD}", *words], check=False, text=True, **options)
    if done.returncode:
        sys.exit(3)
    return done.stdout


def line_of(board):
    """The words that start the emulator with a line; none: there is none."""
    def fact(name):
        return make(f"BOARD={board}", f"board-{name}",
                    stdout=subprocess.PIPE).split()
    run = " ".join(fact("RUN"))
    words = run.replace("-serial stdio", "-serial pty").split() \
        if "-serial stdio" in run else fact("LINE")
    return [] if fact("SMALL") else words, fact("LOADS"), fact("BAUDS")[-1:]


def device_of(emulator, board):
    """The pseudo-terminal, whose name the emulator prints."""
    said = ""
    for said_now in emulator.stdout:
        said += said_now
        if found := re.search("/dev/[a-z]*/[0-9]+", said):
            return found[0]
    sys.exit(f"hil: the emulator of {board} did not start:\n{said}")


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: tools/run hil BOARD [OPTION...]")
    board, *options = sys.argv[1:]
    real, scene = given("REAL", "float"), given("SCENE", "chaos")
    every, program = given("EVERY", "10"), given("WITH", "hil")
    line, loads, baud = line_of(board)
    if not line:
        print(f"hil: {board} has no room for commands, or no serial line",
              file=sys.stderr)
        sys.exit(3)
    make(f"BOARD={board}", "elf", f"SCENE={scene}", f"REAL={real}",
         f"RATE={given('RATE', '1000')}", f"EVERY={every}",
         f"BAUD={''.join(baud)}", "FORMAT=frames", "UPLINK=yes",
         f"NAMED=-{program}", stdout=sys.stderr)
    make(f"{BUILD}/{real}/{program}", stdout=sys.stderr)
    elf = f"{BUILD}/boards/{board}/{scene}-{real}/firmware-{program}.elf"
    with subprocess.Popen([*line, *loads, elf], text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT) as emulator:
        try:
            sys.exit(subprocess.call([
                f"{BUILD}/{real}/{program}", device_of(emulator, board),
                *["--every", every] * (program == "hil"), *options]))
        finally:
            emulator.kill()
