#!/usr/bin/python3 -B
"""What goes over a line, read by parsers that are written from the documents of
the tools that are to read it, and the frames by
tools/board/protocol/decode.py."""
import json
import re
import struct
import sys

from boards import RUN, program, sealed, stuffed
import decode
from tap import ROOT, main, output, same

NAMES = "t,r,v,omega,h,g,F,M,mode,choices".split(",")
PLOTTED = "r,v,omega,h,g,mode,choices".split(",")
MODES = ["slip+", "slip-", "stick+", "stick-", "pinned"]


def arduino(text):
    """The serial plotter of the Arduino IDE, by
    build/shared/ArduinoSerialPlotterProtocol.md of arduino/Arduino: messages
    end with a newline; parts stand between spaces, tabs or commas; a part is
    `label:value`, a value, or in a header a label. Returns: the labels of the
    last header, and each message as pairs (label or None, value)."""
    labels, messages = [], []
    for line in text.split("\n")[:-1]:
        parts = [part for part in re.split(r"[ \t,]+", line.strip()) if part]
        pairs = [part.rpartition(":")[::2] for part in parts]
        if not any(is_number(value) for _, value in pairs):
            labels = [label or value for label, value in pairs]
        else:
            messages.append([(label or None, float(value))
                             for label, value in pairs])
    return labels, messages


def quick_plot(text):
    """Quick Plot of Serial Studio, by doc/help/Operation-Modes.md: a line that
    CR, LF or CRLF ends is a frame; commas alone separate; if the first row has
    strings only, they are the labels. Returns: labels, rows; a cell that is no
    number is None."""
    rows = [line.split(",") for line in re.split(r"\r\n|\r|\n", text)[:-1]]
    labels = []
    if rows and not any(map(is_number, rows[0])):
        labels = rows.pop(0)
    return labels, [[float(cell) if is_number(cell) else None for cell in row]
                    for row in rows]


def teleplot(text):
    """Teleplot, by its README: A:B:C§D|E, the name, milliseconds, the value,
    the unit, and flags; g is a number, t a text. Returns: by name, a list of
    (milliseconds, value, unit)."""
    series = {}
    for line in text.split("\n")[:-1]:
        head, _, flags = line.partition("|")
        name, stamp, value = head.split(":")
        value, _, unit = value.partition("§")
        if set(",;:|.") & set(unit) or set(":|") & set(name):
            raise ValueError(line)
        point = value if flags == "t" else float(value)
        series.setdefault(name, []).append((float(stamp), point, unit))
    return series


def plotjuggler_json(text):
    """The UDP server of PlotJuggler with messages in JSON: an object a message;
    the number `timestamp` of the root is its time in seconds; every number is
    a point of the series of its path. Returns: by path, a list of points."""
    def refuse(word):
        raise ValueError(f"{word} is not JSON")

    series = {}
    for line in text.split("\n")[:-1]:
        message = json.loads(line, parse_constant=refuse)
        for key, value in message.items():
            if isinstance(value, (int, float)):
                series.setdefault("/" + key, []).append(
                    (float(message["timestamp"]), float(value)))
    return series


def plotjuggler_csv(text, time):
    """The CSV loader of PlotJuggler: the first line has the names, one column
    is chosen as time and must not go back; a column is of numbers or, if a cell
    is none, of strings. Returns: by name, a list of points."""
    names, *rows = [line.split(",") for line in text.split("\n")[:-1]]
    at = names.index(time)
    stamps = [float(row[at]) for row in rows]
    if any(len(row) != len(names) for row in rows) or stamps != sorted(stamps):
        raise ValueError("columns or time")
    series = {}
    for i, name in enumerate(names):
        cells = [row[i] for row in rows]
        if all(map(is_number, cells)):
            cells = [float(cell) for cell in cells]
        series[name] = list(zip(stamps, cells))
    return series


def is_number(cell):
    """Whether a reader of numbers takes it."""
    try:
        float(cell)
        return cell.strip() != ""
    except ValueError:
        return False


def shown_as_number(row, name):
    """What a form has that knows no words."""
    return MODES.index(row[name]) if name == "mode" else row[name]


def motion():
    """A run as rows of values by name, and a function that shows its frames in
    a form of `monitor`."""
    lines = output(*RUN, text=True).splitlines()[1:]
    stream = output(*RUN, "--format", "frames")
    rows = []
    for line in lines:
        *numbers, mode, choices = line.split(",")
        rows.append(dict(zip(NAMES, [*map(float, numbers), mode,
                                     int(choices)])))
    return rows, lambda form: output(RUN[0], "monitor", "-", "--as", form,
                                     input=stream).decode()


def of_board():
    """A stream of FORMAT=csv that a reader enters in the middle of a row, with
    the header again in it."""
    whole = output(program("float", "csv")).decode("ascii")
    return whole, whole[whole.index("\n", 200) - 5:] + whole


def test_arduino_plots_the_pairs_of_monitor():
    rows, shown = motion()
    _, messages = arduino(shown("plotter"))
    same(messages, [[(name, shown_as_number(row, name)) for name in PLOTTED]
                    for row in rows])


