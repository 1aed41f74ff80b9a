#!/usr/bin/python3 -B
"""What programs read: the summary as JSON, the time left, and rows that say
what they are of in a form that numpy skips."""
import json
import os
import pty
import re
import signal
import subprocess
import time
from pathlib import Path

from outputs import table
from tap import TWOFOLD, call, check, lacks, main, same, until

SHORT = ["run", "chaos", "--t-end", "0.2", "--every", "10"]
CHAOS = r"# scene chaos, (?:hash [0-9a-f]{8}, )?parameters ([0-9a-f]{8})"


def told(words, *more, code=0):
    """The summary of a command as JSON: one line, the last one."""
    lines = call(*words.split(), *more, "--summary", "json",
                 code=code)[1].splitlines()
    same([line[0] for line in lines].count("{"), 1)
    summary = json.loads(lines[-1])
    same(summary["exit"], code)
    return summary


def rows_of(path):
    return table(Path(path).read_text("ascii"))


def test_run():
    # Of the rate a note says that it has no effect.
    got = told("run chaos --t-end 3 --every 100 --out rows --set rate=3")
    same([got[key] for key in ("command", "scene", "steps", "end")],
         ["run", "chaos", 30000, "done"])
    same(got["final"]["r"], float(rows_of("rows")[-1]["r"]))
    same(got["events"]["two_fold"], 1)
    same(got["events"]["list"][0]["kinds"], ["slip_to_stick", "codim2"])
    for words, code, end in (("k2=1e10 --t-end 1 --dt 0.01", 5, "done"),
                             ("v=9e8 --dt 0.1", 4, "refused")):
        same(told(f"run chaos --set {words}", code=code)["end"], end)


def test_other_commands():
    got = told("sweep chaos --over mu=1:2:3 --over r=0:1e9:2 --t-end 0.1 "
               "--out rows")
    done = [row for row in rows_of("rows") if "done" in row.values()]
    same((got["points"], got["done"], got["kept"], got["together"]),
         (6, len(done), 0, 1))
    same(f"twofold {got['version']}, tf_real_t is {got['number']}",
         call("--version")[0].strip())
    got = told("diverge chaos --samples 3 --cycles 2 --returns rows")
    same((got["samples"], got["done"], got["cycles"]),
         (3, 3, len(rows_of("rows"))))
    got = told("diverge chaos --exhaustive --depth 1 --grid 0.1 --patience 1 "
               "--branches rows")
    same(got["branches"], len(rows_of("rows")))
    call("run", "chaos", "--t-end", "0.005", "--format", "frames", "--out",
         "frames")
    got = told("monitor frames --format csv --out rows")
    same((got["rows"], got["last"]["step"]), (len(rows_of("rows")), 50))
    two_folds = json.loads(call("singularities", "chaos")[0])
    same((got["parameters"], two_folds["units"]["r"]),
         (two_folds["parameters"], "m"))


def test_start_with_several_modes():
    """It is the first ambiguous instant, also where no step follows; a run that
    goes on from another one has no start of its own."""
    here = "chaos --set omega=-1.02"
    for h, t_end, choices, steps, since in (
            ("0", "0", 3, 0, 0), ("0", "0.001", 3, 10, 0),
            ("1e-3", "0", 1, 0, None), ("1e-3", "0.001", 1, 0, None)):
        words = f"run {here} --set h={h} --t-end {t_end}"
        got = told(f"{words} --save at --out rows")
        start = rows_of("rows")[0]
        set_ = start["set"] if choices > 1 else ""
        same([got[key] for key in ("choices_at_start", "ambiguous",
                                   "ambiguous_since", "ambiguous_set")],
             [choices, steps, since, set_])
        same((start["choices"], len(start["set"].split("|"))),
             (str(choices), choices))
        text = re.search("^ambiguous  several modes (.*)$",
                         call(*words.split())[1], re.M)[1]
        same(text, ("at the start and " if choices > 1 else "")
             + f"in {steps} steps" + " (100 %)" * (steps > 0)
             + f", first at t = 0 s: {set_}" * (since == 0))
        told(f"sweep {here} --over h={h}:{h}:1 --t-end {t_end} "
             "--outcome ambiguous --out rows")
        same(rows_of("rows")[0]["ambiguous"], "" if since is None else "0")
        if steps > 0:
            got = told("run chaos --t-end 0.002 --from at --out rows")
            same((got["choices_at_start"], got["ambiguous"],
                  round(got["ambiguous_since"], 9)), (None, 10, 0.0011))


