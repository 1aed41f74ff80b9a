#!/bin/sh
# test_cli.sh - the command line keeps its contract: exit codes, columns, row
# counts, decimals that read back, refusals that say what and why, and a file
# that holds every finished row whatever ends the run.
#
# usage: test_cli.sh TWOFOLD
# Nothing here waits for a fixed time: what has to happen first is polled for,
# and a run without an end stands in for "still running".

T=${1:?usage: test_cli.sh TWOFOLD}
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
header='t,r,v,omega,h,g,F,M,mode,choices'
real=$("$T" --version | sed 's/.* is //')

# result STATUS NAME [DIAGNOSTIC]: one line of TAP.
result() {
  count=$((count + 1))
  if [ "$1" -eq 0 ]; then
    echo "ok $count - $2"
    return
  fi
  failed=$((failed + 1))
  echo "not ok $count - $2"
  [ -n "${3-}" ] && echo "# $3"
  [ -s err ] && sed 's/^/#   /' err | head -n 5
}

# check NAME COMMAND...: the command succeeds.
check() {
  check_name=$1
  shift
  "$@"
  result $? "$check_name" "failed: $*"
}

# equal NAME GOT WANTED
equal() {
  [ "$2" = "$3" ]
  result $? "$1" "got '$2', want '$3'"
}

# run ARGS...: stdout in out, stderr in err, exit code in $code.
run() {
  "$T" "$@" > out 2> err
  code=$?
}

# expect NAME CODE TEXT ARGS...: the exit code, TEXT within standard error, and
# no row where the command line was refused.
expect() {
  expect_name=$1 want=$2 wanted=$3
  shift 3
  run "$@"
  bad=0
  [ "$code" -eq "$want" ] || bad=1
  grep -qF -- "$wanted" err || bad=1
  if [ "$want" -eq 2 ] || [ "$want" -eq 3 ]; then
    [ -s out ] && bad=1
  fi
  result $bad "$expect_name" "twofold $*: code $code, want $want, '$wanted'"
}

# refused VALUE_TEXT RANGE_TEXT ARGS...: code 3 that tells both.
refused() {
  typed=$1 range=$2
  shift 2
  expect "refused: $typed" 3 "$typed" "$@"
  check "its range is told: $typed" grep -qF -- "$range" err
}

rows() { awk 'END { print NR - 1 }' "$1"; }
last() { tail -n 1 "$1"; }
column() { awk -F, -v n="$2" -v c="$3" 'NR == n { print $c }' "$1"; }

# whole_rows FILE: ends with a newline, every row has ten fields, the last one
# a digit.
whole_rows() {
  [ -s "$1" ] && [ -z "$(tail -c 1 "$1")" ] &&
    awk -F, 'NF != 10 { bad = 1 } NR > 1 && $10 !~ /^[0-9]$/ { bad = 1 }
             END { exit bad || NR < 2 }' "$1"
}

# within NAME GOT WANTED TOLERANCE
within() {
  awk -v a="$2" -v b="$3" -v e="$4" \
    'BEGIN { d = a - b; exit !(a != "" && d <= e && -d <= e) }'
  result $? "$1" "got '$2', want '$3' within $4"
}

# poll COMMAND...: until the command succeeds; fails after a minute.
poll() {
  tries=600
  until "$@"; do
    tries=$((tries - 1))
    [ "$tries" -gt 0 ] || return 1
    sleep 0.1 2> /dev/null || sleep 1
  done
}

# ended PID: the process has ended, even if it still waits to be reaped.
ended() {
  case $(ps -o stat= -p "$1" 2> /dev/null) in '' | Z*) ;; *) return 1 ;; esac
}
at_least_lines() { [ -f "$1" ] && [ "$(wc -l < "$1")" -ge "$2" ]; }

test_commands() {
  expect 'no command is a usage error' 2 'which command'
  expect 'unknown command' 2 "unknown command 'scene'" scene
  check 'the closest command is suggested' grep -q "'scenes'" err
  for word in help --help --version scenes 'help run' 'run --help'; do
    # shellcheck disable=SC2086 # two words are two arguments
    run $word
    equal "$word succeeds" "$code" 0
    check "$word prints" test -s out
  done
  run scenes
  check 'scenes lists chaos on a line of its own' grep -q '^chaos  *[^ ]' out
  equal 'one line a scene' "$(wc -l < out)" "$(cut -d ' ' -f 1 out |
    sort -u | wc -l)"
  cut -d ' ' -f 1 out > names
  while read -r scene; do
    expect "scene $scene runs" 0 "scene      $scene," run "$scene" \
      --t-end 0.01 --out rows.csv
  done < names
}

