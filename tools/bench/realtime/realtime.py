#!/usr/bin/python3 -B
"""How late loops in real time are: `make realtime`.

  realtime.py BUILD SECONDS

Runs `twofold run --realtime`, the host firmware, and the loops of both without
a step, at 1 kHz and 10 kHz, each on one processor with real-time priority and
locked memory: alone, and beside a busy process on the same processor that takes
it half of the time. Writes BUILD/realtime/NAME.csv (us,began,ended as
cyclictest has its histograms), BUILD/REALTIME.md and
BUILD/realtime/lateness.svg.
"""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tables import markdown  # noqa: E402
from tables.read import read_csv  # noqa: E402

RATES = 1000, 10000
LAST = 10000  # [us] the bin of what is later
EDGES = [10 ** (i / 10) for i in range(5, 42)]  # of the picture [us]
TITLE = "# Lateness of loops in real time\n"
ABOUT = """
Made by `make realtime` in {seconds} s a row on {processor}, Linux {kernel}, on
processor {cpu}, with SCHED_FIFO and locked memory{lacking}. `began` is how long
after its time a step began, `ended` how long after it was done, with its row
[us]; a step is late where it ended after the time of the next one. `run-empty`
and `firmware-empty` are the loops of `run` and of `firmware` without a step:
what of the lateness is the machine's and the loop's. `run` makes up for a delay
by taking its steps one after the other, each late by its own time; the firmware
leaves out the steps of the ticks that have passed. So after one delay `run`
counts more late steps. {loaded}

The processor was {isolated}; the load of the machine before was {before} (mean
of a minute).
"""
LOADED = ("`loaded`: a busy process on the\nsame processor pre-empts it half "
          "of the time.")


class Loop(NamedTuple):
    """One loop: its program at a rate, writing a histogram."""
    name: str
    rate: int
    command: list[str]
    settings: dict[str, str]


def loops(build: Path, work: Path, seconds: int) -> list[Loop]:
    """The four programs at each rate."""
    made = []
    for rate in RATES:
        steps = rate * seconds
        line = {"TWOFOLD_REALTIME": "1", "TWOFOLD_PORT": str(work / "line")}
        made.append(Loop("run-empty", rate, [
            str(build / "double/tools/bench/realtime/empty_loop"), str(1 / rate),
            str(steps), ""], {}))
        made.append(Loop("run", rate, [
            str(build / "double/twofold"), "run", "chaos", "--realtime",
            "--priority", "--dt", str(1 / rate), "--t-end", str(seconds),
            "--out", str(work / "rows.csv"), "--lateness", ""], {}))
        made.append(Loop("firmware-empty", rate, [str(
            build / f"double/tools/bench/realtime/empty_firmware-{rate}")], line))
        made.append(Loop("firmware", rate, [
            str(build / f"boards/host/chaos-double/firmware-{rate}.elf")],
            line))
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


def perform(loop: Loop, cpu: int, path: Path) -> None:
    """Runs a loop on one processor; it writes its histogram to the path."""
    command = [word or str(path) for word in loop.command]
    done = subprocess.run(
        ["taskset", "-c", str(cpu), *command], stderr=subprocess.PIPE,
        env={**os.environ, **loop.settings, "TWOFOLD_LATENESS": str(path)},
        text=True, check=False)
    if done.returncode not in (0, 5) or not path.is_file():
        sys.exit(f"{loop.name} at {loop.rate} Hz fails: {done.stderr}")


def quantile(counts: list[tuple[int, int]], share: float) -> str:
    """The bin below which a share of the counts lies."""
    total, seen = sum(n for _, n in counts), 0
    for us, n in counts:
        seen += n
        if seen >= share * total:
            return f"> {LAST}" if us == LAST else str(us)
    return "-"


def histogram(path: Path, column: str) -> list[tuple[int, int]]:
    """(us, count) of one column."""
    return [(int(row.number("us")), int(row.number(column)))
            for row in read_csv(str(path), ("us", "began", "ended"))]


