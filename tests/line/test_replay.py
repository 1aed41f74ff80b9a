#!/usr/bin/python3 -B
"""The session of a board is replayed on the host to the bit: every row that the
board sent is a row of the replay, and a replay that is saved and gone on with
has the bits of a longer one, with what commands have left in effect. Records of
a board have commands while it runs; others are made here, of any commands at
any step."""
import json
import re
import signal
import struct
import subprocess
import zlib
from pathlib import Path

from boards import FIRMWARE, Board
from decode import PARAMETERS, frames
from outputs import lines_of, says, says_each
import tap
from tap import ROOT, TWOFOLD, check, main, output, same, until

RULES = ["persist", "slip+", "slip-", "random"]


def call(*words, code=0):
    """Of a run that may have degraded steps, where no other code is asked
    for."""
    return tap.call(*words, code=code or (0, 5))


def told(*words):
    """The summary of a command."""
    return json.loads(call(*words, "--summary", "json")[1].splitlines()[-1])


def real(*values):
    return struct.pack(f"<{len(values)}d", *values)


def bits32(*values):
    return struct.pack(f"<{len(values)}I", *values)


# Commands: their types and data.
def hold(*values):
    return 0x41, real(*values)


def put(name, value):
    return 0x42, bytes([PARAMETERS.index(name)]) + real(value)


def select(rule, seed=0):
    return 0x43, bytes([RULES.index(rule)]) + bits32(seed)


def deadman(steps):
    return 0x4B, bits32(steps)


AGAIN, GO, RESET, SNAPSHOT, RESTORE = (
    (0x41, b""), (0x44, b""), (0x46, b""), (0x47, b""), (0x48, b""))


def sent(*words, out="frames"):
    """The frames of a run."""
    call("run", *words, "--format", "frames", "--out", out)
    return frames(Path(out).read_bytes())


def seal(path, lines):
    """Writes a table with the last line that its rows ask for."""
    text = "".join(f"{line}\n" for line in lines)
    Path(path).write_text(
        f"{text}# {len(lines) - 1} rows, crc32 "
        f"{zlib.crc32(text.encode()):08x}\n", "ascii")


def record(path, schema, *rows):
    """Writes a record of commands: (step, (type, data)) each."""
    seal(path, ["tick,type,data,command",
                f"0,01,{schema.hex()},schema of version 5",
                *(f"{tick},{kind:02x},{data.hex()},-"
                  for tick, (kind, data) in rows)])


def began(*rows, options=()):
    """Records commands to a run of chaos. Returns: the words of its replay."""
    record("one.record", sent("chaos", "--t-end", "0", *AT, *options)[0][3],
           *rows)
    return ["run", "chaos", *AT, "--replay", "one.record"]


def joined(scene, commands, end, *words, now="", stands=None, every=1):
    """A replay of commands and from there a run to the step `end`, beside a
    replay that reaches that step itself.
    now: the options of what the commands leave in effect. stands: the step at
    which they do."""
    schema = sent(scene, "--t-end", "0", *words)[0][3]
    record("one.record", schema, *commands)
    record("two.record", schema, *commands, (end, GO))
    rate = ["--every", every]
    call("run", scene, *words, *rate, "--replay", "two.record", "--save",
         "end", "--out", "want")
    got = told("run", scene, *words, *rate, "--replay", "one.record", "--save",
               "at", "--out", "one")
    check((got["replay"]["commands"], got["replay"]["changes"])
          == (len(commands), now), got)
    stands = commands[-1][0] if stands is None else stands
    check(f"tick {stands}\n" in Path("at").read_text("ascii"), stands)
    if "dt=" in now:
        words = [word for word in words if word not in ("--dt", DT)]
    call("run", scene, *words, *now.split(), *rate, "--from", "at", "--t-end",
         end * float(now.partition("dt=")[2].split()[0] if "dt=" in now
                     else DT), "--save", "again", "--out", "two")
    check(Path("again").read_bytes() == Path("end").read_bytes(),
          "it ends in another state")
    one, two, want = map(lines_of, ("one", "two", "want"))
    if "dt=" in now:  # the time of a row is its step times the first dt
        one, two, want = ([row.partition(",")[2] for row in rows]
                          for rows in (one, two, want))
    if stands % every > 0:
        del one[-1]
    check(one + two[2:] == want, "other rows")
    return got


DT = "0.001"
AT = ("--dt", DT)