def test_run_and_monitor_write_the_same_pairs():
    _, shown = motion()
    same(output(*RUN, "--format", "plotter").decode(), shown("plotter"))


def test_a_board_writes_pairs_of_the_same_labels():
    """Beside its heartbeats."""
    whole = output(program("float", "plotter")).decode("ascii")
    _, messages = arduino(whole)
    rows = [pairs for pairs in messages if pairs[0][0] != "steps"]
    same(len(rows) > 40, True)
    same([row for row in rows if [name for name, _ in row] != PLOTTED], [])
    same(rows[0][0], ("r", 0.18))


def test_serial_studio_cannot_read_pairs():
    """The reason why there is CSV."""
    labels, rows = quick_plot(motion()[1]("plotter"))
    same([cell for row in rows for cell in row if cell is not None], [])
    same(len(labels), 1)


def test_serial_studio_plots_the_csv_of_a_board():
    whole, _ = of_board()
    labels, rows = quick_plot(whole)
    same(labels, NAMES)
    same([row[:4] for row in rows[:1]], [[0, 0.18, -0.03034, -1.037]])
    # A loop that is late drops records, and this one runs beside other tests.
    times = [row[0] for row in rows]
    same(set(times) <= {5 * n / 1000 for n in range(81)}, True)
    same((times, len(times) > 40), (sorted(set(times)), True))
    for row in rows:
        same((len(row), None in row), (10, False))
        same(row[8] in range(5) and 1 <= row[9] <= 5, True)


def test_serial_studio_has_rows_without_numbers_for_a_late_header():
    """Its labels come from the first row alone."""
    _, late = of_board()
    labels, rows = quick_plot(late[late.index("\n") + 1:])
    same(labels, [])
    same([row for row in rows if None in row], [[None] * 10])


def test_serial_studio_plots_the_csv_of_monitor_but_the_mode():
    rows, shown = motion()
    labels, got = quick_plot(shown("csv"))
    same(labels, NAMES)
    same(got, [[row[name] if name != "mode" else None for name in NAMES]
               for row in rows])


def test_arduino_learns_the_header_that_comes_again():
    whole, late = of_board()
    first = late.index("\n") + 1  # the plotter discards a first piece
    labels, messages = arduino(late[first:])
    same(labels, NAMES)
    same(messages[-81:], arduino(whole)[1])


def test_teleplot_plots_every_column_over_time():
    rows, shown = motion()
    series = teleplot(shown("teleplot"))
    same(list(series), NAMES[1:])
    same({name: points[0][2] for name, points in series.items()},
         dict(zip(NAMES[1:], ["m", "m/s", "rad/s", "m/s", "m/s", "N", "N m", "",
                              ""])))
    for name, points in series.items():
        same([(stamp, value) for stamp, value, _ in points],
             [(row["t"] * 1000, row[name]) for row in rows])


def test_plotjuggler_plots_json():
    rows, shown = motion()
    series = plotjuggler_json(shown("json"))
    for name in NAMES[1:]:
        same(series["/" + name],
             [(row["t"], shown_as_number(row, name)) for row in rows])


def test_plotjuggler_loads_csv():
    rows, shown = motion()
    series = plotjuggler_csv(shown("csv"), "t")
    for name in NAMES:
        same(series[name], [(row["t"], row[name]) for row in rows])
    whole, _ = of_board()
    same(len(plotjuggler_csv(whole.replace("\r", ""), "t")["mode"]), 81)


def test_decoder_in_python_rejects():
    """What is no frame under a right CRC, as test_frame.c has it for the core:
    another version, a wrong length, a distance that leads out, and one byte too
    many."""
    def piece(payload, version=2, longer=0):
        return sealed(stuffed(struct.pack(
            "<BBBIQ", version, 7, len(payload) + longer, 1, 2) + payload))
    same([decode.decode(piece(bytes(size))) for size in (0, 238)],
         [(7, 1, 2, bytes(size)) for size in (0, 238)])
    same([decode.decode(bad) for bad in (
        piece(b"", version=3), piece(b"1", longer=1), piece(b"1", longer=-1),
        sealed(b"\xff" + stuffed(bytes(15))[1:]), piece(bytes(240)), b"")],
         [None] * 6)


def test_decoder_is_quoted_in_the_protocol():
    document = (ROOT / "docs/PROTOCOL.md").read_text()
    path = "tools/board/protocol/decode.py"
    quoted = re.findall(rf"```python {path}\n(.*?)```\n", document, re.S)
    same(quoted, [(ROOT / path).read_text()])


def test_examples_of_the_protocol_decode():
    document = (ROOT / "docs/PROTOCOL.md").read_text()
    examples = re.findall(r"```hex (\S+)\n(.*?)```", document, re.S)
    same(len(examples) > 10, True)
    for name, digits in examples:
        if len(decode.frames(bytes.fromhex(digits))) != 1:
            sys.exit(f"{name} is not a frame")


main(globals(), jobs=4)
