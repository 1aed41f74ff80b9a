#!/usr/bin/python3 -B
"""`run --format frames` and `monitor`: the rows of a decoded stream are those of
`run --format csv` byte for byte, what a line breaks is left out and counted,
and nothing else is taken for a stream. A run that was cut or repeated:
test_whole.py."""
import os
import re
import struct
import subprocess
from pathlib import Path

from boards import HEARTBEAT, REPORT, SCHEMA, STATE, says, sealed, stuffed
from decode import frames
from tap import ROOT, TWOFOLD, call, check, main, output, same, until

HEADER = "t,r,v,omega,h,g,F,M,mode,choices\n"


def monitor(stream, *words, code=0):
    """(rows, what is said) of a stream in a file."""
    Path("stream").write_bytes(stream)
    return call("monitor", "stream", *words, code=code)


def decodes(stream, rows, *said, code=0):
    got, text = monitor(stream, "--format", "csv", code=code)
    same(got, rows)
    says(text, *said)


def recorded(*words):
    """The same run as frames and as rows."""
    return (output(TWOFOLD, "run", *words, "--format", "frames"),
            call("run", *words)[0])


def examples(*names):
    """Of the document, as one stream."""
    text = (ROOT / "docs/PROTOCOL.md").read_text()
    return b"".join(bytes.fromhex(re.search(
        rf"```hex {name}\n(.*?)```", text, re.S)[1]) for name in names)


def test_whole_streams():
    scenes = call("scenes")[0].splitlines()
    for scene in [line.split()[0] for line in scenes]:
        decodes(*recorded(scene, "--t-end", "0.5", "--every", "3"),
                "0 lost, 0 broken, 0 too long")
    for words in (["3", "--scheme", "located", "--every", "100"], ["0"],
                  ["0.1", "--scheme", "compensated"],
                  ["3", "--select", "random:5", "--dt", "1e-3"]):
        stream, rows = recorded("chaos", "--t-end", *words)
        decodes(stream, rows)
        same(output(TWOFOLD, "monitor", "-", "--format", "csv",
                    input=stream).decode(), rows)
    schemas = [frames(recorded("chaos", "--t-end", "0", "--scheme", scheme)[0])
               [0][3] for scheme in ("moreau", "located", "compensated")]
    same([schema[3] for schema in schemas], [0, 1, 2])


def test_a_pipe_is_read_until_the_signal():
    """It has no end that anyone knows, and what was read of it is whole."""
    stream, rows = recorded("chaos", "--t-end", "0")
    os.mkfifo("pipe")
    with subprocess.Popen([TWOFOLD, "monitor", "pipe", "--format", "csv",
                           "--out", "live"], stderr=subprocess.DEVNULL) as run:
        with open("pipe", "wb", buffering=0) as pipe:
            pipe.write(stream)
            until(lambda: Path("live.part").exists() and
                  Path("live.part").read_text() == rows, "the rows")
            run.terminate()
            same(run.wait(), 0)
    same(Path("live").read_text(), rows)


def test_streams_that_a_line_broke():
    stream, rows = recorded("chaos", "--t-end", "0.1")
    decodes(b"x" * 3000 + stream, rows, "1 too long", code=6)
    decodes(stream[:-1], rows, "0 lost, 0 broken")
    _, said = monitor(stream[5000:], "--format", "csv", code=6)
    check(" 0 without a match" not in said, said)
    decodes(stream[5000:], HEADER, code=6)


def degraded(said):
    """Its line, whether it is of a run or of reports."""
    return re.search("^degraded .*", said, re.M)[0].replace(
        "first reported at", "first at")


def coarse(*words):
    """(frames, what is said) of a run of coarse steps."""
    words = ["run", "chaos", "--set", "k2=1e6", "--dt", "1e-3", *words,
             "--format", "frames", "--out", "frames"]
    said = call(*words, code=5)[1]
    says(said, " coarse, 0 stalled, 0 fell")
    return Path("frames").read_bytes(), degraded(said)


