#!/usr/bin/python3 -B
"""`twofold sweep`: a row is what `run` does with the same settings, shards and
files that are gone on with have the bytes of one run, a point that is refused
has a row that says why, and errors name axis and range."""
import os
import re
import signal
from pathlib import Path

import outputs
from outputs import check_whole, column, says, says_each, table
from tap import TWOFOLD, call, check, main, same, until

def children(process):
    """The processes that one has started."""
    return [*map(int, Path(f"/proc/{process}/task/{process}/children")
                 .read_text().split())]


ENDS = ["end_r", "end_v", "end_omega", "end_h", "end_g"]
ALL = ["modes", "final", "changes", "rest", "arrivals", "arrival", "recurrence",
       "ambiguous", "set", "ambiguous_share", "stick_share", "energy",
       "energy_change", "r_low", "r_high", *ENDS]
GRID = ["chaos", "--over", "kappa=0.2:0.4:5", "--over", "gamma=0.3:1.2:5",
        "--dt", "1e-3"]
INPUTS = "t,force,r0\n0,0,0.1\n0.5,0.4,0.12\n1.3,-0.2,0.1\n"


def sweep(*words):
    return table(call("sweep", *words)[0])


def outcomes(*names):
    return ["--outcome", ",".join(names)]


def ends_of_run(*words):
    """The last fields of `run` that a sweep has, too; rows; what is said."""
    out, said = call("run", *words, code=(0, 5))
    rows = table(out)
    ends = [rows[-1][name] for name in ("r", "v", "omega", "h", "g")]
    return ends, rows, said


def test_rows_are_those_of_run():
    words = ["chaos", "--dt", "1e-3", "--t-end", "4", "--set", "mu=1.5"]
    rows = sweep(*words, "--over", "kappa=0.25:0.29:2", "--over",
                 "h=-0.01:0.01:3", *outcomes(*ALL))
    same(column(rows, "point", "kappa", "h"),
         [("0", "0.25", "-0.01"), ("1", "0.25", "0"), ("2", "0.25", "0.01"),
          ("3", "0.29", "-0.01"), ("4", "0.29", "0"), ("5", "0.29", "0.01")])
    for row in rows:
        settings = [f"--set={name}={row[name]}" for name in ("kappa", "h")]
        ends, steps, said = ends_of_run(*words, *settings)
        arrivals = re.search(r"two-fold reached (\d+)", said)
        modes = column(steps, "mode")
        first, set_ = next((column([step], "t", "set")[0] for step in steps
                            if int(step["choices"]) > 1),
                           ("", steps[-1]["set"]))
        r = sorted(column(steps, "r"), key=float)
        same([row[name] for name in ENDS], ends)
        same([row["t"], row["final"], row["ambiguous"], row["set"],
              row["r_low"], row["r_high"], row["arrivals"]],
             [steps[-1]["t"], modes[-1], first, set_, r[0], r[-1],
              arrivals[1] if arrivals else "0"])
        same(set(row["modes"].split("|")), set(modes))
        same(int(row["changes"]),
             sum(a != b for a, b in zip(modes, modes[1:])))


def test_outcomes():
    rows = sweep("chaos", "--over", "r=0.1:0.3:2", "--set", "omega=-1",
                 "--set", "h=0", "--set", "mu=1", *outcomes("rest", "modes"))
    same(column(rows, "rest", "modes"),  # pinned for a while is no rest
         [("", "slip+|slip-|stick+|stick-|pinned"), ("0", "pinned")])
    names = ["t", "modes", "rest", "recurrence", "ambiguous",
             "ambiguous_share", "energy_change", "energy"]
    before, after = (sweep("chaos", "--over", "mu=1.5:1.5:1", "--t-end", t_end,
                           *outcomes(*names[1:])) for t_end in (0, 2))
    same(column(before, *names[:-1]), [("0", "slip+", "", "", "", "", "0")])
    check(abs(float(after[0]["energy"]) - float(before[0]["energy"]) -
              float(after[0]["energy_change"])) < 1e-6, "it is since t = 0")


def test_seeds():
    """In float the seeds of a range would be one real number."""
    for program in (TWOFOLD, TWOFOLD.replace("/double/", "/float/")):
        if Path(program).exists():
            rows = table(call(
                "sweep", "chaos", "--over", "seed=100000000:100000003:4",
                "--select", "random", "--t-end", "3", *outcomes("end_r"),
                program=program)[0])
            run = table(call("run", "chaos", "--select", "random:100000002",
                             "--t-end", "3", program=program)[0])
            same((rows[2]["seed"], rows[2]["end_r"]),
                 ("100000002", run[-1]["r"]))


