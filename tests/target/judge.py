"""What a board should send: the golden hashes, and the text of a loop; and what
a firmware of one scene leaves out."""
from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

PAIR = re.compile(r"[a-z]+:-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?")
TYPES = {"double": 1, "float": 2}
# Groups of names, of which a scene has all or none.
GROUPS = {
    "angle": "anchor_cos jump_multipliers",
    "enumeration": "enumerate_both_signs solve_stick select_mode "
                   "tf_least_violation",
    "single-valued": "secant_force",
    "inputs": "speed_at",
    "preparing": "tf_prepare tf_begin tf_scene_start prepare_angle_kernel "
                 "tf_parameter_ranges tf_scenes chaos string",
    "generator": "tf_philox random_exit"}
LEFT_OUT = {
    "coulomb": ["angle", "single-valued", "inputs"],
    "frictionless": ["angle", "enumeration"],
    "string": ["enumeration", "angle"],
    "chaos": ["single-valued", "inputs"],
    "driven": ["single-valued"]}
IN_GENERIC = [name for group in ("angle", "enumeration", "single-valued",
                                 "inputs") for name in GROUPS[group].split()]


def golden(scene: str, real: str, scheme: str = "moreau") -> str:
    """The hash of the library over 1e5 steps; empty where there is none."""
    found = re.search(
        rf'^{{"{scene}", TF_RULE_PERSIST, {scheme.upper()},\n'
        r" 0x([0-9A-F]+)u, 0x([0-9A-F]+)u}",
        Path("tests/golden/golden.inc").read_text(encoding="ascii"), re.M)
    return found[TYPES[real]] if found else ""


def population(key: str, real: str) -> str:
    """The hash over random machines."""
    found = re.search(
        rf'^{{"{key}", 0x(.*)u, 0x(.*)u}}',
        Path("tests/golden/population.inc").read_text(encoding="ascii"), re.M)
    return found[TYPES[real]] if found else ""


def loop(text: str, rate: int, seconds: int, shared: bool) -> tuple[str, str]:
    """The last heartbeat of the text that a firmware sent in real time, and
    what is wrong with the text.

    Every line consists of label:value pairs; the last heartbeat counts all
    steps, and no overruns, skipped ticks or dropped records, of which 50 go out
    in a second, or as many as there are steps. On a computer with other work
    (shared) those are printed and not judged.
    """
    each, records, beats, last, bad = min(rate, 50), 0, 0, "", []
    for line in filter(None, map(str.strip, text.splitlines())):
        if line.startswith("EXIT"):
            continue
        if not all(map(PAIR.fullmatch, line.split())):
            bad.append(f"not name:number: {line}")
        records += line.startswith("r:")
        if line.startswith("steps:"):
            beats, last = beats + 1, line
    said = dict(pair.split(":", 1) for pair in last.split())
    count = {name: float(said.get(name, "nan")) for name in (
        "steps", "sent", "overruns", "skipped", "dropped", "min", "mean",
        "max")}
    if count["steps"] != rate * seconds:
        bad.append("steps")
    # A last record may follow the last heartbeat.
    if records + beats - count["sent"] not in (0, 1):
        bad.append(f"{records} records")
    if not shared:
        if records != seconds * each + 1:
            bad.append(f"{records} records")
        if beats != seconds + 1:
            bad.append(f"{beats} heartbeats")
        bad += [name for name in ("overruns", "skipped", "dropped")
                if count[name] != 0]
    if not count["min"] <= count["mean"] <= count["max"]:
        bad.append("times")
    return last, "\n".join(bad)


def left_out(symbols: Callable[[str], set[str]]) -> list[str]:
    """For all that a scene leaves out "", or what is wrong with it, from the
    names in the firmware of a scene. All must be in the generic firmware,
    because the absence of a name that is nowhere would prove nothing."""
    has = symbols("generic")
    missing = [name for name in [*IN_GENERIC, "tf_parameter_ranges",
                                 "tf_scenes"] if name not in has]
    said = [f"generic has no {' '.join(missing)}" if missing else ""]
    for scene, groups in LEFT_OUT.items():
        has = symbols(scene)
        said += [] if has else [f"{scene} has no names at all"]
        for group in [*groups, "preparing", "generator"]:
            found = [name for name in GROUPS[group].split() if name in has]
            said.append(f"{scene} does not leave out {group}: has "
                        f"{' '.join(found)}" if found else "")
    return said
