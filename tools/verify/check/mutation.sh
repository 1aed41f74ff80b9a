#!/bin/sh
# Wrong changes of src/ that only a hash noticed once (make mutation): each has
# a test that notices it. With FULL=yes also a hundred others in the order of
# the commit, of which more survivors than a quarter are not chance.
. "$(dirname "$0")/lib.sh"
need gcc gcc
commit=$(git rev-parse --short=7 HEAD 2>/dev/null || echo 1)
seed=${MUTATION_SEED:-$((0x$commit))}
CC=gcc SAMPLE=100 SEED="kept${FULL:+ $seed}" BUILD=$BUILD \
  tools/verify/mutation/mutation.py 2>&1 ||
  wrong "wrong changes of src/ survive: SEED=$seed"
checked "$(sed -n 's/\( changes noticed: .*\);.*/\1/p' \
  "$BUILD/mutation/REPORT" | paste -s -d ';')"
