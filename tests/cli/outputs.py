"""What the tests of commands that write rows share: rows by the names of their
columns, refusals, a signal in the middle of a run, and outputs that fail."""
import csv
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from tap import TWOFOLD, call, check, same, until  # noqa: E402


def lines_of(path):
    return Path(path).read_text("ascii").splitlines()


def table(text):
    """Rows of CSV: their fields by the names of the columns."""
    return list(csv.DictReader(text.splitlines()))


def column(rows, *names):
    """These fields of each row; of one name not as a tuple."""
    return [row[names[0]] if len(names) == 1 else
            tuple(row[name] for name in names) for row in rows]


def says(code, texts, *words):
    """A command ends with a code and says all texts, which stand between &;
    where the command line was refused it writes no row. Returns: its output."""
    out, said = call(*words, code=code)
    for text in texts.split("&"):
        check(text in said, f"{words}: no '{text}' in: {said}")
    check(code not in (2, 3) or not out, f"{words}: rows of a refused command")
    return out


def says_each(lines, *before):
    """Lines CODE WORDS|TEXT&TEXT... of one command."""
    for line in lines.strip().splitlines():
        words, _, texts = line.partition("|")
        code, *words = words.split()
        says(int(code), texts, *before, *words)


def check_whole(path, columns):
    """A file has a header and rows, all of them with all fields."""
    text = Path(path).read_text()
    check(text.endswith("\n"), f"{path} ends within a row")
    counts = [line.count(",") + 1 for line in text.splitlines()]
    check(len(counts) > 1 and set(counts) == {columns},
          f"{path} has rows of {sorted(set(counts))} fields")


def started(path, *words, **options):
    """A command in the background, when rows are in the part of its file."""
    part = Path(f"{path}.part")
    part.unlink(missing_ok=True)
    child = subprocess.Popen([TWOFOLD, *map(str, words)], text=True,
                             stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                             stdout=subprocess.DEVNULL, **options)
    until(lambda: part.exists() and part.read_text().count("\n") > 20, part,
          child)
    return child


def ended(child, number=signal.SIGINT):
    """What a command says when a signal has ended it with code 4."""
    child.send_signal(number)
    said = child.communicate()[1]
    same(child.returncode, 4)
    check("interrupted" in said or "by a signal" in said, said)
    return said


def interrupted(path, *words, number=signal.SIGINT):
    """Ends a command by a signal when rows are in the part of its file."""
    said = ended(started(path, *words), number)
    check(f"its rows are in {path}.part" in said, said)
    check(not Path(path).exists(), "a part that passes for a whole file")
    return said


def fails_to_write(columns, *words):
    """A command of nearly endless rows ends well where it cannot write."""
    says(4, "/nowhere/x", *words, "--out", "/nowhere/x")
    says(4, "--out .", *words, "--out", ".")
    says(4, "/dev/full: No space left", *words, "--out", "/dev/full")
    quiet = {"stdin": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with open("/dev/full", "w", encoding="ascii") as full:
        same(subprocess.run([TWOFOLD, *words], check=False, stdout=full,
                            **quiet).returncode, 4)
    quota = subprocess.run(
        [TWOFOLD, *words, "--out", "quota.csv"], check=False, **quiet,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                              (4096, 4096)))
    same(quota.returncode, 4)
    check_whole("quota.csv.part", columns)
    check(not Path("quota.csv").exists(), "a part that passes for whole")
    with subprocess.Popen([TWOFOLD, *words], stdout=subprocess.PIPE,
                          **quiet) as child:
        header = child.stdout.readline().decode()
        child.stdout.close()
        same(child.wait(), 4)
    same(header, Path("quota.csv.part").read_text().splitlines(True)[0])
    os.remove("quota.csv.part")
