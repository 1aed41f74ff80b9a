#!/bin/sh
# `run` with the compensated scheme and in real time. No test judges how fast a
# run is: a paced run may take longer than its time but never less, and a step
# that is shorter than a look at the clock is late.
# usage: test_cli_schemes.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

# near FILE FILE BOUND: the last rows differ by BOUND at most in r, v and omega.
near() {
  { tail -n 1 "$1" && tail -n 1 "$2"; } | awk -F, -v bound="$3" '
    NR == 1 { for (i = 2; i <= 4; i++) x[i] = $i; next }
    { for (i = 2; i <= 4; i++) { d = $i - x[i]; if (d < 0) d = -d
        if (!(d <= bound)) bad = 1 } }
    END { exit bad || NR != 2 }'
}

# stuck BOUND: the largest |h| in stick that err reports is below BOUND.
stuck() {
  sed -n 's/^largest .*stick \([^ ]*\) m.*/\1/p' err |
    awk -v bound="$1" '{ exit !($1 + 0 < bound) }'
}

# late: steps that err counts as late.
late() { sed -n 's/^real time *\([0-9]*\) of .*/\1/p' err; }

# Scheme compensated.
for scene in $("$T" scenes | cut -d ' ' -f 1); do
  set -- run "$scene" --t-end 0.2 --dt 1e-3 --every 1000
  run "$@"
  mv out plain
  runs "$@" --scheme compensated
  check "$scene: ends where moreau does" near plain out 1e-5
done
set -- run chaos --t-end 1 --dt 1e-5 --every 100000
run "$@"
mv out plain
stuck 1e-20
moreau=$?
run "$@" --scheme compensated
check 'the summary names the scheme' grep -q '^scheme  *compensated,' err
# What rounds h in stick is below the digits of the state.
check 'moreau is not as exact' [ $moreau -ne 0 ]
check 'ends where moreau does' near plain out 1e-12
check 'stick to more digits than the state has' stuck 1e-20
# PHYSICS: the state at t = 1 s.
echo '1,0.185676357258,0.010298364853,-0.987353474328' >truth
check 'ends at the reference' near truth out 1e-6
expect 0 'phi = 0.63' run rolling --t-end 0.5 --scheme compensated \
  --set phi=0 --every 100

# Real time.
runs run chaos --t-end 0.2 --dt 0.01
mv out want
check 'without it no pace is printed' not grep -q '^real time' err
runs run chaos --t-end 0.2 --dt 0.01 --realtime
check 'in real time: the same rows' cmp out want
check 'in real time: late steps are counted' test -n "$(late)"
# A step of 1 ns is over before it has begun.
run run chaos --t-end 1e-6 --dt 1e-9 --realtime --every 10
check 'steps that no clock resolves are late' test "$(late)" -gt 0
equal 'late steps are taken all the same' "$(wc -l <out)" 102
# It waits, or it would be over before the signal that ends the wait.
interrupt INT out 2 run chaos --realtime --dt 1 --t-end 1000

# Commands that are targets of make.
for report in bench stability; do expect 2 "make $report" $report; done
finish