def test_inputs_over_time():
    """With a step that is swept, too, so that the rows of the table begin at
    other steps."""
    Path("in.csv").write_text(INPUTS)
    for between in "held", "linear":
        words = ["chaos", "--t-end", "2", "--inputs", "in.csv", "--between",
                 between]
        rows = sweep(*words, "--over", "dt=1e-3:4e-3:2", "--over",
                     "mu=1:1.5:2", *outcomes(*ENDS, "energy_change"))
        for row in rows:
            same([row[name] for name in ENDS], ends_of_run(
                *words, "--dt", row["dt"], "--set", f"mu={row['mu']}")[0])
    (alone,) = sweep("chaos", "--t-end", "2", "--over", "mu=1:1:1",
                     *outcomes("end_r"))
    check(alone["end_r"] != rows[0]["end_r"], "inputs make no difference")
    rows = sweep("chaos", "--inputs", "in.csv", "--between", "held",
                 "--select", "random", "--over", "seed=1:3:3", "--over",
                 "r=0.18:0.19:2", "--t-end", "3", *outcomes("end_r"))
    same(len(set(column(rows, "end_r"))), 6)
    says(0, "--over r0=0.1:0.2:2 has no effect: in.csv gives r0", "sweep",
         "chaos", "--inputs", "in.csv", "--between", "held", "--over",
         "r0=0.1:0.2:2")


def test_what_the_rows_are_of():
    """Comments only under --provenance, four before the header."""
    Path("in.csv").write_text(INPUTS)
    words = ["sweep", "chaos", "--over", "mu=1:2:3", "--t-end", "1", "--inputs",
             "in.csv", "--between", "held"]
    plain, told = (call(*words, *more)[0] for more in ([], ["--provenance"]))
    number = call("--version")[0].split()[-1]
    program, scene, command, units = told[:-len(plain)].splitlines()
    check(plain.startswith("point,mu,status,reason,t,modes") and
          told.endswith(plain), "other rows, or other comments")
    check(re.fullmatch(f"# twofold [0-9.]+, commit [^ ]+, numbers are {number}",
                       program) and
          re.fullmatch("# scene chaos, hash [0-9a-f]{8}", scene), told)
    check(re.match(r"# sweep chaos --scheme moreau --t-end 1 --inputs in.csv "
                   r"--between held \([0-9a-f]{8}\) --over mu=1:2:3 --outcome",
                   command), command)
    same(units, "# units: mu N, rest s, recurrence s, energy J, ambiguous s, "
         "t s")


# Files that are gone on with.

SLOW = ["sweep", "chaos", "--over", "kappa=0.25:0.3:150", "--over",
        "h=-0.01:0.01:3", "--t-end", "2"]


def test_of_a_whole_file_nothing_is_done():
    words = ["sweep", *GRID, "--resume", "--out"]
    call(*words, "x")
    before = Path("x").stat().st_mtime_ns
    says(0, "x has all of its 25 points", *words, "x")
    same(Path("x").stat().st_mtime_ns, before)
    call("sweep", *GRID, "--out", "y")
    same({path.name for path in Path().iterdir()}, {"x", "x.resume", "y"})
    says(3, "--resume: y has no notes in y.resume", *words, "y")


def test_rows_of_another_sweep():
    """They are neither overwritten nor gone on with."""
    call("sweep", *GRID, "--out", "whole", "--resume")
    outputs.interrupted("x", *SLOW, "--out", "x")
    part = Path("x.part").read_bytes()
    says(3, "x.part has rows of a sweep that was stopped: use --resume", *SLOW,
         "--out", "x")
    for other in (["--set", "mu=1.1"], ["--t-end", "9"], ["--shard", "1/2"],
                  ["--outcome", "rest"], ["--scheme", "located"],
                  ["--provenance"]):
        words = [word for word in SLOW[1:] if other[0] != "--t-end" or
                 word not in ("--t-end", "2")]
        says(3, "x.part is of another sweep, or of another build", "sweep",
             *words, *other, "--out", "x", "--resume")
        says(3, "whole is of another sweep, or of another build", "sweep",
             *GRID, *other, "--out", "whole", "--resume")
    notes = Path("x.resume").read_bytes()
    Path("x.resume").write_bytes(notes[:-3] + b"x" + notes[-2:])
    says(3, "x.resume is damaged", *SLOW, "--out", "x", "--resume")
    Path("x.resume").unlink()
    says(3, "x.part has no notes in x.resume", *SLOW, "--out", "x", "--resume")
    same(Path("x.part").read_bytes(), part)
    Path("in.csv").write_text(INPUTS)
    words = ["sweep", "chaos", "--over", "mu=1:2:3", "--t-end", "1", "--inputs",
             "in.csv", "--between", "held", "--out", "driven", "--resume"]
    call(*words)
    Path("in.csv").write_text("t,force\n0,0.1\n")
    says(3, "driven is of another sweep", *words)


