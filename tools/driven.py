"""What scripts share that start other programs for a long time.

    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    import driven
    driven.begin(__file__)

puts a script under tools/drive, so that a signal ends all that it has started
and nothing temporary is left, and lets it run from the root of the project.
"""
from __future__ import annotations

import concurrent.futures
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Callable, Iterable


def begin(script: str) -> None:
    """Goes on under tools/drive, and not as part of a parallel make."""
    # The tree by which it was called, which may be links.
    path = Path(os.path.abspath(script))
    root = next(p for p in path.parents if (p / "Makefile").exists())
    os.chdir(root)
    name = str(path.relative_to(root))
    if os.environ.get("DRIVEN") != name:
        os.execv("tools/drive", ["tools/drive", name, *sys.argv[1:]])
    for variable in ("DRIVEN", "MAKEFLAGS", "MAKELEVEL"):
        os.environ.pop(variable, None)
    os.environ["LC_ALL"] = "C"
    sys.stdout.reconfigure(line_buffering=True)


def processors() -> int:
    """How many jobs run at a time: JOBS, or one a processor."""
    return int(os.environ.get("JOBS") or len(os.sched_getaffinity(0)))


def side_by_side(work: Callable, items: Iterable) -> list:
    """The results of work(item), in the order of the items. The first one that
    raises an exception ends all: what was not begun is not done. Says every
    minute how far it is."""
    with concurrent.futures.ThreadPoolExecutor(processors()) as pool:
        jobs = [pool.submit(work, item) for item in items]
        begin = told = time.time()
        try:
            for n, job in enumerate(concurrent.futures.as_completed(jobs), 1):
                job.result()
                if time.time() > told + 60 and n < len(jobs):
                    told = time.time()
                    print(f"  {n} of {len(jobs)}, about "
                          f"{(told - begin) * (len(jobs) / n - 1):.0f} s left",
                          file=sys.stderr, flush=True)
        except BaseException:
            for job in jobs:
                job.cancel()
            raise
        return [job.result() for job in jobs]


def output(*command: object, **options: object) -> str:
    """What a command prints; where it fails, the script ends."""
    done = subprocess.run([str(word) for word in command], text=True,
                          stdout=subprocess.PIPE, check=False, **options)
    if done.returncode:
        sys.exit(f"{command[0]} fails")
    return done.stdout
