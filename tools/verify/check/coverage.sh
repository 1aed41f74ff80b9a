#!/bin/sh
# Lines and branches of src/ that the tests of the host reach, both real types
# together: what no test reaches is not known to work, so it is wrong. The
# parts of a step are functions here, so that each counts once: the attribute
# that makes them one (kernel.h) is renamed to one without effect.
. "$(dirname "$0")/lib.sh"
need gcov gcc
need gcovr gcovr

# Programs, not the command line: whoever breaks the core should hear it from a
# test that names what broke. Those of units in double and those of laws in
# float are enough, and without one that takes long.
programs_of() { # REAL PLACE...: names of programs
  real=$1
  shift
  files_in 'test_*.c' "$@" |
    grep -v "/test_branch\.c\$" |
    sed "s|^|$place/$real/|; s|\.c\$||"
}
place=$BUILD/coverage
rm -rf "$place"
programs=$(programs_of double tests/unit tests/line tests/regress
  programs_of float tests/law tests/golden tests/regress)
tests=$(files_in 'test_*.c' tests | tr "\n" " ")
# shellcheck disable=SC2086  # a list of programs
build CC=gcc BUILD="$place" OPT=-O0 TESTS="$tests" \
  EXTRA='--coverage -Dalways_inline=unused -fkeep-inline-functions' $programs ||
  wrong "tests do not compile for coverage"
export TIMEOUT=900
# shellcheck disable=SC2086  # a list of programs
quietly tests/run $programs || wrong "tests fail"

# No comment excuses a line.
grep -rnE 'GCOVR?_EXCL|LCOV_EXCL' src && wrong "lines are left out"

for source in src/*/*.c; do
  [ -e "$place/double/${source%.c}.gcno" ] ||
    wrong "$source: is compiled for no test"
done
# Headers are also reached from within a test. An object that no program was
# linked with counts as not reached. What gcov says is read once.
{
  gcovr -j "$(nproc)" --filter src/ --json "$place/counts.json" "$place" &&
    gcovr -a "$place/counts.json" && gcovr -a "$place/counts.json" --branches \
    --print-summary --fail-under-line 100 --fail-under-branch 100
} >"$BUILD/coverage.txt" 2>&1 ||
  wrong "a line or a branch is reached by no test"
cat "$BUILD/coverage.txt"
count='s/^(lines|branches): .*\(([0-9]+) out of ([0-9]+)\)/\2 of \3 \1/p'
counts=$(sed -nE "$count" "$BUILD/coverage.txt" | paste -s -d , | sed 's/,/, /')
checked "$counts of src/"
