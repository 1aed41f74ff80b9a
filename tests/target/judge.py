"""What a board should send: the golden hashes, and the text of a loop."""
from __future__ import annotations

import re
from pathlib import Path

PAIR = re.compile(r"[a-z]+:-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?")
TYPES = {"double": 1, "float": 2}


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
    ticks, and no overruns, skipped ticks or dropped records, of which 50 go out
    in a second, or as many as there are steps. On a computer with other work
    (shared) those are printed and not judged: its steps end after its ticks.
    """
    each, records, beats, last, bad = min(rate, 50), 0, 0, "", []
    told = 0
    for line in filter(None, map(str.strip, text.splitlines())):
        if line.startswith("EXIT"):
            continue
        if not all(map(PAIR.fullmatch, line.split())):
            bad.append(f"not name:number: {line}")
        records += line.startswith("r:")
        if line.startswith("steps:"):
            beats, last, told = beats + 1, line, records + beats + 1
    said = dict(pair.split(":", 1) for pair in last.split())
    count = {name: float(said.get(name, "nan")) for name in (
        "steps", "sent", "overruns", "skipped", "dropped", "min", "mean",
        "max")}
    if not (count["steps"] <= rate * seconds <=
            count["steps"] + count["skipped"]):
        bad.append("steps")
    if told != count["sent"]:
        bad.append(f"{told} records and heartbeats")
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
