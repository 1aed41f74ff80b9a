#!/bin/sh
# A soak of chaos, SOAK_STEPS long (2e6; with FULL=yes 1e8).
. "$(dirname "$0")/lib.sh"
log=$BUILD/soak-runs.log
steps=${SOAK_STEPS:-$([ -n "$FULL" ] && echo 1e8 || echo 2e6)}
setting gcc -O3
in_common "$place/double/soak" "$place/float/soak" || exit 1
: >"$log"
for real in double float; do
  "$place/$real/soak" "$steps" >>"$log" 2>&1 ||
    wrong "a promise did not hold in $real"
done
cat "$log"
checked "$steps steps of chaos, both real types; half replayed"
