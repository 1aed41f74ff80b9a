#!/bin/sh
# The command line keeps its contract: exit codes, columns, row counts, decimals
# that read back, refusals that say what and why, and a file that holds every
# finished row whatever ends the run. usage: test_cli.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
header='t,r,v,omega,h,g,F,M,mode,choices'

rows() { awk 'END { print NR - 1 }' out; }

# chaos OPTION...: it runs, and its rows are in out.
chaos() { runs run chaos "$@"; }

# degraded_count WORDS: the number before WORDS in the line of the degraded
# steps.
degraded_count() { sed -n "s/^degraded .*[^0-9]\([0-9][0-9]*\) $1.*/\1/p" err; }

# chain: whether each listed event of err starts in the mode where the one
# before it ended; N changes of slip in one line swap the slip if N is odd.
chain() {
  awk '/^  \.\.\. [0-9]+ x slip to slip/ {
         if ($2 % 2) mode = mode == "slip+" ? "slip-" : "slip+" }
       /^  [0-9]/ && $7 == "to" {
         gsub(",", ""); if (n++ && $6 != mode) bad = 1; mode = $8 }
       END { exit bad || n < 2 }' err
}

listed() { grep -cE "^  [0-9]${1-}" err; }

# Commands.
expect 2 'which command'
expect 2 "unknown command 'scnes'&'scenes'" scnes
for words in --help --version 'run --help'; do
  # shellcheck disable=SC2086  # two words are two arguments
  runs $words
  check "$words prints" test -s out
done
run scenes
check 'scenes lists chaos on a line of its own' grep -q '^chaos  *[^ ]' out

# Rows.
chaos --t-end 1e-3 --dt 1e-4
cp out all.csv
equal 'header' "$(head -n 1 out)" "$header"
equal 'initial state and every step' "$(rows)" 11
check 'rows are whole' whole_rows out 10 '[0-9]'
equal 'chaos starts at t, r, omega, mode' "$(row 2 1,2,4,9 out)" \
  0,0.18,-1.037,slip+
equal 't = step * dt' "$(row 4 1 out)" 0.0002
within 'last row' "$(row 12 1 out)" 0.001 1e-9
chaos --t-end 1e-3 --dt 1e-4 --every 3
equal 'every third step and the last' "$(cat out)" \
  "$(sed -n '1,2p;5p;8p;11,12p' all.csv)"
chaos --t-end 1e-3 --dt 1e-4 --every 5
equal 'the last step is not written twice' "$(rows)" 3
chaos --t-end 0 --every 7
equal 'no step: the initial state once' "$(rows)" 1
chaos --t-end 2.6e-4 --dt 1e-4
equal 'number of steps is rounded up' "$(rows)" 4
chaos --t-end 2.4e-4 --dt 1e-4
equal 'number of steps is rounded down' "$(rows)" 3
run run --t-end=1e-3 --set dt=1e-4 chaos --out -
check 'options before the scene, with =' cmp -s out all.csv

# Numbers, as they are typed and as they are printed.
number=0.12345678901234568
while read -r fields wanted options; do
  # shellcheck disable=SC2086  # a list of options
  chaos --t-end 0 $options
  equal "$options is read" "$(row 2 "$fields" out)" "$wanted"
done <<END
2 $number --set r=$number
2 0.125 --set r=0x1p-3 --set omega=+2e0
2,3,4 0.5,0.25,-2 --set v=0.25 --set r=0.5 --set omega=-2
9 slip+ --set h=2e-3
9 slip- --set h=-2e-3
END
for h in 2e-3 -2e-3; do
  run run chaos --t-end 0 --set h=$h
  within "h = $h is the slip speed of the start" "$(row 2 5 out)" $h 1e-7
done
expect 0 'phi = 0.5 rad' run chaos --t-end 0 --set phi=0.5
for text in 1e-999 0x '' . e5 1x '1 ' ' 1' ' nan' nanx infx in 1,5 --5 1e; do
  for option in '--set r=' '--dt ' '--t-end '; do
    expect 2 "$option$text" run chaos "${option%% *}" "${option#* }$text"
  done
