#!/bin/sh
# Same bits: the golden trajectory hashes hold under compilers and optimisations
# (three settings, of which check `clang` has compiled one; with FULL=yes
# twelve), and `twofold run` writes the same bytes.
. "$(dirname "$0")/lib.sh"
need gcc gcc
need clang clang
tests=$(echo tests/golden/*.c)
[ -e "${tests%% *}" ] || wrong "there are no tests/golden/*.c"
native=-march=native
# run REAL: in float some steps stand still and say so, which is exit code 5.
run() {
  status=0
  "$place/$1/twofold" run chaos --t-end 10 --every 100 --out "$place/$1.csv" ||
    status=$?
  [ "$status" -eq 0 ] || [ "$1$status" = float5 ]
}
settings=0
first=
for compiler in gcc clang; do
  for opt in -O0 -O1 -O2 -O3 -Os "-O3 $native"; do
    case "$FULL$compiler $opt" in
    yes* | "gcc -O0" | "gcc -O3 $native" | "clang -O0") ;;
    *) continue ;;
    esac
    setting "$compiler" "$opt"
    in_common TESTS="$tests" test || wrong "$compiler $opt gives other hashes"
    for real in double float; do
      if ! in_common "$place/$real/twofold" || ! quietly run "$real"; then
        wrong "$compiler $opt $real: twofold run failed"
      elif [ -n "$first" ]; then
        cmp "$first/$real.csv" "$place/$real.csv" ||
          wrong "$compiler $opt $real: other bytes in the CSV"
      fi
    done
    [ -n "$first" ] || first=$place
    settings=$((settings + 1))
  done
done
checked "golden hashes and the CSV of chaos, $settings compiler settings," \
  "both real types"
