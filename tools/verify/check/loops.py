#!/usr/bin/python3
"""Every loop of the core has a bound that a machine finds: clang's syntax tree,
read by loop_bounds.py. (gcc's own analysis of iterations was tried: it is of
loops as they are after inlining, some of which are no longer there and some
twice, and it calls 2^64 - 2 a bound.) A bound that is not a constant stands in
loops.bounds with what it is at most. BUILD/loops.txt is the table of all. No
recursion: that is stack.py's.
"""
import json
import os
import re
import subprocess
import sys
from pathlib import Path

from findings import BUILD, DEFINES, checked, need, wrong
from loop_bounds import LOOPS, judge

KNOWN = Path("tools/verify/check/loops.bounds")
CORE = sorted(str(f) for room in ("src", "include")
              for f in Path(room).rglob("*.[ch]"))

# It must find each of these, and the bound of the last two.
SEED = """unsigned seeded(const unsigned *to, unsigned n);
unsigned seeded(const unsigned *to, unsigned n) {
  unsigned at = 0;
  for (;;) if (to[at++] == n) break;
  while (at != n) at = to[at];
  while (at < n) at += to[at];
  for (unsigned i = 0; i < n; i++) if (to[i] == 1) i--;
  for (unsigned i = 0; i < n; i++) n++;
  for (unsigned i = 0; i < n; i--) at++;
  while (at < n) { if (to[at]) continue; at++; }
  while (at < n) { if (to[at]) at++; }
  do at = to[at]; while (at > 0);
  for (unsigned char i = 0; i < 250; i += 128) at++;
  for (unsigned char i = 0; i <= 255; i++) at++;
  for (unsigned i = 9; i >= 0; i--) at++;
  for (double x = n; x > 1; x *= 10) at++;
  for (double x = n; x > 1; x /= 1) at++;
  while (at < n) { unsigned by = to[at]; if (by == 0) break; at += by; }
  for (unsigned i = 0; i < 3; i++) at += i;
  return at;
}
"""
SEEDED = {**{line: "none" for line in range(4, 18)}, 18: "runtime",
          19: "constant"}


class Place:
    """clang leaves out file and line where they are those before."""
    def __init__(self):
        self.file = self.line = ""

    def follow(self, loc):
        for part in (loc.get("spellingLoc"), loc.get("expansionLoc"), loc):
            if part:
                self.file = part.get("file", self.file)
                self.line = part.get("line", self.line)


def visit(node, place, function, wanted, out):
    """Adds (file, function, line, kind, bound) of all loops of a tree."""
    place.follow(node.get("loc", {}))
    span = node.get("range", {})
    place.follow(span.get("begin", {}))
    # A header of another room is "src/event/../num/kernel.h".
    file, line = os.path.normpath(place.file or "."), place.line
    if node.get("kind") == "FunctionDecl":
        function = re.sub("_f(64|32)$", "", node.get("name", "?"))
    place.follow(span.get("end", {}))
    for child in node.get("inner", []):
        visit(child, place, function, wanted, out)
    if node.get("kind") in LOOPS and file in wanted:
        out.add((file, function, int(line), *judge(node)))


def loops_of(file, wanted, *flags):
    """All loops of a file that are in one of the wanted files."""
    tree = subprocess.run(
        ["clang", "-std=c99", *flags, "-Iinclude", "-fsyntax-only", "-Xclang",
         "-ast-dump=json", file], stdout=subprocess.PIPE, check=True,
        # A cache of compilers has no use for a tree, and may lose it.
        env={**os.environ, "CCACHE_DISABLE": "1"}).stdout
    found = set()
    sys.setrecursionlimit(10000)
    visit(json.loads(tree), Place(), "?", wanted, found)
    return found


def excused():
    """Loops whose bound is not constant, as (file, function, bound): lines
    "file function : bound : at most, why"."""
    for line in KNOWN.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        place, bound, at_most = [*line.split(" : "), "", ""][:3]
        if not at_most:
            wrong(f"{KNOWN}: not file function : bound : at most: {line}")
        yield (*place.split(" ", 1), bound)


def in_the_text(files):
    """Lines with a loop, but for what a comment says."""
    return sum(bool(re.search(r"\b(for|while|do) *[({]", line.split("//")[0]))
               for file in files for line in Path(file).read_text().split("\n"))


need("clang", "clang")
seed = BUILD / "loops-seed.c"
seed.write_text(SEED)
for _, _, line, kind, _ in loops_of(seed, {str(seed)}):
    if SEEDED.pop(line, None) != kind:
        wrong(f"the seeded loop of line {line} is judged {kind}")
for line, kind in SEEDED.items():
    wrong(f"the seeded loop of line {line} is not judged {kind}")

loops = {loop for define in DEFINES.values() for source in CORE
         if source.endswith(".c")
         for loop in loops_of(source, set(CORE), define)}
(BUILD / "loops.txt").write_text(
    "".join("\t".join(map(str, loop)) + "\n" for loop in sorted(loops)))

# None may have escaped: as many as the text has.
found, there = len({(loop[0], loop[2]) for loop in loops}), in_the_text(CORE)
if found != there:
    wrong(f"{found} lines with loops in the syntax tree, {there} in the text")
known, used = set(excused()), set()
for file, function, line, kind, bound in sorted(loops):
    if kind == "runtime" and (file, function, bound) in known:
        used.add((file, function, bound))
    elif kind != "constant":
        wrong(f"{file}:{line}: {function}: {kind}, {bound}; see {KNOWN}")
for loop in sorted(known - used):
    wrong(f"{KNOWN}: there is no such loop: {' '.join(loop)}")
constant = len({(loop[0], loop[2]) for loop in loops if loop[3] == "constant"})
checked(f"{found} loops, {constant} of constant bounds; seeded ones without "
        "are found")