def without_end(stream):
    return stream[:stream.rindex(b"\0\0") + 1]


def test_steps_that_are_not_to_be_trusted():
    """The words and the exit code are those of the run, whether reports, the
    heartbeat at the end or both tell of them."""
    stream, words = coarse("--t-end", "0.1")
    said = monitor(stream, code=5)[1]
    says(said, "board      100 steps, 0 overruns")
    same(degraded(said), words)
    said = monitor(without_end(stream), "--format", "csv", "--out", "rows",
                   code=6)[1]
    says(said, "ends before its run")
    same(degraded(said), words)
    same(Path("rows.part").read_text().count("\n"), 102)
    said = monitor(examples("heartbeat"), code=5)[1]
    says(said, "4 steps; 1 coarse, 3 stalled, 0 fell back on moreau")
    check("first" not in said, said)
    # A board that stands still repeats its last row, which counts once.
    still = without_end(coarse("--t-end", "0.01", "--every", "5")[0])
    again = still[[at.start() for at in re.finditer(b"\0\0", still)][-2] + 1:]
    said = monitor(still + again, code=6)[1]
    says(said, "4 rows, 0 without a match", "1 restarts")
    same(degraded(said), degraded(monitor(still, code=6)[1]))


def test_a_board_in_float():
    """Whatever this program is."""
    stream = examples("schema", "layout", "state", "report", "heartbeat")
    decodes(stream, HEADER + "0.099999994,0.18,-0.5,-1.037,0,-0.25,0.75,-0.2,"
            "stick-,2\n", "demo, scene chaos, float, dt = 0.0001 s",
            "1000 steps, 2 overruns, 93 ticks without a step, 3 frames dropped",
            "a step takes 5200 to 9100 ns", code=5)
    same(monitor(stream, code=5)[0], "")


def test_what_is_not_a_number_is_a_row():
    def as_sent(number, kind, payload, version=4):
        body = struct.pack("<BBBIQ", version, kind, len(payload), number, 1000)
        return b"\0" + sealed(stuffed(body + payload)) + b"\0"
    found = {frame[0]: frame[3] for frame in frames(
        examples("schema", "state", "report"))}
    report = bytearray(found[REPORT])
    report[8:12] = struct.pack("<f", float("nan"))
    got, said = monitor(as_sent(0, SCHEMA, found[SCHEMA]) +
                        as_sent(1, STATE, found[STATE]) +
                        as_sent(2, REPORT, report), "--format", "csv", code=6)
    says(said, "values     1 rows with one that is not finite, first at step "
         "1000")
    says(got, ",nan,.*stick-,2\n$")
    says(monitor(as_sent(0, HEARTBEAT, b"", 3), code=4)[1], "stream: its "
         "protocol is version 3, here it is 4: build what sends it")


def test_what_is_not_understood():
    says(monitor(call("run", "chaos", "--t-end", "0.01")[0].encode(),
                 "--format", "csv", code=4)[1],
         "no frame of protocol version 4")
    monitor(b"", code=4)
    for words, code, text in (
            (["missing"], 4, "missing: No such file or directory"), ([], 2, ""),
            (["a", "b"], 2, ""), (["x", "--out", "y"], 2, "only with --format"),
            (["x", "--baud", "fast"], 2, ""),
            (["x", "--send", "strat"], 2, "did you mean 'start'\\?"),
            *((["x", "--send", bad], 2, "") for bad in (
                "set:mu", "set:muu=1", "set:mu=1x", "select:rand",
                "select:random:x", "input:1,2,3", "input:1,2,3,4,5",
                "input:1,,3,4"))):
        says(call("monitor", *words, code=code)[1], text)
    Path("stream").write_bytes(recorded("chaos", "--t-end", "0.1")[0])
    with open("/dev/full", "wb") as full:
        same(subprocess.call([TWOFOLD, "monitor", "stream", "--format", "csv"],
                             stdout=full, stderr=subprocess.DEVNULL), 4)


main(globals(), jobs=4)
