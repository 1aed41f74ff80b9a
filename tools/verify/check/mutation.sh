#!/bin/sh
# A few wrong changes of src/ (make mutation): the tests notice each, or
# tools/verify/mutation/equivalent says why it makes no difference. First those
# that are kept. MUTATIONS says how many others (8, with FULL=yes 100): all of
# one order, then those of the commit's own order, which one fixed sample leaves
# unseen: more survivors than a quarter are not chance.
. "$(dirname "$0")/lib.sh"
need gcc gcc
sample=${MUTATIONS:-$([ -n "$FULL" ] && echo 100 || echo 8)}
commit=$(git rev-parse --short=7 HEAD 2>/dev/null || echo 1)
seed=${MUTATION_SEED:-$((0x$commit))}
echo "order of this commit: MUTATION_SEED=$seed make check CHECKS=mutation"
CC=gcc SAMPLE=$sample SEED="kept 1 $seed" SURVIVORS="0 0 $((sample / 4))" \
  BUILD=$BUILD tools/verify/mutation/mutation.py 2>&1 ||
  wrong "wrong changes of src/ survive, or an excuse fits none: SEED=$seed"
checked "kept, SEED=1, $seed: $(sed -n 's/\( changes noticed: .*\);.*/\1/p' \
  "$BUILD/mutation/REPORT" | paste -s -d ';')"
