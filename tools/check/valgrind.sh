#!/bin/sh
# Tests of both real types under valgrind's memcheck: what the sanitizers of gcc
# do not see is a decision by a value that was never set. valgrind.sh: the quick
# tests below, of the line, the session, the step and what is beside it.
# valgrind.sh all (`make valgrind`): every program; those that are not done in
# LIMIT seconds, as orbits of 1e6 steps and sweeps of random machines, are
# stopped and named.
. "$(dirname "$0")/lib.sh"
need valgrind valgrind
room=$BUILD/valgrind
LIMIT=${LIMIT:-60}

# Program, or program:test.
few='unit/link/test_protocol unit/link/test_link unit/link/test_text
  unit/scene/test_session unit/scene/test_scene unit/model/test_prepare
  unit/friction/test_select unit/friction/test_slip_residual
  unit/link/test_frame:frames_survive_the_line
  unit/link/test_frame:long_runs_stay_in_the_buffer
  unit/link/test_frame:block_decoder_is_the_byte_decoder
  unit/link/test_frame:lost_frames_are_counted
  unit/link/test_frame:other_versions_and_lengths_are_counted
  unit/moreau/test_begin:begin_at_codimension_two_is_pinned
  unit/moreau/test_ensemble:ensemble_of_any_size
  law/test_located_report:located_residual_is_that_of_the_law
  law/test_located_report:located_event_at_the_end_of_a_step
  law/test_extremes:overflow_of_a_slope_keeps_every_number_finite
  regress/test_no_friction
  regress/test_degraded:degraded_step_reports_the_consistent_set'
if [ "${1:-few}" = all ]; then
  few=$(files_in 'test_*.c' tests | sed 's|^tests/||; s|\.c$||')
fi

runs='' programs=''
for real in double float; do
  for test in $few; do
    program=$room/$real/tests/${test%%:*}
    case "$programs " in
    *" $program "*) ;;
    *) programs="$programs $program" ;;
    esac
    case $test in
    *:*) runs="$runs $program:${test#*:}" ;;
    *) runs="$runs $program:" ;;
    esac
  done
done
# shellcheck disable=SC2086  # a list of programs
build CC=gcc BUILD="$room" OPT='-O1 -g' $programs || exit 1

# It must find a decision by what was never set.
cat >"$room/seed.c" <<'END'
#include <stdlib.h>
int main(void) {
  int *seed = malloc(sizeof *seed);
  const int is_seven = seed && *seed == 7;
  free(seed);
  return is_seven;
}
END
gcc -g -O0 "$room/seed.c" -o "$room/seed" || exit 1
valgrind -q --error-exitcode=99 "$room/seed" >"$room/seed.log" 2>&1
[ $? -eq 99 ] || wrong "memcheck does not find a value that was never set"

rm -f "$room"/*.stopped
# shellcheck disable=SC2016,SC2086  # the inner shell expands; a list of runs
printf '%s\n' $runs | xargs -P "${JOBS:-$(nproc 2>/dev/null || echo 2)}" \
  -I RUN sh -c '
    program=${1%%:*} test=${1#*:} room=$2
    name=$(echo "${1#"$room"/}" | tr /: __)
    timeout "$3" valgrind -q --error-exitcode=99 --leak-check=full "$program" \
      ${test:+--only "$test"} >"$room/$name.log" 2>&1
    case $? in
    0) ;;
    124) grep -q "^==" "$room/$name.log" || : >"$room/$name.stopped" ;;
    *) false ;;
    esac && ! grep "^==" "$room/$name.log" || {
      echo "$1"
      tail -n 40 "$room/$name.log"
      exit 1
    }' run RUN "$room" "$LIMIT" ||
  wrong "memcheck has found something, or a test failed under it"
stopped=0
for file in "$room"/*.stopped; do
  [ -e "$file" ] || continue
  stopped=$((stopped + 1))
  echo "stopped after $LIMIT s, nothing found: $(basename "$file" .stopped)"
done
# shellcheck disable=SC2086
count=$(printf '%s\n' $runs | wc -l)
[ "$stopped" -lt "$count" ] || wrong "nothing was done in time"
checked "$count runs of tests under memcheck, both real types;" \
  "$stopped stopped after $LIMIT s; the seeded error is found"
