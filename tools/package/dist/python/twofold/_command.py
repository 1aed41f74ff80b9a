"""Runs the command line of a library in a process of its own, so that signals
and messages are those of a program. As a script: _command.py LIBRARY WORD..."""
from __future__ import annotations

import ctypes
import os
import subprocess
import sys


def main(library, words):
    """Returns the exit code."""
    words = b"twofold", *map(os.fsencode, words)
    return ctypes.CDLL(library).twofold_main(
        len(words), (ctypes.c_char_p * (len(words) + 1))(*words))


def output(library, words):
    """Returns what the command prints. Raises ValueError with its message."""
    said = subprocess.run([sys.executable, __file__, library, *words],
                          capture_output=True, text=True, check=False)
    if said.returncode:
        raise ValueError(said.stderr.replace("twofold: ", "").strip())
    return said.stdout


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