test_rows() {
  run run chaos --t-end 1e-3 --dt 1e-4
  cp out all.csv
  equal 'run succeeds' "$code" 0
  equal 'header' "$(head -n 1 out)" "$header"
  equal 'initial state and every step' "$(rows out)" 11
  check 'rows are whole' whole_rows out
  equal 'first row is t = 0' "$(column out 2 1)" 0
  equal 'chaos starts at r = 0.18' "$(column out 2 2)" 0.18
  equal 'chaos starts at omega = -1.037' "$(column out 2 4)" -1.037
  equal 'chaos starts in slip+' "$(column out 2 9)" slip+
  equal 't = step * dt' "$(column out 4 1)" 0.0002
  within 'last row' "$(column out 12 1)" 0.001 1e-9
  run run chaos --t-end 1e-3 --dt 1e-4 --every 3
  equal 'every third step and the last' "$(rows out)" 5
  equal 'row of step 3' "$(sed -n 3p out)" "$(sed -n 5p all.csv)"
  equal 'row of the last step' "$(last out)" "$(last all.csv)"
  run run chaos --t-end 1e-3 --dt 1e-4 --every 5
  equal 'the last step is not written twice' "$(rows out)" 3
  run run chaos --t-end 1e-3 --dt 1e-4 --every 1000
  equal 'never less than two rows' "$(rows out)" 2
  equal 'long strides end at the end' "$(last out)" "$(last all.csv)"
  run run chaos --t-end 0 --every 7
  equal 'no step: the initial state once' "$(rows out)" 1
  run run chaos --t-end 2.6e-4 --dt 1e-4
  equal 'number of steps is rounded up' "$(rows out)" 4
  run run chaos --t-end 2.4e-4 --dt 1e-4
  equal 'number of steps is rounded down' "$(rows out)" 3
  run run --t-end=1e-3 --set dt=1e-4 chaos
  check 'options before the scene, with =' cmp -s out all.csv
  run run chaos --t-end 1e-3 --format plotter
  check 'plotter rows' grep -Eq \
    '^r:[-+.0-9e]+ v:[-+.0-9e]+ omega:[-+.0-9e]+ h:[-+.0-9e]+ g:[-+.0-9e]+$' out
  equal 'plotter writes no header' "$(wc -l < out)" 11
}

test_numbers() {
  number=0.12345678901234568
  [ "$real" = float ] && number=0.12345679
  run run chaos --t-end 0 --set "r=$number"
  equal 'decimals read back to the same bits' "$(column out 2 2)" "$number"
  run run chaos --t-end 0 --set r=0x1p-3 --set omega=+2e0
  equal 'hexadecimal and signs are read' "$(column out 2 2)" 0.125
  run run chaos --t-end 0 --set h=2e-3
  within 'h places the slip speed' "$(column out 2 5)" 2e-3 1e-7
  equal 'h > 0 is slip+' "$(column out 2 9)" slip+
  run run chaos --t-end 0 --set h=-2e-3
  within 'h places a negative slip speed' "$(column out 2 5)" -2e-3 1e-7
  equal 'h < 0 is slip-' "$(column out 2 9)" slip-
  run run chaos --t-end 0 --set v=0.25 --set r=0.5 --set omega=-2
  equal 'v r omega are the state' \
    "$(column out 2 2),$(column out 2 3),$(column out 2 4)" 0.5,0.25,-2
  run run chaos --t-end 0 --set phi=0.5
  check 'phi is told in the summary' grep -q 'phi = 0.5 rad' err
  for text in 1e-999 0x '' . e5 1x '1 ' ' 1' ' nan' nanx infx in 1,5 --5 1e; do
    expect "not a number: '$text'" 2 "--set r=$text" run chaos --set "r=$text"
    expect "not a step: '$text'" 2 "--dt $text" run chaos --dt "$text"
    expect "not a length: '$text'" 2 "--t-end $text" run chaos --t-end "$text"
  done
  for text in 0 -1 1.5 '' x 1e3 99999999999999999999; do
    expect "not a stride: '$text'" 2 "--every $text" run chaos --every "$text"
  done
  expect 'not a number of events' 2 '--events some' run chaos --events some
}

