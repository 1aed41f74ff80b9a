#!/usr/bin/python3 -B
"""Scenes as files: what is printed reads back to the same bits, every command
takes a file, and what is wrong in it is named by line, key and range."""
from pathlib import Path

from outputs import says, says_each
from tap import call, check, main, same

SET = ("--set kappa=0.3 --set law=smooth --set epsilon=1e-3 --set r=0.2 --set "
       "v=0.5 --dt 1e-3 --select slip+").split()


def test_there_and_back():
    """Also with what the command line changes."""
    scenes = [line.split()[0] for line in call("scenes")[0].splitlines()]
    for words in (*([scene] for scene in scenes), ["driven", *SET]):
        call("scene", *words, "--out", "one.scene")
        call("scene", "./one.scene", "--out", "two.scene")
        same(Path("two.scene").read_text(), Path("one.scene").read_text())
        end = ["--t-end", "3", "--every", "7"]
        same(call("run", "one.scene", *end)[0], call("run", *words, *end)[0])
    check(call("run", "one.scene", *end)[0] !=
          call("run", "one.scene", *end, "--set", "v=0.25")[0],
          "settings change a file, too")
    check("\nrule              random\n" in
          call("scene", "chaos", "--select", "random")[0], "the rule is kept")


def test_every_command_takes_a_file():
    Path("mine.scene").write_bytes(
        b"based-on chaos\r\nname mine\r\nkappa\t0.27\r\n")
    check('"mine"' in call("singularities", "mine.scene")[0], "its name")
    for words in ("design mine.scene --r 0.2 --omega=-1.04",
                  "regions mine.scene --r 0:1:2 --omega=-1:1:2",
                  "atlas mine.scene --r 0.1:0.2:2 --omega=-1.1:-1.05:2",
                  "diverge ./mine.scene --samples 2"):
        call(*words.split())
    check("mine" in call("run", "mine.scene", "--t-end", "0.01", "--format",
                         "frames")[0], "its name in frames")


WRONG = r"""
2|based-on chaos\nkapa 0.3\n|2: unknown key&did you mean 'kappa'
2|based-on chaos\nkappa 0.3\n# twice\nkappa = 0.2\n|4: kappa was already given
2|based-on chaos\nkappa 0.3m\n|2: kappa: '0.3m' is not a number
3|based-on chaos\nkappa -0.5\n|2: kappa = -0.5 must lie in [1e-09, 1e+06] m
3|based-on chaos\ndt nan\n|2: dt = nan must lie in
3|r 1e10\n|1: r = 10000000000 must lie in [-1e+09, 1e+09] m
3|based-on chaos\nt-end -1\n|2: t-end = -1 must lie in [0, 1e+09] s
3|based-on chaos\nlaw string\n| k is missing, which law string needs
2|m 1\n| law is missing
2|law none\nr 0\nomega 0\nt-end 1\n| v or h is missing
2|law none\nr 0\nomega 0\nt-end 1\nv 0\n| d is missing
2|law jmp\n|1: law: unknown law&did you mean 'jump'
2|rule random:7\n|1: rule: a seed is not part of a scene
3|based-on driven\nprofile 0:-1 1:1e9\n|2: profile: omega0 = 1e9 must lie in
3|based-on chaos\nsegments 1.5\n|2: segments must be
2|rest bow\n|1: rest: unknown law of rest
2|with-angle 1\n|1: with-angle: '1' must be yes or no
2|based-on chaos\nh 0\nv 1\n|3: v: give h or v
2|m 1\nbased-on chaos\n|2: based-on: must be the first key
2|name mine\nbased-on chaos\n|2: based-on: must be the first key
2|based-on chaso\n|1: based-on: unknown scene&did you mean 'chaos'
2|profile 1 2\n|1: profile: '1': expected T:OMEGA0
3|profile 0:1 1:2 0.5:3\n|1: profile: 0.5 s is not later
3|profile 0:1 1:2 1:3 1:4\n|1: profile: 1 s is not later
2|profile 0:0 1:0 2:0 3:0 4:0 5:0 6:0 7:0 8:0\n|1: profile: more than 8 knots
2|kappa = # none\n|1: kappa: expected a value
2|m \310\n|1: column 3: byte 200 is not ASCII
2|name a b\n|1: name: 'a b'
2|shows "quoted"\n|1: shows: expected at most 127"""


def test_what_is_wrong():
    for line in WRONG.strip().splitlines():
        code, text, texts = line.split("|")
        Path("wrong.scene").write_bytes(
            text.encode().decode("unicode_escape").encode("latin-1"))
        says(int(code), f"wrong.scene:{texts}", "run", "wrong.scene")
    Path("wide.scene").write_text(f"{600 * ' '}\n")
    says(2, "wide.scene:1: the line has more than 511", "run", "wide.scene")
    Path("long.scene").write_text(20000 * "\n")
    says(2, "long.scene: over 16384 bytes", "run", "long.scene")


def test_words_that_are_wrong():
    Path("no name.scene").write_text("based-on chaos\n")
    Path("mine.scene").write_text("based-on chaos\n")
    says(2, "is not a valid scene name&give", "scene", "./no name.scene")
    says_each("""
2 none.scene|none.scene: No such file
2 none|unknown scene&a file has a . or a /
2 ./|Is a directory
2 mine.scene chaos|one scene at a time (mine was given)
2 chaos --select random:7|a scene has no seed
2 chaos --set phi=1|phi=1&starts with phi = 0
3 chaos --set kappa=-1|kappa must lie in [1e-09, 1e+06] m
2 chaos --set kapa=1|did you mean 'kappa'?
2|which scene?""", "scene")


main(globals(), jobs=2)
