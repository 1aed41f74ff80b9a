#!/usr/bin/python3 -B
"""A controller in one process (`hil`), the host port's firmware in another, a
pseudo-terminal between them: the closed loop is that of a pure run, in real
time and in lockstep, and a loop that is not is found out. Then over a line that
repeats or loses frames: between both stands a relay that knows where frames
begin."""
import functools
import itertools
import re
import resource
import signal
import subprocess
import sys
from pathlib import Path

from boards import BUILD, REALS, Board, relayed, says
from decode import ANSWER, INPUT, REPORT, STATE, STOP
from starts import keyed
from tap import ROOT, call, check, run, same

STEPS = ["--steps", "600", "--every", "10"]
# The dead-man counts ticks of a clock, also while the board has no processor.
LOCKSTEP = [*STEPS, "--lockstep", "--deadman", "0"]
REAL = REALS[0]


def hil(real=REAL):
    return str(BUILD / real / "hil")


def drive(line, *words, real=REAL, code=0, **options):
    """What the loop says."""
    return "".join(call(line, *words, program=hil(real), code=code, **options))


def rows(path):
    return Path(path).read_bytes()


def in_real_time(real):
    with Board(real) as board:
        for said, words in (("states .* inputs: the same bits", []),
                            ("[1-9][0-9]* late", ["--delay", "0"])):
            says(drive(board.name, *STEPS, *words, real=real), said)


def no_room():
    """Files end after 4 kB."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


def shown(said, indent=""):
    """The lines of a loop, without the numbers of `line`, which hang on when
    bytes come."""
    heads = "board|loop|inputs|line|control|host"
    lines = re.findall(rf"^{indent}((?:{heads}) .*)", said, re.M)
    # Heartbeats come by the clock: a short loop may end before the first.
    return [re.sub(r"\d+", "N", line.partition(";")[0])
            if line.startswith("line ") else line for line in lines]


def in_lockstep(real):
    """It depends on no clock, and docs/PORTS.md shows it. Without room for the
    rows, those of before stay, and the loop says so."""
    with Board(real) as board:
        said = drive(board.name, *LOCKSTEP, real=real)
        if real == "float":
            page = (ROOT / "docs/PORTS.md").read_text().partition("\n| exit")[0]
            same(shown(page, " {4}"), shown(said))
        for name, more in (("one", []), ("again", []),
                           ("other", ["--silent", "200"])):
            says(drive(board.name, *LOCKSTEP, *more, "--csv", name, real=real),
                 "without end, expired 0 times")
        same(rows("one") == rows("again"), True)
        same(rows("one") == rows("other"), False)
        says(drive(board.name, *LOCKSTEP, "--csv", "again", real=real, code=4,
                   preexec_fn=no_room), "again: File too large")
        same(rows("one") == rows("again"), True)


def silent_controller(real, *how):
    """Its last input expires, here as in the twin; on a busy computer, which
    stops the board or delivers inputs late, earlier ones may as well."""
    with Board(real) as board:
        says(drive(board.name, *STEPS, *how, "--silent", "200", "--deadman",
                   "100", real=real), r"for 100 ticks, expired [1-9]\d* times")


def stopped_board(real):
    """By whose clock inputs expire in fewer steps, one or many of them."""
    with Board(real) as board, subprocess.Popen(
            [hil(real), board.name, *STEPS, "--silent", "300", "--deadman",
             "200"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True) as process:
        while process.poll() is None:
            board.stop_a_while()
        said = process.stdout.read()
    check(process.returncode == 0, said)
    says(said, "held for 200 ticks, expired [1-9][0-9]* times")
    says(said, "the board: .*[1-9][0-9]* ticks without a step")


def inputs_that_never_come_in_time(real):
    with Board(real) as board:
        says(drive(board.name, *STEPS[:3], "20", "--lockstep", "--deadman", "5",
                   "--csv", "slow", real=real), "expired 30 times")


def what_does_not_compare(real):
    """Another real type; states at other ticks, but in lockstep; a machine that
    is not the scene's, by its hash."""
    other = {"double": "float", "float": "double"}[real]
    with Board(real) as board:
        drive(board.name, *STEPS, real=other, code=3)
        board.send("every:20")
        for words in ["--every", "16"], ["--every", "10", "--steps", "40"]:
            says(drive(board.name, *STEPS, *words, real=real, code=3),
                 f"--every {words[1]} is no multiple of 20")
        drive(board.name, *LOCKSTEP, real=real)
        board.send("set:mu=1.5")
        drive(board.name, *STEPS, real=real, code=3)