test_usage() {
  expect 'no scene' 2 'which scene' run
  expect 'unknown scene' 2 "unknown scene 'choas'" run choas
  check 'the closest scene is suggested' grep -q "mean 'chaos'" err
  expect 'two scenes' 2 'one scene' run chaos coulomb
  expect 'unknown option' 2 'unknown option --tend' run chaos --tend 1
  check 'the closest option is suggested' grep -q -e "'--t-end'" err
  expect 'option without value' 2 '--out' run chaos --out
  expect 'unknown name' 2 "unknown name 'bta'" run chaos --set bta=1
  check 'the closest name is suggested' grep -q "'beta'" err
  expect 'name without value' 2 '--set beta' run chaos --set beta
  expect 'value without name' 2 '--set =1' run chaos --set =1
  expect 'unknown law' 2 "unknown law 'strin'" run chaos --set law=strin
  expect 'unknown rule' 2 "unknown rule 'slip'" run chaos --select slip
  expect 'unknown scheme' 2 '--scheme verlet' run chaos --scheme verlet
  expect 'unknown format' 2 '--format xml' run chaos --format xml
  expect 'unknown scheme' 2 "mean 'located'" run chaos --scheme locate
  expect 'h and v' 2 'h or v' run chaos --set h=0 --set v=0
  expect 'seed of a rule without chance' 2 'seed' run chaos --select slip+:1
  expect 'seed too large' 2 'seed' run chaos --select random:4294967296
  expect 'seed missing' 2 'seed' run chaos --select random:
  for rule in persist slip+ slip- random random:4294967295; do
    expect "rule $rule" 0 "rule $rule" run chaos --t-end 0.01 --select $rule
  done
  echo keep > kept
  run run chaos --out kept --set bta=1
  equal 'a refused command leaves the file alone' "$(cat kept)" keep
}

# Of two values one is a mistake, and the program cannot know which.
test_given_twice() {
  while read -r option first second name; do
    expect "given twice: $option $name" 2 \
      "$option $second: $name was already given" \
      run chaos "$option" "$first" --set=m=1 "$option=$second"
  done << END
--t-end 0 1 --t-end
--dt 1e-4 1e-3 dt
--scheme moreau located --scheme
--select slip+ slip- --select
--set r=1 r=2 r
--set law=none law=none law
--every 1 2 --every
--format csv plotter --format
--out one two --out
--events 1 all --events
END
  check 'no file is written' test ! -e one
  expect 'given twice: --dt, --set dt' 2 'dt was already given by --set dt=1' \
    run chaos --set dt=1 --dt 1e-3
}

test_ranges() {
  # name, a value below, a value above, the unit that must be told
  while read -r name below above unit; do
    for value in "$below" "$above"; do
      refused "--set $name=$value" "$name must lie in [" \
        run chaos --set "$name=$value"
      check "its unit is told: $name" grep -qF -- "] $unit" err
    done
  done << END
m -1 1e13 kg
d -1e7 1e7 m
beta 0 1e7 m
k2 -1 1e16 N/m
c1 -1 1e13 N m s
c2 -1 1e13 N s/m
r0 -1e7 1e7 m
omega0 -1e7 1e7 rad/s
mu -1 1e10 N
kappa 0 1e7 m
gamma -4 4 rad
epsilon -1 1e7 m/s
sigma -1 1e7 m
rate -1 1e10 1/s
dt 0 1e9 s
r -1e10 1e10 m
v -1e10 1e10 m/s
omega -1e10 1e10 rad/s
h -1e10 1e10 m/s
END
  refused '--set theta=0.4' 'theta must lie in [0.5, 1]' \
    run chaos --set theta=0.4
  refused '--dt 0' 'dt must lie in [' run chaos --dt 0
  refused '--dt 1e9' 's' run chaos --dt 1e9
  refused '--t-end -1' 't-end must lie in [0, ' run chaos --t-end -1
  refused '--t-end 1e30' '1e15 steps' run chaos --t-end 1e30
  # What is no finite number is out of every range, of an unused name too.
  for text in nan -NAN inf -inf infinity 1e999 -1e999; do
    for name in kappa epsilon omega0 r h phi; do
      refused "--set $name=$text" "$name must lie in [" \
        run chaos --set "$name=$text"
    done
    refused "--dt $text" 'dt must lie in [1e-09, 1] s' run chaos --dt "$text"
    refused "--t-end $text" 't-end must lie in [0,' run chaos --t-end "$text"
  done
  refused 'sin(gamma)' '--set h=1' run chaos --set gamma=0 --set h=1
  refused 'law string: k = 0' '--set k=VALUE' run chaos --set law=string
  expect 'what a law leaves out may be 0' 0 'does not use kappa' \
    run coulomb --t-end 0 --set kappa=0
  while read -r scheme set notes; do
    run run chaos --t-end 0 --scheme "$scheme" --set "$set"
    equal "$set under $scheme: notes" "$(grep -c \
      "note: --set $set has no effect under --scheme $scheme" err)" "$notes"
  done << END
moreau tolerance=1e-5 1
moreau theta=1 0
located tolerance=1e-5 0
located theta=1 1
END
}

