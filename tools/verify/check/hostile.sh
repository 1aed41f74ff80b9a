#!/bin/sh
# HOSTILE_FRAMES hostile frames (1e5; with FULL=yes 1e6) against the running
# firmware of the host port, in both real types and under the sanitizers of gcc:
# it goes on, and sends nothing that is not whole and finite. Bounded in count
# and time; the line is a pseudo-terminal of this machine.
. "$(dirname "$0")/lib.sh"
[ -z "$FULL" ] || HOSTILE_FRAMES=${HOSTILE_FRAMES:-1000000}
export HOSTILE_FRAMES="${HOSTILE_FRAMES:-100000}"
export HOSTILE_SECONDS="${HOSTILE_SECONDS:-300}" TIMEOUT=800
flags='-g1 -fsanitize=address,undefined,float-cast-overflow'
flags="$flags -fno-sanitize-recover=all"
"$MAKE" --no-print-directory CC=gcc BUILD="$BUILD/hostile" OPT=-O1 \
  EXTRA="$flags" TESTS=tests/line/test_hostile.c test \
  >"$BUILD/hostile.said" 2>&1 || {
  wrong "the firmware did not stand $HOSTILE_FRAMES hostile frames"
  cat "$BUILD/hostile.said"
}
for real in double float; do
  timeout -k 5 "$TIMEOUT" env FIRMWARE="$BUILD/hostile/boards/host/chaos" \
    "$BUILD/hostile/$real/tests/line/test_hostile" --seed 2 \
    >"$BUILD/hostile-$real.said" || wrong "another seed, $real"
done
checked "$(sed -n 's/^# //p' "$BUILD"/hostile-*.said | paste -s -d ';')"