def row(loop: Loop, load: str, path: Path) -> list[object]:
    """One row of the table."""
    began, ended = histogram(path, "began"), histogram(path, "ended")
    period = 1000000 // loop.rate
    late = sum(n for us, n in ended if us >= period)
    figures = [quantile(ended, share) for share in (0.5, 0.99, 0.999, 1)]
    return [loop.name, loop.rate, load, sum(n for _, n in began),
            quantile(began, 0.5), quantile(began, 0.999), *figures, late]


def draw(rows: list[tuple[Loop, str, Path]], path: Path) -> None:
    """A panel for each rate and load; a line for each loop."""
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "twofold"
    from matplotlib import pyplot
    panels = [(rate, load) for rate in RATES for load in ("alone", "loaded")]
    figure, axes = pyplot.subplots(2, 2, figsize=(9, 6.5), sharex=True)
    for axis, (rate, load) in zip(axes.flat, panels):
        for loop, how, source in rows:
            if (loop.rate, how) != (rate, load):
                continue
            counts = histogram(source, "ended")
            axis.hist([us + 0.5 for us, _ in counts], bins=EDGES,
                      weights=[n for _, n in counts], histtype="step",
                      label=loop.name)
        axis.axvline(1e6 / rate, color="#555555", linestyle="--")
        axis.set(xscale="log", yscale="log", title=f"{rate} Hz, {load}")
    for axis in axes[1]:
        axis.set_xlabel("end of a step after its time [us]; dashed: the period")
    for axis in axes[:, 0]:
        axis.set_ylabel("steps")
    # Above the panels, where it hides no curve.
    figure.legend(*axes.flat[0].get_legend_handles_labels(), ncol=4,
                  loc="upper center")
    figure.tight_layout(rect=(0, 0, 1, 0.95))
    figure.savefig(path, metadata={"Date": None})


def main() -> None:
    """Runs all, writes table and picture."""
    build, seconds = Path(sys.argv[1]), int(sys.argv[2])
    for tool, package in (("taskset", "util-linux"), ("chrt", "util-linux")):
        if shutil.which(tool) is None:
            sys.exit(f"make realtime needs {tool}: apt-get install {package}")
    work = build / "realtime"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    cpu = max(os.sched_getaffinity(0))
    may = subprocess.run(["chrt", "-f", "1", "true"], check=False,
                         stderr=subprocess.DEVNULL).returncode == 0
    before = f"{os.getloadavg()[0]:.2f}"
    alone = Path("/sys/devices/system/cpu/isolated")
    isolated = alone.is_file() and alone.read_text("ascii").strip()
    done: list[tuple[Loop, str, Path]] = []
    for load in ("alone", "loaded"):
        other = busy(cpu) if load == "loaded" and may else None
        try:
            for loop in loops(build, work, seconds):
                if load == "loaded" and other is None:
                    continue
                path = work / f"{loop.name}-{loop.rate}-{load}.csv"
                print(f"{loop.name} at {loop.rate} Hz, {load}: {seconds} s")
                perform(loop, cpu, path)
                done.append((loop, load, path))
        finally:
            if other is not None:
                other.kill()
                other.wait()
    columns = ("loop", "rate [Hz]", "load", "steps", "began: median", "99.9 %",
               "ended: median", "99 %", "99.9 %", "most", "late")
    table = markdown.table(columns, [row(*one) for one in done],
                           right=(1, *range(3, 11)))
    cpuinfo = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = re.search(r"^model name[^:]*: (.*)$", cpuinfo, re.MULTILINE)
    about = ABOUT.format(
        seconds=seconds, kernel=os.uname().release, cpu=cpu,
        processor=model[1] if model else os.uname().machine,
        lacking="" if may else " wanted but not given", before=before,
        isolated=f"isolated ({isolated})" if isolated else
        "not isolated from the scheduler (isolcpus), so what else runs on the "
        "machine may delay a loop",
        loaded=LOADED if may else "Rows `loaded` are left out: a busy process "
        "needs SCHED_FIFO, too.")
    draw(done, work / "lateness.svg")
    (build / "REALTIME.md").write_text(
        f"{TITLE}{about}\n{table}\n\n![Histograms](report/lateness.svg)\n",
        encoding="utf-8")
    print(table)


if __name__ == "__main__":
    main()
