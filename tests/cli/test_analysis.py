#!/usr/bin/python3 -B
"""singularities, regions, design, atlas and tyre keep the contract of the
command line: exit codes, columns, JSON that closes, refusals that name option,
value and range, and no file where a command was refused."""
import json
from pathlib import Path

from outputs import fails_to_write, says, says_each, table
from tap import call, check, main, same

POINT = "chaos --r 0.1859 --omega -1.037"
CLOSE = 1e-12


def near(got, want, tolerance=CLOSE):
    check(abs(float(got) - want) <= tolerance, f"got {got}, want {want}")


def described(words):
    return json.loads(call(*words.split())[0])


def rows(words):
    return table(call(*words.split())[0])


def test_singularities():
    found = described("singularities chaos")
    same(found["count"], 2)
    first, second = found["two_folds"]
    for name, value in (("r", 0.1859), ("v", -0.0301217), ("omega", -1.037),
                        ("g", 0.009727385146), ("J1", -1.0635141712155655)):
        near(first[name], value)
    same((first["type"], first["case"]), ("invisible", 1))
    same((second["type"], second["case"]), ("visible", None))
    same(call("singularities", "chaos", "--out", "file")[0], "")
    same(json.loads(Path("file").read_text()), found)
    for scene, reason in (
            ("gamma_right", "kappa |cos gamma| < 2 beta |sin gamma|"),
            ("coulomb", "without a moment"),
            ("smooth", "the friction does not jump"),
            ("frictionless", "the friction does not jump")):
        found = described(f"singularities {scene}")
        same(found["count"], 0)
        check(found["reason"].startswith(reason), found["reason"])
    same(described("singularities chaos --set kappa=0.09")["count"], 0)


def test_regions():
    grid = rows("regions chaos --r 0.17:0.2:3 --omega -1.05:-1:3")
    same([(row["r"], row["omega"], row["region"]) for row in grid],
         [(r, omega, region) for r, *regions in (
             ("0.17", "crossing_up", "escaping", "codim2"),
             ("0.185", "crossing_up", "escaping", "codim2"),
             ("0.2", "sliding", "crossing_down", "codim2"))
          for omega, region in zip(("-1.05", "-1.025", "-1"), regions)])
    same((grid[2]["lambda"], grid[2]["delassus"]), ("", ""))
    near(grid[6]["delassus"], 0.0641221403, 1e-6)  # that of tf_step
    out = says(4, "stopped at r = ",
               *"regions chaos --r 0:1e9:2 --omega 0:1e9:2".split())
    check(out.endswith("\n"), "the rows before it are not whole")


def test_design():
    found = described(f"design {POINT}")
    near(found["kappa"], 0.27241153714062027818)
    near(found["k2"], 2.2270992253886014441)
    found = described("design chaos --r 0.25 --omega -1.06")
    near(described(f"singularities chaos {found['set']}")
         ["two_folds"][0]["r"], 0.25)
    described(f"design {POINT.replace('chaos', 'coulomb')} --set law=jump")


def test_atlas():
    grid = rows("atlas chaos --r 0.1:0.1859:2 --omega -1.037:-1:2")
    names = ["K--_positive", "K++_negative", "J1_negative", "J2_negative",
             "J1J2_above_1", "kappa_positive", "k2_positive", "overlap"]
    same(list(grid[0]), ["r", "omega", "v", "g", "kappa", "k2", "K++", "K+-",
                         "K-+", "K--", "J1", "J2", *names])
    same(list(grid[0].values()), ["0.1", "-1.037", *[""] * 17, "0"])
    same([grid[2][name] for name in names], ["1"] * 8)  # the paper's point
    near(grid[2]["kappa"], 0.27241153714062027818)
    for row in rows("atlas chaos --r 0.01:1:60 --omega -3:1:61"):
        if not row["kappa"]:
            same(row["overlap"], "0")
            continue
        holds = [int(row[name]) for name in names]
        same(holds[-1], int(all(holds[:-1])))
        for name, condition in (("K--", 1), ("K++", -1), ("kappa", 1),
                                ("k2", 1)):
            sign = "positive" if condition > 0 else "negative"
            same(row[f"{name}_{sign}"],
                 str(int(condition * float(row[name]) > 0)))