def test_inputs_hold_and_expire():
    """Where it is saved they hold, hold without end, or have expired."""
    drive = hold(-1.4, 0.12, 0.3, -0.02, 0.1)
    for scene in ("chaos", "driven"):
        for limit, left in ((900, 600), (0, 0), (300, 0), (299, None),
                            (1, None)):
            got = joined(scene, [(100, deadman(limit)), (200, drive),
                                 (500, GO)], 2000, *AT)["held"]
            check(got["source"] == ("safe" if left is None else "outside"), got)
            check(got["left"] == (left or 0), got)
        got = joined(scene, [(200, drive), (400, AGAIN), (500, GO)], 2000, *AT)
        check("held" not in got, got)


def test_inputs_expire_by_the_clock_of_the_board():
    """Of which the steps that are left may be fewer: where they end is told."""
    drive, early = hold(-1.4, 0.12, 0.3, -0.02, 0.1), (0x09, bits32(1))
    for left in 1, 200, 299:
        replay = began((100, deadman(300)), (200, drive), (200 + left, early),
                       (600, GO))
        sources = [data[-1] for kind, _, _, data in sent(*replay[1:])
                   if kind == 4]
        check(sources == [0] * 201 + [1] * left + [2] * (400 - left), sources)
    for rows in ([], [(100, deadman(0)), (200, drive)],
                 [(100, deadman(5)), (200, drive)]):
        text = call(*began(*rows, (300, early), (600, GO)), code=4)[1]
        check("inputs expire that are not in effect" in text, text)


def test_alpha_acts_on_one_step():
    """A turntable that is moved step by step moves as in a table; a command
    that is lost or late leaves it where it is, and the next one makes up for
    that by a jump. All numbers are sums of powers of two."""
    parts, slope, count = 1024, 0.25, 400
    r0 = float(re.search(r"^r0 +(\S+)", call("scene", "chaos")[0], re.M)[1])

    def speed(step):
        return -1 + slope * step / parts

    def command(step, tick=None):
        return (step if tick is None else tick,
                hold(speed(step + 1), r0, 0, 0, slope))

    steps = list(range(count))
    every = [command(n) for n in steps]
    late = [command(200, 203) if n == 203 else command(n)
            for n in steps if n not in (200, 201, 202)]
    lost = [command(n) for n in steps if n not in (100, 101)]
    for scheme in ("moreau", "located"):
        words = ["chaos", "--dt", 1 / parts, "--scheme", scheme]
        schema = sent(*words, "--t-end", "0")[0][3]
        for commands, rows in (
                (every, []),
                (late, [(200, 200), (203, 200), (204, 201), (204, 204)]),
                (lost, [(100, 100), (102, 100), (102, 102)])):
            record("moved.record", schema, *commands, (count, GO))
            call("run", *words, "--replay", "moved.record", "--out", "got")
            Path("moved.csv").write_text("t,omega0\n" + "".join(
                f"{t / parts!r},{speed(at)!r}\n"
                for t, at in ((0, 0), *rows, (count, count))))
            call("run", *words, "--t-end", count / parts, "--inputs",
                 "moved.csv", "--between", "linear", "--out", "want")
            same(lines_of("got"), lines_of("want"))


def test_parameters_and_rule_stay():
    """What commands have changed is told, in words that go on with it."""
    changes = [(50, put("kappa", 0.5)), (60, put("mu", 1.25)),
               (200, put("rate", 64.0)), (300, select("random", 7))]
    said = "--set mu=1.25 --set kappa=0.5 --set rate=64 --select random:7"
    for scheme in ("moreau", "located"):
        got = joined("chaos", changes, 2500, *AT, "--scheme", scheme, now=said)
        check((got["rule"], got["seed"]) == ("random", 7), got)
        check(got["replay"]["began_with"] != got["parameters"], got)
    # What is as it was in the end is not told, nor a seed without its rule.
    old = dict(re.findall(r"^(\w+) +(\S+)", call("scene", "chaos")[0], re.M))
    undo = [(400, put(name, float(old[name])))
            for name in ("kappa", "mu", "rate")]
    joined("chaos", [*changes, *undo, (430, select("persist"))], 2500, *AT)
    joined("chaos", [(50, select("slip-"))], 2500, *AT, now="--select slip-")
    joined("chaos", [(100, put("dt", 0.5 ** 10))], 2500, *AT,
           now="--set dt=0.0009765625")
    text = call("run", "chaos", *AT, "--replay", "one.record")[1]
    check("which now needs --set dt=0.0009765625\n" in text, text)
    text = call(*began(*changes))[1]
    check("rule random:7, exit rate 64 /s\n" in text, text)


