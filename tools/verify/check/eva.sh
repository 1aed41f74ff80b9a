#!/bin/sh
# Undefined behaviour and numbers that are not finite, by Frama-C Eva, in both
# real types: all entries but step_finite, which takes longer than the others
# together; with FULL=yes that, too (make eva).
. "$(dirname "$0")/lib.sh"
need frama-c frama-c-base
log=$BUILD/eva-runs.log
entries=$(grep -v '^#' tools/verify/eva/entries | cut -d ' ' -f 1)
[ -n "$FULL" ] || entries=$(echo "$entries" | grep -vx step_finite)
# shellcheck disable=SC2086  # a list
tools/verify/eva/eva.py $entries >"$log" 2>&1 ||
  wrong "see tools/verify/eva/alarms"
cat "$log"
checked "$(tail -n 1 "$log"); both real types"
