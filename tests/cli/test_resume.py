#!/usr/bin/python3 -B
"""A run that goes on from where another one stands has the rows that one run
would have, bit for bit; a file that does not belong to it is refused with what
differs."""
import re
import resource
import signal
import zlib
from pathlib import Path

from outputs import interrupted, lines_of, says, says_each
from tap import call, check, main, same

USUAL = "compensated" if "float" in call("--version")[0] else "moreau"
TABLE = "t,omega0,force\n0,-1,0\n0.4,-1.2,0.1\n1.1,-0.9,0\n"


def joined(middle, end, every, *words, scheme=USUAL):
    """A run to a time, and from there to the end, joined. The last row of the
    first one is in the whole only where `every` divides its step. The scheme is
    that of the file, and noted where it is not the usual one."""
    codes = []
    first = [*words, "--scheme", scheme]
    for path, more in (("want", [*first, "--t-end", end]),
                       ("one", [*first, "--t-end", middle, "--save", "at"]),
                       ("two", [*words, "--t-end", end, "--from", "at"])):
        said = call("run", *more, "--every", every, "--out", path, "--summary",
                    "json", code=(0, 5))[1]
        codes.append(5 if '"exit": 5' in said else 0)
    same(f"--scheme {scheme}, set by at" in said, scheme != USUAL)
    same(codes[0], max(codes[1:]))  # flagged steps lie in one half or the other
    want, one, two = map(lines_of, ("want", "one", "two"))
    same(two[1], one[-1])
    same((one if one[-1] in want else one[:-1]) + two[2:], want)


def test_the_rows_are_those_of_one_run():
    for scheme in "moreau", "located", "compensated":
        joined(1.25, 3, 1, "chaos", "--dt", "0x1p-11", scheme=scheme)
        joined(1.2345, 2, 10, "chaos", scheme=scheme)
    for line in call("scenes")[0].splitlines():
        joined(1.5, 3, 100, line.split()[0])
    joined(2, 3, 1, "chaos", "--select", "random:9", "--dt", "0x1p-11")
    joined(1, 2, 100, "driven", scheme="compensated")
    Path("table.csv").write_text(TABLE)
    for between in "held", "linear":
        joined(0.5, 1.4, 7, "chaos", "--inputs", "table.csv", "--between",
               between)


def test_where_it_goes_on():
    Path("mine.scene").write_text("based-on chaos\n")
    call("run", "chaos", "--t-end", "1", "--save", "at", "--out", "one")
    said = call("run", "mine.scene", "--from", "at", "--t-end", "2")[1]
    check("scene      mine" in said and "10000 of them" in said, said)
    same(call("run", "chaos", "--from", "at", "--t-end", "1")[0].count("\n"), 2)
    words = ["run", "chaos", "--from", "at", "--t-end", "1.01"]
    call(*words, "--format", "frames", "--out", "frames")
    same(call("monitor", "frames", "--format", "csv")[0], call(*words)[0])


def test_what_ends_a_run():
    """It does not lose where it stands; but on a full disk there is no state
    whose rows are in no file."""
    interrupted("big", "run", "chaos", "--t-end", "1e9", "--every", "1000",
                "--save", "at", "--out", "big", number=signal.SIGTERM)
    tick = int(re.search("^tick (.*)$", Path("at").read_text(), re.M)[1])
    rows = call("run", "chaos", "--from", "at", "--t-end",
                f"{(tick + 1) * 1e-4:.10g}")[0]
    same(rows.splitlines()[1], lines_of("big.part")[-1])
    said = call("run", "chaos", "--t-end", "1", "--save", "full", "--out",
                "quota", code=4, preexec_fn=lambda: resource.setrlimit(
                    resource.RLIMIT_FSIZE, (4096, 4096)))[1]
    check("--save full: not written" in said and "did not reach quota" in said,
          said)
    check(not Path("full").exists(), "no state")


DIFFERS = """
0 chaos --from driven --t-end 0.2|was saved with --inputs, and continues without
0 chaos --from at --inputs f.csv --between held --t-end 1|was saved without
0 chaos --from driven --inputs f.csv --t-end 1 --between linear|with another
3 chaos --from at --set kappa=0.3|kappa is 0.27&there and 0.3 here
3 chaos --from at --dt 1e-3|dt is 0.0001 there and 0.001 here
3 chaos --from at --set law=coulomb|law is jump there and coulomb here
3 chaos --from at --set rest=square|rest is hull there and square here
3 chaos --from at --select slip+|rule is persist there and slip+ here
3 chaos --from at --scheme located|scheme is moreau there and located here
3 rolling --from at|with-angle is no there and yes here
3 jump.scene --from at|the profile of the turntable is that of its scene there
3 chaos --from at --t-end 0.4|it stands at t = 0.5 s, after the end at 0.4 s
2 chaos --from at --set r=0.2|--set r=0.2: --from at gives the state
2 chaos --from none|--from none: No such file
2 chaos --from .|--from .: Is a directory
2 chaos --from one|--from one: not from --save
2 chaos --from=|the name of the file is empty
4 chaos --save /nowhere/at --out one|/nowhere/at"""
# The checksum is right, and no run has left such a state.
FORGED = """
twofold-state 3|twofold-state 2|its version (run up to it again, with --save)
r .*|r nan|--from forged: r is not finite
compensation-w .*|compensation-w inf|compensation-w is not finite
delassus .*|delassus 1e999|delassus is not finite
omega .*|omega 1e10|beyond 1e+09"""


def test_what_differs():
    run = ["run", "chaos", "--scheme", "moreau", "--every", "100"]
    Path("f.csv").write_text("t,force\n0,0\n")
    Path("jump.scene").write_text("based-on chaos\nprofile 0:-1 1:-2\n")
    call(*run, "--t-end", "0.5", "--save", "at", "--out", "one")
    call(*run, "--t-end", "0.1", "--inputs", "f.csv", "--between", "held",
         "--save", "driven")
    before = Path("at").read_bytes()
    says_each(DIFFERS, "run")
    call(*run, "--t-end", "0.1", "--select", "random:9", "--save", "drawn",
         "--out", "one")
    says(3, "the seed is 9 there and 7 here", "run", "chaos", "--from", "drawn",
         "--select", "random:7")
    same(Path("at").read_bytes(), before)
    goes_on = ["run", "chaos", "--t-end", "0.6", "--from"]
    text = before[:-15]
    for line in FORGED.strip().splitlines():
        old, new, texts = line.split("|")
        changed = re.sub(f"(?m)^{old}$", new, text.decode(), count=1).encode()
        Path("forged").write_bytes(
            changed + b"crc32 %08x\n" % zlib.crc32(changed))
        says(3, texts, *goes_on, "forged")
    spelled = text.replace(b"rate              20 ", b"rate 0x1.4p4 ")
    Path("spelled").write_bytes(
        spelled + b"crc32 %08x\n" % zlib.crc32(spelled))
    check(spelled != text, "the state has a rate of 20 1/s")
    same(says(0, "", *goes_on, "spelled"), says(0, "", *goes_on, "at"))
    for wrong in (text + b"junk\0", text.replace(b"jump", b"none")):
        Path("forged").write_bytes(wrong + b"crc32 %08x\n" % (
            zlib.crc32(wrong) if wrong[-1] == 0 else zlib.crc32(text)))
        says(3, "cut off or changed: its checksum is wrong", *goes_on, "forged")
    Path("short").write_bytes(before[:400])
    says(3, "cut off or changed", *goes_on, "short")


main(globals(), jobs=2)
