#!/usr/bin/python3 -B
"""The command line keeps its contract: exit codes, columns, row counts,
decimals that read back, and refusals that say what and why."""
import re
import subprocess
from pathlib import Path

from outputs import (column, ended, fails_to_write, says, says_each, started,
                     table)
from tap import HEADER, TWOFOLD, call, check, main, same

REAL = call("--version")[0].split()[-1]
SHORT = ["--t-end", "1e-3", "--dt", "1e-4"]


def chaos(*words, code=0):
    """(rows, what is said) of a run."""
    return call("run", "chaos", *words, code=code)


def rows(*words):
    return table(chaos(*words)[0])


def listed(said):
    """Lines of the events that a summary lists."""
    return re.findall(r"^  \d.*", said, re.M)


def test_rows():
    out = chaos(*SHORT)[0]
    lines = out.splitlines()
    same((lines[0], len(lines)), (HEADER, 12))
    check(all(re.fullmatch(r"([^,]+,){9}1,slip.", line)
              for line in lines[1:]), out)
    found = rows(*SHORT)
    same(column(found, "t", "r", "omega", "mode")[0],
         ("0", "0.18", "-1.037", "slip+"))
    same(found[2]["t"], "0.0002")
    check(abs(float(found[10]["t"]) - 0.001) < 1e-9, "the last row")
    same(chaos(*SHORT, "--every", "3")[0].splitlines(),
         [lines[i] for i in (0, 1, 4, 7, 10, 11)])
    for words, count in ((SHORT + ["--every", "5"], 3),
                         (["--t-end", "0", "--every", "7"], 1),
                         (["--t-end", "2.6e-4", "--dt", "1e-4"], 4),
                         (["--t-end", "2.4e-4", "--dt", "1e-4"], 3)):
        same(len(rows(*words)), count)
    same(call("run", "--t-end=1e-3", "--set", "dt=1e-4", "chaos", "--out",
              "-")[0], out)


def test_numbers():
    """As they are typed and as they are printed."""
    number = "0.12345678901234568"
    for names, want, words in (
            (["r"], [number if REAL == "double" else "0.12345679"],
             f"--set r={number}"),
            (["r"], ["0.125"], "--set r=0x1p-3 --set omega=+2e0"),
            (["r", "v", "omega"], ["0.5", "0.25", "-2"],
             "--set v=0.25 --set r=0.5 --set omega=-2"),
            (["mode"], ["slip+"], "--set h=2e-3"),
            (["mode"], ["slip-"], "--set h=-2e-3")):
        start = rows("--t-end", "0", *words.split())[0]
        same([start[name] for name in names], want)
    for h in "2e-3", "-2e-3":
        start = rows("--t-end", "0", "--set", f"h={h}")[0]
        check(abs(float(start["h"]) - float(h)) < 1e-7, start)
    check("phi = 0.5 rad" in chaos("--t-end", "0", "--set", "phi=0.5")[1],
          "phi of the summary")
    for text in ("1e-999", "0x", "", ".", "e5", "1x", "1 ", " 1", " nan",
                 "nanx", "infx", "in", "1,5", "--5", "1e"):
        for option, name in (("--set", "r="), ("--dt", ""), ("--t-end", "")):
            says(2, f"{option} {name}{text}", "run", "chaos", option,
                 name + text)
    for text in "0", "-1", "1.5", "", "x", "1e3", "99999999999999999999":
        says(2, f"--every {text}", "run", "chaos", "--every", text)


