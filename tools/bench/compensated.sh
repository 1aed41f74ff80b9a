#!/bin/sh
# `make bench-compensated`: what rounding costs at small steps and what the
# compensated step saves of it. Columns are errors of r, v, w (the largest)
# against a run in double whose step is finer: of the scheme (double, carried),
# of double, float and carried float; then carried float by scheme. Runs for
# about three minutes.
set -u
LC_ALL=C
export LC_ALL
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
run() {
  real=$1
  shift
  "$BUILD/$real/tools/bench/compensated" "$@" || exit 1
}

# table PROBLEM MICROSECONDS REFERENCE REFINEMENT DOUBLINGS...: the reference
# has the step 2^REFERENCE us / REFINEMENT.
table() {
  problem=$1 length=$2
  reference=$(run double "$1" "$3" "$2" carried "$4")
  shift 4
  echo
  echo "$problem to t = $(awk -v n="$length" 'BEGIN { print n * 1e-6 }') s"
  echo '     dt [s]    scheme    double     float   carried  / scheme' \
    ' |h| stick'
  for doublings; do
    {
      echo "$reference"
      run double "$problem" "$doublings" "$length" carried
      run double "$problem" "$doublings" "$length" plain
      run float "$problem" "$doublings" "$length" plain
      run float "$problem" "$doublings" "$length" carried
    } | awk -v dt="$doublings" '
      NR == 1 { r = $1; v = $2; w = $3; next }
      function larger(a, b) { b = b < 0 ? -b : b; return a > b ? a : b }
      { e[NR] = larger(larger(larger(0, $1 - r), $2 - v), $3 - w); h = $5 }
      END { printf "%11.4g %9.1e %9.1e %9.1e %9.1e %9.3g %10.1e\n",
              2 ^ dt * 1e-6, e[2], e[3], e[4], e[5], e[5] / e[2], h }'
  done
}

# cost REAL: mean instructions of 1000 steps, plain and carried.
cost() {
  suffix=f64
  [ "$1" = double ] || suffix=f32
  for problem in rolling slip; do
    set -- "$1" "$problem"
    for how in plain carried; do
      function=tf_step_$suffix
      [ "$how" = plain ] || function=tf_step_compensated_$suffix
      valgrind --tool=callgrind --toggle-collect="$function" \
        --callgrind-out-file="$BUILD/bench-compensated" \
        "$BUILD/$1/tools/bench/compensated" "$problem" 10 1024000 "$how" \
        >/dev/null 2>"$BUILD/bench-compensated.log" || return
      set -- "$@" "$(awk '/^summary/ { printf "%.0f", $2 / 1000 }' \
        "$BUILD/bench-compensated")"
    done
    echo "$1, $2: $3 instructions a step plain, $4 carried"
  done
}

echo 'errors of r [m], v [m/s], w [rad/s]; parameters and start as in float'
table rolling 10485760 5 1 0 3 6 8 10 12
table coulomb-slip 10485760 0 2 0 3 6 8
table slip 10485760 0 2 0 2 3 4 6 8
table frictionless 10485760 0 2 0 3 6 8
table chaos 1048576 0 32 0 2 4 6 8 10
table chaos 1900544 0 16 0 2 4 6 8 10
echo
if command -v valgrind >/dev/null; then
  cost double
  cost float
else
  echo 'instructions need valgrind: apt-get install valgrind'
fi
