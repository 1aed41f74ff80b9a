#!/usr/bin/python3 -B
"""What `make firmware` takes and refuses, and by which words: switches,
numbers, records that a line does not carry, keys. A key is by one rule also
that of `monitor` and of `hil`."""
import os
import re
import subprocess
from pathlib import Path

from boards import BUILD
from starts import DIGITS as KEY
from tap import ROOT, TWOFOLD, check, main, same


def make(*words):
    """Of a firmware for the host, by the variables of the make that tests."""
    given = os.environ.get("MAKEFLAGS", "").partition(" -- ")[2]
    goal = [] if words[0] == "tick-budget" else ["elf"]
    done = subprocess.run(
        ["make", *goal, "BOARD=host", "REAL=double", f"BUILD={BUILD}", *words],
        cwd=ROOT, env={**os.environ, "MAKEFLAGS": f" -- {given}"},
        capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def test_switches_are_yes_or_no():
    """UPLINK=no has no uplink, as UPLINK= has none."""
    for name, flag in ("UPLINK", "-DUPLINK "), ("KEY_WEAK", "-DKEY_WEAK "):
        more = ["FORMAT=frames", "NAMED=-switch"]
        if name == "KEY_WEAK":
            more += ["UPLINK=yes", f"KEY={BUILD}/tests/key"]
        for value, on in ("yes", 1), ("no", 0), ("", 0):
            code, said, _ = make("-n", *more, f"{name}={value}")
            same((value, code, flag in said), (value, 0, bool(on)))
    for name, value in (("UPLINK", "1"), ("KEY_WEAK", "No"),
                        ("FULL", "yes no"), ("FEW", "1")):
        code, _, said = make("-n", f"{name}={value}")
        same((code, f"{name} is one of: yes no; not '{value}'" in said),
             (2, True))
    # `make check` and the tests, which ask whether there is FULL at all.
    for value, found in ("yes", "yes"), ("no", "none"), ("", "none"):
        Path("probe.mk").write_text(
            "include Makefile\nprobe:\n\t@echo $${FULL-none}\n")
        done = subprocess.run(
            ["make", "-s", "-f", Path("probe.mk").resolve(), "probe",
             f"FULL={value}", f"BUILD={BUILD}"], cwd=ROOT, check=True,
            env={**os.environ, "MAKEFLAGS": ""}, stdout=subprocess.PIPE)
        same(done.stdout.decode().strip(), found)


def test_what_is_no_number_or_no_choice_is_named():
    for name, low, values in (
            ("RATE", 1, ("1e3", "0", "-1", "010", "", "4294967296", "1 2")),
            ("STEPS", 0, ("many",)), ("EVERY", 1, ("0",)), ("BAUD", 10, ("9",)),
            ("DEADMAN", 0, ("1s",))):
        for value in values:
            code, _, said = make("-n", f"{name}={value}")
            same((value, code, said.split("***")[-1]), (
                value, 2, f" {name} must be a whole number in [{low}, "
                f"4294967295], not '{value}'.  Stop.\n"))
    for name, choice in (("OVERRUN", "skip stop"), ("REAL", "float double"),
                         ("FORMAT", "plotter csv frames"),
                         ("PROGRAM", "firmware trajectory window stack deadman "
                          "fault kit calls contacts"),
                         ("SCHEME", "moreau located compensated"),
                         ("SPLIT", "yes no")):
        code, _, said = make("-n", f"{name}=other")
        same((code, f"{name} is one of: {choice}; not 'other'" in said),
             (2, True))
    same(make("-n", "FORMAT=")[0], 2)


def judged(*words):
    """The check of the line that `make firmware` makes first: its exit code
    and what it says."""
    code, said, why = make("-n", *words)
    check(code == 0, why)
    asks = [line for line in said.splitlines() if "--line" in line] or ["true"]
    same(len(asks), 1)
    done = subprocess.run(asks[0], shell=True, capture_output=True, text=True,
                          check=False)
    return done.returncode, done.stderr


def test_no_firmware_of_the_documents_is_refused():
    """Nor where every step sends a state, to a controller at 1 kHz."""
    found = [line.split() for name in ("USE", "PORTS") for line in re.findall(
        r"^    make firmware ([A-Z].*?)(?:   .*)?$",
        (ROOT / f"docs/{name}.md").read_text("utf-8"), re.M)]
    check(len(found) > 8, found)
    for words in found:
        if "my." not in " ".join(words):
            same((words, judged("REAL=float", *words)[0]), (words, 0))
    loop, = (words for words in found if "EVERY=1" in words)
    for more, code in (["REAL=double"], 0), (["BAUD=1000000"], 3), \
            (["BAUD=1000000", "EVERY=2"], 0):
        same((more, judged("REAL=float", *loop, *more)[0]), (more, code))


def test_a_line_that_does_not_carry_its_records_is_refused():
    key = f"UPLINK=yes KEY={BUILD}/tests/key"
    for form, every, sends in (
            ("plotter", 11, "114 bytes with a record and 157 each second"),
            ("csv", 11, "121 bytes with a record and 4 each second"),
            ("frames", 13, "136 bytes with a record and 658 each second"),
            ("frames UPLINK=yes", 16, "167 bytes with a record and 658 each"),
            (f"frames {key}", 17, "175 bytes with a record and 674 each")):
        for steps in every, every - 1:
            code, said = judged("BAUD=115200", *f"FORMAT={form}".split(),
                                f"EVERY={steps}")
            same(code, 3 * (steps < every))
        same(sends in said and said.endswith(
            f" carries 11520; EVERY={every} would do\n"), True)


def test_a_tick_too_short_for_the_worst_step_is_refused():
    """By the board's table, or that of a board with its processor."""
    for board, words, code, of in (
            ("stm32f405", "RATE=1000 CLOCK=168000000", 0, "chaos, moreau"),
            ("stm32f405", "RATE=1000 CLOCK=168000000 UPLINK=yes FORMAT=frames",
             0, "any parameters, moreau"),
            ("stm32f405", "RATE=9000 CLOCK=168000000", 2,
             "any parameters, compensated"),
            ("pico", "RATE=1000 CLOCK=125000000", 2, "chaos, moreau")):
        got, _, said = make("tick-budget", f"BOARD={board}", "REAL=float",
                            *words.split())
        share = re.search(rf"worst known step \(of {of}\) takes \d+ "
                          r"instructions: (\d+)% of a tick of \d000 Hz at "
                          r"\d+ MHz", said)
        check(share, said)
        same((got, int(share[1]) > 100), (code, code > 0))
    same("BOARD_LIKE" in make("tick-budget", "CLOCK=1000000")[2], True)
    same("has no watchdog" in make("-n", "WATCHDOG=100")[2], True)


KEYS = ((KEY, ""), (KEY + "\n", ""), (KEY.upper() + "\r\n", ""),
        (KEY + "\n\n", ""), (KEY + " \t\r\n\r\n", ""),
        *((text, "must hold 32 hexadecimal digits, then only white space")
          for text in ("", "\n", KEY[1:], KEY + "0", " " + KEY, KEY + "\nx",
                       KEY[:16] + "\n" + KEY[16:], "g" + KEY[1:],
                       KEY + "\n" + KEY, "\ufeff" + KEY)))


def judge_key(path, wrong):
    """By all that read one: what is wrong with it, or nothing."""
    for words, bad in (([TWOFOLD, "monitor", "/dev/null", "--key", path], 2),
                       ([BUILD / "double/hil", "/dev/null", "--key", path], 2),
                       ([BUILD / "double/constants", "--key", path], 3)):
        done = subprocess.run(words, capture_output=True, text=True,
                              check=False)
        check((f"{path}: {wrong}" in done.stderr) == bool(wrong)
              and (done.returncode == bad) == bool(wrong),
              f"{words}: {done.returncode} {done.stderr}")


def test_all_take_the_same_keys():
    for number, (text, wrong) in enumerate(KEYS):
        path = Path(f"key{number}")
        path.write_bytes(text.encode())
        path.chmod(0o600)
        judge_key(path, wrong)
        path.chmod(0o604)
        judge_key(path, "others may read it, or change it: chmod 600")
    Path("folder").mkdir(mode=0o700)
    judge_key("folder", "Is a directory")
    judge_key("none", "No such file or directory")
    for path in "folder", "none", "key5", "a key":
        code, _, said = make("FORMAT=frames", "UPLINK=yes", "NAMED=-keys",
                             f"KEY={Path(path).resolve()}")
        same((code, said.count("KEY="), "grep" in said), (2, 1, False))


def test_another_key_is_another_program():
    """Also where its file is the older one, and the same one is not; with line
    ends of another system, too."""
    path, built = Path("key").resolve(), []
    program = BUILD / "boards/host/chaos-double/firmware-other.elf"
    program.unlink(missing_ok=True)
    for key, year in ((KEY + "\r\n", 2020), (KEY + "\n\n", 2021),
                      ("7" * 31 + "a", 2001)):
        path.write_bytes(key.encode())
        path.chmod(0o600)
        os.utime(path, (year * 31556952 - 62167219200,) * 2)
        code, said, errors = make("FORMAT=frames", "UPLINK=yes", "NAMED=-other",
                                  "BOARD_OPT=-O0 -Werror", "RATE=50", "EVERY=1",
                             f"KEY={path}")
        check(code == 0, errors)
        built.append("  BOARD " in said)
        check(bytes.fromhex(key) in program.read_bytes(), "another key")
        for file in program, program.with_suffix(".elf.keyed"):
            same(file.stat().st_mode & 0o77, 0)
    same(built, [True, False, True])


main(globals(), jobs=2)
