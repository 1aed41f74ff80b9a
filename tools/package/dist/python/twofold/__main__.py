"""The command line `twofold`, and pictures of its rows:

    python3 -m twofold run chaos --out chaos.csv
    python3 -m twofold plot chaos.csv -o chaos.png
"""
import sys

from ._command import main
from ._core import CORE_f64
from ._table import read_csv

USAGE = """usage: python3 -m twofold plot FILE.csv [-o PICTURE]

Draws r, v, omega and h of a run over time, a colour for each mode, shaded where
several futures were possible. PICTURE: .png, .svg or .pdf; without it a window.
"""


def plot(words):
    """The command plot. Returns why it failed, or None."""
    if "-h" in words or "--help" in words:
        return print(USAGE, end="")
    if len(words) not in (1, 3) or (len(words) == 3 and words[1] != "-o"):
        return USAGE
    try:
        import matplotlib
        import matplotlib.pyplot as plt
    except ImportError:
        return ("plot needs matplotlib: python3 -m pip install matplotlib, or "
                "Debian's python3-matplotlib")
    try:
        figure = read_csv(words[0]).strips(words[0])
        if len(words) == 3:
            figure.savefig(words[2], dpi=150)
        elif matplotlib.get_backend().lower() == "agg":
            return "there is no display: give -o PICTURE.png"
        else:
            plt.show()
    except OSError as error:
        return f"{error.filename}: {error.strerror}"
    except ValueError as error:  # which may begin with the name
        return f"{words[0]}: {str(error).removeprefix(f'{words[0]}: ')}"
    return None


if __name__ == "__main__":
    if sys.argv[1:2] == ["plot"]:
        said = plot(sys.argv[2:])
        sys.exit(said and (said if said == USAGE else f"twofold: {said}"))
    sys.exit(main(CORE_f64.path, sys.argv[1:]))
