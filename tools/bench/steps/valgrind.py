"""Counts instructions of a function by callgrind (valgrind), and tells what
kinds they are of (x86-64, objdump)."""
from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path
from typing import NamedTuple


class Failed(Exception):
    """A program that fails under valgrind, or leaves no count."""


class Sample(NamedTuple):
    """One call: what the program printed of it, and its instructions."""
    said: str
    instructions: int


def have() -> bool:
    """Whether valgrind is there."""
    return shutil.which("valgrind") is not None


def _summary(dump: Path) -> int:
    """The sum of a dump."""
    found = re.search(r"^summary: (\d+)", dump.read_text(encoding="utf-8"),
                      re.MULTILINE)
    if not found:
        raise Failed(f"{dump}: callgrind left no summary")
    return int(found[1])


def _callgrind(out: Path, command: list[str], *options: str) -> list[str]:
    """Runs a program. Returns: the lines that it printed."""
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
         *options, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, check=False)
    if done.returncode != 0:
        raise Failed(done.stderr + f"{command[0]} fails under valgrind")
    return done.stdout.splitlines()


def total_and_lines(work: Path, function: str,
                    command: list[str]) -> tuple[int, list[str]]:
    """Instructions of all calls of a function, and what was printed."""
    out = work / "total"
    lines = _callgrind(out, command, f"--toggle-collect={function}")
    return _summary(out), lines


def total(work: Path, function: str, command: list[str]) -> int:
    """Instructions of all calls of a function."""
    return total_and_lines(work, function, command)[0]


def samples(work: Path, function: str, sampler: str,
            command: list[str]) -> list[Sample]:
    """Each call of a function inside `sampler`, one printed line each."""
    place = work / "dumps"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    lines = _callgrind(place / "out", command, f"--toggle-collect={function}",
                       f"--zero-before={sampler}", f"--dump-after={sampler}")
    found = [Sample(line, _summary(place / f"out.{i}"))
             for i, line in enumerate(lines, start=1)]
    shutil.rmtree(place)
    return found


# Where valgrind puts a program that may lie anywhere.
LOADED_AT = 0x108000
KINDS = (
    ("arithmetic", r"(mul|add|sub|div|sqrt|and|andn|or|xor|max|min)[sp][sd]"
                   r"|p(xor|and|or).*"),
    ("comparisons and jumps", r"u?comis[sd]|cmp.*|test.*|set.*|j.*"),
    ("loads, stores and copies", r"v?mov.*|unpck.*|shuf.*|push|pop|pshuf.*"),
)


def _opcodes(program: str) -> dict[int, str]:
    """The instructions of a program, by address."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    found = re.finditer(r"^ +([0-9a-f]+):\s+(\S+)", text, re.MULTILINE)
    return {int(at, 16): name for at, name in (one.groups() for one in found)}


def _counts(dump: Path) -> Counter[int]:
    """How often the instruction at each address was executed. The line behind
    `calls=` has what was called."""
    counts: Counter[int] = Counter()
    at, called = 0, False
    for line in dump.read_text(encoding="utf-8").splitlines():
        if line.startswith("calls="):
            called = True
        fields = re.fullmatch(r"(0x[0-9a-f]+|[+-]\d+|\*) \S+ (\d+)", line)
        if fields:
            place = fields[1]
            at = int(place, 16) if place[0] == "0" else at + (
                0 if place == "*" else int(place))
            counts[at] += 0 if called else int(fields[2])
            called = False
    return counts


def kinds(work: Path, function: str,
          command: list[str]) -> list[tuple[str, int]]:
    """Instructions of all calls of a function, by what they do."""
    out = work / "kinds"
    _callgrind(out, command, f"--toggle-collect={function}", "--dump-instr=yes")
    opcodes = _opcodes(command[0])
    sums: Counter[str] = Counter()
    for at, count in _counts(out).items():
        name = opcodes.get(at) or opcodes.get(at - LOADED_AT) or ""
        kind = [kind for kind, what in KINDS if re.fullmatch(what, name)]
        sums[kind[0] if kind else "others"] += count
    return [(kind, sums[kind]) for kind in [*(one for one, _ in KINDS),
                                            "others"]]