COMMANDS = """
2 scnes|unknown command 'scnes'&'scenes'
2 bench|'make bench'
2 stability|'make stability'
2 run|which scene
2 run choas|unknown scene 'choas'&mean 'chaos'
0 --help|
0 --version|
0 version|
0 -v|
2 version now|unexpected argument 'now'
0 scenes|
0 run --help|"""
REFUSED = """
2 --t-end 0 --set=m=1 --t-end=1|--t-end 1: --t-end was already given
2 --dt 1e-4 --set=m=1 --dt=1e-3|--dt 1e-3: dt was already given
2 --select slip+ --select=slip-|--select slip-: --select was already given
2 --set r=1 --set=m=1 --set=r=2|--set r=2: r was already given
2 --set law=none --set=law=none|--set law=none: law was already given
3 --scheme located --set law=smooth|law must be jump, coulomb or none, not smo
3 --scheme located --set law=string|law must be jump, coulomb or none, not str
3 --scheme located --set law=two_piece|law must be jump, coulomb or none, not t
2 --events some|--events some
2 --out|--out
2 --set bta=1|unknown name 'bta'&'beta'
2 --set beta|--set beta
2 --set =1|--set =1
2 --set law=strin|unknown law 'strin'
2 --select slip|--select slip: unknown rule; rules are persist, slip+
2 --select slip|slip- and random; did you mean 'slip+'
2 --select :7|--select :7: unknown rule
2 --set h=0 --set v=0|h or v
2 --select slip+:1|seed
2 --select random:|seed
2 --select random:4294967296|seed
2 --set dt=1 --dt 1e-3|dt was already given by --set dt=1
2 --realtime=yes|takes no value
2 --realtime --realtime|already given
2 --lateness=late|--lateness: only with --realtime
2 --priority|--priority: only with --realtime
2 coulomb|one scene
3 --set theta=0.4|--set theta=0.4&theta must lie in [0.5, 1]
3 --dt 1e9|--dt 1e9&dt must lie in [&] s
3 --t-end -1|--t-end -1&t-end must lie in [0,
3 --t-end 1e30|--t-end 1e30&1e15 steps
3 --set gamma=0 --set h=1|sin(gamma)&--set h=1
3 --set law=string|law string: k = 0&--set k=VALUE
3 --set segments=2.5|segments must be a whole number
3 --scheme compensated --set beta=0|beta must lie in [
3 --scheme located --accuracy 1|--accuracy: not with --scheme located
3 --accuracy -1|must lie in (0, 1]
4 --realtime --t-end 0.01 --lateness no/late --out other|no/late"""


def test_refusals():
    """Of two values one is a mistake, and the program cannot know which."""
    says_each(COMMANDS)
    same(call(code=2), (call("help")[0], ""))
    same(call("run", "chaos", "-q", "--t-end=1", "--set", "v=1")[1], "")
    words = ["run", "chaos", "--t-end", "1", "--dt", "1e-3"]
    call(*words, "-o", "one")
    call(*words, "--out=two", "--quiet")
    same(Path("one").read_bytes(), Path("two").read_bytes())
    check(call(*words, "-qx", code=2)[1].startswith("twofold: -qx: takes no"),
          "a value of -q")
    check(re.search("^chaos +[^ ]", call("scenes")[0], re.M), "a line of chaos")
    says_each(REFUSED, "run", "chaos")
    Path("kept").write_text("keep")
    says(2, "bta", "run", "chaos", "--out", "kept", "--set", "bta=1")
    same(Path("kept").read_text(), "keep")


def test_what_is_not_finite():
    """It is out of every range, of an unused name too."""
    for text in "nan", "-NAN", "inf", "-inf", "infinity", "1e999", "-1e999":
        for name in "kappa", "epsilon", "omega0", "r", "h", "phi":
            says(3, f"--set {name}={text}&{name} must lie in [", "run", "chaos",
                 "--set", f"{name}={text}")
        says(3, f"--dt {text}&dt must lie in [1e-09, 1] s", "run", "chaos",
             "--dt", text)
        says(3, f"--t-end {text}&t-end must lie in [0,", "run", "chaos",
             "--t-end", text)


def test_notes():
    says(0, "does not use kappa", "run", "coulomb", "--t-end", "0", "--set",
         "kappa=0")
    for scheme, setting, notes in (
            ("moreau", "tolerance=1e-5", 1), ("moreau", "theta=1", 0),
            ("located", "tolerance=1e-5", 0), ("located", "theta=1", 1),
            ("compensated", "tolerance=1e-5", 1)):
        said = chaos("--t-end", "0", "--scheme", scheme, "--set", setting)[1]
        same(said.count(f"note: --set {setting} has no effect under --scheme "
                        + scheme), notes)


def test_output_that_fails():
    fails_to_write(11, "run", "chaos", "--t-end", "1e9")
    with subprocess.Popen([TWOFOLD, "run", "chaos", "--t-end", "1e9"],
                          stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE) as child:
        child.stdout.readline()
        child.stdout.close()
        check(b"\nfinal " in child.stderr.read(), "the summary comes anyhow")
    for command, to in (("run chaos --t-end 0", ">&-"),
                        ("scenes", ">/dev/full")):
        same(subprocess.run(f"'{TWOFOLD}' {command} {to} 2>said", shell=True,
                            check=False).returncode, 4)


