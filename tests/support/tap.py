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


class Skip(Exception):
    """What a test needs is not there."""


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def same(got, want):
    check(got == want, f"got  {str(got)[:300]}\nwant {str(want)[:300]}")


def lacks(package):
    """Skips a test for want of a package, or fails it where that is required
    (.ci/required)."""
    listed = os.environ.get("REQUIRED")
    check(not listed or not any(line.split()[-1:] == [package] for line in
                                Path(listed).read_text().splitlines()),
          f"missing, and required: {package}")
    raise Skip(f"missing: {package}")


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


def until(holds, what, patience=60, every=0.01):
    """Waits for what has to happen. Returns: what holds() did."""
    end = time.monotonic() + patience
    while not (got := holds()):
        check(time.monotonic() < end, f"not in time: {what}")
        time.sleep(every)
    return got


def outcome(test):
    """A word and what is said of it."""
    try:
        test()
        return "ok", ""
    except Skip as reason:
        return "skip", str(reason)
    except (Exception, SystemExit):  # a test may fail in any way
        return "not ok", traceback.format_exc()


def one_by_one(tests):
    for _, test in tests:
        yield outcome(test)


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


def run(tests, jobs=0):
    """Runs (name, function) pairs: in this process, or so many side by side.
    Returns: the exit code."""
    words = sys.argv[1:] or [""]
    tests = [one for one in tests if any(word in one[0] for word in words)]
    count = {"ok": 0, "skip": 0, "not ok": 0}
    results = side_by_side(tests, jobs) if jobs else one_by_one(tests)
    for number, ((name, _), (word, said)) in enumerate(zip(tests, results), 1):
        count[word] += 1
        if word == "skip":
            print(f"ok {number} - {name} # SKIP {said}", flush=True)
            continue
        print(f"{word} {number} - {name}", flush=True)
        print("".join(f"# {line}\n" for line in said.splitlines()), end="")
    print(f"1..{len(tests)}")
    if count["skip"]:
        print(f"# {count['skip']} skipped")
    print(f"{count['ok']} passed, {count['not ok']} failed", flush=True)
    return 1 if count["not ok"] else 0


def main(names, jobs):
    """names: globals() of the program; its tests begin with test_. All of them
    wait most of the time, so that `jobs` go side by side."""
    sys.exit(run([(name[5:], test) for name, test in names.items()
                  if name.startswith("test_")], jobs))
