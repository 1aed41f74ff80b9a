#!/bin/sh
# A search for the most expensive inputs of every public function, begun at what
# is in tools/verify/cost/worst.*, finds no call of more instructions than header and
# longest way have; no header says more than 1.25 times the found, or that way.
# The counter itself is held against single steps.
. "$(dirname "$0")/lib.sh"
need gcc gcc
need clang clang
[ "$(uname -m)" = x86_64 ] || {
  echo 'missing: a processor of type x86-64, of which the rows speak'
  exit 3
}
EVALUATIONS=${EVALUATIONS:-2000}
cost=$BUILD/costs/double/cost
build CC=gcc BUILD="$BUILD/costs" OPT=-O2 EXTRA=-Werror "$cost" \
  "$BUILD/costs/float/cost" || wrong "tools/verify/cost does not build"

files_in '*.h' include | xargs tools/verify/cost/headers.py claims \
  >"$BUILD/cost.claims" || wrong "the headers are not understood"
while read -r name first _; do
  [ "$first" != none ] ||
    wrong "$name: its row does not say \"Cost: at most N instructions\""
done <"$BUILD/cost.claims"

for real in double float; do
  cat tools/verify/cost/worst.* | "$BUILD/costs/$real/cost" search "$EVALUATIONS" \
    >"$BUILD/cost.$real" || wrong "the search failed"
  tools/verify/cost/paths.py "$real" "$BUILD/costs" >"$BUILD/cost.ways.$real" ||
    wrong "the ways through the code are not understood"
done
tools/verify/cost/judge.py "$BUILD/cost.claims" "$BUILD/cost.ways.double" \
  "$BUILD/cost.double" "$BUILD/cost.ways.float" "$BUILD/cost.float" ||
  wrong "rows do not hold"

# Functions without repeated string instructions, of which each step is one;
# tf_step has them where it is rare.
for name in tyre_force begin surface_at; do
  grep "^tf_$name " "$BUILD/cost.double" | "$cost" step "$name" ||
    wrong "tf_$name: other instructions were counted than stepped through"
done
[ "$BAD" -eq 0 ] ||
  echo 'figures that hold, into the rows: make bounds && make keep-bounds'
checked "$(wc -l <"$BUILD/cost.claims") functions," \
  "$EVALUATIONS calls each beside the most expensive known; gcc -O2," \
  "both real types"
