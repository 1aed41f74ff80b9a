#!/usr/bin/python3 -B
"""A map of what `twofold sweep` wrote: an outcome over one or two axes.

usage: map.py TABLE X [Y] OUTCOME PICTURE

TABLE is a file of all points, or its shards one after the other (`-` is
standard input); a shard that is missing is refused. X, Y and OUTCOME are names
of columns. PICTURE ends in .png, .svg or .pdf. An outcome in words is drawn in
a colour each. Points whose machine was refused are hatched, points where the
outcome did not happen are blank.
"""
import sys
from pathlib import Path

sys.path[:0] = map(str, Path(__file__).resolve().parents[1:3])

try:
    import numpy as np
    import pandas as pd
    import pictures
    import table
    from pictures import LINE, SERIES, SOFT, colors, pyplot
except ImportError as missing:
    sys.exit(f"map.py: {missing}: apt-get install python3-matplotlib "
             "python3-pandas python3-statsmodels python3-tabulate python3-pil")


def grid_of(rows: pd.DataFrame, x: str, y: str, column: str) -> pd.DataFrame:
    """A column over both axes."""
    for axis in x, y:
        if not pd.api.types.is_numeric_dtype(rows[axis]):
            raise table.TableError(f"axis {axis} has words, not numbers")
    if rows.duplicated([x, y]).any():
        raise table.TableError(f"some rows have the same {x} and {y}: another "
                               "axis was swept, too")
    return rows.pivot(index=y, columns=x, values=column)


def words_of(outcome: pd.Series) -> list[str]:
    """Words of an outcome, the most frequent first."""
    words = list(outcome.dropna().value_counts().index)
    return words if len(words) <= len(SERIES) else [
        *words[:len(SERIES) - 1], "others"]


def draw_map(axes, rows: pd.DataFrame, x: str, y: str, outcome: str) -> None:
    """An outcome over two axes, with its key."""
    values, refused = (grid_of(rows, x, y, column)
                       for column in (outcome, "status"))
    refused, place = refused == "refused", (values.columns, values.index)
    keys = []
    if pd.api.types.is_numeric_dtype(rows[outcome]):
        axes.figure.colorbar(axes.pcolormesh(*place, values), ax=axes)
    else:
        words = words_of(rows[outcome])
        number = {word: i for i, word in enumerate(words)}
        cells = values.applymap(lambda word: np.nan if word != word else
                                number.get(word, len(words) - 1))
        axes.pcolormesh(*place, cells.astype(float),
                        cmap=colors.ListedColormap(SERIES), vmin=0,
                        vmax=len(SERIES) - 1)
        keys = [({"color": colour}, word)
                for colour, word in zip(SERIES, words)]
    if refused.to_numpy().any():
        axes.pcolor(*place, np.where(refused, 1.0, np.nan), hatch="////",
                    cmap=colors.ListedColormap([LINE]), linewidth=0)
        keys.append(({"fc": LINE, "hatch": "////"}, "refused"))
    if (values.isna() & ~refused).to_numpy().any():
        keys.append(({"fc": "white", "ec": SOFT}, "did not happen"))
    if keys:
        axes.figure.legend([pyplot.Rectangle((0, 0), 1, 1, **style)
                            for style, _ in keys], [word for _, word in keys],
                           loc="upper center", ncols=3)
    axes.set(ylabel=y, title=outcome)


def main() -> int:
    if len(sys.argv) not in (5, 6):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    path, x, *middle, outcome, picture = sys.argv[1:]
    rows = table.read(path, ["point", "status", x, *middle, outcome])
    table.whole(rows, "point", path)
    figure, axes = pyplot.subplots(figsize=(6.4, 5.2))
    if middle:
        draw_map(axes, rows, x, middle[0], outcome)
    else:
        grid_of(rows.assign(one=0), x, "one", outcome)
        axes.plot(rows[x], rows[outcome], ".", color=SERIES[0])
        axes.set(ylabel=outcome)
    axes.set(xlabel=x)
    try:
        pictures.save(figure, Path(picture), 150)
    except (OSError, ValueError) as error:
        raise table.TableError(f"{picture}: {error}") from None
    return 0


if __name__ == "__main__":
    table.run_script(main)
