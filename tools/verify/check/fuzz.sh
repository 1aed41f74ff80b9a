#!/bin/sh
# Every fuzz target from its corpus, SECONDS_EACH s (5; with FULL=yes 30). The
# target `machine` in double, with FULL=yes also in float.
. "$(dirname "$0")/lib.sh"
need clang clang
seconds=${SECONDS_EACH:-$([ -n "$FULL" ] && echo 30 || echo 5)}
quietly "$MAKE" -s --no-print-directory BUILD="$BUILD/fuzz" fuzz-clang || {
  echo 'missing: libFuzzer of clang (apt-get install libclang-rt-dev)'
  exit 3
}
log=$BUILD/fuzz-runs.log
"$MAKE" -s --no-print-directory BUILD="$BUILD/fuzz" SECONDS="$seconds" \
  FUZZ_REALS="double${FULL:+ float}" fuzz >"$log" 2>&1 ||
  wrong "a fuzz target found something"
cat "$log"
checked "$(tail -n 1 "$log"); $(awk '$5 == "ok" { runs += $2 }
  END { print runs }' "$log") runs, $seconds s a target"
