"""Results of a test in TAP, as those of the tests in C and sh: a function is a
test, an exception is a failure, and the last line is the sum."""
import sys
import traceback


class Skip(Exception):
    """What a test needs is not there."""


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def run(tests):
    """Runs (name, function) pairs. Returns the exit code."""
    failed = skipped = 0
    for number, (name, function) in enumerate(tests, 1):
        try:
            function()
            print(f"ok {number} - {name}", flush=True)
        except Skip as reason:
            skipped += 1
            print(f"ok {number} - {name} # SKIP {reason}", flush=True)
        except Exception:  # a test may fail in any way
            failed += 1
            print(f"not ok {number} - {name}", flush=True)
            text = traceback.format_exc()
            print("".join(f"# {line}\n" for line in text.splitlines()), end="")
    print(f"1..{len(tests)}")
    if skipped:
        print(f"# {skipped} skipped")
    print(f"{len(tests) - failed - skipped} passed, {failed} failed")
    sys.stdout.flush()
    return 1 if failed else 0
