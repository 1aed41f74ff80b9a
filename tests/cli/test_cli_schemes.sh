#!/bin/sh
# test_cli_schemes.sh - `run` with the compensated scheme and in real time.
#
# usage: test_cli_schemes.sh TWOFOLD
# No test judges how fast a run is: a paced run may take longer than its time
# but never less, and a step that is shorter than a look at the clock is late.

T=${1:?usage: test_cli_schemes.sh TWOFOLD}
case $T in /*) ;; *) T=$PWD/$T ;; esac
if [ ! -x "$T" ]; then
  echo "# $T cannot be executed"
  echo "0 passed, 1 failed"
  exit 1
fi
D=$(mktemp -d) || exit 1
trap 'rm -rf "$D"' EXIT
cd "$D" || exit 1
LC_ALL=C
export LC_ALL

count=0
failed=0
real=$("$T" --version | sed 's/.* is //')

# check NAME COMMAND...: the command succeeds.
check() {
  name=$1
  shift
  count=$((count + 1))
  if "$@"; then
    echo "ok $count - $name"
    return
  fi
  failed=$((failed + 1))
  echo "not ok $count - $name"
  echo "# failed: $*"
  sed 's/^/#   /' err | head -n 5
}

# run ARGS...: stdout in out, stderr in err, exit code in $code.
run() {
  "$T" run "$@" >out 2>err
  code=$?
}

# near FILE FILE BOUND: the last rows differ by BOUND at most in r, v and omega.
near() {
  tail -n 1 "$1" >last
  tail -n 1 "$2" >>last
  awk -F, -v bound="$3" '
    NR == 1 { for (i = 2; i <= 4; i++) x[i] = $i; next }
    { for (i = 2; i <= 4; i++) { d = $i - x[i]; if (d < 0) d = -d
        if (!(d <= bound)) bad = 1 } }
    END { exit bad || NR != 2 }' last
}

# stuck BOUND: the largest |h| in stick that err tells is below BOUND.
stuck() {
  sed -n 's/^largest .*stick \([^ ]*\) m.*/\1/p' err |
    awk -v bound="$1" '{ exit !($1 + 0 < bound) }'
}

# late: steps that err tells as late.
late() { sed -n 's/^real time *\([0-9]*\) of .*/\1/p' err; }

test_compensated() {
  for scene in $("$T" scenes | cut -d ' ' -f 1); do
    run "$scene" --t-end 0.2 --dt 1e-3 --every 1000
    mv out plain
    run "$scene" --t-end 0.2 --dt 1e-3 --every 1000 --scheme compensated
    check "$scene: runs" test "$code" -eq 0
    check "$scene: ends where moreau does" near plain out 1e-5
  done
  run chaos --t-end 1 --dt 1e-5 --every 100000
  mv out plain
  cp err plain-err
  run chaos --t-end 1 --dt 1e-5 --every 100000 --scheme compensated
  check 'the summary names the scheme' grep -q '^scheme  *compensated,' err
  # What rounds h in stick is below the digits of the state.
  if [ "$real" = double ]; then
    check 'stick to more digits than the state has' stuck 1e-20
    check 'ends where moreau does' near plain out 1e-12
    cp plain-err err
    check 'moreau does not' eval '! stuck 1e-20'
  else
    check 'stick to more digits than the state has' stuck 1e-11
  fi
  # PHYSICS: the state at t = 1 s.
  echo '1,0.185676357258,0.010298364853,-0.987353474328' >truth
  check 'ends at the reference' near truth out 1e-6
  run chaos --t-end 1 --scheme compensated --set tolerance=1e-5 --every 10000
  check 'tolerance is left aside' grep -q 'no effect under --scheme comp' err
  run rolling --t-end 0.5 --scheme compensated --set phi=0 --every 100
  check 'the angle is carried too' grep -q 'phi = 0.63' err
  run chaos --scheme compensate
  check 'the closest scheme is suggested' grep -q "mean 'compensated'" err
  check 'an unknown scheme is usage' test "$code" -eq 2
  run chaos --scheme compensated --set beta=0
  check 'a refused parameter' test "$code" -eq 3
}

test_frames() {
  run chaos --t-end 0.1 --scheme compensated
  mv out want
  run chaos --t-end 0.1 --scheme compensated --format frames
  mv out frames
  check 'frames are written' test -s frames
  "$T" monitor frames --csv >out 2>err
  check 'frames hold the same rows' cmp out want
  for scheme in moreau located compensated; do
    "$T" run chaos --t-end 0 --scheme $scheme --format frames 2>err |
      head -c 40 | cksum >"schema-$scheme"
  done
  check 'the schema tells it from moreau' \
    eval '! cmp -s schema-moreau schema-compensated'
  check 'the schema tells it from located' \
    eval '! cmp -s schema-located schema-compensated'
}

test_real_time() {
  run chaos --t-end 0.2 --dt 0.01
  mv out want
  check 'without it no pace is told' eval '! grep -q "^real time" err'
  run chaos --t-end 0.2 --dt 0.01 --realtime
  check 'in real time: runs' test "$code" -eq 0
  check 'in real time: the same rows' cmp out want
  check 'in real time: late steps are counted' test -n "$(late)"
  # A step of 1 ns is over before it has begun.
  run chaos --t-end 1e-6 --dt 1e-9 --realtime --every 10
  check 'steps that no clock resolves are late' test "$(late)" -gt 0
  check 'late steps are taken all the same' test "$(wc -l <out)" -eq 102
  run chaos --realtime=yes
  check 'it takes no value' grep -q 'takes no value' err
  check 'a value is usage' test "$code" -eq 2
  run chaos --realtime --realtime
  check 'given twice' grep -q 'already given' err
  # It waits, or it would be over before the signal that ends the wait.
  "$T" run chaos --realtime --dt 1 --t-end 1000 >out 2>err &
  child=$!
  until grep -q '^0,' out 2>/dev/null; do sleep 0.05; done
  kill -INT $child
  wait $child
  code=$?
  check 'interrupted while it waits' test "$code" -eq 4
  check 'interrupted: it is told' grep -q 'interrupted' err
}

test_help() {
  "$T" help run >out 2>err
  for word in compensated --realtime; do
    check "help run tells $word" grep -qF -e "$word" out
  done
}

test_reports() {
  for report in bench stability; do
    "$T" $report >out 2>err
    check "$report: usage" test $? -eq 2
    check "$report: where to find it" grep -q "make $report" err
  done
}

test_compensated
test_frames
test_real_time
test_help
test_reports

echo "1..$count"
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