def test_steps_go_back():
    """After a restore or a reset the state is another one, and so is the
    report that it is saved with: its first row has the state's h and g."""
    back = [(400, SNAPSHOT), (900, hold(-1.4, 0.1, 0.2, 0, 0)), (1000, RESTORE)]
    joined("chaos", [back[0], back[2]], 3000, *AT, stands=400)
    row = lines_of("two")[1].split(",")
    plain = call("run", "chaos", *AT, "--t-end", "0.4")[0].splitlines()[-1]
    check(row[:6] + row[8:] == plain.split(",")[:6] + plain.split(",")[8:],
          f"{row} is not {plain}")
    joined("chaos", back, 3000, *AT, stands=400)
    joined("chaos", [(2300, RESET)], 3000, *AT, stands=0)
    events = told("run", "chaos", *AT, "--replay", "two.record", "--out",
                  "want", "--events", "all")["events"]["list"]
    check(all(round(event["t"], 4) != 2.301 for event in events),
          "the step back to the start is no change of mode")


def test_other_inputs_are_told():
    """Going on under a table in place of inputs by a command is told."""
    Path("table.csv").write_text("t,force\n0,0\n", "ascii")
    replay = began((100, hold(-1, 0.1, 0.5, 0, 0)), (200, GO))
    text = call(*replay, "--save", "at")[1]
    check("inputs     by a command: omega0 = -1 rad/s" in text, text)
    words = ["run", "chaos", *AT, "--from", "at", "--t-end", "0.3"]
    check("by a command" in call(*words)[1], "they do not hold")
    text = call(*words, "--inputs", "table.csv", "--between", "held")[1]
    check("with inputs by a command, and continues with --inputs" in text, text)
    check("inputs     by a command" not in text, text)


def test_start_is_that_of_the_record():
    """Another start or seed would be another motion, and is refused."""
    words = began((100, GO), options=["--select", "random:7"])
    call(*words, "--select", "random")
    call(*words, "--select", "random:7")
    text = call(*words, "--select", "random:8", code=3)[1]
    check("--replay one.record: the seed is 7 there and 8 here" in text, text)
    text = call(*words, "--select", "random", "--set", "r=0.2", code=2)[1]
    check("--set r=0.2: --replay one.record gives the state" in text, text)


def test_records_are_told_apart():
    """In the hash of the run, although they begin with the same frames."""
    found = [sent(*began((100, GO), (end, GO))[1:])[0][3][25:29]
             for end in (200, 201, 200)]
    check(found[0] == found[2] != found[1], found)


def test_frames_say_what_holds():
    """A schema follows each change, and reports tell whose inputs they had."""
    replay = began((100, put("kappa", 0.5)), (150, deadman(20)),
                   (200, hold(-1, 0.1, 0.5, 0, 0)), (300, select("random", 9)))
    got = sent(*replay[1:])
    plain = told(*replay, "--out", "rows")
    schemas = [(tick, data) for kind, _, tick, data in got if kind == 1]
    check([tick for tick, _ in schemas] == [0, 100, 150, 300], schemas)
    check([struct.unpack_from("<II", data, 5) for _, data in schemas][-1]
          == (9, int(plain["parameters"], 16)), schemas)
    sources = [data[-1] for kind, _, tick, data in got if kind == 4]
    check(sources == [0] * 201 + [1] * 20 + [2] * 80, sources)
    call("monitor", "frames", "--format", "csv", "--out", "read")
    check(Path("read").read_bytes() == Path("rows").read_bytes(),
          "monitor reads other rows")


SENT = ["input:-1.5,0.12,0.2,-0.01", "set:kappa=0.3", "deadman:50",
        "input:-0.7,0.1,0,0", "snapshot", "select:random:7", "set:mu=1.25",
        "stop", "start", "restore", "input", "set:mu=-1", "set:rate=100"]


def session():
    """Each command waits for the answer to the one before; the record goes on
    until the rows do. Returns: the exit code of monitor and what it says."""
    with Board("double") as board, open("told", "wb") as said:
        monitor = subprocess.Popen(
            [TWOFOLD, "monitor", board.name, "--format", "csv", "--out", "rows",
             "--record", "record",
             *(word for one in SENT for word in ("--send", one))],
            stderr=said, stdin=subprocess.DEVNULL)

        def answered():
            return b"set:rate=100: took effect" in Path(
                "told").read_bytes() and \
                Path("rows.part").read_bytes().count(b"\n") > 1500
        until(answered, "all commands are answered", monitor)
        monitor.send_signal(signal.SIGINT)
        return monitor.wait(), Path("told").read_text()


