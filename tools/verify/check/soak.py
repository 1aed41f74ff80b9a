#!/usr/bin/python3 -B
"""A soak of chaos under the rule `random`, STEPS long (2e6; with FULL=yes 1e8),
in pieces of which each goes on from the state that the one before has saved.
The second half is then stepped again in one go, to the same bits. By moreau,
and in float by compensated too: plain steps of a float come to stand where dt v
is below the rounding of r (DESIGN.md, section 11).
"""
import json
import os
import re
import subprocess

from findings import BUILD, FULL, checked, in_common, place_of, wrong

STEPS = round(float(os.environ.get("STEPS") or (1e8 if FULL else 2e6)))
PIECE = min(10**7, STEPS // 10 + 1)  # steps; its events are told together
LONGEST_STAY = 5  # in one mode [s]: it sticks for 2, rests for 0.1
EPSILON = {"double": 2.0**-52, "float": 2.0**-23}
PLACE = place_of("gcc", "-O3")


def run(real, scheme, tick, path, *more):
    """Saves the state at a tick. Returns: the summary."""
    done = subprocess.run(
        [PLACE / real / "twofold", "run", "chaos", "--select", "random:2014",
         "--set", "rate=10", "--scheme", scheme, "--t-end", f"{tick / 1e4}",
         "--every", "1000000000", "--out", os.devnull, "--save", path,
         "--events", "all", "--summary", "json", *more],
        text=True, check=False, stderr=subprocess.PIPE)
    return json.loads(done.stderr.splitlines()[-1])


def judge(of, holds, what, figure):
    print(f"{'ok' if holds else 'FAILED':6s} {what}: {figure}")
    if not holds:
        wrong(f"{of}: {what}: {figure}")


def soak(real, scheme):
    """All that is promised of one scheme."""
    half, of = STEPS // 2, f"{scheme} in {real}"
    state = [BUILD / f"soak.{name}" for name in ("half", "odd", "even")]
    changed = stay = choices = drift = degraded = 0
    ends, modes, more = set(), set(), ()
    for n, tick in enumerate(sorted({*range(PIECE, half, PIECE), half,
                                     *range(half + PIECE, STEPS, PIECE),
                                     STEPS})):
        path = state[0 if tick == half else 1 + n % 2]
        said = run(real, scheme, tick, path, *more)
        more = "--from", path
        ends.add(said["end"])
        if said["end"] != "done":
            break
        for event in said["events"]["list"]:
            if event["from"] != event["to"]:
                stay, changed = max(stay, event["t"] - changed), event["t"]
                modes.add(event["to"])
        x, choices = said["final"], choices + said["ambiguous"]
        degraded += said["degraded"]
        # What |h| is off by in stick, its terms being known to a rounding each,
        # on both sides of a step; d = 1 m, omega0 = -1 rad/s.
        rounding = abs(x["v"]) + (D + abs(x["r"])) * (abs(x["omega"]) - OMEGA0)
        drift = max(drift, said["largest_h_in_stick"] /
                    (2 * EPSILON[real] * rounding))
    print(f"{of}, {STEPS} steps; with a choice: {choices}, "
          f"degraded: {degraded}")
    judge(of, ends == {"done"}, "ends", ", ".join(ends))
    judge(of, drift <= 1, "largest |h| in stick over its rounding", drift)
    judge(of, choices > 0 and {"stick+", "stick-"} <= modes,
          "steps with a choice, of sticks of both signs", choices)
    if (real, scheme) != ("float", "moreau"):
        stay = max(stay, STEPS / 1e4 - changed)
        judge(of, stay <= LONGEST_STAY, "longest stay in a mode [s]", stay)
    if ends == {"done"}:
        again = BUILD / "soak.again"
        run(real, scheme, STEPS, again, "--from", state[0])
        judge(of, again.read_bytes() == path.read_bytes(),
              "steps replayed from the snapshot, bit for bit", STEPS - half)


if not in_common("gcc", "-O3", *(PLACE / real / "twofold" for real in EPSILON)):
    wrong("the command line does not build")
    checked("nothing")
SCENE = subprocess.run([PLACE / "double/twofold", "scene", "chaos"], text=True,
                       stdout=subprocess.PIPE, check=True).stdout
D, OMEGA0 = (float(re.search(rf"^{name} +(\S+)", SCENE, re.M)[1])
             for name in ("d", "omega0"))
for one in ("double", "moreau"), ("float", "moreau"), ("float", "compensated"):
    if one[0] in (os.environ.get("VARIANTS") or "double float").split():
        soak(*one)
checked(f"{STEPS} steps of chaos, both real types; half replayed")
