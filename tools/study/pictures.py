"""Pictures by matplotlib, in few colours: a tree keeps them for ever."""
import io
from pathlib import Path

import matplotlib
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = 64


def save(figure: pyplot.Figure, path: Path, dpi: int) -> None:
    """A figure as PNG with a palette."""
    figure.tight_layout()
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dpi, format="png")
    small(Image.open(drawn), path)
    pyplot.close(figure)


def save_drawing(figure: pyplot.Figure, path: Path) -> None:
    """A figure of few lines as SVG, the same bytes each time."""
    figure.tight_layout()
    with pyplot.rc_context({"svg.hashsalt": "", "svg.fonttype": "none"}):
        figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def small(picture: Image.Image, path: Path) -> None:
    """A picture with a palette, no dots between its colours."""
    picture.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(
        path, optimize=True)
