#!/usr/bin/python3
"""Programs in Python: pyflakes finds no name that is unknown, defined twice or
imported in vain."""
import re
import subprocess
from pathlib import Path

from findings import asked, checked, need, wrong

PYTHON = re.compile(r"#!.*\bpython3?\b")


def is_python(path):
    if path.suffix == ".py":
        return True
    with path.open("rb") as file:
        return bool(PYTHON.match(file.readline(80).decode("latin-1")))


need("pyflakes3", "pyflakes3")
programs = sorted(path for room in (".ci", "port", "tests", "tools")
                  for path in Path(room).rglob("*")
                  if path.is_file() and is_python(path))
said, _ = asked("pyflakes3", *programs, stderr=subprocess.STDOUT)
for line in said.splitlines():
    wrong(line)
checked(f"{len(programs)} programs and modules")