test_repeat() {
  for scene in chaos driven string; do
    run run "$scene" --t-end 2 --select random:7 --every 10
    cp out first.csv
    run run "$scene" --t-end 2 --select random:7 --every 10
    check "the same command gives the same bytes: $scene" \
      cmp -s first.csv out
  done
  run run "$scene" --t-end 2 --select random:7 --every 10 --out file.csv
  check '--out is standard output' cmp -s first.csv file.csv
  equal '--out leaves standard output empty' "$(wc -c < out)" 0
  run run "$scene" --t-end 2 --select random:7 --every 10 --out -
  check '--out - is standard output' cmp -s first.csv out
}

test_failing_output() {
  expect 'a file that cannot be opened' 4 '/nowhere/x' run chaos \
    --out /nowhere/x
  expect 'a directory' 4 "$D" run chaos --out "$D"
  if [ -c /dev/full ]; then
    expect 'a full device' 4 '/dev/full: No space left' run chaos \
      --t-end 1e9 --out /dev/full
    expect 'a full device, one row' 4 '/dev/full: No space left' run chaos \
      --t-end 0 --out /dev/full
    "$T" scenes > /dev/full 2> err
    equal 'scenes on a full device' $? 4
    "$T" run chaos --t-end 0 > /dev/full 2> err
    equal 'standard output on a full device' $? 4
  fi
  "$T" run chaos --t-end 0 >&- 2> err
  equal 'closed standard output' $? 4
  (
    ulimit -f 8 || exit 4
    exec "$T" run chaos --t-end 1e9 --out quota.csv 2> err
  )
  equal 'a file at its quota' $? 4
  check 'a file at its quota ends with a whole row' whole_rows quota.csv
  { "$T" run chaos --t-end 1e9 2> err; echo $? > code; } | head -n 1 > out
  equal 'the reader got the header' "$(cat out)" "$header"
  equal 'a closed pipe stops the run' "$(cat code)" 4
  check 'a closed pipe is told with the summary' grep -q '^final' err
}

test_stops() {
  expect 'a refused step' 4 'step 2 was refused' run frictionless --set k2=0 \
    --set v=4e8 --set omega=0 --set c1=0 --set c2=0 --dt 1 --t-end 10 \
    --every 5
  check 'its time and state are told' grep -q 'stopped at t = 1 s.*r = 4e+08' \
    err
  equal 'all rows before it are written' "$(column out 3 1)" 1
  for signal in INT TERM; do
    rm -f signal.csv
    # Rows are so rare that no buffer fills: only the clock can flush them.
    "$T" run chaos --t-end 1e9 --every 1000000000 --out signal.csv 2> err &
    pid=$!
    check "rows reach the file while the run goes on, SIG$signal" \
      poll at_least_lines signal.csv 2
    kill -s $signal $pid
    poll ended $pid || kill -s KILL $pid
    wait $pid
    equal "SIG$signal gives code 4" $? 4
    check "SIG$signal leaves whole rows" whole_rows signal.csv
    check "SIG$signal is told" grep -q 'stopped at t = .*interrupted' err
    within "the last step is the last row after SIG$signal" \
      "$(column signal.csv "$(wc -l < signal.csv)" 1)" \
      "$(sed -n 's/.*stopped at t = \(.*\) s: interrupted/\1/p' err)" 1e-3
  done
}

# modes: those that the listed events of err pass through up to the two-fold,
# without pinned: only a step that locates no switch has to rest at h = g = 0.
modes() {
  awk '/^  [0-9].*two-fold reached/ { print "two-fold"; exit }
       / to / && /^  [0-9]/ { if (!n++) print $6; if ($8 !~ /pinned/) print $8 }
      ' err | tr -d ,
}

