"""The code of a program as blocks, from assembly of x86-64 (gcc -S -g1)."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Iterable, NamedTuple, Optional

Label = tuple[int, str]  # of which file, and its name there


class Instruction(NamedTuple):
    """Where it stands: its line of the assembly; line and column of the source
    that .loc says of it, (0, 0) where it says none."""
    at: int
    of: tuple[int, int]


class Block:
    """Instructions that are run one after the other.

    A conditional jump is the last of its block.
    """

    def __init__(self, file: int) -> None:
        self.file = file
        self.code: list[Instruction] = []
        self.calls: list[Label] = []
        self.jumps: list[Label] = []
        self.falls_to: Optional[Block] = None
        self.why_unknown = ""  # where it goes to is not known

    def is_conditional(self) -> bool:
        """Whether it ends in a conditional jump."""
        return bool(self.jumps and self.falls_to)


class Code:
    """The blocks of all files, by their labels."""

    LABEL = re.compile(r"([A-Za-z_.][\w.$]*):")
    INSTRUCTION = re.compile(r"[ \t]+([a-z]\S*)(?:.*\s)?(\S*)$")
    LOCATION = re.compile(r"[ \t]+\.loc \d+ (\d+) (\d+)")
    ENTRY = re.compile(r"[ \t]+\.long\t(\.L\w+)-(\.L\w+)$")
    ADDRESS = re.compile(r"[ \t]+lea\w?\t(\.L\w+)\(%rip\)")

    def __init__(self, paths: Iterable[Path]) -> None:
        self.blocks: dict[Label, Block] = {}
        self.functions: dict[Label, Block] = {}
        self.files: list[Path] = []
        self.public: dict[str, Label] = {}
        for path in paths:
            self.files.append(path)
            _File(self, path.read_text(encoding="utf-8").splitlines())

    def place(self, target: Label) -> tuple[Optional[Block], Optional[Label]]:
        """What a name means in its file: a block, or a function."""
        if target in self.functions:
            return None, target
        if target in self.blocks:
            return self.blocks[target], None
        return None, self.public.get(target[1], target)


class _File:
    """Reads one file."""

    def __init__(self, code: Code, lines: list[str]) -> None:
        self.code, self.file = code, len(code.files) - 1
        self.of = 0, 0
        self.named: list[str] = []  # what the function takes addresses of
        self.by_table: list[tuple[Block, list[str]]] = []
        tables: dict[str, list[Label]] = {}
        here = None
        for at, line in enumerate(lines, start=1):
            if label := Code.LABEL.match(line):
                here = self._label(label[1], here)
            elif line.split()[:1] == [".globl"]:
                code.public[line.split()[1]] = self.file, line.split()[1]
            elif location := Code.LOCATION.match(line):
                self.of = int(location[1]), int(location[2])
            elif entry := Code.ENTRY.match(line):
                tables.setdefault(entry[2], []).append((self.file, entry[1]))
            elif instruction := Code.INSTRUCTION.match(line):
                if address := Code.ADDRESS.match(line):
                    self.named.append(address[1])
                here = self._take(here or Block(self.file), at,
                                  *instruction.groups())
        for block, named in self.by_table:
            # Any of the function's tables: there is rarely more than one.
            block.jumps = [target for name in set(named)
                           for target in tables.get(name, [])]
            if not block.jumps:
                block.why_unknown = "a jump through a pointer"

    def _label(self, name: str, before: Optional[Block]) -> Block:
        """The block that a label opens."""
        inside = re.match(r"\.L|.*\.cold$", name)
        here = self._open(before if inside else None)
        self.code.blocks[self.file, name] = here
        if not inside:
            self.code.functions[self.file, name] = here
            self.named = []
        return here

    def _open(self, before: Optional[Block]) -> Block:
        """A new block, to which the one before falls through."""
        block = Block(self.file)
        if before:
            before.falls_to = block
        return block

    def _take(self, here: Block, at: int, name: str,
              operand: str) -> Optional[Block]:
        """Adds an instruction. Returns: the block that goes on, if one does."""
        here.code.append(Instruction(at, self.of))
        target = self.file, operand.split("@")[0]
        if name == "call":
            if operand.startswith("*"):
                here.why_unknown = "a call through a pointer"
            else:
                here.calls.append(target)
            return here
        if name in ("jmp", "notrack") and operand.startswith("*"):
            self.by_table.append((here, self.named))
            return None
        if name.startswith("j"):
            here.jumps.append(target)
            return None if name == "jmp" else self._open(here)
        return None if name.startswith(("ret", "ud2")) else here