def test_refused_and_flagged_points():
    row = sweep("chaos", "--over", "gamma=-0.5:0.5:3", *outcomes("modes"))[1]
    same(column([row], "gamma", "status", "t", "modes"),
         [("0", "refused", "", "")])
    check("no speed v gives the slip speed h" in row["reason"], row)
    text = call("sweep", "chaos", "--over", "omega=-3e5:3e5:3", "--over",
                "dt=1e-3:1:2", "--set", "r=100", *outcomes("modes"))[0]
    stopped = [row for row in table(text) if row["status"] == "stopped"]
    check(stopped and all(
        re.match(r"step \d+: ", row["reason"]) and float(row["t"]) >= 0
        for row in stopped), "a step that is refused stops the motion")
    Path("rows").write_text(text)
    check_whole("rows", 7)  # no field has a comma
    flagged = [row for row in sweep(
        "chaos", "--over", "omega=-30:-1:9", "--dt", "0.3", "--set", "h=0.1",
        *outcomes("modes")) if row["status"] == "flagged"]
    check(flagged and all(re.search(r"\d+ steps degraded; \d+ coarse",
                                    row["reason"]) for row in flagged), flagged)


def test_lanes():
    """Points of one machine go together, in lanes of an ensemble, with the
    rows of shards: of few points, and of one, which takes single steps."""
    Path("in.csv").write_text(
        "t,force,omega0\n0,0,-1\n0.5,0.4,-1.1\n1.3,-0.2,-1\n")
    statuses = set()
    for words in (
            "chaos --over r=0.17:0.19:7 --over h=-0.01:0.01:5 --dt 1e-3 "
            "--t-end 3", "chaos --select random --over seed=1:9:9 --over "
            "omega=-1.1:-1:2 --t-end 4 --dt 1e-3", "driven --inputs in.csv "
            "--between linear --t-end 2 --dt 1e-3 --over v=-0.1:0.1:17 "
            "--scheme moreau", "chaos --over r=0:9e8:5 --over omega=-9e8:0:5 "
            "--t-end 0.01", "chaos --over omega=-3e5:-1:19 --set h=0.1 "
            "--dt 0.3"):
        words = ["sweep", *words.split(), *outcomes(*ALL)]
        whole, said = call(*words)
        check(re.search(r"\ncost .* s, [0-9.e+]+ points/s, in lanes", said),
              said)
        points = whole.count("\n") - 1
        for shards in 3, points:
            same("".join(call(*words, "--shard", f"{i + 1}/{shards}")[0]
                         for i in range(shards)), whole)
        statuses |= set(column(table(whole), "status"))
    same(statuses, {"done", "flagged", "refused", "stopped"})
    for words in ("kappa=0.2:0.3:2", "r=0.1:0.2:2 --scheme located",
                  "r=0.1:0.2:2 --set law=coulomb", "dt=1e-3:2e-3:2"):
        says(0, "points/s, one by one", "sweep", "chaos", "--t-end", "0.1",
             "--over", *words.split())


def test_jobs():
    """Their number does not show in the rows, nor where one goes on, whatever
    ended the program; and none outlives it."""
    for words in SLOW, ["sweep", *GRID], ["sweep", *GRID, "--shard", "2/3"]:
        same(len({call(*words, f"-j{n}")[0] for n in (1, 2, 7)}), 1)
    whole = call(*SLOW, "--jobs=1")[0]
    for number, first, then in ((signal.SIGINT, 3, 2), (signal.SIGKILL, 2, 5)):
        child = outputs.started("x", *SLOW, "-j", first, "--out", "x")
        there = children(child.pid)
        same(len(there), first)
        child.send_signal(number)
        child.communicate()
        until(lambda: not any(Path(f"/proc/{n}").exists() for n in there), "")
        said = call(*SLOW, "--out", "x", "--resume", "-j", then)[1]
        check("of them kept" in said and f"{then} jobs" in said, said)
        same(Path("x").read_text(), whole)
        Path("x").unlink()
        Path("x.resume").unlink()


def test_a_job_that_ends():
    words = [word.replace(":150", ":90000") for word in SLOW]
    child = outputs.started("x", *words, "-j", "2", "--out", "x")
    os.kill(children(child.pid)[0], signal.SIGKILL)
    said = child.communicate()[1]
    same(child.returncode, 4)
    check("a process ended at point" in said and "x.part" in said, said)


def test_refusals():
    says_each("""
2 chaos|--over NAME=A:B:N is missing
2 chaos --over kapa=0.1:1:2 --out kept|unknown name 'kapa'; did you mean
2 chaos --over kappa --out kept|--over kappa: expected NAME=A:B:N
3 chaos --over kappa=0:1:2 --out kept|--over kappa=0:1:2: kappa must&[1e-09,
2 chaos --over kappa=0.1:1:2 --set kappa=1 --out kept|kappa was already given
2 chaos --over kappa=0.1:1:2 --over kappa=1:2:2 --out kept|already given
2 chaos --over law=0:1:2 --out kept|unknown law
2 chaos --over seed=1:2:2 --out kept|only with --select random
3 chaos --over seed=1:2:3 --select random|seed must be whole&value 2 is 1.5
2 chaos --over kappa=0.1:1:2 --outcome enrgy --out kept|did you mean 'energy'
2 chaos --over kappa=0.1:1:2 --outcome rest,rest|rest was already given
2 chaos --over kappa=0.1:1:2 --outcome rest,|unknown outcome ''
2 chaos --over kappa=0.1:1:2 --resume|--resume: only with --out FILE
""", "sweep")
    same(list(Path().iterdir()), [])


main(globals(), jobs=2)
