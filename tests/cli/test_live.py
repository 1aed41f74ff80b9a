#!/usr/bin/python3 -B
"""`--live` of `run` and `monitor` behind a pseudo-terminal: what is drawn fits
the screen, follows its size and shows every mode that was visited; the terminal
is given back whatever ends the program; and where there is no terminal there is
not one escape code."""
import os
import re
import signal
import termios
import threading
from pathlib import Path

from outputs import column, says, table
from tap import TWOFOLD, call, check, main, output
from terminal import Terminal

LONG = [TWOFOLD, "run", "chaos", "--live", "--realtime", "--dt", "1e-3",
        "--t-end", "1000"]
SHORT = [TWOFOLD, "run", "chaos", "--live", "--t-end", "10", "--events", "0"]
LANES = ["slip+", "slip-", "stick+", "stick-", "pinned", "ambiguous"]
MARKS = dict(zip(LANES, "+-PMo?"))


def ended(words, code=0, **options):
    """A terminal in which a command has run to its end."""
    with Terminal(words, **options) as terminal:
        check(terminal.end() == code, f"{words}: code")
        check(terminal.is_given_back(), "the terminal is not given back")
        return terminal


def lanes_of(lines):
    """The lanes of a picture by their names, without these."""
    found = {}
    for line in lines:
        name = line.split(" ")[0]
        if name in LANES and line[:10].strip() == name:
            found.setdefault(name, line[10:])  # the summary has it, too
    return found


def planes_of(lines):
    """The rows of cells of both planes."""
    return [tuple(re.split("[│|]", line)[1:]) for line in lines
            if line[:1] in "│|"]


def test_shows_planes_and_lanes_at_every_size():
    with Terminal(LONG) as terminal:
        for columns, rows in ((80, 24), (133, 50), (40, 15), (300, 100),
                              (50, 20), (30, 8), (80, 24)):
            small = columns < 40 or rows < 15

            def fits(lines, columns=columns, rows=rows, small=small):
                return (len(lines) <= rows and
                        max(map(len, lines), default=999) <= columns and
                        len(planes_of(lines)) == (
                            0 if small else min(rows - 11, 128)) and
                        list(lanes_of(lines)) == ([] if small else LANES) and
                        ("(the planes need" in "".join(lines)) == small)
            terminal.screen.strict = False  # some of the old size may come
            terminal.resize(columns, rows)
            terminal.until(lambda: fits(terminal.screen.drawing), "it fits")
            terminal.screen.strict = True
            lines = terminal.drawn(2)
            check(fits(lines), terminal.text())
            for side in () if small else (0, 1):
                cells = "".join(row[side] for row in planes_of(lines))
                check(re.search("[\u2800-\u28ff]", cells), terminal.text())
                check(cells.count("●") == 1, "where it is now")
        terminal.signal()
        check(terminal.end() == 4, "code of an interrupted run")


def test_lanes_are_the_modes_of_the_rows():
    for words in (["chaos", "--dt", "1e-3"], ["coulomb", "--dt", "1e-3"],
                  ["chaos", "--t-end", "0.003"],
                  ["chaos", "--dt", "1e-3", "--set", "omega=-1", "--set",
                   "h=0"]):
        terminal = ended([TWOFOLD, "run", *words, "--live", "--out", "rows"])
        lanes = lanes_of(terminal.screen.lines())
        shown = {name for name, cells in lanes.items() if cells.strip()}
        text = call("run", *words)[0]
        rows = table(text)
        futures = any(int(choices) > 1 for choices in column(rows, "choices"))
        check(shown == {*column(rows, "mode"), *["ambiguous"] * futures},
              f"{words}: {shown}")
        check("steps      " in terminal.text(), "the summary follows")
        check(Path("rows").read_text() == text, "other rows")


def test_gives_back_before_a_second_signal():
    """The first signal alone puts the terminal in order: where the program
    then hangs, here in a full pipe, a second one kills it."""
    os.mkfifo("fifo")
    reader = os.open("fifo", os.O_RDONLY | os.O_NONBLOCK)
    words = [TWOFOLD, "run", "chaos", "--live", "--dt", "1e-6", "--t-end",
             "1000", "--out", "fifo"]
    with Terminal(words) as terminal:
        terminal.until(lambda: terminal.screen.other, "the page")
        terminal.signal()
        terminal.until(terminal.is_given_back, "the terminal is back")
        terminal.signal()
        code = terminal.end()
        check(code in (-signal.SIGINT, 4), f"code {code}")
        check(terminal.is_given_back(), "not given back")
    os.close(reader)


def test_gives_back():
    """On q and on a signal, and the terminal takes lines again; other keys do
    not leave the picture."""
    for leave in (lambda terminal: os.write(terminal.line, b"q"),
                  *(lambda terminal, number=number: terminal.signal(number)
                    for number in (signal.SIGINT, signal.SIGTERM,
                                   signal.SIGHUP))):
        with Terminal(LONG, keys=True) as terminal:
            terminal.drawn(2)
            check(not terminal.screen.cursor and terminal.screen.other,
                  "it takes the terminal")
            check(termios.tcgetattr(terminal.line) != terminal.lines,
                  "takes no keys")
            os.write(terminal.line, b"xQ\n")
            terminal.drawn(3)
            leave(terminal)
            check(terminal.end() == 4, "code of an interrupted run")
            check(terminal.is_given_back(), "not given back")
            check(termios.tcgetattr(terminal.line) == terminal.lines,
                  "no lines")


