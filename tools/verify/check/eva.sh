#!/bin/sh
# Undefined behaviour and numbers that are not finite, by Frama-C Eva, in both
# real types: the entries of set `short`; with FULL=yes all (make eva).
. "$(dirname "$0")/lib.sh"
need frama-c frama-c-base
log=$BUILD/eva-runs.log
# shellcheck disable=SC2046  # one word or none
tools/verify/eva/eva.py $([ -n "$FULL" ] || echo short) >"$log" 2>&1 ||
  wrong "see tools/verify/eva/alarms"
cat "$log"
checked "$(tail -n 1 "$log"); both real types"