def test_real_time():
    """On the wall clock a run may take longer than its time but never less, and
    a step that is shorter than a look at the clock is late."""
    want, said = chaos("--t-end", "0.2", "--dt", "0.001")
    check("\nreal time" not in said, "without it no pace is printed")
    got, said = chaos("--t-end", "0.2", "--dt", "0.001", "--realtime",
                      "--priority", "--lateness", "late")
    same(got, want)
    check(re.search(r"^real time +\d+ of ", said, re.M), said)
    late = table(Path("late").read_text())
    same(list(late[0]), ["us", "began", "ended"])
    same([sum(map(int, column(late, name))) for name in ("began", "ended")],
         [200, 200])
    out, said = chaos("--t-end", "1e-6", "--dt", "1e-9", "--realtime",
                      "--every", "10")
    check(int(re.search(r"^real time +(\d+) of ", said, re.M)[1]) > 0, said)
    same(out.count("\n"), 102)
    # It waits, or it would be over before the signal that ends the wait.
    ended(started("x", "run", "chaos", "--realtime", "--dt", "0.02", "--t-end",
                  "100", "--out", "x"))


def test_steps_that_miss_their_bound():
    """So stiff that some steps run out of segments, or that no series
    converges. --accuracy flags steps and changes no row."""
    words = ["--scheme", "located", "--dt", "0.01", "--every", "1000"]
    said = chaos(*words, "--set", "k2=1e4", "--t-end", "4", code=5)[1]
    check(re.search("degraded .* [1-9][0-9]* coarse, 0 stalled, 0 fell.*first "
                    "at t = ", said), said)
    said = chaos(*words, "--set", "c2=1e9", "--t-end", "1", code=5)[1]
    found = re.search(r" (\d+) coarse.* 0 fell back on moreau", said)
    check(found and int(found[1]) > 50, said)
    words = ["--scheme", "moreau", "--t-end", "0.1", "--dt", "1e-3"]
    got, said = chaos(*words, "--accuracy", "1")
    same(got, chaos(*words)[0])
    check("\nestimate   a step is off" in said, said)
    check("\nestimate   a step is off by" in chaos(
        *words, "--accuracy", "1e-6", code=5)[1], "it is coarse")


def test_the_scheme_of_no_option():
    usual = "compensated" if REAL == "float" else "moreau"
    check(f"\nscheme     {usual}," in chaos(*SHORT)[1], "below 1 ms")
    check("\nscheme     moreau," in chaos("--t-end", "1e-2", "--dt", "1e-3")[1],
          "at 1 ms")


def test_events():
    """Those of the summary are the changes of mode, two-folds within stick, and
    no more; what is not listed is counted."""
    every = ["--every", "1000000"]
    said = chaos("--t-end", "10", *every)[1]
    for word in ("scene scheme steps events ambiguous degraded largest final "
                 "cost").split():
        check(re.search(f"^{word} +[^ ]", said, re.M), word)
    same(len(listed(said)), 20)
    said = chaos("--t-end", "3", *every, "--events", "3")[1]
    same(len(listed(said)), 3)
    more = int(re.search(r"^  \.\.\. (\d+) more events", said, re.M)[1])
    out, said = chaos("--t-end", "3", "--events", "all")
    same(len(listed(said)), more + 3)
    modes = column(table(out), "mode")
    same(sum(" to " in line for line in listed(said)),
         sum(a != b for a, b in zip(modes[1:], modes[2:])))
    said = chaos("--t-end", "3", *every)[1]
    same(sum(map(int, re.findall(r"^  \.\.\. (\d+)", said, re.M)),
             len(listed(said))), more + 3)


def test_each_event_starts_where_the_one_before_ended():
    """N changes of slip in one line swap the slip where N is odd."""
    for words in ("10", "3 --events 6", "3 --events all", "10 --scheme located",
                  "10 --select random:7"):
        said = chaos("--every", "1000000", "--t-end", *words.split())[1]
        mode, count = None, 0
        for times, begins, ends in re.findall(
                r"^  (?:\.\.\. (\d+) x slip|\d.*?  ([a-z]+[-+d]) to ([^,\n]*))",
                said, re.M):
            if times and int(times) % 2:
                mode = "slip-" if mode == "slip+" else "slip+"
            elif not times:
                check(mode in (None, begins), f"{words}: {said}")
                mode, count = ends, count + 1
        check(count > 2, said)


main(globals(), jobs=2)