done
for text in 0 -1 1.5 '' x 1e3 99999999999999999999; do
  expect 2 "--every $text" run chaos --every "$text"
done
expect 2 '--events some' run chaos --events some

# What cannot be understood.
expect 2 'which scene' run
expect 2 "unknown scene 'choas'&mean 'chaos'" run choas
expect 2 'one scene' run chaos coulomb
expectations run chaos <<END
2 --out|--out
2 --set bta=1|unknown name 'bta'&'beta'
2 --set beta|--set beta
2 --set =1|--set =1
2 --set law=strin|unknown law 'strin'
2 --select slip|--select slip: unknown rule; rules are persist, slip+
2 --select slip|slip- and random; did you mean 'slip+'
2 --select :7|--select :7: unknown rule
2 --set h=0 --set v=0|h or v
2 --select slip+:1|seed
2 --select random:|seed
2 --select random:4294967296|seed
2 --set dt=1 --dt 1e-3|dt was already given by --set dt=1
2 --realtime=yes|takes no value
2 --realtime --realtime|already given
END
echo keep >kept
run run chaos --out kept --set bta=1
equal 'a refused command leaves the file alone' "$(cat kept)" keep
# Of two values one is a mistake, and the program cannot know which.
while read -r option first second name; do
  expect 2 "$option $second: $name was already given" \
    run chaos "$option" "$first" --set=m=1 "$option=$second"
done <<END
--t-end 0 1 --t-end
--dt 1e-4 1e-3 dt
--select slip+ slip- --select
--set r=1 r=2 r
--set law=none law=none law
END
check 'no file is written' test ! -e one

# What is not a finite number is out of every range, of an unused name too.
for text in nan -NAN inf -inf infinity 1e999 -1e999; do
  for name in kappa epsilon omega0 r h phi; do
    expect 3 "--set $name=$text&$name must lie in [" \
      run chaos --set "$name=$text"
  done
  expect 3 "--dt $text&dt must lie in [1e-09, 1] s" run chaos --dt "$text"
  expect 3 "--t-end $text&t-end must lie in [0," run chaos --t-end "$text"
