#!/bin/sh
# Lines and branches of the command line, the monitor, the closed loop (hil) and
# the loop of the boards that the tests which start programs reach. Not all of
# them, unlike in src/: what an operating system hardly ever does (a close that
# fails, no memory) has no test. The floors are what is reached; they may only
# rise.
. "$(dirname "$0")/lib.sh"
need gcov gcc
need gcovr gcovr
LINES=93
BRANCHES=82
place=$BUILD/coverage-tools
rm -rf "$place"
# Not the tests of builds and drivers: they start other programs.
tests=$(files_in 'test_*.sh' tests/cli tests/line
  files_in 'test_*.py' tests/cli tests/line
  files_in 'test_*.c' tests/line tests/cli)
tests=$(echo "$tests" | grep -vE '/test_(drive|required|figures)\.')
export TIMEOUT=900
quietly "$MAKE" --no-print-directory CC=gcc BUILD="$place" OPT=-O0 \
  EXTRA=--coverage TESTS="$(echo "$tests" | tr '\n' ' ')" test ||
  wrong 'tests fail'
# Counts of shards have tests beside those of clusters.
export TWOFOLD="$place/double/twofold"
quietly tests/shards/test_shards.py those || wrong 'tests of counts fail'
# The functions of port/sim.h stand there twice, with a link and without;
# gcovr 5 stops where a function of two programs is on two lines.
said=$BUILD/coverage-tools.txt
gcovr --filter tools/cli/ --filter tools/board/hil/ --filter port/ \
  --exclude port/sim.h --print-summary --fail-under-line $LINES \
  --fail-under-branch $BRANCHES "$place" >"$said" 2>&1 ||
  wrong "wrong: gcovr, or under $LINES % of lines or $BRANCHES % of branches"
for file in tools/cli/monitor/monitor.c tools/cli/run/run.c port/loop.c \
  tools/board/hil/drive.c; do
  grep -q "^$file " "$said" || wrong "$file is not counted"
done
[ "$BAD" -eq 0 ] || cat "$said"
count='s/^(lines|branches): (.*)% .*/\2 % of \1/p'
checked "$(sed -nE "$count" "$said" | paste -s -d , |
  sed 's/,/, /') of command line, hil and loop"