def test_inputs_of_run():
    """The profile; a table, whose path is quoted; what was applied of it."""
    def seen(t_end, between):
        return told(f"run frictionless --t-end {t_end} --every 100 --out rows "
                    f"--dt {dt} --between {between} --inputs", name)["inputs"]
    same(told("run driven --t-end 1 --out rows")["profile"]["rows"], 5)
    name, dt = 'a "b" \\.csv', 0.001
    Path(name).write_text("t,force\n0,0.1\n0.5,-0.3\n2,0.7\n", "ascii")
    same(seen(1, "held")["name"], name)
    same(seen(1, "held")["applied"], {"force": [-0.3, 0.1]})
    same(seen(0.5, "held")["applied"], {"force": [0.1, 0.1]})
    same([seen(t, "linear")["last"] for t in (0.4, 0.5, 0.6)], [1, 1, 2])
    # The mean of the two ends of a step: of the first one behind the knot of
    # -0.3 N, and of the very first one.
    want = [-0.3 + 1 / 1.5 * dt / 2, 0.1 - 0.8 * dt / 2]
    same([round(x, 9) for x in seen(1, "linear")["applied"]["force"]],
         [round(x, 9) for x in want])


def test_refusals():
    """Of every command, before it has done anything, in either order."""
    for line in """\
3 run chaos --set mu=-1|mu must lie in
3 run chaos --set segments=70000|in [0, 1000]
3 run chaos --set segments=nan|in [0, 1000]
2 run nowhere|nowhere
4 run chaos --out none/rows|none/rows
2 sweep chaos --over mu=1:2|mu=1:2
3 diverge coulomb|has no two-fold
4 monitor nothing|nothing
2 regions chaos|--summary""".splitlines():
        words, why = line[2:].split("|")
        got = told(words, code=int(line[0]))
        same((got["command"], why in got["message"]), (words.split()[0], True))
    err = call("run", "--summary=json", "chaos", "--t-end", "no", code=2)[1]
    same(json.loads(err.splitlines()[-1])["exit"], 2)
    err = call("run", "chaos", "--summary", "xml", code=2)[1]
    same("--summary xml: must be text or json" in err, True)


LONG = """\
diverge chaos --samples 100000 --cycles 10 --returns
diverge chaos --exhaustive --grid 1e-6 --count 1000000 --branches
sweep chaos --over mu=1:2:100000 --out
regions chaos --r 0.1:0.2:100000 --omega=-1:1:99 --out
atlas chaos --r 0.1:0.2:100000 --omega=-1:1:99 --out
run chaos --t-end 1e6 --every 1000000 --out""".splitlines()


def test_events_within_a_step():
    """Under scheme located each has its own time, whatever dt is; a sweep
    counts the same ones."""
    seen = []
    for dt in 0.7, 0.35, 0.1, 0.01:
        words = ["coulomb", "--scheme", "located", "--dt", dt]
        said = call("run", *words, "--t-end", "1.4", "--summary", "json",
                    "--out", "rows")[1]
        events = json.loads(said.splitlines()[-1])["events"]
        same((events["slip_to_stick"], events["stick_to_slip"],
              events["codim2"]), (2, 1, 0))
        seen.append([(one["from"], one["to"]) for one in events["list"]])
        for one, time_ in zip(events["list"], (0.3176, 0.5936, 0.8759)):
            check(abs(one["t"] - time_) < 1e-4, str(events))
        rows = call("sweep", *words, "--t-end", "1.4", "--over", "mu=1:2:2",
                    "--outcome", "modes,changes")[0].splitlines()
        same(rows[1].split(",")[-2:], ["slip+|stick+|stick-", "3"])
    same(seen, [[("slip+", "stick+"), ("stick+", "slip+"),
                 ("slip+", "stick-")]] * 4)
    for dt in 0.2, 0.01:
        said = call("run", "chaos", "--scheme", "located", "--dt", dt,
                    "--t-end", "2.1", "--summary", "json", "--out", "rows")[1]
        three = json.loads(said.splitlines()[-1])["events"]["list"][2:5]
        same([one["kinds"] for one in three],
             [["slip_to_stick"], ["two_fold"], ["stick_to_slip"]])
        fold, end = three[1:]
        check(abs(fold["t"] - 2.046276) < 2e-6 and
              abs(fold["omega"] + 1.037) < 1e-6 and
              abs(abs(end["lambda"]) - 1) < 1e-9, str(three))