test_located() {
  way='slip+ stick- slip- stick+ two-fold '
  for scheme in moreau located; do
    run run chaos --t-end 3 --every 1000 --scheme $scheme
    equal "$scheme runs" "$code" 0
    equal "$scheme: the same header" "$(head -n 1 out)" "$header"
    equal "$scheme: the same rows" "$(rows out)" 31
    # A float of this step size does not tell where stick+ ends.
    [ "$real" = float ] ||
      equal "$scheme: the same events" "$(modes | tr '\n' ' ')" "$way"
  done
  # The reference has it at 2.0462756 s; moreau is nine steps late.
  [ "$real" = float ] || within 'located: the two-fold in its step' \
    "$(awk '/^  [0-9].*two-fold reached/ { print $1; exit }' err)" 2.0463 1e-9
  for law in smooth string two_piece; do
    expect "located refuses law $law" 3 \
      "--scheme located: law must be jump, coulomb or none, not $law" \
      run chaos --scheme located --set law=$law
  done
  expect 'located runs coulomb' 0 'located' run coulomb --scheme located
  run help run
  for word in located tolerance theta 'coulomb, none' hexadecimal; do
    check "help run tells $word" grep -qF "$word" out
  done
}

# told WORDS: the number before WORDS in the line of the degraded steps.
told() { sed -n "s/^degraded .*[^0-9]\([0-9][0-9]*\) $1.*/\1/p" err; }

test_degraded_summary() {
  # So stiff that some steps run out of segments, or that no series converges.
  run run chaos --scheme located --set k2=1e4 --t-end 4 --dt 0.01 --every 1000
  check 'steps that missed the tolerance' test "$(told missed)" -gt 0
  run run chaos --scheme located --set k2=1e10 --t-end 1 --dt 0.01 --every 1000
  check 'steps that fell back' test "$(told fell)" -gt 50
  equal 'none of them is degraded' "$(told steps)" 0
  run run chaos --set k2=1e10 --t-end 1 --dt 0.01 --every 1000
  equal 'moreau does neither' "$(grep -cE 'missed|fell' err)" 0
}

# chain: whether each listed event of err starts in the mode where the one
# before it ended; N changes of slip in one line swap the slip if N is odd.
chain() {
  awk '/^  \.\.\. [0-9]+ x slip to slip/ {
         if ($2 % 2) mode = mode == "slip+" ? "slip-" : "slip+" }
       /^  [0-9]/ && $7 == "to" {
         gsub(",", ""); if (n++ && $6 != mode) bad = 1; mode = $8 }
       END { exit bad || n < 2 }' err
}

test_summary() {
  run run chaos --t-end 10 --every 1000000
  for word in scene scheme steps events futures degraded largest final cost; do
    check "the summary tells $word" grep -q "^$word  *[^ ]" err
  done
  check 'the first stick is an event' grep -Eq 'slip. to (stick|pinned)' err
  equal 'twenty events unless told' "$(grep -cE '^  [0-9]' err)" 20
  run run chaos --t-end 3 --every 1000000 --events 3
  equal '--events 3' "$(grep -cE '^  [0-9]' err)" 3
  more=$(sed -n 's/^  \.\.\. \([0-9]*\) more events .*/\1/p' err)
  run run chaos --t-end 3 --every 1000000 --events all
  equal '--events all' "$(grep -cE '^  [0-9]' err)" $((more + 3))
  run run chaos --t-end 3 --every 1000000
  equal 'what is not listed is counted' "$(awk '/^  [0-9]/ { n++ }
    /^  \.\.\. / { n += $2 } END { print n }' err)" $((more + 3))
  for words in '10' '2.1' '3 --events 6' '3 --events all' '3 --events 8' \
    '10 --scheme located' '10 --select random:7'; do
    # shellcheck disable=SC2086 # several words are several arguments
    run run chaos --every 1000000 --t-end $words
    check "each event starts where the one before ended: $words" chain
  done
  # The events are the changes of mode, two-folds within stick, and no more.
  run run chaos --t-end 3 --events all
  awk -F, 'NR > 2 && $9 != old && (old ~ /slip/ || $9 ~ /slip/) { n++ }
           NR > 1 { old = $9 } END { print n + 0 }' out > changes
  equal 'slips begin and end as often as the rows say' \
    "$(sed -n 's/^events *//p' err | tr ',' '\n' |
      awk '/slip/ { n += $NF } END { print n + 0 }')" "$(cat changes)"
  awk -F, 'NR > 2 && $9 != old { n++ } NR > 1 { old = $9 } END { print n }' \
    out > changes
  equal 'every change of mode is listed' \
    "$(grep -cE '^  [0-9].*[-+d] to (slip|stick|pinned)' err)" "$(cat changes)"
}

test_commands
test_rows
test_numbers
test_usage
test_given_twice
test_ranges
test_repeat
test_failing_output
test_stops
test_located
test_degraded_summary
test_summary

echo "1..$count"
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
