#!/bin/sh
# A soak of chaos, short enough for every check: SOAK_STEPS says how long.
. "$(dirname "$0")/lib.sh"
log=$BUILD/soak-runs.log
setting gcc -O3
in_common "$place/double/soak" "$place/float/soak" || exit 1
: >"$log"
for real in double float; do
  "$place/$real/soak" "${SOAK_STEPS:-1e7}" >>"$log" 2>&1 ||
    wrong "a promise did not hold in $real"
done
cat "$log"
checked "${SOAK_STEPS:-1e7} steps of chaos, both real types; half replayed"
