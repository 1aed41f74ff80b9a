"""A program of tests, of which a script starts each one by its name: without a
name it prints their names."""
import subprocess
import sys


def same(got, want):
    """Fails where they differ."""
    if got != want:
        sys.exit(f"got  {str(got)[:300]}\nwant {str(want)[:300]}")


def output(*command, **options):
    """What a program prints."""
    return subprocess.run(command, check=True, stderr=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, **options).stdout


def main(names):
    """names: globals() of the program; its tests begin with test_."""
    tests = {name[5:]: test for name, test in names.items()
             if name.startswith("test_")}
    if len(sys.argv) > 1:
        tests[sys.argv[1]]()
    else:
        print(*tests, sep="\n")
