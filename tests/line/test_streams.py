#!/usr/bin/python3 -B
"""What goes over a line has the form that the documents of the tools ask for
which are to read it:
  plotter   the serial plotter of the Arduino IDE
            (ArduinoSerialPlotterProtocol.md): a message a line, of parts
            `label:value` between spaces, tabs or commas
  csv       Quick Plot of Serial Studio (Operation-Modes.md) and PlotJuggler's
            loader: names in the first line, commas alone separate
  teleplot  its README: A:B:C§D|E, the name, milliseconds, the value, the unit,
            and flags, of which t is a text
  json      the UDP server of PlotJuggler: an object a message, whose number
            `timestamp` is its time in seconds
And frames are what tools/board/protocol/decode.py takes for them."""
import json
import re
import struct

from boards import RUN, program
import decode
from decode import sealed, stuffed
from tap import HEADER, check, main, output, same

MODES = ["slip+", "slip-", "stick+", "stick-", "pinned"]
NAMES = HEADER.split(",")
PLOTTED = "r,v,omega,h,g,mode,choices,set".split(",")
SHOWN = NAMES[1:]
UNITS = dict(zip(SHOWN, ["m", "m/s", "rad/s", "m/s", "m/s", "N", "N m"] +
                 3 * [""]))


def shown_as_number(row, name):
    """What a form has that knows no words."""
    return MODES.index(row[name]) if name == "mode" else row[name]


def motion(form):
    """A run as rows of values by name, and its frames in a form of `monitor`,
    line by line."""
    lines = output(*RUN, text=True).splitlines()[1:]
    stream = output(*RUN, "--format", "frames")
    rows = []
    for line in lines:
        *numbers, mode, choices, set_ = line.split(",")
        rows.append(dict(zip(NAMES, [
            *map(float, numbers), mode, int(choices),
            sum(1 << MODES.index(name) for name in set_.split("|"))])))
    for row, report in zip(rows, [frame[3] for frame in decode.frames(stream)
                                  if frame[0] == 4], strict=True):
        same((row["set"], row["set"].bit_count()), (report[49], row["choices"]))
    shown = output(RUN[0], "monitor", "-", "--format", form,
                   input=stream).decode()
    check(output(*RUN, "--format", form).decode() == shown, "`run` has another")
    check(shown.endswith("\n"), "it does not end with its line")
    return rows, shown.split("\n")[:-1]


def test_frames_of_monitor_are_those_that_came():
    stream = output(*RUN, "--format", "frames")
    same(output(RUN[0], "monitor", "-", "--format", "frames", input=stream),
         stream)


def pairs_of(line):
    return [(label, float(value)) for label, value in
            (part.split(":") for part in line.split())]


def test_pairs_of_monitor_run_and_a_board():
    """Those of a board stand beside its heartbeats."""
    rows, lines = motion("plotter")
    same([pairs_of(line) for line in lines],
         [[(name, shown_as_number(row, name)) for name in PLOTTED]
          for row in rows])
    sent = output(program("float", "plotter")).decode("ascii").splitlines()
    rows = [pairs_of(line) for line in sent if not line.startswith("steps:")]
    same((len(rows) > 40, rows[0][0]), (True, ("r", 0.18)))
    same([row for row in rows if [name for name, _ in row] != PLOTTED], [])


def test_teleplot_has_every_column_over_time():
    rows, lines = motion("teleplot")
    series = {}
    for line in lines:
        name, stamp, value, unit, flags = re.fullmatch(
            r"(\w+):([^:]+):([^:§|]+)(?:§([^,;:|.]*))?(?:\|(\w+))?",
            line).groups()
        same(unit or "", UNITS[name])
        series.setdefault(name, []).append(
            (float(stamp), value if flags == "t" else float(value)))
    same(series, {name: [(row["t"] * 1000, row[name]) for row in rows]
                  for name in SHOWN})


def test_json_has_every_column_over_time():
    def refuse(word):
        raise ValueError(f"{word} is not JSON")

    rows, lines = motion("json")
    for row, line in zip(rows, lines, strict=True):
        message = json.loads(line, parse_constant=refuse)
        same(message["timestamp"], row["t"])
        same([message[name] for name in SHOWN],
             [shown_as_number(row, name) for name in SHOWN])


def test_csv_of_a_board():
    """That of `monitor` has the bytes of `run` (test_monitor.py)."""
    sent = output(program("float", "csv")).decode("ascii")
    header, *rows = [line.split(",") for line in sent.split("\r\n")[:-1]]
    same((header, rows[0][:4]), (NAMES, ["0.000000", "0.18", "-0.03034",
                                         "-1.037"]))
    # A loop that is late drops records, and this one runs beside other tests.
    times = [float(row[0]) for row in rows]
    same(set(times) <= {5 * n / 1000 for n in range(81)}, True)
    same((times, len(times) > 40), (sorted(set(times)), True))
    for row in rows:
        same((len(row), float(row[8]) in range(5)), (11, True))
        same(int(row[10]).bit_count(), int(row[9]))


def test_decoder_in_python_rejects():
    """What is no frame under a right CRC, as test_frame.c has it for the core:
    another version, a wrong length, a distance that leads out, and one byte too
    many."""
    def piece(payload, version=5, longer=0):
        return sealed(stuffed(struct.pack(
            "<BBBIQ", version, 7, len(payload) + longer, 1, 2) + payload))
    same([decode.decode(piece(bytes(size))) for size in (0, 238)],
         [(7, 1, 2, bytes(size)) for size in (0, 238)])
    same([decode.decode(bad) for bad in (
        piece(b"", version=3), piece(b"1", longer=1), piece(b"1", longer=-1),
        sealed(b"\xff" + stuffed(bytes(15))[1:]), piece(bytes(240)), b"")],
         [None] * 6)


def test_layouts_describe_their_payloads():
    """Names, types and, for a number with a unit, what to multiply it by."""
    sizes = {"real": 8, "u8": 1, "i8": 1, "u32": 4}
    found = decode.frames(output(*RUN, "--format", "frames"))
    lengths = {kind: len(payload) for kind, _, _, payload in found}
    layouts = {payload[0]: [(field if "," in field else field + ",u32").split(
        ",") for field in payload[1:].decode().split(";")]
               for kind, _, _, payload in found if kind == 2}
    same({kind: sum(sizes[field[1]] for field in fields)
          for kind, fields in layouts.items()},
         {kind: lengths[kind] for kind in (3, 4, 6)})
    same([field for fields in layouts.values() for field in fields
          if len(field) not in (2, 4) or len(field) == 4 and
          not float(field[2]) > 0], [])


main(globals(), jobs=4)