def refusals():
    for code, *words in (4,), (2, "--delay", "21"), (2, "--steps", "many"):
        drive("/dev/null", *words, code=code)
    call(program=hil(), code=2)


def lockstep(up, *words):
    """hil in lockstep over a line that changes frames."""
    with Board() as board:
        return relayed(up, board, hil(), "LINE", *LOCKSTEP, *words)


def losing(kind, number):
    """The Nth frame of a type is lost."""
    seen = itertools.count(1)
    return lambda found, frame: \
        b"" if found == kind and next(seen) == number else frame


def as_it_is(_, frame):
    return frame


def doubled_commands_change_nothing():
    same(lockstep(as_it_is, "--csv", "one")[0], 0)
    code, said = lockstep(lambda _, frame: frame + frame, "--csv", "two")
    same((code, "0 late, 0 without an answer" in said), (0, True))
    same(rows("one") == rows("two"), True)


def a_stop_that_is_lost_ends_the_lockstep(number):
    """The first stop is that before the reset, which is sent again."""
    code, said = lockstep(losing(STOP, number), "--csv", "rows")
    same((code, " was lost" in said), (4, True))
    same(Path("rows").exists(), False)


def an_input_that_is_lost_is_sent_again(number):
    for change, name in (as_it_is, "one"), (losing(INPUT, number), "two"):
        same(lockstep(change, "--csv", name)[0], 0)
    same(rows("one") == rows("two"), True)


def inputs_that_never_come_end_the_lockstep():
    code, said = lockstep(lambda kind, frame: b"" if kind == INPUT else frame)
    same((code, "step 0: its input was lost" in said), (4, True))


def a_line_of_115200_baud(kind, every, code, said_so, key=()):
    """One frame of each thousand is lost, which is of that type. It ends right,
    or says why: without its answer an input may have acted, here it has; a line
    that does not carry the records is one on which states are missed."""
    numbers, done = itertools.count(700), {0}

    def lose(found):
        thousand = next(numbers) // 1000
        if found != kind or thousand in done:
            return False
        done.add(thousand)
        return True

    with keyed() if key else Board() as board:
        if not key:
            board.send(f"every:{every}")
        got, said = relayed(
            as_it_is, board, hil("double" if key else REAL), "LINE", "--steps",
            "4000", "--every", "20", *key, lose=lose, carries=11520)
    check(got == code and re.search(said_so, said), said)


def the_dead_man_is_given_back():
    with Board() as board:
        for words in ["--deadman", "0"], []:
            said = drive(board.name, *STEPS, "--lockstep", *words)
            same("held without end" in said, bool(words))


def closed_descriptors_are_not_the_line():
    """What would be written there goes nowhere, and certainly not up."""
    with Board() as board:
        shell = f'"{hil()}" {board.name} {" ".join(LOCKSTEP)}'
        same(subprocess.call(["sh", "-c", shell + " >&- 2>&-"]), 4)
        says(drive(board.name, *LOCKSTEP), " 0 broken")


def cases():
    """Tests with the values that they are made for, the longest one first."""
    for values in ((STATE, 20, 0, "0 without an answer; [1-9].* missed"),
                   (REPORT, 20, 0, " [1-9] lost"),
                   (INPUT, 20, 0, "[1-9] without an answer"),
                   (ANSWER, 20, 1, "without an answer may have acted"),
                   (None, 1, 0, "[1-9][0-9]* states missed"),
                   (STATE, 20, 0, "0 without an answer; [1-9].* missed",
                    ("--key", "key"))):
        yield a_line_of_115200_baud, values
    yield inputs_that_never_come_end_the_lockstep, ()
    for real in REALS:
        for test in (in_real_time, in_lockstep, inputs_that_never_come_in_time,
                     what_does_not_compare):
            yield test, (real,)
        yield silent_controller, (real, "--lockstep")
        yield silent_controller, (real, "--delay", "20")
        yield stopped_board, (real,)
    for test, numbers in (
            (a_stop_that_is_lost_ends_the_lockstep, (2, 9)),
            (an_input_that_is_lost_is_sent_again, (1, 5))):
        for number in numbers:
            yield test, (number,)
    for test in (refusals, doubled_commands_change_nothing,
                 the_dead_man_is_given_back,
                 closed_descriptors_are_not_the_line):
        yield test, ()


# They wait for boards, which take a millisecond a step.
sys.exit(run([(" ".join([test.__name__, *map(str, values)]),
               functools.partial(test, *values)) for test, values in cases()],
             jobs=8))
