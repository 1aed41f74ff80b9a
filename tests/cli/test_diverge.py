#!/usr/bin/python3 -B
"""`twofold diverge`: the same bytes whatever the shards, exits from the
two-fold where and as often as declared, refusals that say why and leave no
file, whole cycles on disk after an interrupt. After a kill: test_endings.py."""
from pathlib import Path

from outputs import check_whole, column, interrupted, says_each, table
from tap import call, check, main, same

FEW = ["chaos", "--samples", "4", "--patience", "0.3", "--seed", "5"]
# The first h = g = 0 of `chaos`.
AT = ["--set", "r=0.17986265324413", "--set", "omega=-1", "--set", "h=0"]


def diverge(*words):
    """The bytes of both files."""
    call("diverge", *words, "--exits", "e", "--returns", "r")
    return Path("e").read_text(), Path("r").read_text()


def rows_of(*words):
    return [table(text) for text in diverge(*words)]


def share(rows, holds, low, high=1.0):
    """The share of rows for which it holds."""
    got = sum(map(bool, map(holds, rows))) / len(rows)
    check(low <= got <= high, f"share {got}, want {low} to {high}")


def test_shards():
    """Their files, one after the other, are those of the run."""
    for kind in "random --codim2 even --cycles 3", "noise --size 1e-6":
        words = [*FEW, "--by", *kind.split()]
        whole = diverge(*words)
        same(diverge(*words), whole)
        parts = [diverge(*words, "--shard", f"{i}/3") for i in (1, 2, 3)]
        same(["".join(files) for files in zip(*parts)], list(whole))
        same([text.splitlines()[0] for text in whole],
             ["sample,cycle,time,r,omega,g,side,phase,how,section_time",
              "sample,cycle,outcome,time,arrived,exit_r,landing_time,"
              "landing_r,landings,windings"])
        samples = dict.fromkeys(column(table(whole[1]), "sample"))
        same(list(samples), [str(i) for i in range(4)])
    check(diverge(*FEW[:-1], "6")[0] != diverge(*FEW)[0], "a seed is a run")
    same(call("diverge", "chaos", "--samples", "2", "--shard", "3/3")[0], "")
    out = call("diverge", "chaos", "--samples", "4", "--shard", "2/2",
               "--header", "--rate", "0", "--patience", "1")[0]
    check(out.startswith("sample,cycle"), "a header if asked for")


def test_rows_say_what_the_rule_declares():
    """2000 exits, four standard deviations."""
    exits, _ = rows_of("chaos", "--samples", "2000", "--rate", "200",
                       "--patience", "0.2", "--seed", "3")

    def from_weak_direction(row):
        r, omega = float(row["r"]) - 0.1859, float(row["omega"]) + 1.037
        return r * r + 1e-12 > (omega + 10.244253 * r) ** 2
    share(exits, lambda row: float(row["time"]) < 0.005, 0.589, 0.675)
    share(exits, lambda row: float(row["r"]) < 0.1859, 1)
    share(exits, from_weak_direction, 1)
    for codim2, patience, outcome, low in (("even", 200, "returned", 0.95),
                                           ("noise", 200, "returned", 0.95),
                                           ("attracting", 20, "small_cycle",
                                            0.9)):
        rows = table(call("diverge", "chaos", "--samples", "40", "--codim2",
                          codim2, "--patience", patience, "--seed", "4")[0])
        share(rows, lambda row, want=outcome: row["outcome"] == want, low)
    exits, _ = rows_of("chaos", "--set", "r=0.18", "--set", "omega=-1.02",
                       "--set", "h=0", "--samples", "20", "--rate", "100",
                       "--patience", "0.5")
    same(len(exits), 20)  # an escaping start is left


def test_rows_do_not_depend_on_dt():
    """Every winding is counted, also those of microseconds."""
    fine, coarse = (rows_of("chaos", "--samples", "300", "--dt", dt)
                    for dt in (0.002, 0.05))
    same(column(coarse[1], "windings"), column(fine[1], "windings"))
    for a, b in zip(fine[0], coarse[0]):
        same([a["time"], a["side"]], [b["time"], b["side"]])
        if a["phase"]:
            check(abs(float(a["phase"]) - float(b["phase"])) < 1e-3, b)


