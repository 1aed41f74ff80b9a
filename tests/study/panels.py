#!/usr/bin/python3 -B
"""Whether a picture of gnuplot has marks in every panel: panels.py SVG...

gnuplot draws a panel whose data it cannot read, warns and ends well. In its SVG
every plot is a group with its number and the letter of its panel, so what each
panel has to show is counted: points, lines of two points at least, boxes, and
images of two colours at least. The name of the file says which figure it is.
"""
from __future__ import annotations

import argparse
import base64
import io
import re
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Iterator

from matplotlib import image

# Plots in each panel, in their order; the last one is the key, where there is
# one. A plot that has no mark, or is not there, is an error.
PLOTS = {
    "atlas": (1, 1, 1, 1, 1, 1, 2),
    "exits": (2, 3, 2, 2, 5),
    "normal": (6, 9, 10),
    "portrait": (6, 5, 7),
    "regions": (9, 6),
    "return": (4, 3, 8),
    "set": (11, 11, 8),
    "surface": (3, 3, 3, 4),
    "tyre": (2, 3, 4),
}
# How many plots of a panel have nothing to show: a mode that one of the two
# motions never takes; directions that repel; borders outside of the window.
EMPTY = {("normal", "b"): 1, ("portrait", "b"): 1, ("regions", "a"): 2}
SVG = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}href"


def colours(picture: ET.Element) -> int:
    """How many colours an image has."""
    data = base64.b64decode(picture.get(LINK, "").split("base64,")[-1])
    pixels = image.imread(io.BytesIO(data))
    return len({tuple(pixel) for row in pixels for pixel in row})


def marks(plot: ET.Element) -> int:
    """How many marks a plot has made."""
    n = 0
    for element in plot.iter():
        if element.tag in (SVG + "use", SVG + "polygon", SVG + "circle"):
            n += 1
        elif element.tag == SVG + "path":
            n += len(re.findall("[LlHhVv]", element.get("d", "")))
        elif element.tag == SVG + "image":
            n += colours(element) > 1
    return n


def panels(root: ET.Element) -> Iterator[tuple[str, list[tuple[str, int]]]]:
    """Letter of each panel, and the title and marks of its plots."""
    found: dict[str, list[tuple[str, int]]] = {}
    for group in root.iter(SVG + "g"):
        name = re.fullmatch(r"gnuplot_plot_\d+([a-z]*)", group.get("id", ""))
        if name:
            title = group.findtext(SVG + "title", "")
            found.setdefault(name[1], []).append((title, marks(group)))
    yield from found.items()


def wrong(path: Path) -> Iterator[str]:
    """What is wrong with a picture."""
    name = path.stem
    if name not in PLOTS:
        yield f"{path}: tests/study/panels.py does not know its panels"
        return
    try:
        found = list(panels(ET.parse(path).getroot()))
    except (OSError, ET.ParseError) as error:
        yield f"{path}: {error}"
        return
    counts = tuple(len(plots) for _, plots in found)
    if PLOTS[name] != counts:
        yield f"{path}: plots in its panels: {counts}, not {PLOTS[name]}"
    for letter, plots in found:
        # The first plot of the row of the key only holds its place.
        bare = [title for title, n in plots
                if n == 0 and title != f"gnuplot_plot_1{letter}"]
        if len(bare) > EMPTY.get((name, letter), 0):
            yield f"{path}: panel {letter}: no mark for: {'; '.join(bare)}"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("svg", nargs="+", type=Path)
    found = [text for path in parser.parse_args().svg for text in wrong(path)]
    for text in found:
        print(text)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
