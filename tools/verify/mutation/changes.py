"""Small wrong changes of C source files.

Changed are comparisons, arithmetic and logical operators, signs, literals,
truth values and strings, where the layout of clang-format shows which operator
is binary (blanks around it), unary or a pointer. Comments, characters,
directives, case labels, assertions and sizes of arrays are left.
"""
from __future__ import annotations

import re
from pathlib import Path
from typing import Iterable, Iterator, NamedTuple

# Operators that stand between blanks, and what each may become.
BINARY = {
    "<=": "< >", ">=": "> <", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "|=": "&=", "&=": "|=",
    "<<": ">>", ">>": "<<", "<": "<= >=", ">": ">= <=", "+": "-", "-": "+",
    "*": "/", "/": "*", "|": "&", "&": "|", "^": "|", "%": "*"}
OPPOSITE = {"true": "false", "false": "true"}
# Lines in which nothing is changed: directives but the value of a macro (whose
# name is not its value), labels, and what only declares.
LEFT = re.compile(r" *(?:#(?!define )|case |_Static_assert).*")
MACRO = re.compile(r"#define \w+")
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|'(?:\\.|[^\\'])*'", re.S)
STRING = re.compile(r'"(?:\\.|[^\\"])*"', re.S)
NUMBER = re.compile(r"0x(?:[\w.]|(?<=[pP])[-+])*|\d(?:[\w.]|(?<=[eE])[-+])*",
                    re.A)
WORD = re.compile(r"\w+", re.A)
# The size of an array that is declared here: the name before it follows a type.
ARRAY = re.compile(r"\[\d[^]\n]*[]\n]?")
DECLARED = re.compile(r"(?<!\breturn)(?<=\w) \w+\Z", re.A)
OPERATOR = re.compile("|".join(map(re.escape, BINARY)))
SIGN = re.compile(r"[-!~](?=[\w(])", re.A)


def next_literal(number: str) -> str:
    """A whole literal becomes the next one, another twice as large, 0.0 1."""
    is_hex = number.startswith("0x")
    if not re.search("[.pP]" if is_hex else "[.eE]", number):
        digits = re.match(r"0x[\da-fA-F]+|\d+", number)[0]
        base = 16 if is_hex else 8 if re.match("0[0-7]", digits) else 10
        return f"{int(digits, base) + 1}{number[len(digits):]}"
    digits = re.match(r"0x[\da-fA-F.]+[pP][-+]?\d+|[\d.]+(?:[eE][-+]?\d+)?",
                      number)[0]
    value = float.fromhex(digits) if is_hex else float(digits)
    text = f"{2 * value if value > 0 else 1:.17g}"
    return text + ("" if re.search("[.e]", text) else ".0") + \
        number[len(digits):]


def operators_at(source: str, at: int) -> tuple[int, list[tuple[str, str]]]:
    """What begins here and may be an operator: its length, and (old, new)."""
    before = source[at - 1] if at else ""
    found = OPERATOR.match(source, at)
    if found and before in (" ", "\n") and \
            source[found.end():found.end() + 1] in (" ", "\n"):
        return len(found[0]), [(found[0], new)
                               for new in BINARY[found[0]].split()]
    changes = []
    if before and before in " \n([-!" and SIGN.match(source, at):
        changes.append((source[at], ""))
    two = source[at:at + 2]
    if two in ("++", "--"):
        changes.append((two, "--" if two == "++" else "++"))
    return 2 if two in ("++", "--", "->") else 1, changes


def changes_in(source: str) -> Iterator[tuple[int, str, str]]:
    """Where each change is, what it replaces, and by what."""
    at, fresh = 0, True
    while at < len(source):
        if fresh:
            for pattern in (LEFT, MACRO):
                left = pattern.match(source, at)
                at = left.end() if left else at
        here = source[at:at + 1]
        fresh = here == "\n"
        comment, string, number, word, array = (
            pattern.match(source, at) for pattern in
            (COMMENT, STRING, NUMBER, WORD, ARRAY))
        if comment:
            at = comment.end()
        elif string:
            if len(string[0]) > 2:
                yield at, string[0], '""'
            at = string.end()
        elif number:
            yield at, number[0], next_literal(number[0])
            at = number.end()
        elif word:
            if word[0] in OPPOSITE:
                yield at, word[0], OPPOSITE[word[0]]
            at = word.end()
        elif array and DECLARED.search(source, max(0, at - 80), at):
            at = array.end()
        else:
            length, changes = operators_at(source, at)
            yield from ((at, old, new) for old, new in changes)
            at += length


def mixed(number: int, text: str) -> int:
    """FNV-1a, and a last mixing for its high bits."""
    for byte in text.encode():
        number = (number ^ byte) * 0x100000001b3 % 2**64
    number = (number ^ number >> 32) * 0x9e3779b97f4a7c15 % 2**64
    return number ^ number >> 29


class Change(NamedTuple):
    """A change of a file; `text` is its line with the change in braces, as in
    `if (a {< -> <=} b)`."""
    order: int
    file: str
    number: int  # of those of the file
    line: int
    column: int
    text: str

    def __str__(self) -> str:
        return " ".join(map(str, self[1:]))

    def excuse(self) -> str:
        return f"{self.file}: {self.text}"

    def make(self) -> str:
        """The file with the change."""
        source = Path(self.file).read_text("utf-8")
        at, old, new = list(changes_in(source))[self.number - 1]
        return source[:at] + new + source[at + len(old):]


def all_changes(seed: int, files: Iterable[Path]) -> list[Change]:
    """In the order of a seed."""
    found = []
    for file in files:
        source = file.read_text("utf-8")
        start = mixed(0xcbf29ce484222325 ^ seed, str(file))
        for number, (at, old, new) in enumerate(changes_in(source), 1):
            begin = source.rfind("\n", 0, at) + 1
            end = re.compile("$", re.M).search(source, at + len(old)).start()
            text = (f"{source[begin:at].lstrip(' ')}{{{old} -> {new}}}"
                    f"{source[at + len(old):end]}")
            found.append(Change(mixed(start, text), str(file), number,
                                source.count("\n", 0, begin) + 1,
                                at - begin + 1, text))
    return sorted(found)
