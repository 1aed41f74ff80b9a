"""What the tests in Python share: the command line that is tested, and results
in TAP, as those of the tests in C and sh. A function is a test, an exception is
a failure, and the last line is the sum. A test program is started with words:
only tests whose names contain one of them are run.

Environment: TWOFOLD the command line; REQUIRED a list of what must be there."""
import os
import subprocess
import sys
import tempfile
import time
import traceback
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TWOFOLD = str(Path(os.environ.get("TWOFOLD") or
                   ROOT / "build/double/twofold").resolve())
HEADER = "t,r,v,omega,h,g,F,M,mode,choices,set"  # of CSV, whoever writes it


class Skip(Exception):
    """What a test needs is not there."""


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def same(got, want):
    check(got == want, f"got  {str(got)[:300]}\nwant {str(want)[:300]}")


def lacks(package, what=""):
    """Skips a test for want of a package, or of what else, or fails it where
    that is required (.ci/required)."""
    listed = os.environ.get("REQUIRED")
    check(not listed or not any(line.split()[-1:] == [package] for line in
                                Path(listed).read_text().splitlines()),
          f"missing, and required: {what or package}")
    raise Skip(f"missing: {what or package}")


def output(*command, **options):
    """What a program prints."""
    return subprocess.run(command, check=True, stderr=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, **options).stdout


def call(*words, code=0, program=TWOFOLD, **options):
    """(standard output, standard error) of a command, as text. code: its exit
    code, or several of them."""
    done = subprocess.run([program, *map(str, words)], check=False,
                          stdin=subprocess.DEVNULL, capture_output=True,
                          encoding="utf-8", errors="replace", **options)
    check(done.returncode in (code if isinstance(code, tuple) else (code,)),
          f"{words}: code {done.returncode}, not {code}: {done.stderr}")
    return done.stdout, done.stderr


def until(holds, what, child=None):
    """Waits for what has to happen, and fails where the child that does it has
    ended before. Returns: what holds() did."""
    while not (got := holds()):
        check(child is None or child.poll() is None or holds(),
              f"it ended before: {what}")
        time.sleep(0.01)
    return got


def outcome(test):
    """A word and what is said of it, which a test may return."""
    try:
        return "ok", test() or ""
    except Skip as reason:
        return "skip", str(reason)
    except (Exception, SystemExit):  # a test may fail in any way
        return "not ok", traceback.format_exc()


def side_by_side(tests, jobs):
    """Each test in a process and a folder of its own."""
    with tempfile.TemporaryDirectory() as name:
        running, begun = {}, 0
        said = [Path(name, f"said{i}") for i in range(len(tests))]

        def begin(i):
            child = os.fork()
            if child:
                running[child] = i
                return
            folder = Path(name, str(i))
            folder.mkdir()
            os.chdir(folder)
            said[i].write_text("\n".join(outcome(tests[i][1])))
            sys.stdout.flush()
            os._exit(0)

        for i in range(len(tests)):
            while i in running.values() or begun == i:
                while begun < len(tests) and len(running) < jobs:
                    begin(begun)
                    begun += 1
                running.pop(os.wait()[0], None)
            if said[i].exists():
                yield said[i].read_text().partition("\n")[::2]
            else:
                yield "not ok", "it was killed"


class Tally:
    """What tests come to."""

    def __init__(self):
        self.count = {"ok": 0, "skip": 0, "not ok": 0}

    def run(self, tests, jobs=0):
        """Runs (name, function) pairs: in this process, or so many side by
        side. Returns: a word of each."""
        results = side_by_side(tests, jobs) if jobs else (
            outcome(test) for _, test in tests)
        words = []
        for (name, _), (word, said) in zip(tests, results):
            self.count[word] += 1
            words.append(word)
            number = sum(self.count.values())
            if word == "skip":
                print(f"ok {number} - {name} # SKIP {said}", flush=True)
                continue
            print(f"{word} {number} - {name}", flush=True)
            print("".join(f"# {line}\n" for line in said.splitlines()), end="")
        return words

    def end(self):
        """Prints the sum. Returns: the exit code."""
        print(f"1..{sum(self.count.values())}")
        if self.count["skip"]:
            print(f"# {self.count['skip']} skipped")
        print(f"{self.count['ok']} passed, {self.count['not ok']} failed",
              flush=True)
        return int(self.count["not ok"] > 0)


def run(tests, jobs=0):
    """Runs those that the words of the program name. Returns: the exit code."""
    words, tally = sys.argv[1:] or [""], Tally()
    tally.run([one for one in tests if any(word in one[0] for word in words)],
              jobs)
    return tally.end()


def main(names, jobs):
    """names: globals() of the program; its tests begin with test_. All of them
    wait most of the time, so that `jobs` go side by side."""
    sys.exit(run([(name[5:], test) for name, test in names.items()
                  if name.startswith("test_")], jobs))
