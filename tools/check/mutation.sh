#!/bin/sh
# A few wrong changes of src/ (make mutation), the same in every run until
# their lines change: the tests notice each, or tools/mutation/equivalent says
# why it makes no difference. MUTATIONS says how many.
. "$(dirname "$0")/lib.sh"
need gcc gcc
CC=gcc SAMPLE=${MUTATIONS:-24} SEED=1 BUILD=$BUILD AGAIN='' \
  tools/mutation/run 2>&1 ||
  wrong "a wrong change of src/ survives, or an excuse fits none"
[ "$BAD" -eq 0 ] || exit 1
checked "$(tail -n 2 "$BUILD/mutation/REPORT" | head -n 1 | cut -d ';' -f 1)"
