#!/usr/bin/python3 -B
"""Proofs that can fail: breaks the source, and looks that the proof notices.

Paragraphs of tools/verify/eva/broken are lines "in: ENTRY", "change: FILE", "from:
TEXT", "to: TEXT" and "lost: FUNCTION, PROPERTY". Each change is made alone in a
copy of the core, its entry is analysed there in double, and the property that
begins so has to be among those that are not proven and not explained. Where the
list is empty, a text not there once, or a proof keeps its verdict, that is a
failure. Exits with code 1 where there was one.
"""
from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[3]
KEYS = ("in", "change", "from", "to", "lost")


class Change(NamedTuple):
    """A wrong change and the proof that it ends."""
    entry: str
    file: str
    old: str
    new: str
    function: str
    lost: str

    def __str__(self) -> str:
        return f"{self.entry}: {self.file}: {self.old} -> {self.new}"


def changes_of(path: Path) -> list[Change]:
    """The paragraphs of the list."""
    text = re.sub(r"^#.*\n", "", path.read_text(encoding="utf-8"), flags=re.M)
    found = []
    for paragraph in filter(None, (p.strip() for p in text.split("\n\n"))):
        lines = [line.partition(": ") for line in paragraph.splitlines()]
        if tuple(key for key, _, _ in lines) != KEYS:
            raise ValueError(f"{path}: not a change:\n{paragraph}")
        entry, file, old, new, lost = (value for _, _, value in lines)
        function, _, begins = lost.partition(", ")
        if not function or not begins:
            raise ValueError(f"{path}: no property is named:\n{paragraph}")
        found.append(Change(entry, file, old, new, function, begins))
    return found


def failure_of(change: Change, keep: Path) -> str:
    """Why the proof does not notice the change; empty where it does."""
    with tempfile.TemporaryDirectory(prefix="twofold-eva-") as name:
        copy = Path(name)
        for part in ("src", "include", "tools"):
            shutil.copytree(ROOT / part, copy / part)
        file = copy / change.file
        text = file.read_text(encoding="utf-8")
        if text.count(change.old) != 1:
            return f"the text is there {text.count(change.old)} times"
        file.write_text(text.replace(change.old, change.new), encoding="utf-8")
        run = subprocess.run(
            ["tools/verify/eva/run", change.entry], cwd=copy, check=False, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            env=dict(os.environ, REALS="f64", JOBS="1", BUILD="build"))
    keep.write_text(run.stdout, encoding="utf-8")
    if f"\nat: {change.function}\nwhat: {change.lost}" in run.stdout:
        return ""
    return f"the proof keeps its verdict ({keep})"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("entry", nargs="*", help="those of these entries only")
    given = parser.parse_args()
    changes = [change for change in changes_of(ROOT / "tools/verify/eva/broken")
               if not given.entry or change.entry in given.entry]
    keep = Path(os.environ.get("BUILD", ROOT / "build")) / "eva" / "broken"
    keep.mkdir(parents=True, exist_ok=True)
    jobs = int(os.environ.get("JOBS", os.cpu_count() or 2))
    bad = 0
    with ThreadPoolExecutor(jobs) as pool:
        logs = [keep / f"{i}.log" for i in range(len(changes))]
        for change, why in zip(changes, pool.map(failure_of, changes, logs)):
            bad += bool(why)
            print(f"{'NOT NOTICED' if why else 'noticed'} {change}",
                  *[f"    {why}"] * bool(why), sep="\n", flush=True)
    print("passed: the proof notices; failed: it keeps its verdict",
          f"{len(changes) - bad} passed, {bad} failed", sep="\n")
    return int(bool(bad) or not changes)


if __name__ == "__main__":
    sys.exit(main())
