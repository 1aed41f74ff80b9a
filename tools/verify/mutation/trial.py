"""A change, tried: which test notices it. Whatever a change does, it cannot do
much: tests only read files, and their time, memory and output have limits."""
from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import Optional

import plain
from plain import PLACE, PLAIN, REALS, Change, Test

PATIENCE = os.environ.get("PATIENCE")
SLOW = {f"test_{name}" for name in (
    "extremes", "ensemble", "friction", "reference", "branch", "frame",
    "physics_numbers")}
# Bytes of output, bytes of memory.
LIMITS = ("--fsize=102400000", "--as=4096000000")
lock = threading.Lock()
took: dict[str, int] = {}  # milliseconds of the processor, without a change
saw: dict[str, list[str]] = {}  # the tests that noticed a change of a file


def limited(program: Path, seconds: int, out: Path, *arguments: str,
            **more: str) -> tuple[int, int]:
    """Runs a test within its limits; its exit code (137 where it was killed)
    and the milliseconds of the processor."""
    with open(out, "wb") as said:
        # pylint: disable=consider-using-with
        child = subprocess.Popen(
            ["prlimit", *LIMITS, f"--cpu={seconds}", "timeout", "-k", "1",
             "3600", str(program), *arguments], stdin=subprocess.DEVNULL,
            stdout=said, stderr=subprocess.DEVNULL, env={**os.environ, **more})
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, int(1000 * usage.ru_utime)


class Trial:
    """One change of a file."""

    def __init__(self, change: Change, tests: list[Test], work: Path) -> None:
        self.change, self.tests, self.work = change, tests, work
        self.changed = {file.stem for file in plain.core()
                        if change.file in plain.made_of(file)}
        self.same = False

    def compile(self, real: str) -> bool:
        """Makes what the changed file is a part of, and links."""
        objects, place = [], self.work / real
        place.mkdir()
        for file in plain.core():
            target = PLAIN / real / f"{file.stem}.o"
            if file.stem in self.changed:
                target = place / f"{file.stem}.o"
                if not plain.compiled(real, file, self.work, target):
                    return False
            objects.append(target)
        return plain.linked(place / "libtwofold.so", "-shared", *objects)

    def is_part_of(self, test: Test) -> bool:
        """Whether a test has the changed file in it, a header."""
        return self.change.file in plain.made_of(test.source)

    def concerns(self, test: Test) -> bool:
        return self.is_part_of(test) or \
            not self.same and bool(test.needs & self.changed)

    def program(self, test: Test) -> Optional[Path]:
        """A test that has the changed file in it is made again."""
        if not self.is_part_of(test):
            return PLAIN / test.name
        target = self.work / "test"
        done = plain.compiled(test.real, test.source, self.work,
                              self.work / "test.o") and plain.linked(
            target, self.work / "test.o",
            plain.BASE / test.real / "libsupport.a",
            f"-L{self.work}/{test.real}", "-ltwofold", "-lm")
        return target if done else None

    def asked(self, program: Path, core: Path, seconds: int) -> tuple[int, int]:
        return limited(program, seconds, self.work / "tap", TAP_BAIL="1",
                       LD_LIBRARY_PATH=str(core))

    def is_trusted(self, test: Test) -> bool:
        """Whether a test that failed passes without a change."""
        if test.name in took:
            return True
        code, time = self.asked(PLAIN / test.name, PLAIN / test.real,
                                int(PATIENCE or 200))
        if code == 0:
            took[test.name] = time
        elif not PATIENCE or code != 137:
            sys.exit(f"mutation: {test.name} fails without a change")
        return code == 0

    def order(self, test: Test) -> float:
        """Who noticed a change of this file before is asked first, then who is
        quick, or, where that is not known yet, who needs few parts; those that
        are known to be slow come last."""
        remembered = saw.get(self.change.file, [])
        if test.name in remembered:
            return remembered.index(test.name) - 1e6
        return took.get(test.name, (
            1e5 if test.source.stem in SLOW else 20) * (1 + len(test.needs)))

    def noticed(self, real: str) -> str:
        """The test of a real type that notices the change, or none."""
        for test in sorted((test for test in self.tests if test.real == real),
                           key=self.order):
            if not self.concerns(test):
                continue
            program = self.program(test)
            if program is None:
                return test.name
            # Many times what it took; what is enough, where that is not known.
            limit = took[test.name] // 100 + 5 if test.name in took else int(
                PATIENCE or (200 if test.source.stem in SLOW else 20))
            code, time = self.asked(program, self.work / real, limit)
            if code == 0:
                took.setdefault(test.name, time)
            elif self.is_trusted(test):
                with lock:
                    first = saw.get(self.change.file, [])
                    saw[self.change.file] = [test.name] + [
                        name for name in first if name != test.name][:20]
                return test.name
        return ""

    def verdict(self) -> str:
        same_in_both = True
        for real in REALS:
            if not self.compile(real):
                return "invalid -"
            self.same = (self.work / real / "libtwofold.so").read_bytes() == (
                PLAIN / real / "libtwofold.so").read_bytes()
            same_in_both &= self.same
            name = self.noticed(real)
            if name:
                return f"noticed {name}"
        return "same -" if same_in_both else "survived -"


def tried(change: Change, tests: list[Test]) -> None:
    """Writes to the log what became of a change:
    noticed TEST | survived - | same - | invalid -  FILE NUMBER LINE COLUMN TEXT
    """
    with tempfile.TemporaryDirectory(dir=PLACE, prefix="work.") as name:
        work = Path(name)
        plain.link_tree(work)
        (work / change.file).unlink()
        (work / change.file).write_bytes(change.make())
        line = f"{Trial(change, tests, work).verdict()} {change}"
    log = PLACE / "log"
    with lock:
        with open(log, "a", encoding="utf-8") as file:
            print(line, file=file)
        count = len(log.read_text("utf-8").splitlines())
    if line.startswith("survived") or count % 25 == 0:
        print(f"{count}: {line}", file=sys.stderr)
