#!/bin/sh
# Runs fuzz targets from their corpus:
#   tools/verify/fuzz/fuzz.sh SECONDS REAL/TARGET...      (environment: BUILD)
# What a run finds new stays in BUILD/fuzz/REAL/TARGET.found, where the next one
# starts. An input that breaks a promise is kept as tests/regress/crash-TARGET-
# ..., which every `make test` replays from then on. Prints runs and coverage,
# and "N passed, N failed".
set -u
cd "$(dirname "$0")/../../.." || exit 1
seconds=$1
shift
[ "$seconds" -gt 0 ] 2>/dev/null || {
  echo "make fuzz: SECONDS=$seconds: not a whole number > 0" >&2
  exit 2
}

# last PATTERN: what it takes out of the last line of the log that has it.
last() { sed -n "s/$1/\\1/p" "$place.log" | tail -n 1; }

row() { printf '%-18s %10s %8s %8s %8s\n' "$@"; }

row target runs edges features result
passed=0 failed=0
for run; do
  target=${run#*/} place=${BUILD:-build}/fuzz/$run
  mkdir -p "$place.found"
  cp tests/regress/crash-"$target"-* "$place.found" 2>/dev/null
  # What a target says of its own (complaints of the command line) is left out:
  # stdout and stderr of it are closed, those of libFuzzer stay.
  "$place" -max_total_time="$seconds" -max_len=512 -timeout=10 \
    -close_fd_mask=3 -print_final_stats=1 \
    -artifact_prefix="tests/regress/crash-$target-" "$place.found" \
    "tests/corpus/$target" >"$place.log" 2>&1 && result=ok || result=FAILED
  row "$run" "$(last 'stat::number_of_executed_units: *\(.*\)')" \
    "$(last '.* cov: \([0-9]*\) .*')" "$(last '.* ft: \([0-9]*\) .*')" "$result"
  [ "$result" != ok ] || { passed=$((passed + 1)) && continue; }
  failed=$((failed + 1))
  grep -E 'ERROR|runtime error|broken promise|    #[0-9] ' "$place.log" |
    head -n 20
  kept=$(last '.*Test unit written to \(.*\)')
  # Its own words, which the run has left out.
  [ -z "$kept" ] || "$place" "$kept" 2>&1 | grep 'broken promise'
  [ -z "$kept" ] || echo "kept: $kept; replay: $place $kept"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
