#!/usr/bin/python3 -B
"""What leaves the program is whole or says that it is not, and destroys nothing
that was there: streams of runs that were cut or joined, rows of them, summaries
that are lost, files that two programs or two options write."""
import fcntl
import json
import os
import struct
import subprocess
from pathlib import Path

from boards import HEARTBEAT, RUN, framed, program
from decode import frames
from tap import main, output, same


def judged(stream, *words, code):
    """What `monitor` says on standard error of a stream from a pipe."""
    done = subprocess.run([RUN[0], "monitor", "-", *words], input=stream,
                          capture_output=True, check=False)
    same(done.returncode, code)
    return done.stderr.decode()


def refused(*words):
    """Of a command whose files are not two."""
    done = subprocess.run([RUN[0], *words], capture_output=True, text=True,
                          check=False)
    same((words, done.returncode), (words, 2))
    same("two files are needed" in done.stderr, True)


def borders_of(stream):
    """Where a frame begins."""
    return [at + 1 for at in range(len(stream) - 1)
            if stream[at:at + 2] == b"\0\0"]


def test_a_run_that_was_cut_is_told():
    """At each border of frames, where nothing else is wrong."""
    stream = output(*RUN, "--every", "50", "--format", "frames")
    judged(stream, code=0)
    borders = borders_of(stream)
    same(len(borders) > 20, True)
    for border in borders:
        said = judged(stream[:border], code=6)
        # A state whose report is cut off is lost.
        same("ends before its run" in said or "were lost" in said, True)
    summary = judged(stream[:borders[-1]], "--summary", "json", code=6)
    same(json.loads(summary.splitlines()[-1])["exit"], 6)


def test_more_than_one_run_is_told():
    """Repeated, one after the other, and the second one behind a part."""
    one = output(*RUN, "--every", "50", "--format", "frames")
    other = output(*RUN, "--every", "100", "--format", "frames")
    for stream in one + one, one + other, other + one:
        same("more than one run" in judged(stream, code=6), True)
    half = one[:one.index(b"\0\0", len(one) // 2) + 1]
    same("more than one run" in judged(half + other, code=6), True)


def test_counts_are_those_since_the_first_heartbeat():
    """By the counts of the board, which go round, or begin again with it: of
    records that were dropped, and of ticks without a step."""
    stream = output(*RUN, "--every", "50", "--format", "frames")
    last = framed(*frames(stream)[-1])
    same((stream.endswith(last), last[0]), (True, 0))
    number = frames(stream)[-1][1]
    for counts, grows in (([3, 3, 3], 0), ([3, 3, 10], 1), ([100, 0], 0),
                          ([100, 0, 2], 1), ([2**32 - 1] * 2, 0),
                          ([2**32 - 2, 2], 1)):
        for where, code in ((3, 6), (15, 5)):
            beats = [framed(HEARTBEAT, number + i, 500, struct.pack(
                "<16I", 500, *(one * (at == where) for at in range(1, 16))))
                     for i, one in enumerate(counts)]
            said = judged(stream.removesuffix(last) + b"".join(beats),
                          "--summary", "json", code=grows * code)
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
    same("ends before its run" in judged(begun + rest, code=6), True)


def test_a_summary_that_is_lost_is_told():
    """/dev/full takes no byte: all was done, and nobody was told of it."""
    stream = output(*RUN, "--format", "frames")
    for words in (RUN[1:] + ["--out", "rows"], ["monitor", "-"],
                  ["monitor", "-", "--summary", "json"]):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([RUN[0], *words], input=stream, stderr=full,
                                  stdout=subprocess.DEVNULL, check=False)
        same((words, done.returncode), (words, 4))


def test_rows_of_a_part_do_not_get_the_name():
    """What was there stays, and the rows are in the part."""
    stream = output(*RUN, "--every", "50", "--format", "frames")
    cut = stream[:stream.index(b"\0\0", len(stream) // 2) + 1]
    for broken in b"", cut, stream + stream, stream[len(stream) // 2:]:
        Path("rows").write_text("kept")
        said = judged(broken, "--csv", "--out", "rows",
                      code=6 if broken else 4)
        same(Path("rows").read_text(), "kept")
        same("rows.part" in said or not Path("rows.part").exists(), True)
    judged(stream, "--csv", "--out", "rows", code=0)
    same(Path("rows").read_bytes().count(b"\n"), 12)


def test_no_command_writes_what_it_reads():
    Path("own.scene").write_bytes(output(RUN[0], "scene", "chaos"))
    Path("table").write_text("t,torque\n0,0\n1,0\n")
    output(*RUN, "--save", "stand")
    Path("link.scene").symlink_to("own.scene")
    for name in "own.scene", "table", "stand":
        Path(name + ".part").write_bytes(Path(name).read_bytes())
    before = {path: path.read_bytes() for path in Path(".").iterdir()}
    for end in "", ".part":
        scene, table, stand = "own.scene" + end, "table" + end, "stand" + end
        refused("run", scene, "--out", "own.scene")
        refused("run", scene, "--out=./own.scene")
        refused("run", scene, "--save", "own.scene")
        refused("run", "link.scene", "--out", "own.scene")
        refused("sweep", scene, "--over", "mu=1:2:2", "--outcome", "rest",
                "--out", "own.scene")
        refused("regions", scene, "--out", "own.scene")
        refused("diverge", scene, "--counts", "own.scene")
        refused("run", "chaos", "--inputs", table, "--between", "held",
                "--out", "table")
        refused("run", "chaos", "--from=" + stand, "--out", "stand")
        refused("merge", "table", stand, "--out", "stand")
    refused("diverge", "chaos", "--counts", "e", "--returns", "e.resume",
            "--resume")
    refused("run", "chaos", "--out", "new", "--save", "./new")
    same({path: path.read_bytes() for path in Path(".").iterdir()}, before)
    output(*RUN, "--out", "chaos")  # a scene of the program, not a file
    output(*RUN, "--out", "chaos")


def test_no_file_is_written_twice():
    stream = output(*RUN, "--format", "frames")
    Path("frames").write_bytes(stream)
    Path("link").symlink_to("frames")
    for words in (["frames", "--out", "./frames"], ["link", "--out", "frames"],
                  ["frames", "--record", "frames"],
                  ["frames", "--out", "new", "--record", "./new"]):
        refused("monitor", "--csv", *words)
        same(Path("frames").read_bytes() == stream, True)
        same(Path("new").exists(), False)


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
