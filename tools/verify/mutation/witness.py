"""For each test of a program a change of one of its files (its headers, the
parts of the core that it needs, tests/support, port/) that the test fails
for."""
from __future__ import annotations

import os
import re
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Iterator

import plain
from plain import BASE, PLACE, PLAIN, Change, Test
from trial import limited, lock


def cases(test: Test) -> list[str]:
    """The names of the tests in a program."""
    return re.findall(r"^TEST\((\w+)\)", test.source.read_text("utf-8"), re.M)


def sources(test: Test) -> list[Path]:
    """What is linked: the test's, parts of the core, tests/support."""
    support = [Path(name).with_suffix(".c")
               for name in sorted(plain.made_of(test.source))
               if re.match(r"tests/support/.*\.h$", name)]
    return [test.source,
            *(file for file in plain.core() if file.stem in test.needs),
            *(file for file in support if file.exists())]


def in_turns(changes: list[Change], tries: int) -> Iterator[Change]:
    """The first change of each file, the second of each, and so on."""
    count: Counter[str] = Counter()
    ranked = []
    for change in changes:
        count[change.file] += 1
        ranked.append((count[change.file], change))
    ranked.sort(key=lambda pair: pair[0])
    return (change for _, change in ranked[:tries])


class Search:
    """One program."""

    def __init__(self, test: Test, waiting: list[str], work: Path) -> None:
        self.test, self.waiting, self.work = test, waiting, work
        self.sources = sources(test)
        plain.link_tree(work)
        (work / "objects").mkdir()

    def program(self, change: Change) -> bool:
        """Whether the program with the change could be made."""
        objects = []
        for source in self.sources:
            if change.file in plain.made_of(source):
                objects.append(self.work / "objects" /
                               f"{source.as_posix().replace('/', '_')}.o")
                if not plain.compiled("double", source, self.work, objects[-1]):
                    return False
        base = BASE / "double"
        if change.file not in plain.made_of(self.test.source):
            objects.insert(0, base / self.test.source.with_suffix(".o"))
        return plain.linked(self.work / "test", *objects,
                            base / "libsupport.a",
                            PLAIN / "double/libparts.a",
                            base / "libtwofold.a", "-lm")

    def fails(self, name: str) -> bool:
        """Whether a test of the changed program says that it fails."""
        out = self.work / "tap"
        limited(self.work / "test", 60, out, "--only", name)
        said = out.read_bytes().decode("utf-8", "replace")
        return re.search(rf"^not ok \d* - {name}$", said, re.M) is not None

    def show(self, change: Change) -> None:
        """Writes "PROGRAM NAME FILE NUMBER LINE COLUMN TEXT" to the witnesses
        for each test that fails."""
        file = self.work / change.file
        file.unlink()
        file.write_bytes(change.make())
        if self.program(change):
            for name in [name for name in self.waiting if self.fails(name)]:
                self.waiting.remove(name)
                with lock, open(PLACE / "witnesses", "a",
                                encoding="utf-8") as found:
                    print(self.test.source.stem, name, change, file=found)
        file.unlink()
        file.symlink_to(os.path.abspath(change.file))


def shown(test: Test, shaken: set[tuple[str, str]], seed: str,
          tries: int) -> None:
    """Looks for witnesses of all tests that have none in `shaken`."""
    waiting = [name for name in cases(test)
               if (test.source.stem, name) not in shaken]
    with tempfile.TemporaryDirectory(dir=PLACE, prefix="witness.") as name:
        search = Search(test, waiting, Path(name))
        files = sorted({file for source in search.sources
                        for file in plain.made_of(source)
                        if file not in (str(test.source), "tests/tap.h")
                        and not file.startswith("tests/golden/")})
        for change in in_turns(plain.changes(seed, files), tries):
            if not search.waiting:
                break
            search.show(change)
    print(f"{test.source.stem}: {len(search.waiting)} left", file=sys.stderr)
