"""A terminal to test with: a program behind a pseudo-terminal, and what its
screen shows. It knows the ANSI codes that `--live` uses and no others: one that
is not known fails the test."""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time

PATIENCE = 60  # [s], for what has to happen
CODE = re.compile(rb"\x1b\[(\??)([0-9;]*)([A-Za-z])")


class Screen:
    """Cells, without colours. Two pages, as terminals have."""

    def __init__(self, columns, rows):
        self.columns, self.rows = columns, rows
        self.cursor, self.wraps, self.other = True, True, False
        self.page = {False: {}, True: {}}
        self.row = self.column = 0
        self.saved = 0, 0
        self.strict = True  # what is beyond the edge is a failure
        self.drawings, self.drawing = 0, []

    def resize(self, columns, rows):
        self.columns, self.rows = columns, rows

    def cells(self):
        return self.page[self.other]

    def code(self, private, numbers, letter):
        if private and numbers == "25":
            self.cursor = letter == "h"
        elif private and numbers == "7":
            self.wraps = letter == "h"
        elif private and numbers == "1049":
            if letter == "h":
                self.saved = self.row, self.column
            else:
                self.row, self.column = self.saved
            self.other = letter == "h"
        elif not private and letter == "H" and numbers == "":
            self.row = self.column = 0
        elif not private and letter == "J":
            for at in [at for at in self.cells()
                       if numbers == "2" or at >= (self.row, self.column)]:
                del self.cells()[at]
            if numbers == "":  # the end of a drawing
                self.drawings += 1
                self.drawing = self.lines()
        elif not private and letter == "K" and numbers == "":
            for at in [at for at in self.cells()
                       if at[0] == self.row and at[1] >= self.column]:
                del self.cells()[at]
        elif not (not private and letter == "m"):
            raise AssertionError(f"unknown code {numbers}{letter}")

    def feed(self, data):
        """Takes bytes; returns those of a code that is not whole yet."""
        at = 0
        while at < len(data):
            if data[at:at + 1] == b"\x1b":
                found = CODE.match(data, at)
                if not found:
                    return data[at:]
                self.code(found[1] == b"?", found[2].decode(),
                          found[3].decode())
                at = found.end()
                continue
            size = 1 if data[at] < 0x80 else 2 if data[at] < 0xe0 else 3
            if at + size > len(data):
                return data[at:]
            self.put(data[at:at + size].decode("utf-8"))
            at += size
        return b""

    def put(self, letter):
        if letter == "\n":
            self.row += 1
        elif letter == "\r":
            self.column = 0
        else:
            inside = self.column < self.columns and self.row < self.rows
            if self.strict and self.other and not inside:
                raise AssertionError(f"'{letter}' beyond the edge, at "
                                     f"{self.row}, {self.column}")
            self.cells()[self.row, self.column] = letter
            self.column += 1

    def lines(self):
        cells = self.cells()
        last = max((row for row, _ in cells), default=-1)
        return ["".join(cells.get((row, column), " ") for column in
                        range(max(self.columns, 1))).rstrip()
                for row in range(last + 1)]


class Terminal:
    """`with Terminal(words, ...) as terminal:` a program and its screen."""

    def __init__(self, words, columns=80, rows=24, stdin=subprocess.DEVNULL,
                 keys=False, **environment):
        """keys: its input is this terminal, which is its own."""
        self.line, self.child_end = pty.openpty()
        self.lines = termios.tcgetattr(self.line)
        self.screen = Screen(columns, rows)
        self.left = self.all = b""
        self.resize(columns, rows)
        settings = {**os.environ, "TERM": "xterm", "LC_ALL": "", "NO_COLOR": "",
                    "LANG": "C.UTF-8", **environment}
        self.child = subprocess.Popen(
            [str(word) for word in words],
            stdin=self.child_end if keys else stdin, stdout=self.child_end,
            stderr=self.child_end, env=settings, start_new_session=True,
            preexec_fn=(lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
            if keys else None)
        os.close(self.child_end)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.child.poll() is None:
            self.child.kill()
        self.child.wait()
        os.close(self.line)

    def resize(self, columns, rows):
        fcntl.ioctl(self.line, termios.TIOCSWINSZ,
                    struct.pack("HHHH", rows, columns, 0, 0))
        self.screen.resize(columns, rows)

    def read(self, seconds=0.1):
        """Returns: whether the program still has its end open."""
        ready, _, _ = select.select([self.line], [], [], seconds)
        if not ready:
            return True
        try:
            data = os.read(self.line, 65536)
        except OSError:
            return False
        self.all += data
        self.left = self.screen.feed(self.left + data)
        return bool(data)

    def until(self, holds, what):
        """Reads until something holds."""
        end = time.monotonic() + PATIENCE
        while not holds():
            if not self.read() and not holds():
                raise AssertionError(f"it ended before {what}: {self.text()}")
            if time.monotonic() > end:
                raise AssertionError(f"not in time: {what}: {self.text()}")

    def end(self):
        """Reads to the end. Returns: the exit code."""
        end = time.monotonic() + PATIENCE
        while self.read():
            if time.monotonic() > end:
                raise AssertionError(f"no end: {self.text()}")
        return self.child.wait(PATIENCE)

    def signal(self, number=signal.SIGINT):
        os.kill(self.child.pid, number)

    def text(self):
        return "\n".join(self.screen.lines()[-200:])

    def drawn(self, more=1):
        """Waits for so many more drawings. Returns: the last whole one."""
        want = self.screen.drawings + more
        self.until(lambda: self.screen.drawings >= want, "drawings")
        return self.screen.drawing

    def is_given_back(self):
        screen = self.screen
        return screen.cursor and screen.wraps and not screen.other
