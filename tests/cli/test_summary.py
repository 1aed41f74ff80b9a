#!/usr/bin/python3 -B
"""What programs read: the summary as JSON, the time left, and rows that say
what they are of in a form that numpy skips."""
import json
import os
import pty
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from tap import TWOFOLD, call, check, lacks, main, same, until  # noqa: E402

SHORT = ["run", "chaos", "--t-end", "0.2", "--every", "10"]
CHAOS = r"# scene chaos, (?:hash [0-9a-f]{8}, )?parameters ([0-9a-f]{8})"


def told(*words, code=0):
    """The summary of a command as JSON: one line, the last one."""
    lines = call(*words, "--summary", "json", code=code)[1].splitlines()
    same([line[0] for line in lines].count("{"), 1)
    summary = json.loads(lines[-1])
    same(summary["exit"], code)
    return summary


def rows_of(path):
    """Rows of a file that begin with a digit."""
    lines = Path(path).read_text("ascii").splitlines()
    return [line.split(",") for line in lines if line[:1].isdigit()]


def test_run():
    _, err = call(*SHORT, "--summary", "json", "--set", "rate=3")
    same("note: --set rate=3 has no effect" in err, True)
    got = told("run", "chaos", "--t-end", "3", "--every", "100", "--out",
               "rows")
    same([got[key] for key in ("command", "scene", "steps", "end")],
         ["run", "chaos", 30000, "done"])
    same(got["final"]["r"], float(rows_of("rows")[-1][1]))
    same(got["events"]["two_fold"], 1)
    same(got["events"]["list"][0]["kinds"], ["slip_to_stick", "codim2"])


def test_start_with_several_modes():
    """It is the first ambiguous instant, also where no step follows; a run that
    goes on from another one has no start of its own."""
    here = ["--set", "omega=-1.02"]
    for h, t_end, choices, steps, since in (
            ("0", "0", 3, 0, 0), ("0", "0.001", 3, 10, 0),
            ("1e-3", "0", 1, 0, None), ("1e-3", "0.001", 1, 0, None)):
        words = ["run", "chaos", *here, "--set", f"h={h}", "--t-end", t_end]
        got = told(*words, "--save", "at", "--out", "rows")
        same([got[key] for key in ("choices_at_start", "ambiguous",
                                   "ambiguous_since")],
             [choices, steps, since])
        same(rows_of("rows")[0][-1], str(choices))
        text = re.search("^ambiguous  several modes (.*)$",
                         call(*words)[1], re.M)[1]
        same(text, ("at the start and " if choices > 1 else "")
             + f"in {steps} steps" + " (100 %)" * (steps > 0)
             + ", first at t = 0 s" * (since == 0))
        call("sweep", "chaos", *here, "--over", f"h={h}:{h}:1", "--t-end",
             t_end, "--outcome", "ambiguous", "--out", "rows")
        same(rows_of("rows")[0][-1], "" if since is None else "0")
        if steps > 0:
            got = told("run", "chaos", "--t-end", "0.002", "--from", "at",
                       "--out", "rows")
            same((got["choices_at_start"], got["ambiguous"],
                  round(got["ambiguous_since"], 9)), (None, 10, 0.0011))


def test_inputs_of_run():
    """The profile; a table, whose path is quoted; what was applied of it."""
    words = ["--t-end", "1", "--every", "100", "--out", "rows"]
    same(told("run", "driven", *words)["profile"]["rows"], 5)
    name = 'a "b" \\.csv'
    Path(name).write_text("t,force\n0,0.1\n0.5,-0.3\n2,0.7\n", "ascii")
    held = told("run", "frictionless", *words, "--inputs", name, "--between",
                "held")
    same(held["inputs"]["name"], name)
    same(held["inputs"]["applied"], {"force": [-0.3, 0.1]})
    dt = 0.001
    got = told("run", "frictionless", *words, "--dt", str(dt), "--inputs",
               name, "--between", "linear")["inputs"]["applied"]["force"]
    same([told("run", "frictionless", *words[2:], "--inputs", name, "--between",
               "linear", "--t-end", t)["inputs"]["last"]
          for t in ("0.4", "0.5", "0.6")], [1, 1, 2])
    # The mean of the two ends of a step: of the first one behind the knot of
    # -0.3 N, and of the very first one.
    want = [-0.3 + 1 / 1.5 * dt / 2, 0.1 - 0.8 * dt / 2]
    same([round(x, 9) for x in got], [round(x, 9) for x in want])
    last = told("run", "frictionless", "--t-end", "0.5", "--every", "100",
                "--out", "rows", "--inputs", name, "--between", "held")
    same(last["inputs"]["applied"], {"force": [0.1, 0.1]})


