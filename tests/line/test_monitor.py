#!/usr/bin/python3 -B
"""`run --format frames` and `monitor`: the rows of a decoded stream are those
of `run --format csv` byte for byte, and nothing else is taken for a stream.
What leaves the program is whole or says that it is not, and destroys nothing
that was there: streams that a line broke, that were cut or joined, summaries
that are lost, files that two programs or two options write."""
import fcntl
import json
import os
import re
import struct
import subprocess
import zlib
from pathlib import Path

from boards import RUN, chained, program, says
from decode import (HEARTBEAT, REPORT, SCHEMA, STATE, breaks, framed, frames,
                    runs, sealed, stuffed)
from outputs import says_each
from tap import (HEADER, ROOT, TWOFOLD, call, check, main, output, same,
                 until)


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
                  Path("live.part").read_text() == rows, "the rows",
                  run)
            run.terminate()
            same(run.wait(), 0)
    same(Path("live").read_text(), rows)
    for option in "--out", "--record":
        Path("kept.part").write_text("of a board")
        done = subprocess.run([TWOFOLD, "monitor", "-", "--format", "csv",
                               option, "kept"], input=stream, check=False,
                              capture_output=True)
        same(done.returncode, 3)
        check(b"kept.part has the rows of a command that" in done.stderr,
              str(done.stderr))
        same(Path("kept.part").read_text(), "of a board")


def test_streams_that_a_line_broke():
    stream, rows = recorded("chaos", "--t-end", "0.1")
    decodes(b"x" * 3000 + stream, rows, "1 too long", code=6)
    decodes(stream[:-1], rows, "0 lost, 0 broken")
    _, said = monitor(stream[5000:], "--format", "csv", code=6)
    check(" 0 without a match" not in said, said)
    decodes(stream[5000:], HEADER + "\n", code=6)


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
    says(said, "ends early")
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


def test_a_board_that_breaks_is_heard():
    """Also where its line comes in two blocks, and behind what only begins
    like it."""
    stream, rows = recorded("chaos", "--t-end", "0.01")
    line = "fault: bus at 08000106 cause 00008200"
    said = f"\0\r\nfault: \x80\r\r\n{line}\r\n\0".encode("latin1")
    for first in range(len(said)):
        decodes(stream + bytes(-(len(stream) + first) % 65536) + said, rows,
                f"stream: the board says: {line}\n",
                "stream: the board reported a fault", code=6)


def test_a_board_in_float():
    """Whatever this program is."""
    stream = examples("schema", "layout", "state", "report", "heartbeat")
    decodes(stream, HEADER + "\n0.099999994,0.18,-0.5,-1.037,0,-0.25,0.75,-0.2,"
            "stick-,2,stick-|pinned\n",
            "demo, scene chaos, float, dt = 0.0001 s",
            "1000 steps, 2 overruns, 93 ticks without a step, 3 frames dropped",
            "a step takes 5200 to 9100 ns", code=5)
    same(monitor(stream, code=5)[0], "")


def test_what_is_not_a_number_is_a_row():
    found = {frame[0]: frame[3] for frame in frames(
        examples("schema", "state", "report"))}
    report = bytearray(found[REPORT])
    report[8:12] = struct.pack("<f", float("nan"))
    got, said = monitor(
        framed(SCHEMA, 0, 1000, found[SCHEMA]) +
        framed(STATE, 1, 1000, found[STATE]) +
        framed(REPORT, 2, 1000, bytes(report)), "--format", "csv", code=6)
    says(said, "values     1 rows with one that is not finite, first at step "
         "1000")
    says(got, ",nan,.*stick-,2,stick-.pinned\n$")
    other = sealed(stuffed(struct.pack("<BBBIQ", 3, HEARTBEAT, 0, 0, 1000)))
    says(monitor(b"\0" + other + b"\0", code=4)[1], "stream: its protocol is "
         "version 3, here it is 5: rebuild the sender")


