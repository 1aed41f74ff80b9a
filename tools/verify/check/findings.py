"""What checks in Python share; lib.sh is the same for those in shell. A check
runs from the root of the project, calls `wrong` for each thing that is wrong
and ends with `checked`, which says what was looked at. A missing tool ends it
with code 3: what was not checked is not known to hold."""
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
count = 0


def need(tool, package):
    if not shutil.which(tool):
        print(f"missing: {tool} (apt-get install {package})")
        sys.exit(3)


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


def build(*arguments):
    """make, as in lib.sh."""
    return quietly(MAKE, "--no-print-directory", *arguments)


def in_common(place, compiler, opt, *arguments):
    """make in a folder that checks share. They run side by side: one of them
    builds, the others wait."""
    return quietly("flock", f"{place}.lock", MAKE, "--no-print-directory",
                   f"CC={compiler}", f"OPT={opt}", f"BUILD={place}",
                   "EXTRA=-Werror", *arguments)


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