done
expectations run chaos <<END
3 --set theta=0.4|--set theta=0.4&theta must lie in [0.5, 1]
3 --dt 1e9|--dt 1e9&dt must lie in [&] s
3 --t-end -1|--t-end -1&t-end must lie in [0,
3 --t-end 1e30|--t-end 1e30&1e15 steps
3 --set gamma=0 --set h=1|sin(gamma)&--set h=1
3 --set law=string|law string: k = 0&--set k=VALUE
3 --scheme compensated --set beta=0|beta must lie in [
END
expect 0 'does not use kappa' run coulomb --t-end 0 --set kappa=0
while read -r scheme set notes; do
  run run chaos --t-end 0 --scheme "$scheme" --set "$set"
  equal "$set under $scheme: notes" "$(grep -c \
    "note: --set $set has no effect under --scheme $scheme" err)" "$notes"
done <<END
moreau tolerance=1e-5 1
moreau theta=1 0
located tolerance=1e-5 0
located theta=1 1
compensated tolerance=1e-5 1
END

# Output that fails.
failing_output 10 run chaos --t-end 1e9
check 'a closed pipe still prints the summary' grep -q '^final' err
"$T" run chaos --t-end 0 >&- 2>err
equal 'closed standard output' $? 4

full_device scenes

# On the wall clock a run may take longer than its time but never less, and a
# step that is shorter than a look at the clock is late.
late() { sed -n 's/^real time *\([0-9]*\) of .*/\1/p' err; }
chaos --t-end 0.2 --dt 0.01
mv out want
check 'without it no pace is printed' not grep -q '^real time' err
chaos --t-end 0.2 --dt 0.01 --realtime
check 'in real time: the same rows' cmp out want
check 'in real time: late steps are counted' test -n "$(late)"
# A step of 1 ns is over before it has begun.
run run chaos --t-end 1e-6 --dt 1e-9 --realtime --every 10
check 'steps that no clock resolves are late' test "$(late)" -gt 0
equal 'late steps are taken all the same' "$(wc -l <out)" 102
# It waits, or it would be over before the signal that ends the wait.
interrupt INT out 2 run chaos --realtime --dt 1 --t-end 1000
chaos --t-end 0.2 --dt 0.001 --out want
chaos --t-end 0.2 --dt 0.001 --realtime --priority --lateness late --out other
check 'waiting changes no row' cmp -s want other
began=0 ended=0
while IFS=, read -r us first last; do
  [ "$us" = us ] || { began=$((began + first)) && ended=$((ended + last)); }
done <late
equal 'lateness: its columns' "$(head -n 1 late)" 'us,began,ended'
equal 'lateness: each step once' "$began $ended" '200 200'
expectations run chaos --t-end 0.01 <<END
2 --lateness=late|--lateness: only with --realtime
2 --priority|--priority: only with --realtime
4 --realtime --lateness none/late --out other|none/late
END

# Other schemes.
for law in smooth string two_piece; do
  expect 3 "--scheme located: law must be jump, coulomb or none, not $law" \
    run chaos --scheme located --set law=$law
done
for report in bench stability; do expect 2 "make $report" $report; done

# So stiff that some steps run out of segments, or that no series converges.
expect 5 " coarse, 0 stalled, 0 fell&first at t = " \
  run chaos --scheme located --set k2=1e4 --t-end 4 --dt 0.01 --every 1000
check 'steps that missed the tolerance' test "$(degraded_count coarse)" -gt 0
expect 5 "0 fell back on moreau" \
  run chaos --scheme located --set c2=1e9 --t-end 1 --dt 0.01 --every 1000
check 'steps too long for a damper' test "$(degraded_count coarse)" -gt 50

expect 3 'segments must be a whole number' run chaos --set segments=2.5

# --accuracy flags steps and changes no row; float has a default of its own.
chaos --scheme moreau --t-end 0.1 --dt 1e-3
cp out plain.csv
chaos --scheme moreau --t-end 0.1 --dt 1e-3 --accuracy 1
check '--accuracy changes no row' cmp -s out plain.csv
check 'the summary has the largest error' \
  grep -q '^estimate  *a step is off' err
expect 5 'estimate   a step is off by' \
  run chaos --scheme moreau --t-end 0.1 --dt 1e-3 --accuracy 1e-6
expect 3 '--accuracy: not with --scheme located' \
  run chaos --scheme located --accuracy 1
expect 3 'must lie in (0, 1]' run chaos --accuracy -1
chaos --t-end 1e-3 --dt 1e-4
scheme=moreau
[ "$real" != float ] || scheme=compensated
check "no --scheme below 1 ms: $scheme" grep -q "^scheme     $scheme," err
chaos --t-end 1e-2 --dt 1e-3
check 'no --scheme at 1 ms: moreau' grep -q '^scheme     moreau,' err

# The summary and its events.
chaos --t-end 10 --every 1000000
for word in scene scheme steps events ambiguous degraded largest final cost; do
  check "the summary tells $word" grep -q "^$word  *[^ ]" err
done
equal 'twenty events by default' "$(listed)" 20
chaos --t-end 3 --every 1000000 --events 3
equal '--events 3' "$(listed)" 3
more=$(sed -n 's/^  \.\.\. \([0-9]*\) more events .*/\1/p' err)
chaos --t-end 3 --every 1000000 --events all
equal '--events all' "$(listed)" $((more + 3))
chaos --t-end 3 --every 1000000
equal 'what is not listed is counted' "$(awk '/^  [0-9]/ { n++ }
  /^  \.\.\. / { n += $2 } END { print n }' err)" $((more + 3))
for words in '10' '3 --events 6' '3 --events all' '10 --scheme located' \
  '10 --select random:7'; do
  # shellcheck disable=SC2086  # several words are several arguments
  chaos --every 1000000 --t-end $words
  check "each event starts where the one before ended: $words" chain
done
# The events are the changes of mode, two-folds within stick, and no more.
chaos --t-end 3 --events all
equal 'every change of mode is listed' \
  "$(listed '.*[-+d] to (slip|stick|pinned)')" "$(awk -F, '
    NR > 2 && $9 != old { n++ } NR > 1 { old = $9 } END { print n }' out)"
finish