def test_what_is_not_understood():
    says(monitor(call("run", "chaos", "--t-end", "0.01")[0].encode(),
                 "--format", "csv", code=4)[1],
         "no frame of protocol version 5")
    monitor(b"", code=4)
    says_each("""
4 missing|missing: No such file or directory
2 |which file or device?
2 a b|
2 x --out y|only with --format
2 x --baud fast|
2 x --send strat|did you mean 'start'?""", "monitor")
    for bad in ("set:mu", "set:muu=1", "set:mu=1x", "select:rand",
                "select:random:x", "input:1,2,3", "input:1,2,3,4,5",
                "input:1,,3,4"):
        call("monitor", "x", "--send", bad, code=2)
    Path("stream").write_bytes(recorded("chaos", "--t-end", "0.1")[0])
    with open("/dev/full", "wb") as full:
        same(subprocess.call([TWOFOLD, "monitor", "stream", "--format", "csv"],
                             stdout=full, stderr=subprocess.DEVNULL), 4)


def flagged(*words):
    """The frames of a run, whose steps may be."""
    done = subprocess.run([*RUN, *words, "--format", "frames"],
                          capture_output=True, check=False)
    same(done.returncode in (0, 5), True)
    return done.stdout


def borders_of(stream):
    """Where a frame begins."""
    return [at + 1 for at in range(len(stream) - 1)
            if stream[at:at + 2] == b"\0\0"]


def test_a_run_that_was_cut_is_told():
    """At each border of frames, where nothing else is wrong: what is before it,
    and what is behind it without its beginning; and a run that comes twice.
    Their rows stay in the part, and what had the name keeps it."""
    words = ["--format", "csv", "--out", "rows"]
    stream = output(*RUN, "--every", "50", "--format", "frames")
    monitor(stream, *words, code=0)
    whole = Path("rows").read_bytes()
    same(whole.count(b"\n"), 12)
    borders = borders_of(stream)
    same(len(borders) > 20, True)
    for border in borders:
        said = monitor(stream[:border], *words, code=6)[1]
        # A state whose report is cut off is lost.
        check("ends early" in said or "were lost" in said, said)
        if border + 119 < len(stream):
            monitor(stream[border:], *words, code=6)
    says(monitor(stream + stream, *words, code=6)[1], "rows.part")
    monitor(b"", *words, code=4)
    same(Path("rows").read_bytes(), whole)
    said = monitor(stream[:borders[-1]], "--summary", "json", code=6)[1]
    same(json.loads(said.splitlines()[-1])["exit"], 6)


def saved(name, *words):
    """Words by which a run goes on from what is saved there."""
    output(*RUN[:-4], *words, "--save", name)
    return ["--scheme", "compensated", "--from", name]