def test_rows_at_a_glance():
    """On a terminal the first and the last rows; all of them, if asked."""
    words = ["run", "chaos", "--set", "omega=-1.02", "--set", "h=0"]
    rows = call(*words, "--t-end", "0.2")[0].splitlines()[1:]
    rows = [line.split(",") for line in rows]
    for count in (2001, 8, 1):
        words[6:] = ["--t-end", (count - 1) / 1e4]
        lines = ended([TWOFOLD, *words], columns=120).screen.lines()
        header, *shown = lines[:lines.index("")]
        check(header.split()[-1] == "choices", header)
        check(f"{count} rows" in shown.pop(), "how many there are")
        want = [[f"{float(x):.4g}" for x in row[:6]] + row[8:10]
                + row[10:] * (row[9] > "1") for row in rows[:count]]
        want = want if count < 11 else [*want[:5], ["..."], *want[-5:]]
        check([line.split() for line in shown] == want, "\n".join(shown))
    check("t,r,v,omega" in ended([TWOFOLD, *words, "--out", "-", "--every",
                                  "1"]).text(), "--out - has all digits")


def test_ascii_and_colours():
    for ascii_only, names in (
            (True, {"LANG": "", "NO_COLOR": "1"}),
            (True, {"LANG": "de_DE.ISO-8859-1"}),
            (True, {"LC_ALL": "C", "LANG": "C.UTF-8"}),
            (True, {"LC_CTYPE": "POSIX", "LANG": "C.UTF-8"}),
            (False, {"LANG": "de_DE.utf8", "NO_COLOR": "1"}),
            (False, {"LC_CTYPE": "C.UTF-8", "LANG": ""})):
        terminal = ended(SHORT, **names)
        check(terminal.all.isascii() == ascii_only, f"{names}: ASCII")
        check((b"\x1b[33m" in terminal.all) != ("NO_COLOR" in names),
              f"{names}: colours")
        check("t,r,v" not in terminal.text(), "no rows in the picture")
        lines = terminal.screen.lines()
        if ascii_only:
            for name, cells in lanes_of(lines).items():
                check(set(cells.strip()) <= {MARKS[name], " "}, cells)
            planes = planes_of(lines)
            check("".join(a + b for a, b in planes).count("@") == 2, "now")


def test_quiet_without_a_terminal():
    rows = call("run", "chaos", "--t-end", "1")[0]
    out, told = call("run", "chaos", "--t-end", "1", "--live")
    check(out == rows and "\x1b" not in out + told, "other rows, or a code")
    told = [line for line in told.splitlines() if "--live" in line]
    check(len(told) == 1 and "needs a terminal" in told[0], str(told))
    Path("frames").write_bytes(output(TWOFOLD, "run", "chaos", "--t-end", "1",
                                      "--format", "frames"))
    for source, code in ("-", 4), ("frames", 0):
        out, told = call("monitor", source, "--live", code=code)
        check(not out and "\x1b" not in told and
              told.count("--live needs a terminal") == 1, out + told)
    for term in "dumb", "":
        terminal = ended([*SHORT, "--every", "50000"], TERM=term)
        check(b"\x1b" not in terminal.all, f"TERM={term}")
        check("--live needs a terminal" in terminal.text(), "it says so")


def feed(pipe, data, terminal):
    """Writes into a pipe while the terminal is read: a program that waits for
    its terminal reads no pipe."""
    def write():
        pipe.write(data)
        pipe.flush()
    writing = threading.Thread(target=write)
    writing.start()
    terminal.until(lambda: not writing.is_alive(), "all is taken")


def test_monitor_draws_a_stream():
    frames = output(TWOFOLD, "run", "chaos", "--t-end", "3", "--format",
                    "frames")
    half = len(frames) // 2
    reader, writer = os.pipe()
    with Terminal([TWOFOLD, "monitor", "-", "--live"], 100, 30,
                  stdin=reader) as terminal:
        os.close(reader)
        check("(nothing yet)" in terminal.drawn(), "before the first frame")
        with os.fdopen(writer, "wb") as pipe:
            feed(pipe, frames[:half], terminal)
            terminal.until(lambda: set(lanes_of(terminal.screen.lines())) ==
                           set(LANES), "lanes")
            check("scene chaos;" in terminal.screen.lines()[0], "the sender")
            feed(pipe, frames[half:half + 40] + frames[half + 60:], terminal)
        check(terminal.end() == 6, "a frame was broken")
        check(terminal.is_given_back(), "not given back")
        check("t = 3.0000 s" in terminal.text(), terminal.text())
        check(re.search(r"frames, 1 broken, \d+ lost", terminal.text()),
              terminal.text())
    says(2, "--out FILE", "monitor", "-", "--live", "--format", "csv")


main(globals(), jobs=4)
