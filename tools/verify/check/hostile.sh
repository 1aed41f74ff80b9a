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
  EXTRA="$flags" TESTS=tests/line/test_hostile.py test \
  >"$BUILD/hostile.said" 2>&1 || {
  wrong "the firmware did not stand $HOSTILE_FRAMES hostile frames"
  cat "$BUILD/hostile.said"
}
SEED=2 TWOFOLD="$BUILD/hostile/double/twofold" timeout -k 5 "$TIMEOUT" \
  tests/line/test_hostile.py >"$BUILD/hostile.other" || wrong 'another seed'
checked "$(sed -n 's/^# //p' "$BUILD/hostile.other" | paste -s -d ';')"
