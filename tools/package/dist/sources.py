#!/usr/bin/python3
"""The tree as one text: what `make dist` makes its files of. As a program it
makes two of them, twofold.h and twofold.c: sources.py FOLDER.

A source or header is written out with the headers that it includes, each of
them once, at the place of its first include; includes of the C library are
kept, each once. Names that are local to a file are unique in all of src/ (check
arrows), so that any choice of files can stand in one."""
import math
import re
import sys
from fractions import Fraction
from itertools import count
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
INCLUDE = re.compile(r'\s*#\s*include\s+([<"])([^>"]+)[>"]')
HEXADECIMAL = re.compile(
    r"\b(0[xX][0-9a-fA-F]+(?:\.[0-9a-fA-F]*)?[pP][+-]?[0-9]+)(f?)\b")
# Bits of the mantissa of float and double.
FLOAT, DOUBLE = 24, 53


def version():
    """TF_VERSION, the one place of the version."""
    umbrella = (ROOT / "include/twofold.h").read_text()
    return re.search(r'#define TF_VERSION "([^"]+)"', umbrella)[1]


def preface(purpose):
    """The comment that a generated file opens with."""
    license_text = (ROOT / "LICENSE").read_text().strip()
    lines = [f"twofold {version()}: {purpose}", "", *license_text.split("\n")]
    return "".join(f"// {line}".rstrip() + "\n" for line in lines) + "\n"


def nearest(number, bits):
    """A fraction, rounded to so many bits."""
    unit = Fraction(2) ** (math.frexp(number)[1] - bits)
    return round(number / unit) * unit


def decimal(found):
    """The shortest decimal that reads back to the bits of a hexadecimal
    constant; what has no suffix may stand in TF_R, and does so in both real
    types."""
    value = float.fromhex(found[1])
    types = (FLOAT,) if found[2] else (FLOAT, DOUBLE)
    for digits in count(1):
        text = f"{value:.{digits}g}"
        if all(nearest(Fraction(text), bits) == nearest(Fraction(value), bits)
               for bits in types):
            return text + (".0" if text.isdigit() else "") + found[2]


def without_hexadecimals(text):
    """A text that C++ before C++17 takes without a warning: it has no
    hexadecimal constants of a floating type."""
    return HEXADECIMAL.sub(decimal, text)


class Text:
    """A growing file, and what it contains already."""

    def __init__(self, without=()):
        self.parts, self.there = [], set(without)

    def add(self, text):
        """A text of its own."""
        self.parts.append(text)

    def add_file(self, path, after=None):
        """A file of the tree with what it includes. after: by the path of a
        file, a text that is to follow it."""
        path = path.resolve()
        if path in self.there:
            return
        self.there.add(path)
        own = []
        for line in path.read_text().split("\n"):
            found = INCLUDE.match(line)
            if not found:
                own.append(line)
                continue
            kind, name = found.groups()
            if kind == "<":
                if name not in self.there:
                    self.there.add(name)
                    own.append(line)
                continue
            self.flush(own)
            self.add_file(self.resolve(path, name), after)
        self.flush(own)
        text = (after or {}).get(path.relative_to(ROOT).as_posix())
        if text:
            self.add(text)

    def flush(self, own):
        """Appends lines; no two of them are empty one after the other."""
        text = re.sub(r"\n{3,}", "\n\n", "\n".join(own)).strip("\n")
        if text:
            self.add(text + "\n\n")
        own.clear()

    @staticmethod
    def resolve(path, name):
        """The file that an include names."""
        for folder in (path.parent, ROOT / "include"):
            if (folder / name).is_file():
                return (folder / name).resolve()
        raise SystemExit(f"{path}: there is no {name}")

    def write(self, to):
        """Writes the file."""
        text = without_hexadecimals("".join(self.parts))
        Path(to).write_text(text.rstrip("\n") + "\n")


# For a compiler of C++: the core is C99, of which gcc and clang know all that
# it uses as extensions of C++, under other warnings.
# And & of comparisons is meant: it has no branch.
COMPILERS = """\
#if defined(__clang__) && __clang_major__ >= 14
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif
#ifdef __cplusplus
#define restrict __restrict
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#ifdef __clang__
#pragma clang diagnostic ignored "-Wc++11-narrowing"
#pragma clang diagnostic ignored "-Wc99-extensions"
#if __cplusplus < 202002L
#pragma clang diagnostic ignored "-Wc++20-designator"
#endif
#else
#pragma GCC diagnostic ignored "-Wnarrowing"
#if __GNUC__ >= 12
#pragma GCC diagnostic ignored "-Wc++20-extensions"
#endif
#endif
#endif

"""


def core_sources():
    """The sources of the core."""
    return sorted((ROOT / "src").glob("*/*.c"))


def sources_of(names):
    """The sources that define what the names stand for, and all that these
    call: the shortest list that links."""
    text = {path: re.sub(r"//.*", "", path.read_text())
            for path in core_sources()}
    home = {}
    for path, body in text.items():
        for name in re.findall(r"^(?!static|typedef)\w[\w ]*[ *](tf_\w+)[(\[]",
                               body, re.M):
            home[name] = path
    found, queue = set(), [home[name] for name in names]
    while queue:
        path = queue.pop()
        if path in found:
            continue
        found.add(path)
        seen = Text()
        seen.add_file(path)
        for name in set(re.findall(r"\btf_\w+", code_of(seen))):
            if name in home:
                queue.append(home[name])
    return sorted(found)


def code_of(text):
    """What a text does: without comments, declarations and macros."""
    body = re.sub(r"//.*", "", "".join(text.parts))
    body = re.sub(r"^#.*", "", body, flags=re.M)
    return re.sub(r"^\w[\w ]*[ *]tf_\w+(\([^;{]*\)|\[\w+\]);", "", body,
                  flags=re.M)


def two_files(folder):
    header = Text()
    header.add(preface("all public headers in one"))
    header.add_file(ROOT / "include/twofold.h")
    header.write(folder / "twofold.h")
    # What twofold.h has is not in twofold.c again.
    source = Text(without=header.there)
    source.add(preface("the core in one file, C99"))
    source.add(COMPILERS)
    source.add_file(ROOT / "src/num/rounding.h")
    source.add('#include "twofold.h"\n\n')
    for path in core_sources():
        source.add_file(path)
    source.write(folder / "twofold.c")


if __name__ == "__main__":
    two_files(Path(sys.argv[1]))
