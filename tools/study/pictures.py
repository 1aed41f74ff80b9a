"""What all pictures share: one palette, and files that are small and the same
bytes each time.

A mode, a region of h = 0 and ink have the colours of the page (page.css).
Series that are none of these take SERIES, Okabe and Ito's colours, which stay
apart for all eyes.
"""
import io
import math
import re
from pathlib import Path

import matplotlib
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

colors = matplotlib.colors
CSS = Path(__file__).resolve().parents[1] / "page/page.css"
PAGE = dict(re.findall(r"--([a-z-]+): (#\w{6})",
                       CSS.read_text("utf-8").split("@media")[0]))
MODES = {name: PAGE[name.replace("+", "-plus") if "+" in name else
                    re.sub("-$", "-minus", name)]
         for name in ("slip+", "slip-", "stick+", "stick-", "pinned")}
REGIONS = {"sliding": PAGE["sliding"], "escaping": PAGE["escaping"],
           "crossing_up": PAGE["up"], "crossing_down": PAGE["down"]}
INK, SOFT, LINE = PAGE["ink"], PAGE["soft"], PAGE["line"]
SERIES = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7",
          "#f0e442", "#000000", "#999999")
COLOURS = 128  # of a PNG: a tree keeps it for ever
matplotlib.rcParams.update({
    "svg.hashsalt": "twofold", "svg.fonttype": "none", "font.size": 9,
    "legend.frameon": False, "lines.linewidth": 1,
    "path.simplify_threshold": 0.3})


def save(figure: pyplot.Figure, path: Path, dpi: int = 90) -> None:
    """Writes a PNG with a palette, or an SVG without a date, and without blanks
    and digits of coordinates that nobody sees. The keys of a figure stand above
    its panels."""
    rows = sum(math.ceil(len(key.get_texts()) / key._ncols) * 0.2 + 0.1
               for key in figure.legends)  # [inch]
    figure.tight_layout(rect=(0, 0, 1, 1 - rows / figure.get_figheight()))
    drawn = io.BytesIO()
    if path.suffix == ".svg":
        figure.savefig(drawn, format="svg", dpi=110, metadata={"Date": None})
        text = re.sub("<[^<>]*>", lambda tag: re.sub(
            r"(\d\.\d)\d+", r"\1", tag[0]), drawn.getvalue().decode())
        path.write_text(re.sub(r"\s*\n\s*", "\n", text), "utf-8")
    else:
        figure.savefig(drawn, format="png", dpi=dpi)
        Image.open(drawn).convert("RGB").quantize(
            COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
    pyplot.close(figure)
