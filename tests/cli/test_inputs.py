#!/usr/bin/python3 -B
"""Inputs over time: the profile of a scene is such a table with the same bits,
a table does what it says between two rows, and what is wrong in one is named by
line, column and reason."""
import math
import subprocess
from pathlib import Path

import outputs
from tap import TWOFOLD, call, check, main, same

SCHEMES = ("moreau", "located", "compensated")
KNOTS = "# knots of driven\nt,omega0\n0,-1\n2,-2\n4,-2\n8,1\n10,0\n"
JUMP = "t,omega0\n0,-1\n0.3,-1\n0.3,-0.8\n"
BINARY = "run chaos --dt 0x1p-10"  # [s], so that times are exact


def command(words, text=None, between="linear"):
    """A command, under a table."""
    if text is None:
        return words.split()
    Path("table.csv").write_bytes(text.encode())
    return [*words.split(), "--inputs", "table.csv", "--between", between]


def says(texts, *given, code=0):
    """Its rows, where it says all texts, which stand between &."""
    return outputs.says(code, texts, *command(*given))


def rows(*given):
    return says("", *given)


def lines(head, values):
    return "\n".join([head, *(",".join(map(repr, row)) for row in values), ""])


def within(count, *given):
    """Likewise, with so many rows within a step."""
    out, said = call(*command(*given))
    text = f" {count} times of rows lie within a step" if count else "within a"
    same(text in said, count > 0)
    return out


def test_profile_as_a_table():
    for scheme in SCHEMES:  # at a dt at which no step says that it is coarse
        words = f"--scheme {scheme} --every 44 --dt 5e-5"
        same(says("table.csv, linear: 5 of 5 rows, t = 0 to 10 s; applied "
                  "omega0 in [-2, 1] rad",
                  f"run chaos --set phi=0 --t-end 12 {words}", KNOTS),
             rows(f"run driven {words}"))
    says("linear: 3 of 5 rows, t = 0 to 4 s; applied omega0 in [-2, -1.00005] "
         "rad/s", "run driven --t-end 3")
    quoted = "\ufeff" + KNOTS.replace("t,omega0", '"t","omega0"')
    same(rows("run driven --t-end 1", quoted, "held"),
         rows("run driven --t-end 1", KNOTS, "held"))


def test_linear_is_the_mean_over_a_step():
    """It loses no part of an impulse (140 N s on 1 kg); held says which rows
    never held."""
    blow = "t,force\n0,0\n0.00025,1e6\n0.00028,0\n"
    free = "--set " + "=0 --set ".join(("k2", "c1", "c2", "d", "omega", "v=0"))
    out = rows(f"run frictionless {free} --t-end 1e-3", blow)
    check(abs(float(out.split(",")[-9]) - 140) < 1e-4, out)
    says("held: 2 of 3 rows&1 other rows lie between",
         "run chaos --t-end 1e-3", blow, "held")
    words = f"{BINARY} --t-end 0.5"
    want = rows(words, "t,force\n0,0\n0.5,0.5\n")
    steps = lines("t, torque ,force", [(i / 1024, 0, (i + 0.5) / 1024)
                                       for i in range(512)])
    same(says("held: 512 of 512 rows", words, steps, "held"), want)
    check(rows(words) != want, "a force makes no difference")
    piped = subprocess.run(
        [TWOFOLD, *words.split(), "--inputs", "-", "--between", "held"],
        input=steps, capture_output=True, check=True, text=True)
    same(piped.stdout, want)
    check("standard input, held" in piped.stderr, piped.stderr)


def test_held_from_the_step_that_begins_there():
    want = rows("run chaos --t-end 0.5", "t,r0,torque\r\n-1,0.1,0\r\n"
                "0.3,0.12,0.01\r\n", "held").splitlines()
    dense = [(i / 1e4, *((0.1, 0) if i < 3000 else (0.12, 0.01)))
             for i in range(5000)]
    same(rows("run chaos --t-end 0.5", lines("t,r0,torque", dense),
              "held").splitlines(), want)
    plain = rows("run chaos --t-end 0.3001").splitlines()
    same(plain[:3002], want[:3002])
    check(plain[3002] != want[3002], "nothing in the step after")
    # One row is a constant.
    one = "t,r0\n0,0.12\n"
    want = rows("run chaos --t-end 1 --set r0=0.12")
    for between in ("held", "linear"):
        same(rows("run chaos --t-end 1", one, between), want)
    says("r0=0.2 has no effect&table.csv",
         "run chaos --t-end 0.01 --set r0=0.2", one)
    says("profile of the scene, linear&table.csv, linear",
         "run driven --t-end 0.1", one)
    same(rows("run chaos --t-end 0.2", "t,omega0\n0,-0.5\n"),  # also of v
         rows("run chaos --t-end 0.2 --set omega0=-0.5"))


