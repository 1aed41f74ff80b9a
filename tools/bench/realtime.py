"""How late loops in real time are.

`twofold run --realtime`, its loop without a step, which is what the machine
does, and the host firmware, at 1 kHz and 10 kHz, each on one processor with
real-time priority and locked memory: alone, and beside a busy process on the
same processor that takes it half of the time. Leaves BUILD/realtime/NAME.csv
(us,began,ended as cyclictest has its histograms).
"""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pandas as pd

import driven
from measure import BUILD, COLUMNS, say

RATES = 1000, 10000
WORK = BUILD / "realtime"


class Loop(NamedTuple):
    """One loop: its program at a rate, writing a histogram."""
    name: str
    rate: int
    command: list[object]


def built(rate: int, seconds: int) -> None:
    """The firmware, STEPS of which go by SECONDS."""
    driven.output("make", "-s", "--no-print-directory", f"BUILD={BUILD}",
                  "firmware", "BOARD=host", "REAL=double", "SCHEME=moreau",
                  f"RATE={rate}", f"NAMED=-{rate}", "FORMAT=csv",
                  f"STEPS={rate * seconds}")


def loops(seconds: int) -> list[Loop]:
    """The programs at each rate."""
    made = []
    for rate in RATES:
        made += [Loop("empty", rate, [
            BUILD / "double/tools/bench/empty_loop", 1 / rate,
            rate * seconds, ""]),
            Loop("run", rate, [
                BUILD / "double/twofold", "run", "chaos", "--realtime",
                "--priority", "--dt", 1 / rate, "--t-end", seconds, "--out",
                WORK / "rows.csv", "--lateness", ""]),
            Loop("firmware", rate, [
                BUILD / f"boards/host/chaos-double/firmware-{rate}.elf"])]
    return made


def busy(cpu: int) -> subprocess.Popen[bytes]:
    """A process that takes its processor for 5 of every 10 ms."""
    return subprocess.Popen(
        ["taskset", "-c", str(cpu), "chrt", "-f", "50", sys.executable, "-c",
         "import time\n"
         "while True:\n"
         "    end = time.perf_counter() + 0.005\n"
         "    while time.perf_counter() < end: pass\n"
         "    time.sleep(0.005)\n"])


def perform(loop: Loop, cpu: int, load: str) -> list[list[object]]:
    """Runs a loop on one processor. Returns: quantiles of its lateness."""
    path = WORK / f"{loop.name}-{loop.rate}-{load}.csv"
    say(f"{loop.name} at {loop.rate} Hz, {load}")
    settings = {"TWOFOLD_LATENESS": str(path)}
    if loop.name == "firmware":
        settings |= {"TWOFOLD_REALTIME": "1",
                     "TWOFOLD_PORT": str(WORK / "line")}
    done = subprocess.run(
        ["taskset", "-c", str(cpu), *(str(word or path)
                                      for word in loop.command)],
        stderr=subprocess.PIPE, env={**os.environ, **settings}, text=True,
        check=False)
    if done.returncode not in (0, 5) or not path.is_file():
        sys.exit(f"{loop.name} at {loop.rate} Hz fails: {done.stderr}")
    counts = pd.read_csv(path)
    late = counts.ended[counts.us >= 1000000 // loop.rate].sum()
    figures = {"late steps": late, "steps": counts.ended.sum()}
    rows = [[f"{loop.rate} Hz {load}", loop.name, name, number, None, None, ""]
            for name, number in figures.items()]
    for column in "began", "ended":
        seen = counts[column].cumsum() / counts[column].sum()
        for name, share in ("median", 0.5), ("99 %", 0.99), \
                ("99.9 %", 0.999), ("most", 1 - 1e-12):
            us = counts.us[np.searchsorted(seen, share)]
            rows.append([f"{loop.rate} Hz {load}", loop.name,
                         f"{column}: {name}", None, 1000 * us, None, ""])
    return rows


def measure() -> pd.DataFrame:
    """All loops, alone and beside a busy process."""
    for tool in "taskset", "chrt":
        if shutil.which(tool) is None:
            sys.exit(f"realtime needs {tool}: apt-get install util-linux")
    seconds = int(os.environ.get("SECONDS") or 10)
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    for rate in RATES:
        built(rate, seconds)
    cpu = max(os.sched_getaffinity(0))
    may = subprocess.run(["chrt", "-f", "1", "true"], check=False,
                         stderr=subprocess.DEVNULL).returncode == 0
    if not may:
        say("no SCHED_FIFO here: without the busy process")
    rows: list[list[object]] = []
    for load in ("alone", "loaded") if may else ("alone",):
        other = busy(cpu) if load == "loaded" else None
        try:
            for loop in loops(seconds):
                rows += perform(loop, cpu, load)
        finally:
            if other is not None:
                other.kill()
                other.wait()
    return pd.DataFrame(rows, columns=COLUMNS)
