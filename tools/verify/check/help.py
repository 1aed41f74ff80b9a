#!/usr/bin/python3
"""`make help` lists every target that a user may call: each phony one that is
not among HELPERS, in at most 80 columns, and nothing else."""
import os
import re
import subprocess
import tempfile

from findings import checked, wrong

MAKE = os.environ.get("MAKE", "make")
CLEAN = {k: v for k, v in os.environ.items()
         if k not in ("MAKEFLAGS", "MAKELEVEL")}


def output(*arguments):
    return subprocess.run([MAKE, "--no-print-directory", *arguments],
                          env=CLEAN, stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.DEVNULL).stdout


def targets(makefile):
    """Phony targets of a makefile that users may call, from make's data."""
    data = output("-f", makefile, "-pq", "help")
    phony = re.search(r"^\.PHONY: (.*)", data, re.M)
    helpers = re.search(r"^HELPERS :?= (.*)", data, re.M)
    if not (phony and helpers):
        wrong(f"{makefile}: make reports neither .PHONY nor HELPERS")
        return set()
    return set(phony[1].split()) - set(helpers[1].split())


text = output("help")
told = set(re.findall(r"^  make (\S+) +\S", text, re.M))
for line in text.splitlines():
    if len(line) > 80:
        wrong(f"make help: {len(line)} columns: {line}")
there = targets("Makefile")
for name in sorted(there - told):
    wrong(f"make {name}: no line `{name}: ## what it does` beside the target")
for name in sorted(told - there):
    wrong(f"make help lists {name}, which is not phony or among HELPERS")

with tempfile.NamedTemporaryFile("w", suffix=".mk") as seed:
    seed.write("include Makefile\n.PHONY: planted\nplanted: ; @true\n")
    seed.flush()
    if targets(seed.name) - there != {"planted"}:
        wrong("a planted target without help is not found")
checked(f"{len(told)} targets, each with its line of make help; a planted one "
        "without is found")