def test_rows_of_one_time_are_a_jump():
    """Between two steps as rows that are held, and within a step at its start:
    307/1024 = 0.2998."""
    Path("jump.scene").write_text(
        "based-on chaos\nprofile 0:-1 0.3:-1 0.3:-0.8\n")
    for scheme in SCHEMES:
        words = f"--t-end 0.5 --scheme {scheme}"
        want = rows(f"run chaos {words}", "t,omega0\n0,-1\n0.3,-0.8\n", "held")
        same(rows(f"run chaos {words}", JUMP), want)
        same(rows(f"run jump.scene {words}"), want)
    words = f"{BINARY} --t-end 0.5"
    same(says("1 times of rows lie within a step, 1 of them", words, JUMP),
         rows(words, "t,omega0\n0,-1\n0.2998046875,-0.8\n", "held"))
    within(0, f"{words} --scheme located", JUMP)
    # The table takes the place of the profile; steps before its first row have
    # none of its rows within.
    said = call(*command("run driven --t-end 0.1", JUMP))[1]
    check("profile of the scene" not in said and
          "applied omega0 in [-1, -1] rad/s" in said, said)
    for first, count in ("0.3", 0), ("0.30005", 1):
        within(count, "run chaos --t-end 0.5", f"t,force\n{first},0\n0.4,1\n")


def test_a_step_is_told_its_ends():
    """omega0 at its end and its mean slope, whatever lies within it: a table
    with that row at each of its ends alone is the same to it. The rows, in
    steps, reverse and have their kinks at steps and within."""
    kinks = [(t / 1024, w) for t, w in (
        (0, -1), (100, -0.75), (100.5, -0.5), (120, -0.875), (120.25, -0.5),
        (300, -1))]
    ends = []
    for at in (n / 1024 for n in range(301)):
        i = max(k for k in range(5) if kinks[k][0] <= at)
        (t, w), (after, then) = kinks[i:i + 2]
        ends.append((at, w + (then - w) * ((at - t) / (after - t))))
    for scheme in ("moreau", "compensated"):
        words = f"{BINARY} --t-end 0.3 --scheme {scheme}"
        same(within(0, words, lines("t,omega0", ends)),
             within(2, words, lines("t,omega0", kinks)))


def test_located_is_split_at_rows():
    """So its end is that of steps that end there: ramp, steps, sine, reversal,
    kinks at steps of 10 ms and within those of 37."""
    sine = [(i / 50, -1 + 0.3 * math.sin(7 * i / 50)) for i in range(61)]
    words = ("run coulomb --set omega0=-1 --set tolerance=1e-11 --set "
             "segments=1000 --t-end 1.11 --scheme located --dt")
    for shape in (
            "0:-1 1:-0.5", "0:-1 0.3:-1 0.31:1 0.32:-1 1:-1",
            "0:-1 0.2:-1 0.2:-0.8 0.5:-0.8 0.5:-1.1 0.83:-1.1 0.83:-1",
            " ".join(f"{t:.2f}:{w!r}" for t, w in sine),
            "0:-1 0.111:-0.9 0.13:-1.1 0.4:-1 0.777:-0.7 0.8:-1"):
        text = f"t,omega0 {shape}".replace(":", ",").replace(" ", "\n") + "\n"
        ends = [float(rows(f"{words} {dt}", text).split(",")[-9])
                for dt in (0.001, 0.01, 0.037, 0.111)]
        check(max(ends) - min(ends) < 1e-8, f"{shape}: {ends}")


def test_each_part_of_a_step_has_a_draw_by_itself():
    """A stick that is left at the rate of four a step is there at the end in
    exp(-4) of the motions; with the draws of each 4096 parts again, in 1/e."""
    out = rows("sweep chaos --set r=0.18 --set omega=-1.02 --set h=0 --set "
               "rate=4096 --dt 0x1p-10 --t-end 0x1p-10 --scheme located "
               "--select random --over seed=1:100:100 --outcome final",
               lines("t,force", [(i / 2 ** 24, 0) for i in range(2 ** 14)]))
    check(out.count(",stick") < 10, f"{out.count(',stick')} of 100 stay")


