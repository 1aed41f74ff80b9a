"""What checks share. A check runs from the root of the project, calls `wrong`
for each thing that is wrong and ends with `checked`, which says what was looked
at. A missing tool ends it with code 3: what was not checked is not known to
hold."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
os.chdir(ROOT)
BUILD = Path(os.environ.get("BUILD") or "build/check")
MAKE = os.environ.get("MAKE") or "make"
FULL = bool(os.environ.get("FULL"))  # what is sampled otherwise, whole
DEFINES = {"double": "-UTF_REAL_FLOAT", "float": "-DTF_REAL_FLOAT"}
DECLARED = re.compile(r"^(?:TF_API|TF_INLINE|static inline)\b[^;{(]*?"
                      r"\b(tf_\w+)\(", re.M)
BUILD.mkdir(parents=True, exist_ok=True)
os.environ["LC_ALL"] = "C"
sys.path.insert(0, str(ROOT / "tools"))
count = 0


def missing(what, package):
    print(f"missing: {what} (apt-get install {package})")
    sys.exit(3)


def need(tool, package):
    if not shutil.which(tool):
        missing(tool, package)


def wrong(text):
    global count
    print(text, flush=True)
    count += 1


def asked(*command, **options):
    """What a command prints, and its code."""
    done = subprocess.run([str(word) for word in command], text=True,
                          stdout=subprocess.PIPE, check=False, **options)
    return done.stdout, done.returncode


def quietly(*command, **options):
    """Whether a command succeeds; its output only where it fails."""
    said, code = asked(*command, stderr=subprocess.STDOUT, **options)
    if code:
        print(said, end="", flush=True)
    return code == 0


def passes(what, *command, **options):
    """A command, which is wrong where it fails."""
    if not quietly(*command, **options):
        wrong(what)


def version(tool):
    """The first line; nothing where it is not installed."""
    return shutil.which(tool) and asked(tool, "--version")[0].splitlines()[0]


def commit():
    """As a number."""
    return int(asked("git", "rev-parse", "--short=7", "HEAD",
                     stderr=subprocess.DEVNULL)[0] or "1", 16)


def build(*arguments):
    return quietly(MAKE, "--no-print-directory", *arguments)


def place_of(compiler, opt):
    """Where what is compiled so is."""
    return BUILD / re.sub("[ =]", "", compiler + opt)


def in_common(compiler, opt, *arguments):
    """make in a folder that checks share. They run side by side: one of them
    builds, the others wait."""
    place = place_of(compiler, opt)
    return quietly("flock", f"{place}.lock", MAKE, "--no-print-directory",
                   f"CC={compiler}", f"OPT={opt}", f"BUILD={place}",
                   "EXTRA=-Werror", *arguments)


def files_in(*rooms, pattern="*"):
    """Files below folders, and those that are named."""
    for room in map(Path, rooms):
        yield from sorted(path for path in (
            [room] if room.is_file() else room.rglob(pattern))
            if path.is_file())


def public_functions():
    """Their names, without the suffix of the real type."""
    return {name for header in Path("include").rglob("*.h")
            for name in DECLARED.findall(header.read_text())}


def checked(text):
    if count:
        sys.exit(1)
    note = os.environ.get("CHECK_NOTE")
    if note:
        Path(note).write_text(text + "\n")
    print("checked:", text)
