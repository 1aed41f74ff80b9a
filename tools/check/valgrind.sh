#!/bin/sh
# Tests of both real types under valgrind's memcheck: what no sanitizer of gcc
# sees is a decision by a value that was never set. Takes the tests that it is
# given, else those of the line, the session, the step and what is beside it
# that need few seconds; `make valgrind` does all but the ones named here.
. "$(dirname "$0")/lib.sh"
need valgrind valgrind
room=$BUILD/valgrind

# Over a minute each under memcheck: long orbits, sweeps of random machines.
slow='SLOW'
case ${1:-few} in
all)
  tests=
  for test in tests/unit/*.c tests/law/*.c tests/golden/*.c tests/regress/*.c; do
    case " $slow " in
    *" $(basename "$test" .c) "*) ;;
    *) tests="$tests $test" ;;
    esac
  done
  ;;
few)
  tests='FEW'
  ;;
*) tests=$* ;;
esac

programs=
for real in double float; do
  for test in $tests; do programs="$programs $room/$real/${test%.c}"; done
done
# shellcheck disable=SC2086  # a list of programs
build CC=gcc BUILD="$room" OPT='-O1 -g' $programs || exit 1

# It must find a decision by what was never set.
cat >"$room/seed.c" <<'END'
#include <stdlib.h>
int main(void) {
  int *seed = malloc(sizeof *seed);
  return seed && *seed == 7 ? 1 : 0;
}
END
gcc -g -O0 "$room/seed.c" -o "$room/seed" || exit 1
memcheck() {
  valgrind -q --error-exitcode=99 --leak-check=full "$@"
}
memcheck "$room/seed" >"$BUILD/valgrind.seen" 2>&1 &&
  wrong "memcheck does not find a value that was never set"

jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
# shellcheck disable=SC2086
printf '%s\n' $programs |
  xargs -P "$jobs" -I PROGRAM sh -c '
    nice -n 5 valgrind -q --error-exitcode=99 --leak-check=full PROGRAM \
      >PROGRAM.memcheck 2>&1 || { cat PROGRAM.memcheck; exit 1; }' ||
  wrong "memcheck has found something, or a test failed under it"
# shellcheck disable=SC2086
checked "$(printf '%s\n' $programs | wc -l) test programs under memcheck," \
  "both real types; the seeded error is found"
