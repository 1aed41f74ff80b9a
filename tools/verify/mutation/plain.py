"""What changes of src/ are tried on: the tests, linked with a shared library of
the core, the objects of the core, and the parts of the core that each test
needs. Environment: CC BUILD MAKE.
"""
from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

CC = os.environ.get("CC") or "gcc"
PLACE = Path(os.environ.get("BUILD") or "build", "mutation")
BASE, PLAIN = PLACE / "base", PLACE / "plain"
REALS = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
# They start other programs.
STARTERS = ("test_device", "test_line", "test_hostile")


class Change(NamedTuple):
    """A line of `mutants list`."""
    order: str
    file: str
    number: str
    line: str
    column: str
    text: str

    def __str__(self) -> str:
        return " ".join(self[1:])

    def make(self) -> bytes:
        """The file with the change."""
        return subprocess.run([PLACE / "mutants", "make", self.file,
                               self.number], stdout=subprocess.PIPE,
                              check=True).stdout


class Test(NamedTuple):
    """A test program in one real type."""
    real: str
    source: Path
    needs: frozenset[str]  # stems of files of the core

    @property
    def name(self) -> str:
        return f"{self.real}-{self.source.stem}"


def changes(seed: str, files: list[str]) -> list[Change]:
    """In the order of a seed, which is a hash of what is changed."""
    listed = subprocess.run([PLACE / "mutants", "list", seed, *files],
                            stdout=subprocess.PIPE, text=True, check=True)
    return [Change(*line.split(" ", 5))
            for line in sorted(listed.stdout.splitlines())]


@functools.lru_cache(maxsize=None)
def strict() -> tuple[str, ...]:
    """What more the compiler can do about what goes beyond an array or is read
    before it is written."""
    return tuple(flag for flag in ("-fsanitize=bounds-strict",
                                   "-ftrivial-auto-var-init=pattern")
                 if subprocess.run([CC, flag, "-x", "c", "-c", "-", "-o",
                                    PLACE / "empty.o"], input=b"",
                                   stderr=subprocess.DEVNULL,
                                   check=False).returncode == 0)


def compiled(real: str, file: Path, root: Path, target: Path) -> bool:
    """Compiles a file of the project, or of a changed copy of it in `root`, for
    a shared library. What goes beyond an array ends the program, as the checks
    with sanitizers would report, and what is read before it is written is not
    0, as memcheck would."""
    flags = ["-ffreestanding"] if file.parts[0] == "src" else [
        f"-I{root}/{place}" for place in ("tests", "tests/support", "src")]
    return subprocess.run(
        [CC, "-std=c99", "-O1", "-ffp-contract=off", "-fno-math-errno",
         "-fPIC", "-w", REALS[real], "-fsanitize=bounds",
         "-fsanitize-undefined-trap-on-error", *strict(), *flags,
         f"-I{root}/include", "-c", root / file, "-o", target],
        stderr=subprocess.DEVNULL, check=False).returncode == 0


def linked(target: Path, *parts: object) -> bool:
    return subprocess.run([CC, *map(str, parts), "-o", str(target)],
                          stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def must(done: bool, what: object) -> None:
    if not done:
        sys.exit(f"mutation: {what} does not compile")


@functools.lru_cache(maxsize=None)
def made_of(file: Path) -> frozenset[str]:
    """What an object was made of, by its file of dependencies."""
    text = (BASE / "double" / file).with_suffix(".d").read_text("utf-8")
    words = re.sub(r"\S*:|\\\n", " ", text).split()
    return frozenset(os.path.relpath(os.path.realpath(word)) for word in words
                     if re.match("(src|port|include|tests)/", word))


def link_tree(place: Path) -> None:
    """Folders of the project, with links to its files."""
    for part in ("src", "include", "port", "tests", "tools"):
        shutil.copytree(part, place / part, copy_function=lambda file, link:
                        os.symlink(os.path.abspath(file), link))


def core() -> list[Path]:
    return sorted(Path().glob("src/*/*.c"))


def prepare() -> list[Test]:
    """Builds all of it."""
    sources = sorted(path for path in Path("tests").rglob("test_*.c")
                     if path.stem not in STARTERS)
    print("mutation: building the tests ...", file=sys.stderr)
    log = PLACE / "build.log"
    with open(log, "w", encoding="utf-8") as said:
        if subprocess.run(
                [*(os.environ.get("MAKE") or "make").split(), "-s", f"CC={CC}",
                 f"BUILD={BASE}", "OPT=-O1", "EXTRA=-fPIC",
                 *(str(BASE / real / source.with_suffix(""))
                   for real in REALS for source in sources)],
                stdout=said, stderr=said, check=False).returncode:
            sys.exit("\n".join(log.read_text("utf-8").splitlines()[-20:]))
    tests = []
    for real in REALS:
        room, work = BASE / real, PLAIN / real
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        for file in core():
            must(compiled(real, file, Path("."), work / f"{file.stem}.o"), file)
        must(linked(work / "libtwofold.so", "-shared", *work.glob("*.o")), real)
        # What the replay of the corpus takes from the command line.
        subprocess.run(["ar", "rcs", work / "libparts.a",
                        *room.glob("tools/verify/fuzz/*.o"),
                        *room.glob("tools/cli/**/*.o")], check=True)
        tests += [linked_test(real, source) for source in sources]
    return tests


def linked_test(real: str, source: Path) -> Test:
    """Links a test, and looks which parts of the core it needs."""
    room, work = BASE / real, PLAIN / real
    parts = [room / source.with_suffix(".o"), room / "libsupport.a",
             work / "libparts.a"]
    must(linked(PLAIN / f"{real}-{source.stem}", *parts, f"-L{work}",
                "-ltwofold", "-lm"), source)
    must(linked(PLAIN / "static", *parts, room / "libtwofold.a", "-lm",
                f"-Wl,-Map={PLAIN}/map"), source)
    needs = re.findall(r"libtwofold\.a\((\w+)\.o\)",
                       (PLAIN / "map").read_text("utf-8"))
    return Test(real, source, frozenset(needs))
