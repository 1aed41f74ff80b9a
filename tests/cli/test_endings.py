#!/usr/bin/python3 -B
"""A command that writes is ended at each of its calls on files (end_at.c), and
begun again: what has its name is whole, and in the end all is there, with the
bytes of a command that was not ended. Rows or notes in which a bit is another
one, or that another build has written, are not gone on with."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / place)
                for place in ("support", "line")]
from boards import BUILD, Board  # noqa: E402
from outputs import says  # noqa: E402
from tap import (ROOT, TWOFOLD, Skip, call, check, lacks, main,  # noqa: E402
                 output, same)

ENDED = 99
SWEEP = ["sweep", "chaos", "--over", "kappa=0.2:0.4:7", "--t-end", "0.01",
         "--resume", "--out", "x"]
DIVERGE = ["diverge", "chaos", "--samples", "2", "--cycles", "2",
           "--provenance", "--exits", "e", "--returns", "r", "--resume"]
GRID = ["--r", "0.1:0.2:9", "--omega=-1.1:-0.9:9"]


def perform(words, number=0, program=TWOFOLD):
    """The exit code of a command that is ended at such a call, or by itself."""
    return subprocess.run(
        [program, *words], check=False, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        env=dict(os.environ, LD_PRELOAD=str(Path("../end_at.so").resolve()),
                 ENDS_AT=str(number))).returncode


def enter_folder():
    """A new one, with what is preloaded beside it."""
    compiler = shutil.which("gcc") or lacks("gcc")
    subprocess.run([compiler, "-shared", "-fPIC", "-o", "end_at.so",
                    Path(__file__).with_name("end_at.c"), "-ldl"], check=True)
    os.chdir(tempfile.mkdtemp(dir="."))
    if perform(["scene", "chaos", "--out", "x"], 1) != ENDED:
        raise Skip("nothing can be preloaded here")
    clear(())


def contents():
    return {path.name: path.read_bytes() for path in Path().iterdir()}


def rows(files):
    """Files without notes, which grow in number with each interruption."""
    return {name: text for name, text in files.items()
            if not name.endswith(".resume")}


def clear(kept):
    for path in Path().iterdir():
        if path.name not in kept:
            path.unlink()


def ends(words, *prepare, step=1, program=TWOFOLD):
    """Ends a command at each call, or at each of so many; what has its name
    then is whole, or what was there before. The same command has to go on from
    there. Yields the files of each end, and those without one."""
    enter_folder()
    for first in prepare:
        same(perform(first), 0)
    before = contents()
    same(perform(words, program=program), 0)
    whole, code, number = rows(contents()), ENDED, 1 - step
    made = sorted(set(whole) - set(before))
    while code == ENDED:
        clear(before)
        number += step
        old = b"old" if number % 2 and "--resume" not in words else None
        for name in made if old else ():
            Path(name).write_bytes(old)
        code = perform(words, number, program)
        found = contents()
        for name in made:
            check(found.get(name) in (old, whole[name]),
                  f"{name} is not whole, ended at call {number}")
        yield found, whole
        same(perform(words, program=program), 0)
        check(rows(contents()) == whole, f"not the same, ended at {number}: "
              f"{sorted(contents())}")
    same(code, 0)
    check(number > 5, f"only {number} calls were seen")


def ends_well(*given, **options):
    for _ in ends(*given, **options):
        pass


def test_diverge():
    ends_well(DIVERGE, step=2)  # fsync before each rename, close behind it


def test_run():
    """A state that is there belongs to rows that are there."""
    for found, whole in ends([
            "run", "chaos", "--t-end", "0.02", "--every", "20", "--out", "x",
            "--save", "at", "--realtime", "--lateness", "late"]):
        check(found.get("at") != whole["at"] or found["x"] == whole["x"],
              "a state without its rows")


def test_monitor():
    ends_well(["monitor", "rows", "--format", "csv", "--out", "x",
               "--record", "y"],
              ["run", "chaos", "--t-end", "0.01", "--format", "frames",
               "--out", "rows"])


def test_hil():
    os.environ["ENDS_LINE"] = "1"
    with Board("double") as board:
        ends_well([board.name, "--steps", "60", "--every", "1", "--lockstep",
                   "--csv", "x"], program=str(BUILD / "double" / "hil"))


def test_one_file():
    for words in (SWEEP[:-2], [*SWEEP[:-2], "--shard", "2/3"],
                  ["regions", "chaos", *GRID],
                  ["atlas", "chaos", *GRID], ["singularities", "chaos"],
                  ["design", "chaos", "--r", "0.1859", "--omega=-1.037"],
                  ["tyre", "chaos"], ["scene", "chaos"]):
        ends_well([*words, "--out", "x"])
    ends_well(["diverge", "chaos", "--exhaustive", "--depth", "1", "--grid",
               "0.1", "--patience", "0.5", "--branches", "x"])


def lay(files):
    """Makes these the files that are there."""
    clear(())
    for path, text in files.items():
        Path(path).write_bytes(text)


def last_end(words, part):
    """The files of the last end that leaves a part, and the whole ones."""
    return [pair for pair in ends(words) if part in pair[0]][-1]


def test_a_bit_of_rows_or_of_notes():
    """It is found, wherever it is: no other file is made."""
    for words, part in (SWEEP, "x.part"), (DIVERGE, "r.part"):
        found, whole = last_end(words, part)
        for changed, text in found.items():
            for at in range(0, len(text), 9):
                bit = bytearray(text)
                bit[at] ^= 1 << at % 8
                given = {**found, changed: bit}
                lay(given)
                check(perform(words) in (0, 3) and all(
                    text in (whole.get(path), given.get(path))
                    for path, text in rows(contents()).items()),
                    f"{changed}, byte {at}")


def test_an_end_of_rows_or_of_notes():
    """Where it is lost, or more is there, what is right in all files stays, and
    no more is made again. Another command goes on with none of them."""
    for words, part, said in (
            (SWEEP, "x.part", "x has all of its 7 points"),
            (DIVERGE, "e.part", "all 2 samples are done")):
        found, whole = last_end(words, part)
        for changed, text in found.items():
            for less in (text + b"9,0.2", text[:-1], text[:-9],
                         text[:len(text) * 4 // 5]):
                lay({**found, changed: less})
                kept = re.search(r"(\d+) of them kept", call(*words)[1])
                check(rows(contents()) == whole, f"{changed}: {len(less)} B")
                check(words is DIVERGE or
                      int(kept[1]) == min(7, less.count(b"\n") - 1), kept)
        says(0, said, *words)
        lay(found)
        says(3, "is of another", *words, "--set", "mu=1.1")
        same(contents(), found)


def test_two_builds():
    """The version has the checksum of the sources, and what other sources have
    written is not gone on with."""
    sources = sorted(
        str(path.relative_to(ROOT)) for pattern in (
            "include/*.h", "include/*/*.h", "src/*/*.[ch]", "tools/*.[ch]",
            "tools/cli/*.[ch]", "tools/cli/*/*.[ch]")
        for path in ROOT.glob(pattern))
    total = output("cksum", input=b"".join(
        Path(ROOT, path).read_bytes() for path in sources)).split()[0]
    rows = output(TWOFOLD, "run", "chaos", "--t-end", "0", "--provenance")
    check(b"-%s, numbers are" % total in rows, f"{total}: {rows[:99]}")
    other = Path("other").resolve()
    other.write_bytes(Path(TWOFOLD).read_bytes().replace(
        b"-%s\0" % total, b"-%s\0" % total[::-1]))
    other.chmod(0o700)
    for words, name in (SWEEP, "x.part"), (DIVERGE, "r.part"):
        found = next(found for found, _ in ends(words) if found.get(name))
        lay(found)
        same(perform(words, program=other), 3)
        same(contents(), found)


main(globals(), jobs=2)