def test_a_long_table():
    many = lines("t,force", [(i * 1e-5, 1e-3 * (i % 7)) for i in range(300000)])
    says("300000 of 300000 rows", "run chaos --t-end 3 --dt 1e-5 --every 1000",
         many, "held")


def test_a_table_that_does_not_fit_the_run():
    """It is noted, and the run goes on."""
    for texts, times in (
            ("is t in seconds? (rows: t = 0 to 2000 s, run: 0 to 2 s)",
             (0, 1000, 2000)),
            ("all rows lie after the run (rows: t = 3 to 4 s", (3, 4)),
            ("all rows lie before the run (rows: t = -2 to -1", (-2, -1)),
            ("", (0, 10)), ("", (0,)), ("", (-1,)), ("", (-1, 3))):
        table = lines("t,force", [(t, 0.0) for t in times])
        for words in "run chaos", "sweep chaos --over r=0.1:0.2:2":
            said = call(*command(f"{words} --t-end 2", table))[1]
            same("(rows: " in said, texts != "")
            check(texts in said, said)


def test_files_that_are_cut():
    """Each text file that is read, cut anywhere near its end, is refused, or
    told; but for the newline behind a checksum."""
    text = "t,force\n0,1\n1,0.25\n"
    call("scene", "chaos", "--out", "scene")
    call("run", "chaos", "--t-end", "0.01", "--save", "state")
    call("run", "chaos", "--t-end", "0", "--format", "frames", "--out", "rows")
    call("monitor", "rows", "--record", "record")
    table = "run chaos --t-end 0 --between held --inputs less"
    for words, given, cuts in (
            (table, text, 4),
            ("run ./less --t-end 0", "based-on chaos\nkappa 0.25\n", 4),
            ("run ./less --t-end 0", Path("scene").read_text(), 4),
            ("run chaos --t-end 1 --from less", Path("state").read_text(), 40),
            ("run chaos --replay less", Path("record").read_text(), 40)):
        for cut in range(1, cuts + 1):
            Path("less").write_text(given[:-cut])
            said = call(*words.split(), code=(0, 2, 3))[1]
            check("cut off" in said or "less:" in said or
                  (cut == 1 and "--replay" in words),
                  f"{words}: {given[-cut:]!r} is lost in silence")


WRONG = r"""
2|t,force\n0,1\n1,1x\n|3: column 2: '1x' is not a number
3|t,force\n0,nan\n|2: column 2: force = nan must lie in [-1e+09, 1e+09] N
3|t,force,r0\n0,1,inf\n|2: column 3: r0 = inf must lie in
3|t,force\ninf,1\n|2: column 1: t = inf must lie in
3|t,force\n0,1\n1,1\n0.5,2\n|4: column 1: '0.5' is earlier than t in the
3|t,force\n0,1\n1,1\n1,2\n1,2\n|5: column 1: '1' is in two rows already
2|t,forec\n|1: unknown column 'forec'&did you mean 'force'
2|force,t\n|1: column 1: 'force' is misplaced
2|t,t\n|1: column 2: 't' is misplaced
2|t,force,force\n|1: column 3: 'force' comes twice
2|t\n|1: column 1: 't' is alone
2|t,force\n0,1,2\n|2: more than the 2 columns
2|t,force,r0\n0,1\n|2: fewer than the 3 columns
2|t,force\n0,\n|2: column 2: '' is not a number
2|# nothing\n| no header
2|t,force\n| no row
2|t,\0force\n|1: a zero, or a line
2|t,force\n0,1\n1,2\0,3|3: a zero, or a line
2|t,force\n0,1\r2\n| a line ends with CR alone, expected LF or CR LF
2|t,force\r0,1\r1,1\r| a line ends with CR alone
2|t;force\n0;1\n|1: separator is ';', expected ','
2|t\tforce\n0\t1\n|1: separator is a tab, expected ','
 --inputs table.csv|say what holds between two rows
 --between held|--between: only with --inputs
 --inputs table.csv --between cubic|--between cubic: must be held or linear
 --inputs none.csv --between held|none.csv: No such file
 --inputs . --between held|Is a directory
 --inputs= --between held|the name of the file is empty"""


def test_what_is_wrong():
    for line in WRONG.split("\n")[1:]:
        *code, text, said = line.split("|")
        if code:
            says(f"table.csv:{said}", "run chaos",
                 text.encode().decode("unicode_escape"), code=int(code[0]))
        else:
            says(said, "run chaos" + text, code=2)


main(globals(), jobs=2)
