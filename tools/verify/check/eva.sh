#!/bin/sh
# Undefined behaviour and numbers that are not finite, by Frama-C Eva, in both
# real types.
. "$(dirname "$0")/lib.sh"
need frama-c frama-c-base
log=$BUILD/eva-runs.log
tools/verify/eva/eva.py >"$log" 2>&1 || wrong "see tools/verify/eva/alarms"
cat "$log"
checked "$(tail -n 1 "$log"); both real types"
