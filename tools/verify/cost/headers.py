#!/usr/bin/python3 -B
"""What the headers say of costs and stacks, read or brought up to date.

`claims` prints a line "name A B W V" for each public function, from its row
"Cost: at most A instructions [and B a UNIT]" and what it may say of "W [and V]
by the longest way", 0 for what is not said; "name none" where there is no such
row.

`put` writes figures into the rows of a header, in place. Lines of FIGURES:
"name Stack BYTES" or "name Cost A B W V". Words around the numbers stay, and so
does what FIGURES does not name.
"""
from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Iterator, NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import read  # noqa: E402

ALIAS = re.compile(r"#define (tf_[a-z_0-9]+) TF_LINK")
DECLARED = re.compile(r"(?:TF_API|static inline) (?=.*\()(?:.*?(tf_\w+)\()?")
COST = re.compile(r"Cost: at most (\d+) instructions(?: and (\d+) a )?")
WAY = re.compile(r"(\d+)(?: and (\d+))? by the longest way")


class Block(NamedTuple):
    """A declaration, or another line, with the comment above it."""
    name: str  # "" where nothing public is declared
    lines: list[str]

    def comment(self) -> str:
        """The comment as one line."""
        words = (line[3:] for line in self.lines if line.startswith("///"))
        return re.sub(" +", " ", " ".join(words))


def blocks(lines: list[str]) -> Iterator[Block]:
    """All lines of a header, in its order."""
    held, alias = [], ""
    for line in lines:
        held.append(line)
        if line.startswith("///"):
            continue
        if found := ALIAS.match(line):
            alias = found[1]
            continue
        declared = DECLARED.match(line)
        yield Block((alias or declared[1] or "") if declared else "", held)
        held, alias = [], ""
    yield Block("", held)


def claims(block: Block) -> str:
    """What a block says of its function's cost; "" of a table look-up."""
    text = block.comment()
    if "Cost: one look-up in a table." in text:
        return ""
    cost, way = COST.search(text), WAY.search(text)
    if not cost:
        return f"{block.name} none"
    ways = f"{way[1]} {way[2] or 0}" if way else "0 0"
    return f"{block.name} {cost[1]} {cost[2] or 0} {ways}"


def put(block: Block, figures: dict[tuple[str, str], list[str]]) -> list[str]:
    """The block's lines with figures for what has one."""
    replaced = []
    stack = figures.get((block.name, "Stack"))
    if stack:
        replaced.append((r"Stack: \d+ B", f"Stack: {stack[0]} B"))
    cost = figures.get((block.name, "Cost"))
    if cost:
        most, slope, way, way_slope = cost
        and_slope = f" and {way_slope}" if way_slope != "0" else ""
        replaced += [(r"at most \d+ instructions",
                      f"at most {most} instructions"),
                     (r"and \d+ a", f"and {slope} a"),
                     (r"\d+(?: and \d+)? by the longest way",
                      f"{way}{and_slope} by the longest way")]
    lines = block.lines
    for pattern, text in replaced:
        lines = [re.sub(pattern, text, line, count=1) for line in lines]
    return lines


def read_figures(path: str) -> dict[tuple[str, str], list[str]]:
    """The figures, by function and row."""
    return {(row["name"], row["row"]): row["figures"].split()
            for row in read.read_words(path, ["name", "row", "figures"])}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_subparsers(dest="what", required=True)
    one = what.add_parser("claims", help="print what the headers say")
    one.add_argument("headers", nargs="+", type=Path)
    one = what.add_parser("put", help="put figures into the headers")
    one.add_argument("figures")
    one.add_argument("headers", nargs="+", type=Path)
    given = parser.parse_args()
    figures = read_figures(given.figures) if given.what == "put" else {}
    for header in given.headers:
        found = blocks(header.read_text(encoding="utf-8").splitlines())
        if given.what == "claims":
            for block in found:
                if block.name:
                    if row := claims(block):
                        print(row)
            continue
        lines = [line for block in found for line in put(block, figures)]
        header.write_text("".join(f"{line}\n" for line in lines),
                          encoding="utf-8")


if __name__ == "__main__":
    read.run_script(main)
