#!/usr/bin/python3 -B
"""A soak of chaos under the rule `random`, STEPS long (2e6; with FULL=yes 1e8),
whose second half goes on from the state that the first has saved. It is then
stepped again in two pieces, to the same bits. By moreau, and in float by
compensated too: plain steps of a float come to stand where dt v is below the
rounding of r (DESIGN.md, section 10).
"""
import json
import os
import re
import subprocess

from findings import BUILD, FULL, checked, in_common, place_of, wrong

STEPS = round(float(os.environ.get("STEPS") or (1e8 if FULL else 2e6)))
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
    path = [BUILD / f"soak.{n}" for n in range(4)]
    said = [run(real, scheme, half, path[0])]
    if said[0]["end"] == "done":
        said.append(run(real, scheme, STEPS, path[1], "--from", path[0]))
    choices, degraded = (sum(part[what] for part in said)
                         for what in ("ambiguous", "degraded"))
    print(f"{of}, {STEPS} steps; with a choice: {choices}, "
          f"degraded: {degraded}")
    ends = {part["end"] for part in said}
    judge(of, ends == {"done"}, "ends", ", ".join(ends))
    drift = 0
    for part in said:
        # What |h| is off by in stick, its terms being known to a rounding each,
        # on both sides of a step; d = 1 m, omega0 = -1 rad/s.
        x = part["final"]
        rounding = abs(x["v"]) + (D + abs(x["r"])) * (abs(x["omega"]) - OMEGA0)
        drift = max(drift, part["largest_h_in_stick"] /
                    (2 * EPSILON[real] * rounding))
    judge(of, drift <= 1, "largest |h| in stick over its rounding", drift)
    changes = [event for part in said for event in part["events"]["list"]
               if event["from"] != event["to"]]
    modes = {event["to"] for event in changes}
    judge(of, choices > 0 and {"stick+", "stick-"} <= modes,
          "steps with a choice, of sticks of both signs", choices)
    if (real, scheme) != ("float", "moreau"):
        times = [0, *(event["t"] for event in changes), STEPS / 1e4]
        stay = max(later - t for t, later in zip(times, times[1:]))
        judge(of, stay <= LONGEST_STAY, "longest stay in a mode [s]", stay)
    if ends == {"done"}:
        run(real, scheme, half + STEPS // 3, path[2], "--from", path[0])
        run(real, scheme, STEPS, path[3], "--from", path[2])
        judge(of, path[1].read_bytes() == path[3].read_bytes(),
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
