"""What programs share that start others for a long time (tools/run)."""
from __future__ import annotations

import concurrent.futures
import os
import subprocess
import sys
import time
from typing import Callable, Iterable, Iterator, Sequence


def processors() -> int:
    """How many jobs run at a time: JOBS, or one a processor."""
    return int(os.environ.get("JOBS") or len(os.sched_getaffinity(0)))


class Progress:
    """How far a long work of some cost is, on a terminal only."""

    def __init__(self, total: float) -> None:
        self.total, self.begin, self.width = total, time.time(), 0

    def __call__(self, done: float, what: str = "") -> None:
        """Shows the share that is done, the time left, and what goes on; the
        line ends with the work."""
        if not sys.stderr.isatty():
            return
        took = time.time() - self.begin
        left = (f", {done / took:.3g}/s, about "
                f"{took * (self.total / done - 1):.0f} s left"
                if done and took else "")
        line = f"  {done / self.total:.0%} after {took:.0f} s{left} {what}"
        print("\r" + line.ljust(self.width), file=sys.stderr, flush=True,
              end="\n" if done == self.total else "")
        self.width = len(line)


def shown(items: Sequence, costs: Sequence[float] = (),
          text: Callable[..., object] = lambda item: "") -> Iterator:
    """Each item of a long work, and on a terminal how far all of it is: costs
    are about in proportion to times, and text(item) says what goes on."""
    costs, done = costs or [1] * len(items), 0.0
    show = Progress(sum(costs))
    for n, (item, cost) in enumerate(zip(items, costs), 1):
        show(done, f"{n} of {len(items)} {text(item)}")
        yield item
        done += cost
    show(show.total)


def side_by_side(work: Callable, items: Iterable, shows: bool = True) -> list:
    """The results of work(item), in the order of the items. The first one that
    raises an exception ends all: what was not begun is not done. shows: whether
    a terminal is shown how far it is."""
    with concurrent.futures.ThreadPoolExecutor(processors()) as pool:
        jobs = [pool.submit(work, item) for item in items]
        show = Progress(len(jobs))
        try:
            for n, job in enumerate(concurrent.futures.as_completed(jobs), 1):
                job.result()
                if shows:
                    show(n, f"{n} of {len(jobs)}")
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