def test_session_of_a_board():
    """When a step passes by h = g = 0 depends on the commands."""
    for _ in range(5):
        for part in Path().glob("*.part"):
            part.unlink()  # of a try that has lost frames
        code, text = session()
        if Path("record").exists():
            break  # a busy computer may lose frames, and keeps none then
    same(code, 3)  # one is refused
    check("set:mu=-1: refused" in text, text)
    lines = lines_of("record")
    same(len([line for line in lines if re.match(r"\d+,4[0-9a-f],", line)]), 12)
    check(any(re.search(",03,.*,state$", line) for line in lines), "no state")
    expired = sum(",09," in line for line in lines)
    check(re.fullmatch(fr"# {14 + expired} rows, crc32 [0-9a-f]{{8}}",
                       lines[-1]), lines[-1])
    text = call("run", "chaos", *AT, "--replay", "record", "--save", "at",
                "--out", "again")[1]
    check("record: 12 commands took effect, 1 states" in text, text)
    # The first row is the start, which a board does not send.
    rows, again = lines_of("rows")[1:], lines_of("again")[1:]
    same(sorted(set(rows) - set(again))[:2], [])
    check(len(set(rows)) > 1000, "not enough rows")
    last = again[-1].split(",")[0]
    same([row for row in rows if row.split(",")[0] == last][-1], again[-1])
    needs = re.search("which now needs(.*)", text)[1].split()
    out = call("run", "chaos", *AT, *needs, "--from", "at", "--t-end", "60")[0]
    same(out.splitlines()[1], again[-1])
    wrong_records(lines)


def refused(path, rows, code, texts):
    """No run replays a record with these rows."""
    seal(path, rows)
    says(code, texts, "run", "chaos", *AT, "--replay", path)


def wrong_records(lines):
    """Every row counts, nothing may follow, and what is not the session is
    found out."""
    words = ["run", "chaos", *AT, "--replay"]
    whole = Path("record").read_bytes()
    for i in range(1, len(lines)):
        Path("short").write_text("".join(f"{line}\n" for line in lines[:i]))
        says(*((2, "not from") if i < 3 else (3, "cut off or changed")),
             *words, "short")
    for wrong in whole[:-20], whole + whole:
        Path("short").write_bytes(wrong)
        says(3, "cut off or changed", *words, "short")
    call(*words[:-1], "--out", "plain")
    same(lines_of("plain") == lines_of("again"), False)
    rows = lines[1:-1]  # without the comment
    seal("other", rows)
    call(*words, "other")
    # Inputs that are not held do not expire either, where the board was late.
    refused("other", [row for row in rows if "input:-1.5" not in row], 4,
            "other: row")
    says_each(f"""
3 chaos --dt 1e-4 --replay record|of the board have the hash&--dt 1/RATE
3 chaos --dt {DT} --replay record --scheme located|of the board is moreau
3 coulomb --dt {DT} --replay record|have the hash
2 chaos --dt {DT} --replay record --t-end 1|not with --t-end
2 chaos --dt {DT} --replay record --from x|not with --from
2 chaos --dt {DT} --replay rows|rows:1: not from
2 chaos --dt {DT} --replay none|none: No such file""", "run")
    refused("bad", [row.replace(" of version 5", "") for row in rows], 3,
            "'schema', here it is 'schema of version 5': record the session "
            "again")
    refused("bad", [row.replace(",44,,start", ",44,0g,start") for row in rows],
            2, "bad:&not from")
    refused("bad", [re.sub("^[0-9]*(,42.*kappa)", r"0\1", row)
                    for row in rows], 3,
            "bad: row 2 is at step 0, when the board has taken")
    # More steps than there are, whose sum passes 2^64.
    refused("bad", rows[:2] + 4 * ["9000000000000000000,46,,reset"], 3,
            "bad: more than 1e15 steps")
    # A zero hides what follows it from most readers.
    Path("bad").write_bytes(whole.replace(b",stop\n", b",st\0op\n"))
    says(2, "bad:&not from", *words, "bad")


def test_firmware_of_a_scene_in_a_file():
    """It has the motion of `run` with the same file. 5: at this dt some steps
    miss their tolerance."""
    firmware = Path(FIRMWARE).parent / "own.scene-double/firmware-own.elf"
    for _ in range(5):
        Path("frames").write_bytes(output(firmware))
        said = call("monitor", "frames", "--format", "csv", "--out", "got",
                    code=(5, 6))[1]
        if Path("got").exists():
            break  # a busy computer may drop frames
    check("scene own" in said, said)
    said = call("run", ROOT / "tests/data/own.scene", *AT, "--t-end", "2",
                "--out", "want", code=5)[1]
    check("scene      own" in said, said)
    same(Path("got").read_bytes(), Path("want").read_bytes())


main(globals(), jobs=4)
