#!/bin/sh
# Lines and branches of src/ that the tests of the host reach, both real types
# together: what no test reaches is not known to work, so it is wrong. The
# parts of a step are functions here, so that each counts once: the attribute
# that makes them one (kernel.h) is renamed to one without effect.
. "$(dirname "$0")/lib.sh"
need gcov gcc

# Programs, not the command line: who breaks the core is to be told by a test
# that names what broke. Those of units in double and those of laws in float
# are enough, and without two that take long; test_line and test_device start
# programs.
programs_of() { # REAL PLACE...: names of programs
  real=$1
  shift
  files_in 'test_*.c' "$@" |
    grep -vE "/test_(device|line|ensemble|branch)\.c\$" |
    sed "s|^|$place/$real/|; s|\.c\$||"
}
place=$BUILD/coverage
rm -rf "$place"
programs=$(programs_of double tests/unit tests/regress
  programs_of float tests/law tests/golden)
tests=$(files_in 'test_*.c' tests | tr "\n" " ")
# shellcheck disable=SC2086  # a list of programs
build CC=gcc BUILD="$place" OPT=-O0 TESTS="$tests" \
  EXTRA='--coverage -Dalways_inline=unused -fkeep-inline-functions' $programs ||
  wrong "tests do not compile for coverage"
export TIMEOUT=900
# shellcheck disable=SC2086  # a list of programs
quietly tests/run $programs || wrong "tests fail"

# Every object, run or not: what no test is linked with counts as not reached.
# Headers are also reached from within a test.
files_in '*.gcno' "$place" | while read -r notes; do
  gcov -t -b -c -r "$notes" 2>/dev/null
done >"$BUILD/coverage.gcov"
for source in src/*/*.c; do
  [ -e "$place/double/${source%.c}.gcno" ] ||
    wrong "$source: is compiled for no test"
done
awk -f tools/check/coverage.awk "$BUILD/coverage.gcov" >"$BUILD/coverage.txt" ||
  wrong "a line or a branch is reached by no test"
cat "$BUILD/coverage.txt"
checked "$(tail -n 1 "$BUILD/coverage.txt")"