def test_codes_of_run():
    got = told("run", "chaos", "--set", "k2=1e10", "--t-end", "1", "--dt",
               "0.01", "--out", "rows", code=5)
    same(got["end"], "done")
    got = told("run", "chaos", "--set", "v=9e8", "--dt", "0.1", code=4)
    same(got["end"], "refused")


def test_refusals():
    """Of every command, before it has done anything, in either order."""
    for words, code, why in (
            (["run", "chaos", "--set", "mu=-1"], 3, "mu must lie in"),
            (["run", "chaos", "--set", "segments=70000"], 3, "in [0, 1000]"),
            (["run", "chaos", "--set", "segments=nan"], 3, "in [0, 1000]"),
            (["run", "nowhere"], 2, "nowhere"),
            (["run", "chaos", "--out", "none/rows"], 4, "none/rows"),
            (["sweep", "chaos", "--over", "mu=1:2"], 2, "mu=1:2"),
            (["diverge", "coulomb"], 3, "has no two-fold"),
            (["monitor", "nothing"], 4, "nothing"),
            (["regions", "chaos"], 2, "--summary")):
        got = told(*words, code=code)
        same((got["command"], why in got["message"]), (words[0], True))
    _, err = call("run", "--summary=json", "chaos", "--t-end", "no", code=2)
    same(json.loads(err.splitlines()[-1])["exit"], 2)
    _, err = call("run", "chaos", "--summary", "xml", code=2)
    same("--summary xml: must be text or json" in err, True)


def test_sweep():
    got = told("sweep", "chaos", "--over", "mu=1:2:3", "--over", "r=0:1e9:2",
               "--t-end", "0.1", "--out", "rows")
    done = [row for row in rows_of("rows") if "done" in row]
    same((got["points"], got["done"], got["kept"], got["together"]),
         (6, len(done), 0, 1))
    same(f"twofold {got['version']}, tf_real_t is {got['number']}",
         call("--version")[0].strip())


def test_diverge():
    got = told("diverge", "chaos", "--samples", "3", "--cycles", "2",
               "--returns", "rows")
    same((got["samples"], got["done"], got["cycles"]),
         (3, 3, len(rows_of("rows"))))
    got = told("diverge", "chaos", "--exhaustive", "--depth", "1", "--grid",
               "0.1", "--patience", "1", "--branches", "rows")
    same(got["branches"], len(rows_of("rows")))


def test_monitor():
    call("run", "chaos", "--t-end", "0.005", "--format", "frames", "--out",
         "frames")
    got = told("monitor", "frames", "--format", "csv", "--out", "rows")
    same((got["rows"], got["last"]["step"]), (len(rows_of("rows")), 50))
    two_folds = json.loads(call("singularities", "chaos")[0])
    same((got["parameters"], two_folds["units"]["r"]),
         (two_folds["parameters"], "m"))


LONG = [["diverge", "chaos", "--samples", "100000", "--cycles", "10",
         "--returns"],
        ["diverge", "chaos", "--exhaustive", "--grid", "1e-6", "--count",
         "1000000", "--branches"],
        ["sweep", "chaos", "--over", "mu=1:2:100000", "--out"],
        ["regions", "chaos", "--r", "0.1:0.2:100000", "--omega=-1:1:99",
         "--out"],
        ["atlas", "chaos", "--r", "0.1:0.2:100000", "--omega=-1:1:99",
         "--out"],
        ["run", "chaos", "--t-end", "1e6", "--every", "1000000", "--out"]]


def in_a_log(words):
    """Its process, and where it speaks."""
    said, end = os.pipe()
    pid = subprocess.Popen([TWOFOLD, *words], stderr=end).pid
    os.close(end)
    return pid, said


def on_a_terminal(words):
    pid, terminal = pty.fork()
    if pid == 0:
        os.execv(TWOFOLD, [TWOFOLD, *words])
    return pid, terminal


