#!/bin/sh
# Tests under the address and undefined-behaviour sanitizers: sanitize.sh
# COMPILER. With gcc those of units and the line in double, with clang laws,
# golden and regress in float; with FULL=yes all tests in both.
. "$(dirname "$0")/lib.sh"
need "$1" "$1"
# Of the debugger's tables lines are enough, at half the time of compiling.
FLAGS='-g1 -fsanitize=address,undefined,float-cast-overflow'
FLAGS="$FLAGS -fno-sanitize-recover=all"
echo 'int main(void) { return 0; }' >"$BUILD/empty-$1.c"
# shellcheck disable=SC2086  # a list of flags
"$1" $FLAGS "$BUILD/empty-$1.c" -o "$BUILD/empty-$1" || {
  echo "missing: the sanitizers of $1 (apt-get install libclang-rt-dev)"
  exit 3
}
# What is left of a stack is watched under one of them: with gcc it doubles the
# time of the tests.
[ "$1" = gcc ] || export ASAN_OPTIONS=detect_stack_use_after_return=1
export TIMEOUT=900
set -- "$1" EXTRA="$FLAGS -fno-omit-frame-pointer"
if [ -z "$FULL" ]; then
  [ "$1" = gcc ] && rooms='tests/unit tests/line' real=double ||
    rooms='tests/law tests/golden tests/regress' real=float
  # None starts the command line, which would be compiled for nothing.
  # shellcheck disable=SC2086  # a list of folders
  set -- "$@" VARIANTS=$real TWOFOLD= \
    TESTS="$(files_in 'test_*.c' $rooms | tr '\n' ' ')"
fi
compiler=$1
shift
"$MAKE" --no-print-directory CC="$compiler" BUILD="$BUILD/sanitize-$compiler" \
  OPT=-O1 "$@" test >"$BUILD/tests-$compiler.log" 2>&1 ||
  wrong "tests fail under the sanitizers of $compiler"
cat "$BUILD/tests-$compiler.log"
checked "$(tail -n 1 "$BUILD/tests-$compiler.log"); address and undefined" \
  "behaviour${real:+, $real}"
