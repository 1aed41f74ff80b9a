#!/usr/bin/python3
"""Makes twofold.h and twofold.c: two_files.py FOLDER."""
import sys
from pathlib import Path

from sources import COMPILERS, ROOT, Text, core_sources, preface

folder = Path(sys.argv[1])
header = Text()
header.add(preface("all public headers in one"))
header.add_file(ROOT / "include/twofold.h")
header.write(folder / "twofold.h")

# What twofold.h has is not in twofold.c again.
source = Text(without=header.there)
source.add(preface("the core in one file, C99"))
source.add(COMPILERS)
source.add_file(ROOT / "src/num/rounding.h")
source.add('#include "twofold.h"\n\n')
for path in core_sources():
    source.add_file(path)
source.write(folder / "twofold.c")