def test_noise():
    """Steps that do not resolve the noise at h = g = 0 have half of these rest
    there before they have wound. Finer steps there leave the exits as they
    are."""
    words = ("chaos", "--by", "noise", "--size", "1e-5", "--samples", "10",
             "--seed", "3")
    exits, returns = rows_of(*words)
    share(exits, lambda row: row["phase"], 1)
    finer = rows_of(*words, "--fine", "20")
    same(column(finer[0], "r"), column(exits, "r"))
    check(finer[1] != returns, "--fine changes nothing")
    share(returns, lambda row: row["outcome"] == "returned", 1)


# All branches.

def branches(*words):
    return table(call("diverge", "chaos", "--exhaustive", *words)[0])


def test_branches():
    rows = branches("--depth", "1", "--grid", "0.1", "--patience", "0.5")
    left = [(row["mode"], float(row["stick_time"])) for row in rows]
    same([left.count(one) for one in (("slip+", 0.1), ("slip-", 0.1),
                                      ("slip+", 3 * 0.1))], [1, 1, 1])
    call("diverge", "chaos", "--exhaustive", "--depth", "1", "--grid", "0.1",
         "--patience", "0.5", "--branches", "b")
    same(table(Path("b").read_text()), rows)
    rows = branches("--depth", "3", "--grid", "0.1", "--patience", "1",
                    "--count", "5")
    check(len(rows) > 3 and all(int(row["node"]) < 5 and
                                int(row["to"] or 0) < 5 for row in rows),
          "more places than --count")


def test_branches_of_a_start():
    """One for each mode, of which the first row of `run` has as many."""
    for law, *modes in (("hull", "slip-", "stick+", "stick-", "pinned"),
                        ("bow_tie", "slip-", "stick+", "stick-")):
        words = [*AT, "--set", f"rest={law}"]
        same(column(branches("--depth", "1", *words), "mode"), modes)
        run = table(call("run", "chaos", *words, "--t-end", "1e-4")[0])
        same(run[0]["choices"], str(len(modes)))


def test_branches_that_meet():
    """Those that end at one place are joined, and have its number."""
    rows = branches("--depth", "4", "--grid", "0.2", "--patience", "3")
    check({"slip-", "stick-", "pinned"} <= set(column(
        [row for row in rows if row["kind"] == "codim2"], "mode")),
        "a mode of h = g = 0 is not followed")
    same(set(column([row for row in rows if row["end"] == "two-fold"], "to")),
         {"0"})
    ends = [(row["to"], float(row["end_r"])) for row in rows
            if row["end"] == "codim2" and row["to"]]
    places = {}
    for number, r in ends:
        check(abs(places.setdefault(number, r) - r) < 2e-6, "two places")
    check(1 < len(places) < len(ends), "nothing is joined")
    same(len(set(places.values())), len(places))


def test_refusals():
    files = "--exits e.csv --returns r.csv"
    says_each("\n".join(
        [f"2 chaos {option} {files}|only with --exhaustive" for option in (
            "--depth 2", "--count 5", "--grid 0.1", "--branches b.csv")] +
        [f"""
3 chaos --rate nan {files}|--rate nan: rate must lie in [0, 1e+09] 1/s
3 chaos --by noise --size inf {files}|--size inf: must lie in (0, 1]
3 chaos --set r=0.3 --set omega=-0.5 --set h=0.1 {files}|has one future
2 chaos --by noise {files}|give --size
2 chaos --by delay --size 1 {files}|unknown kind
2 chaos --size 1 {files}|has a --rate
3 chaos --shard 5/4 {files}|I must lie in
2 chaos --shard 3 {files}|expected I/N
3 coulomb {files}|no two-fold
3 driven {files}|driven
2 chaos --exhaustive --shard 1/2|--exhaustive
2 chaos --resume|--resume: only with
4 chaos --exits e.csv --returns no/such/r.csv|No such
4 chaos --exhaustive --branches no/such/b.csv|--branches no/such/b.csv: No such
""".strip()]), "diverge")
    same(list(Path().iterdir()), [])


def test_an_interrupt_leaves_whole_cycles():
    interrupted("r", "diverge", "chaos", "--samples", "1000000", "--codim2",
                "even", "--cycles", "1000", "--exits", "e", "--returns", "r")
    check_whole("r.part", 10)
    same(*(Path(name).read_text().count("\n") for name in ("e.part", "r.part")))


main(globals(), jobs=2)