def test_time_left():
    """On a terminal and in a log, of all long work. It comes two seconds after
    the beginning, for which the processor is left to others; where nothing was
    done by then, with the message after that."""
    running = []
    for i, words in enumerate(LONG):
        for how, form in ((in_a_log, rb"(twofold: 0 of [^\n]*\n)?"
                           rb"twofold: [^\n]*, \d+ s left\n"),
                          (on_a_terminal, rb"[^\n]*, \d+ s left.*")):
            path = f"rows{i}{how.__name__}"
            pid, said = how([*words, path])
            running.append((pid, said, form))
            until(Path(path + ".part").exists, f"{words}: it has begun")
            os.kill(pid, signal.SIGSTOP)
    begun = time.monotonic()
    until(lambda: time.monotonic() - begun > 2, "the time of a first message")
    for pid, said, form in running:
        os.kill(pid, signal.SIGCONT)
        seen = b""
        while not re.fullmatch(form, seen, re.S):
            got = os.read(said, 4096)
            check(got and seen.count(b"\n") < 2, f"no time left: {seen}")
            seen += got
        os.kill(pid, signal.SIGKILL)


def test_provenance_tells_all_that_matters():
    """What a motion depends on changes a hash or a word; a name does not."""
    scenes = {"plain": "", "knots": "profile 0:-1 1:-2\n",
              "other": "profile 0:-1 1:-3\n", "start": "r 0.2\n",
              "rule": "rule slip+\n", "machine": "mu 1.25\n"}
    tables = {"one": "t,force\n0,1\n", "two": "t,force\n0,2\n",
              "three": "t,torque\n0,1\n"}
    told_by = {}
    for name, lines in scenes.items():
        Path(f"{name}.scene").write_text(
            f"based-on chaos\nname mine\n{lines}", "ascii")
        told_by[name] = [f"{name}.scene"]
    for name, text in tables.items():
        Path(f"{name}.csv").write_text(text, "ascii")
        for between in ("held", "linear"):
            told_by[name + between] = ["chaos", "--inputs", f"{name}.csv",
                                       "--between", between]
    told_by["set"] = ["plain.scene", "--set", "r=0.21"]
    told_by["by v"] = ["plain.scene", "--set", "v=0"]
    told_by["seed"] = ["plain.scene", "--select", "random:3"]
    seen = {}
    for name, words in told_by.items():
        lines = call("run", *words, "--t-end", "0", "--provenance")[0]
        said = tuple(line.replace("scene mine", "scene chaos")
                     for line in lines.splitlines()[1:3])
        same(seen.setdefault(said, name), name)
    same(call("run", "plain.scene", "--t-end", "0", "--provenance")[0].replace(
        "scene mine", "scene chaos"),
        call("run", "chaos", "--t-end", "0", "--provenance")[0])


def test_provenance():
    """Four lines before the header; without them the file is the same."""
    call("run", "chaos", "--t-end", "0.005", "--format", "frames", "--out",
         "frames")
    for words in (SHORT,
                  ["regions", "chaos", "--r", "0.1:0.2:2", "--omega=-1:1:2"],
                  ["atlas", "chaos", "--r", "0.1:0.2:2",
                   "--omega=-1.1:-1.05:2"],
                  ["tyre", "chaos"],
                  ["diverge", "chaos", "--samples", "3", "--returns", "-"],
                  ["diverge", "chaos", "--samples", "3", "--by", "noise",
                   "--size", "1e-4", "--patience", "0.1", "--exits", "-"],
                  ["diverge", "chaos", "--exhaustive", "--depth", "1",
                   "--grid", "0.1", "--patience", "1"],
                  ["monitor", "frames", "--format", "csv"]):
        plain = call(*words)[0]
        lines = call(*words, "--provenance")[0].splitlines(keepends=True)
        same("".join(lines[4:]), plain)
        for line, form in zip(lines, (
                "# twofold .*commit .*", CHAOS + ".*", "# .*", "# units: .*")):
            same(bool(re.fullmatch(form + "\n", line)), True)
    lines = call(*SHORT, "--provenance")[0].splitlines()
    number = call("--version")[0].split()[-1]
    same(bool(re.fullmatch(r"# twofold [0-9.]+, commit \S+, numbers are "
                           + number, lines[0])), True)
    same(lines[2], "# scheme moreau, dt 0.0001 s")
    same(call(*SHORT, "--provenance", "--accuracy", "1")[0].splitlines()[2],
         lines[2] + ", accuracy 1")
    same(re.match(CHAOS, lines[1])[1] in call("monitor", "frames",
                                              "--format", "csv")[1],
         True)
    call(*SHORT, "--provenance", "--format", "plotter", code=2)


def test_provenance_of_lateness():
    call("run", "chaos", "--realtime", "--t-end", "0.02", "--dt", "1e-3",
         "--out", "rows", "--provenance", "--lateness", "late")
    lines = Path("late").read_text("ascii").splitlines()
    same(bool(re.match(CHAOS, lines[1])), True)
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
