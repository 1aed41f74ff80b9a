"""What programs share that start others for a long time (tools/run)."""
from __future__ import annotations

import concurrent.futures
import os
import subprocess
import sys
import time
from typing import Callable, Iterable


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
