#!/bin/sh
# A few wrong changes of src/ (make mutation): the tests notice each, or
# tools/verify/mutation/equivalent says why it makes no difference. MUTATIONS
# says how many (8, with FULL=yes 100). First all of one order, then those of
# the commit's own order, which one fixed sample leaves unseen: more survivors
# than a quarter are not chance.
. "$(dirname "$0")/lib.sh"
need gcc gcc
sample=${MUTATIONS:-$([ -n "$FULL" ] && echo 100 || echo 8)}

# tried SEED SURVIVORS WORD...: a sample of an order, and what to say of it.
tried() {
  CC=gcc SAMPLE=$sample SEED=$1 SURVIVORS=$2 BUILD=$BUILD AGAIN='' \
    tools/verify/mutation/mutation.py 2>&1 ||
    wrong "wrong changes of src/ survive, or an excuse fits none: SEED=$1"
  shift 2
  note="${note:+$note; }$* $(tail -n 2 "$BUILD/mutation/REPORT" | head -n 1 |
    cut -d ';' -f 1)"
}

note=
tried 1 0 'fixed order:'
commit=$(git rev-parse --short=7 HEAD 2>/dev/null || echo 1)
seed=${MUTATION_SEED:-$((0x$commit))}
echo "order of this commit: MUTATION_SEED=$seed make check CHECKS=mutation"
tried "$seed" $((sample / 4)) "SEED=$seed:"
checked "$note"
