"""The loops of the core with their bounds, as clang's syntax tree has them
(loop_bounds.py), and how often each is run at most in one go: that is a number
where its bound is a constant, or where loops.bounds says what it is at most.
"""
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from loop_bounds import LOOPS, judge, kids

KNOWN = Path("tools/verify/check/loops.bounds")
CORE = sorted(str(f) for room in ("src", "include")
              for f in Path(room).rglob("*.[ch]"))


class Loop(NamedTuple):
    """A loop, from `line` and `column` to the line `last`. `test`: (line,
    column) of the first and of the last word of the comparison that sets the
    bound, and so `condition`, of all that it is a part of; `body`: where what
    they guard begins; `begin`: "" where the first value is not constant;
    `beyond`: see loop_bounds.Bound."""
    file: str
    function: str
    line: int
    kind: str
    bound: str
    column: int
    last: int
    test: tuple
    condition: tuple
    body: tuple
    up: bool
    begin: str
    limit: str
    beyond: int


class LoopError(Exception):
    """What is wrong with loops.bounds."""


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
    place.follow(node.get("loc", {}))
    span = node.get("range", {})
    place.follow(span.get("begin", {}))
    # A header of another room is "src/event/../num/kernel.h".
    file, line = os.path.normpath(place.file or "."), place.line
    if node.get("kind") == "FunctionDecl":
        function = node.get("name", "?")
    place.follow(span.get("end", {}))
    node["lines"] = line, place.line
    for child in node.get("inner", []):
        visit(child, place, function, wanted, out)
    if node.get("kind") in LOOPS and file in wanted:
        kind, bound, begin, found = judge(node)
        out.add(Loop(file, function, int(line), kind, bound,
                     words_of(node)[0][1], int(node["lines"][1]),
                     words_of(found.test) if found else (),
                     words_of(condition_of(node)),
                     words_of(body_of(node))[0],
                     found is None or found.up, begin or "",
                     found.limit if found else "",
                     turns_beyond(node, found)))


def turns_beyond(loop, bound):
    """As Bound has it; a loop that ends with its condition has one more."""
    return (bound.beyond if bound else 0) + (loop["kind"] == "DoStmt")


def body_of(loop):
    """The statement that is repeated."""
    return kids(loop)[0 if loop["kind"] == "DoStmt" else -1]


def condition_of(loop):
    """The condition of a loop, {} where it has none."""
    if loop["kind"] == "ForStmt":
        return loop["inner"][2]
    return kids(loop)[-1 if loop["kind"] == "DoStmt" else 0]


def words_of(node):
    """(line, column) of the first and of the last word of an expression."""
    if not node.get("kind"):
        return ()
    return tuple(
        (int(line), int(at.get("expansionLoc", at).get("col", 0)))
        for line, at in zip(node["lines"], (node["range"]["begin"],
                                            node["range"]["end"])))


def loops_in(tree, wanted):
    """All loops of a syntax tree that are in one of the wanted files."""
    found = set()
    sys.setrecursionlimit(10000)
    visit(tree, Place(), "?", wanted, found)
    return found


def loops_of(file, wanted, *flags):
    """All loops of a file that are in one of the wanted files."""
    tree = subprocess.run(
        ["clang", "-std=c99", *flags, "-Iinclude", "-fsyntax-only", "-Xclang",
         "-ast-dump=json", file], stdout=subprocess.PIPE, check=True).stdout
    return {loop._replace(function=re.sub("_f(64|32)$", "", loop.function))
            for loop in loops_in(json.loads(tree), wanted)}


def loops_of_core(define):
    """All loops of src/ and include/ in one real type."""
    return {loop for source in CORE if source.endswith(".c")
            for loop in loops_of(source, set(CORE), define)}


def excused():
    """What a loop whose bound is not constant is at most, by (file, function,
    bound): lines "file function : bound : at most, why"."""
    found = {}
    for line in KNOWN.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        place, _, rest = line.partition(" : ")
        bound, _, at_most = rest.partition(" : ")
        if not at_most or " : " in at_most:
            raise LoopError(
                f"{KNOWN}: not file function : bound : at most: {line}")
        found[(*place.split(" ", 1), bound)] = at_most
    return found


def whole(text, units=0):
    """The whole number that an expression of numbers and of n, the units,
    is, or None."""
    if not re.fullmatch(r"[\dn+\-*/%() ]*[\dn][\dn+\-*/%() ]*", text):
        return None
    return int(eval(text.replace("/", "//"), {}, {"n": units}))


def numbers(define):
    """What the loops of excused() are at most, as an expression of numbers and
    of n: what the preprocessor makes of its first words."""
    told, found = excused(), {}
    for file in {key[0] for key in told}:
        keys = [key for key in told if key[0] == file]
        source = f'#include "{file}"\n' + "".join(
            f"loop_bound {i} {re.split('[,;]| divis| multi', told[key])[0]}\n"
            for i, key in enumerate(keys))
        out = subprocess.run(
            ["clang", "-std=c99", define, "-Iinclude", "-I.", "-E", "-P", "-"],
            input=source, stdout=subprocess.PIPE, text=True, check=True).stdout
        for i, at_most in re.findall(r"^loop_bound (\d+) (.*)$", out, re.M):
            found[keys[int(i)]] = at_most
    return found


def turns(loop, told):
    """How often a loop is run at most from its entry to its end, as a function
    of the number of units; None where that is not known.

    told: what numbers() gives, of a loop without a constant bound the most that
    the limit is or, on the way down, the first value. A counter moves by 1 or
    more in a turn.
    """
    first, last = whole(loop.begin), whole(loop.limit)
    if loop.kind == "constant" and None not in (first, last):
        return lambda units: abs(last - first) + loop.beyond
    at_most = told.get((loop.file, loop.function, loop.bound), "")
    if loop.kind != "runtime" or whole(at_most) is None:
        return None
    end = (first if loop.up else last) or 0
    return lambda units: max(0, whole(at_most, units) - end) + loop.beyond
