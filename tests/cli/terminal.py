"""A terminal to test with: a program behind a pseudo-terminal, and what its
screen shows. It takes the ANSI codes that `--live` uses; another one fails the
test."""
import codecs
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios

CODE = re.compile(r"\x1b\[(\??[0-9;]*[A-Za-z])|[^\x1b]")
SWITCHES = {"?25": "cursor", "?7": "wraps", "?1049": "other"}


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
        self.left = ""  # what is not drawn yet
        # A signal may end a drawing within a character.
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")

    def cells(self):
        return self.page[self.other]

    def erase(self, is_erased):
        self.page[self.other] = {at: letter for at, letter in
                                 self.cells().items() if not is_erased(at)}

    def code(self, code):
        here = self.row, self.column
        if code[:-1] in SWITCHES and code[-1] in "hl":
            setattr(self, SWITCHES[code[:-1]], code[-1] == "h")
            if code[:-1] == "?1049":
                (self.row, self.column), self.saved = self.saved, here
        elif code == "H":
            self.row = self.column = 0
        elif code == "2J":
            self.erase(lambda at: True)
        elif code == "J":  # the end of a drawing
            self.erase(lambda at: at >= here)
            self.drawings += 1
            self.drawing = self.lines()
        elif code == "K":
            self.erase(lambda at: at[0] == here[0] and at >= here)
        elif code[0] == "?" or code[-1] != "m":
            raise AssertionError(f"unknown code {code}")

    def feed(self, data):
        text = self.left + self.decoder.decode(data)
        at = 0
        for found in CODE.finditer(text):
            if found.start() > at:  # a code that is not whole yet
                break
            if found[1]:
                self.code(found[1])
            else:
                self.put(found[0])
            at = found.end()
        self.left = text[at:]

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
        self.all = b""
        self.is_open = True
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
        self.screen.columns, self.screen.rows = columns, rows

    def read(self, seconds=0.1):
        if select.select([self.line], [], [], seconds)[0]:
            try:
                data = os.read(self.line, 65536)
            except OSError:  # the program has closed its end
                data = b""
            self.is_open = bool(data)
            self.all += data
            self.screen.feed(data)

    def until(self, holds, what):
        """Reads until something holds."""
        while not holds():
            if not self.is_open:
                raise AssertionError(f"it ended before {what}: {self.text()}")
            self.read()

    def end(self):
        """Reads to the end. Returns: the exit code."""
        self.until(lambda: not self.is_open, "its end")
        return self.child.wait()

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