def test_a_splice_is_told():
    """Two runs joined at one number, where no frame is missing: others by what
    they were asked for, or by the state that they go on from, and a part within
    a run. That its steps are flagged is said as well."""
    Path("table").write_text("t,torque\n0,0\n1,1e-3\n")
    begun = saved("begun", "--scheme", "compensated", "--t-end", "0", *RUN[-2:])
    text = Path("begun").read_text().replace("compensation-w 0",
                                             "compensation-w 1e-19")
    text = text[:text.index("crc32 ")]
    Path("other").write_text(f"{text}crc32 {zlib.crc32(text.encode()):08x}\n")
    for first, *others in (
            ([], ["--set", "r=0.2"], ["--set", "mu=0.9"],
             ["--accuracy", "1e-9"], ["--inputs", "table", "--between", "held"],
             ["--every", "2"], ["--select", "random:2"],
             ["--set", "rest=square"]),
            (["--accuracy", "1e-9"], ["--accuracy", "1e-10"], []),
            (begun, [*begun[:-1], "other"])):
        one, *others = [flagged(*more) for more in (first, *others)]
        same(len(runs(frames(one))), 1)
        for other in others:
            at = min(500, len(borders_of(other)) // 2)
            spliced = other[:borders_of(other)[at]] + one[borders_of(one)[at]:]
            same(len(runs(frames(spliced))), 2)
            _, said = monitor(spliced, "--format", "csv", "--out", "rows",
                              code=6)
            same(("more than one run" in said, Path("rows").exists(),
                  "\ndegraded " in said), (True, False, True))


def beating(*words):
    """A run with a heartbeat behind every 50th step, and where frames begin."""
    sent = []
    for kind, _, tick, payload in frames(output(*RUN, *words, "--format",
                                                "frames")):
        sent.append((kind, tick, payload))
        if kind == REPORT and tick % 50 == 0:
            sent.append((HEARTBEAT, tick, bytes(80) + struct.pack(
                "<II", *runs([(sent[0][0], 0, 0, sent[0][2])]), 0)))
    stream = chained(sent)
    return stream, [0, *borders_of(stream), len(stream)]


def test_frames_put_between_two_heartbeats_are_told():
    """Of another start: all but schema, layouts and the end of a run; one state
    with its report; and of a stream with many heartbeats one between two. The
    decoder in Python agrees."""
    def put(one, other, first, behind):
        (stream, at), (foreign, to) = one, other
        return (stream[:at[first]] + foreign[to[first]:to[behind]]
                + stream[at[behind]:])

    for spans in ((4, 1004, 0, 500), (600, 602, 0, 500)):
        one, other = ((stream, [0, *borders_of(stream)]) for stream in (
            output(*RUN, *more, "--format", "frames")
            for more in ([], ["--set", "r=0.2"])))
        spliced = put(one, other, *spans[:2])
        same((breaks(one[0]), breaks(spliced)), ([], [500]))
        monitor(one[0], code=0)
        _, said = monitor(spliced, code=6)
        same(f"between steps {spans[2]} and {spans[3]} frames" in said, True)
    one, other = beating(), beating("--set", "r=0.2")
    monitor(one[0], code=0)
    spliced = put(one, other, 4 + 2 * 120 + 2, 4 + 2 * 121 + 2)
    same((breaks(one[0]), breaks(spliced)), ([], [150]))
    _, said = monitor(spliced, "--format", "csv", "--out", "rows", code=6)
    same(("between steps 100 and 150 frames are of another run" in said,
          Path("rows").exists()), (True, False))
    # Where one is missing that is told, and the chain begins anew.
    cut = put(one, (b"", [0] * 999), 300, 302)
    same(breaks(cut), [])
    same("were lost" in monitor(cut, code=6)[1], True)


def test_another_session_is_another_start():
    """But for the first one of a start."""
    found = frames(output(*RUN, "--every", "50", "--format", "frames"))
    schema, beat = found[0][3], found[-1][3]
    for sessions, code in (((0, 7, 7), 0), ((7, 8), 6), ((7, 0), 6)):
        sent = [(SCHEMA, 0, schema[:13] + struct.pack("<I", session)
                 + schema[17:]) for session in sessions]
        monitor(chained([*sent, (HEARTBEAT, 0, beat)]), code=code)


def test_counts_are_those_since_the_first_heartbeat():
    """By the counts of the board, which go round, or begin again with it: of
    records that were dropped, and of ticks without a step."""
    stream = output(*RUN, "--every", "50", "--format", "frames")
    *sent, (kind, _, tick, _) = frames(stream)
    same((kind, tick), (HEARTBEAT, 500))
    sent = [(kind, tick, payload) for kind, _, tick, payload in sent]
    for counts, grows in (([3, 3, 3], 0), ([3, 3, 10], 1), ([100, 0], 0),
                          ([100, 0, 2], 1), ([2**32 - 1] * 2, 0),
                          ([2**32 - 2, 2], 1)):
        for where, code in ((3, 6), (15, 5)):
            beats = [(HEARTBEAT, 500, struct.pack(
                "<21I", 500, *(one * (at == where) for at in range(1, 20)),
                *runs(frames(stream)))) for one in counts]
            _, said = monitor(chained(sent + beats), "--summary", "json",
                              code=grows * code)
            same(json.loads(said.splitlines()[-1])["board"][
                "dropped" if where == 3 else "skipped"], counts[-1])


def test_an_interrupted_run_has_no_end():
    with subprocess.Popen([RUN[0], "run", "chaos", "--t-end", "1e6",
                           "--realtime", "--format", "frames"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          bufsize=0) as run:
        begun = run.stdout.read(2000)
        run.terminate()
        rest, said = run.communicate()
    same((run.returncode, b"interrupted" in said), (4, True))
    same("ends early" in monitor(begun + rest, code=6)[1], True)


def test_a_summary_that_is_lost_is_told():
    """/dev/full takes no byte: all was done, and nobody was told of it."""
    stream = output(*RUN, "--format", "frames")
    for words in (RUN[1:] + ["--out", "rows"], ["monitor", "-"],
                  ["monitor", "-", "--summary", "json"]):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([RUN[0], *words], input=stream, stderr=full,
                                  stdout=subprocess.DEVNULL, check=False)
        same((words, done.returncode), (words, 4))


def test_no_command_writes_what_it_reads_or_writes_twice():
    """Nor does a command that is refused so write anything."""
    Path("own.scene").write_bytes(output(RUN[0], "scene", "chaos"))
    Path("table").write_text("t,torque\n0,0\n1,0\n")
    output(*RUN, "--save", "stand")
    Path("frames").write_bytes(output(*RUN, "--format", "frames"))
    Path("link.scene").symlink_to("own.scene")
    Path("link").symlink_to("frames")
    for name in "own.scene", "table", "stand":
        Path(name + ".part").write_bytes(Path(name).read_bytes())
    before = {path: path.read_bytes() for path in Path(".").iterdir()}
    for words in ("run SCENE --out=./own.scene", "run SCENE --save own.scene",
                  "run link.scene --out own.scene",
                  "sweep SCENE --over mu=1:2:2 --outcome rest --out own.scene",
                  "regions SCENE --out own.scene",
                  "diverge SCENE --returns own.scene",
                  "run chaos --inputs TABLE --between held --out table",
                  "run chaos --from=STAND --out stand",
                  "diverge chaos --exits e --returns e.resume --resume",
                  "run chaos --out new --save ./new",
                  "monitor --format csv frames --out ./frames",
                  "monitor --format csv link --out frames",
                  "monitor --format csv frames --record frames",
                  "monitor --format csv frames --out new --record ./new"):
        for end in "", ".part":
            given = words.replace("SCENE", "own.scene" + end).replace(
                "TABLE", "table" + end).replace("STAND", "stand" + end)
            says(call(*given.split(), code=2)[1], "two files are needed")
    same({path: path.read_bytes() for path in Path(".").iterdir()}, before)
    for _ in range(2):  # a scene of the program, not a file
        output(*RUN, "--out", "chaos")


def board(**where):
    """A firmware of the host that ends by itself: its exit code and what it
    says. where: its environment."""
    done = subprocess.run([program("float", "csv")],
                          env={**os.environ, **where}, capture_output=True,
                          text=True, check=False)
    return done.returncode, done.stderr


def test_a_file_of_a_board_has_one_writer():
    with open("stream", "w+", encoding="ascii") as other:
        other.write("kept")
        other.flush()
        fcntl.lockf(other, fcntl.LOCK_EX)
        code, said = board(TWOFOLD_PORT="stream")
        same((code, said.splitlines()[0]),
             (4, "host: stream: Device or resource busy"))
        same(Path("stream").read_text(), "kept")
    same(board(TWOFOLD_PORT="stream")[0], 0)
    same(Path("stream").read_text()[:2], "t,")


def test_messages_of_a_board_are_not_in_its_stream():
    """Where standard error is closed, the line would get its number."""
    for closed in "2>&-", "2>&- <&-":
        code = subprocess.call(
            ["sh", "-c", f'"{program("float", "csv")}" {closed}'],
            env={**os.environ, "TWOFOLD_PORT": "stream"})
        same(code, 0)
        same("host:" in Path("stream").read_text(), False)


def test_lateness_of_a_board_is_whole_or_what_it_was():
    Path("late").write_text("kept")
    Path("late.part").mkdir()
    code, said = board(TWOFOLD_LATENESS="late", TWOFOLD_PORT="stream")
    same((code, "host: late.part: Is a directory" in said), (4, True))
    same(Path("late").read_text(), "kept")
    Path("late.part").rmdir()
    same(board(TWOFOLD_LATENESS="late", TWOFOLD_PORT="stream")[0], 0)
    same(Path("late").read_text().splitlines()[0], "us,began,ended")
    same(Path("late.part").exists(), False)


main(globals(), jobs=4)
