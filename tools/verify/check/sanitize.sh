#!/bin/sh
# All tests under the address and undefined-behaviour sanitizers:
# sanitize.sh COMPILER.
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
"$MAKE" --no-print-directory CC="$1" BUILD="$BUILD/sanitize-$1" OPT=-O1 \
  EXTRA="$FLAGS -fno-omit-frame-pointer" test >"$BUILD/tests-$1.log" 2>&1 ||
  wrong "tests fail under the sanitizers of $1"
cat "$BUILD/tests-$1.log"
checked "$(tail -n 1 "$BUILD/tests-$1.log"); address and undefined" \
  "behaviour, both real types"
