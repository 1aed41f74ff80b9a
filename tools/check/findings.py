"""What checks in Python share; lib.sh is the same for those in shell. A check
runs from the root of the project, calls `wrong` for each thing that is wrong
and ends with `checked`, which says what was looked at. A missing tool ends it
with code 3: what was not checked is not known to hold."""
import os
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.chdir(ROOT)
count = 0


def need(tool, package):
    if not shutil.which(tool):
        print(f"missing: {tool} (apt-get install {package})")
        sys.exit(3)


def wrong(text):
    global count
    print(text, flush=True)
    count += 1


def checked(text):
    if count:
        sys.exit(1)
    note = os.environ.get("CHECK_NOTE")
    if note:
        Path(note).write_text(text + "\n")
    print("checked:", text)