def test_time_left():
    """On a terminal, of all long work, and nowhere else. It comes two seconds
    after the beginning, for which the processor is left to others; where
    nothing was done by then, with the message after that."""
    running = []
    for i, words in enumerate(LONG):
        for pair, more in (pty.openpty, []), (os.pipe, []), (pty.openpty,
                                                             ["-q"]):
            path = f"rows{i}{pair.__name__}{len(more)}"
            said, end = pair()
            child = subprocess.Popen([TWOFOLD, *words.split(), path, *more],
                                     stderr=end)
            os.close(end)
            running.append((child, said, pair is pty.openpty and not more))
            until(Path(path + ".part").exists, f"{words}: it has begun",
                  child)
            child.send_signal(signal.SIGSTOP)
    time.sleep(2)
    for child, said, is_tty in running:
        child.send_signal(signal.SIGCONT)
    for child, said, is_tty in running:
        seen = b""
        while is_tty and not re.fullmatch(rb"\r\d+ %, [^\n]*, \d+ s left.*",
                                          seen, re.S):
            got = os.read(said, 4096)
            check(got and seen.count(b"\n") < 2, f"no time left: {seen}")
            seen += got
    for child, said, is_tty in running:
        child.kill()
        child.wait()
        try:
            check(is_tty or not os.read(said, 1), "progress that nobody sees")
        except OSError:  # a terminal without a word
            pass


def test_provenance_tells_all_that_matters():
    """What a motion depends on changes a hash or a word; a name does not."""
    variants = {"set": ["plain.scene", "--set", "r=0.21"],
                "by v": ["plain.scene", "--set", "v=0"],
                "seed": ["plain.scene", "--select", "random:3"],
                "another name": ["chaos"]}
    for name, line in (("plain", ""), ("knots", "profile 0:-1 1:-2\n"),
                       ("other", "profile 0:-1 1:-3\n"), ("start", "r 0.2\n"),
                       ("rule", "rule slip+\n"), ("machine", "mu 1.25\n")):
        Path(f"{name}.scene").write_text(
            f"based-on chaos\nname mine\n{line}", "ascii")
        variants[name] = [f"{name}.scene"]
    for name, text in (("one", "t,force\n0,1\n"), ("two", "t,force\n0,2\n"),
                       ("three", "t,torque\n0,1\n")):
        Path(f"{name}.csv").write_text(text, "ascii")
        for between in ("held", "linear"):
            variants[name + between] = ["chaos", "--inputs", f"{name}.csv",
                                        "--between", between]
    said = {name: call("run", *words, "--t-end", "0", "--provenance")[0]
            .replace("scene mine", "scene chaos")
            for name, words in variants.items()}
    same(said["another name"], said.pop("plain"))
    same(len({tuple(text.splitlines()[1:3]) for text in said.values()}),
         len(said))


def test_provenance():
    """Four lines before the header; without them the file is the same."""
    call("run", "chaos", "--t-end", "0.005", "--format", "frames", "--out",
         "frames")
    here = "chaos --r 0.1:0.2:2 --omega=-1.1:-1.05:2"
    for words in (" ".join(SHORT), f"regions {here}", f"atlas {here}",
                  "tyre chaos", "monitor frames --format csv",
                  "diverge chaos --samples 3 --returns -",
                  "diverge chaos --samples 3 --by noise --size 1e-4 "
                  "--patience 0.1 --exits -",
                  "diverge chaos --exhaustive --depth 1 --grid 0.1 "
                  "--patience 1"):
        plain = call(*words.split())[0]
        lines = call(*words.split(), "--provenance")[0].splitlines(True)
        same("".join(lines[4:]), plain)
        for line, form in zip(lines, (
                "# twofold .*commit .*", CHAOS + ".*", "# .*", "# units: .*")):
            check(re.fullmatch(form + "\n", line), line)
    lines = call(*SHORT, "--provenance")[0].splitlines()
    number = call("--version")[0].split()[-1]
    check(re.fullmatch(r"# twofold [0-9.]+, commit \S+, numbers are "
                       + number, lines[0]), lines[0])
    same(lines[2], "# scheme moreau, dt 0.0001 s")
    same(call(*SHORT, "--provenance", "--accuracy", "1")[0].splitlines()[2],
         lines[2] + ", accuracy 1")
    check(re.match(CHAOS, lines[1])[1] in
          call("monitor", "frames", "--format", "csv")[1], "another machine")
    call(*SHORT, "--provenance", "--format", "plotter", code=2)
    call("run", "chaos", "--realtime", "--t-end", "0.02", "--dt", "1e-3",
         "--out", "rows", "--provenance", "--lateness", "late")
    lines = Path("late").read_text("ascii").splitlines()
    check(re.match(CHAOS, lines[1]), lines[1])
    same(lines[3:5], ["# units: us us, began and ended 1 (steps)",
                      "us,began,ended"])


def test_numpy_reads_it():
    try:
        import numpy
    except ImportError:
        lacks("python3-numpy")
    call(*SHORT, "--provenance", "--out", "told")
    one = numpy.genfromtxt("told", delimiter=",", names=True, dtype=None,
                           encoding="ascii", skip_header=4)
    two = numpy.loadtxt("told", delimiter=",", usecols=range(8), skiprows=5)
    same(one.dtype.names[:3], ("t", "r", "v"))
    same((len(one), list(one["r"])), (201, list(two[:, 1])))


# The time left waits; the others are short.
main(globals(), jobs=4)
