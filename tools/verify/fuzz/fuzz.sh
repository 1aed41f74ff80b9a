#!/bin/sh
# Runs fuzz targets from their corpus, or puts what that found into the corpus:
#   tools/verify/fuzz/fuzz.sh SECONDS REAL/TARGET...      (environment: BUILD)
#   tools/verify/fuzz/fuzz.sh merge REAL/TARGET...        (BUILD, MOST)
# What a run finds new stays in BUILD/fuzz/REAL/TARGET.found, where the next one
# starts. An input that breaks a promise is kept as tests/regress/crash-TARGET-
# ..., which every `make test` replays from then on. Prints runs and coverage,
# and "N passed, N failed".
#
# merge: the smallest inputs that reach what all reach, up to MOST files a
# target: the corpus is there to be replayed in every test run, and stands in
# the history of the project. Files named seed-* were made by hand and stay:
# what they show, as a frame broken on its way, is no edge of its own.
set -u
cd "$(dirname "$0")/../../.." || exit 1
BUILD=${BUILD:-build}
seconds=$1
shift

merge() {
  rm -rf "$place.merged"
  mkdir -p "$place.merged"
  # Counts of how often an edge is taken are left out: files for them would be
  # ten times as many.
  "$place" -merge=1 -use_counters=0 -max_len=512 -close_fd_mask=3 \
    "$place.merged" "$corpus" "$place.found" >"$place.log" 2>&1 || exit 1
  # The largest reach most.
  find "$place.merged" -type f -size +0 -printf '%s %p\n' | sort -rn |
    head -n "${MOST:-15}" | cut -d ' ' -f 2 >"$place.list"
  find "$corpus" -type f ! -name 'seed-*' -exec rm -f {} +
  while read -r file; do
    cp "$file" "$corpus/$(basename "$file" | cut -c 1-12)" || exit 1
  done <"$place.list"
  echo "$run: $(wc -l <"$place.list") files," \
    "$(cat "$corpus"/* | wc -c) bytes in $corpus"
}

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
merge) work=merge ;;
'' | *[!0-9]* | 0*)
  echo "make fuzz: SECONDS=$seconds: not a whole number > 0" >&2
  exit 2
  ;;
*)
  work=fuzz
  printf '%-18s %10s %8s %8s %8s\n' target runs edges features result
  ;;
esac
passed=0 failed=0
for run; do
  target=${run#*/}
  place=$BUILD/fuzz/$run
  corpus=tests/corpus/$target
  mkdir -p "$place.found"
  if $work; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done
[ $work = merge ] || echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
