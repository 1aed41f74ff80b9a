#!/bin/sh
# Runs fuzz targets from their corpus:
#   tools/verify/fuzz/fuzz.sh SECONDS REAL/TARGET...      (environment: BUILD)
# What a run finds new stays in BUILD/fuzz/REAL/TARGET.found, where the next one
# starts. An input that breaks a promise is kept as tests/regress/crash-TARGET-
# ..., which every `make test` replays from then on. Prints runs and coverage,
# and "N passed, N failed".
set -u
cd "$(dirname "$0")/../../.." || exit 1
BUILD=${BUILD:-build}
seconds=$1
shift

# last PATTERN: what it takes out of the last line of the log that has it.
last() { sed -n "s/$1/\\1/p" "$place.log" | tail -n 1; }

fuzz() {
  result=ok
  # What a target says of its own (complaints of the command line) is left out:
  # stdout and stderr of it are closed, those of libFuzzer stay.
  "$place" -max_total_time="$seconds" -max_len=512 -timeout=10 \
    -close_fd_mask=3 -print_final_stats=1 \
    -artifact_prefix="tests/regress/crash-$target-" "$place.found" "$corpus" \
    >"$place.log" 2>&1 || result=FAILED
  printf '%-18s %10s %8s %8s %8s\n' "$run" \
    "$(last 'stat::number_of_executed_units: *\(.*\)')" \
    "$(last '.* cov: \([0-9]*\) .*')" "$(last '.* ft: \([0-9]*\) .*')" \
    "$result"
  [ "$result" != ok ] || return 0
  grep -E 'ERROR|runtime error|broken promise|    #[0-9] ' "$place.log" |
    head -n 20
  kept=$(last '.*Test unit written to \(.*\)')
  [ -n "$kept" ] || return 1
  # Its own words, which the run has left out.
  "$place" "$kept" 2>&1 | grep 'broken promise'
  echo "kept: $kept; replay: $place $kept"
  return 1
}

case $seconds in
'' | *[!0-9]* | 0*)
  echo "make fuzz: SECONDS=$seconds: not a whole number > 0" >&2
  exit 2
  ;;
*)
  printf '%-18s %10s %8s %8s %8s\n' target runs edges features result
  ;;
esac
passed=0 failed=0
for run; do
  target=${run#*/}
  place=$BUILD/fuzz/$run
  corpus=tests/corpus/$target
  mkdir -p "$place.found"
  cp tests/regress/crash-"$target"-* "$place.found" 2>/dev/null
  if fuzz; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