def test_tyre():
    angles = rows("tyre chaos --angle=-45:90:4")
    same(list(angles[0]), ["angle", "F", "M"])
    near(angles[1]["M"], 0.2724115371406203)  # at 0, for h > 0
    near(angles[3]["F"], 1.3333333333333333)
    near(angles[0]["F"], -float(angles[2]["F"]))


def test_window():
    """A window that is not given lies around the first two-fold."""
    rows = table(call("regions", "chaos")[0])
    same((len(rows), rows[-1]["omega"]), (41 * 41, "0"))
    near(rows[840]["r"], 0.1859)
    near(rows[840]["omega"], -1.037)
    last = table(call("atlas", "chaos", "--r", "0:1:2")[0])[41]
    same((last["r"], last["omega"]), ("1", rows[0]["omega"]))


def test_refusals():
    grid = "--r 0:1:2 --omega 0:1:2"
    Path("kept").write_text("keep")
    says_each(f"""
3 regions smooth {grid}|scene smooth: regions needs law jump
3 regions chaos --set law=none {grid}|--set law=none: regions needs
3 regions gamma_zero {grid}|scene gamma_zero: regions needs |sin(gamma)| in
3 regions chaos --set gamma=0 {grid}|--set gamma=0: regions needs
3 atlas gamma_zero {grid}|gamma_zero: atlas needs |sin(gamma)|
3 atlas chaos --set law=coulomb {grid}|--set law=coulomb: atlas needs law jump
2 design chaos --r 1|--omega W is missing
3 tyre chaos --angle 0:181:2|--angle 0:181:2&[-180, 180] degrees
2 singularities chaos --r 1|unknown option --r
0 singularities chaos --set r=1|--set r=1 has no effect
0 design {POINT} --set kappa=1|kappa=1 has no effect: design finds it
2 regions gamma_right --r 0:1:3|--omega A:B:N are needed&has no two-fold
""")
    says_each("""
3 chaos --r 0.1859 --omega 1|kappa would be -0.27&in [1e-09, 1e+06] m
3 chaos --r 0.05 --omega -2.5|--r 0.05 --omega -2.5: k2 would be -3.7
2 chaos --r 1:2:3 --omega 1|--r 1:2:3
3 chaos --r 0 --omega 1|--r 0: r must not be 0
3 chaos --r 0.1 --omega 1|--r 0.1: k2 does not act
3 chaos --r 0.2 --omega -1|--omega -1: omega must differ from omega0 = -1
3 coulomb --r 0.2 --omega -1.1|scene coulomb: design needs law jump
3 chaos --set mu=0 --r 0.2 --omega -1.1|--set mu=0: design needs mu > 0
3 gamma_right --r 0.2 --omega -1.1|gamma_right: design needs |sin(gamma)|
""", "design")
    for text in ("", "1", "1:2", "1:2:3:4", "::", "1:2:", "1:2:0", "1:2:-1",
                 "1:2:1.5", "1:2:1000001", "1:2:1", "x:1:2", "1:x:2"):
        says(2, f"--r {text}", "regions", "chaos", "--r", text, "--omega",
             "0:1:2", "--out", "kept")
    for text in "1e10:1:2", "0:-1e10:2", "nan:1:2", "0:inf:2":
        says(3, f"--omega {text}&[-1e+09, 1e+09] rad/s", "regions", "chaos",
             "--omega", text, "--r", "0:1:2", "--out", "kept")
    same(Path("kept").read_text(), "keep")


def test_outputs_that_fail():
    fails_to_write(20, "atlas", "chaos", "--r", "0:1:1000", "--omega",
                   "0:1:1000")


main(globals(), jobs=2)
