#!/bin/sh
# Inputs over time: the profile of a scene is such a table with the same bits, a
# table does what it says between two rows, and what is wrong in one is named by
# line, column and reason. usage: test_inputs.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

# The profile of the scene `driven`, as a table over the scene `chaos`. At its
# own dt one slip passes h = g = 0 within a step, which says so.
printf '# knots of driven\nt,omega0\n0,-1\n2,-2\n4,-2\n8,1\n10,0\n' >knots.csv
for scheme in moreau located compensated; do
  set -- --scheme $scheme --every 11 --dt 2e-4
  runs run driven "$@" --out want
  runs run chaos --set phi=0 --t-end 12 --inputs knots.csv --between linear "$@"
  check "the profile as a table, $scheme" cmp out want
done
check 'the summary tells what was applied' says \
  'knots.csv, linear: 5 of 5 rows, t = 0 to 10 s; applied omega0 in [-2, 1] rad'
runs run driven --t-end 3
check 'of a shorter run: what it came to see' says \
  'linear: 3 of 5 rows, t = 0 to 4 s; applied omega0 in [-2, -1.00005] rad/s'

# A mark of UTF-8 and quotes, as other programs write them, change nothing.
runs run driven --t-end 1 --inputs knots.csv --between held --out want
sed '1s/^/\xEF\xBB\xBF/; 2s/.*/"t","omega0"/' knots.csv >quoted.csv
runs run driven --t-end 1 --inputs quoted.csv --between held
check 'quotes and a mark of UTF-8' cmp out want

# Rows within a step: linear loses no part of an impulse (140 N s on 1 kg), held
# says which rows never held.
printf 't,force\n0,0\n0.00025,1e6\n0.00028,0\n' >blow.csv
set -- --inputs blow.csv --t-end 0.001 --between
runs run frictionless --set k2=0 --set c1=0 --set c2=0 --set d=0 --set omega=0 \
  --set v=0 "$@" linear
within 'an impulse within a step' "$(row 12 3 out)" 140 1e-4
runs run chaos "$@" held
check 'a row that never held' says 'held: 2 of 3 rows&1 other rows lie between'

# dt is a power of two, so that the times below are exact.
set -- run chaos --dt 0x1p-10 --t-end 0.5
awk 'BEGIN { print "t,force"; print "0,0"; print "0.5,0.5" }' >ramp.csv
awk 'BEGIN { print "t, torque ,force"
  for (i = 0; i < 512; i++) printf "%.17g,0,%.17g\n", i / 1024,
    (i + 0.5) / 1024 }' >steps.csv
runs "$@" --inputs ramp.csv --between linear --out want
runs "$@" --inputs steps.csv --between held
check 'linear: force is the mean over the step' cmp out want
check 'held: the rows that came to hold' says 'held: 512 of 512 rows'
runs "$@" --out plain
check 'a force makes a difference' not cmp -s out plain
# shellcheck disable=SC2002  # a pipe is what is tested
cat steps.csv | "$T" "$@" --inputs - --between held >out 2>err
equal 'from a pipe: code' $? 0
check 'from a pipe: the same' cmp out want
check 'from a pipe: its name' says 'standard input, held'

# held: from the step that begins at the time of a row, as far as decimals tell.
printf 't,r0,torque\r\n-1,0.1,0\r\n0.3,0.12,0.01\r\n' >jump.csv
awk 'BEGIN { print "t,r0,torque"; for (i = 0; i < 5000; i++)
  print i / 1e4 "," (i < 3000 ? "0.1,0" : "0.12,0.01") }' >dense.csv
runs run chaos --t-end 0.5 --inputs jump.csv --between held --out want
runs run chaos --t-end 0.5 --inputs dense.csv --between held
check 'held: sparse and dense are the same' cmp out want
runs run chaos --t-end 0.3 --out plain
head -n 3002 want >first
check 'held: nothing before its time' cmp first plain
runs run chaos --t-end 0.3001 --out plain
equal 'held: and something in the step after' \
  "$([ "$(sed -n 3003p want)" != "$(tail -n 1 plain)" ] && echo other)" other
printf 't,r0\n0,0.12\n' >one.csv
runs run chaos --set r0=0.12 --t-end 1 --out want
for between in held linear; do
  runs run chaos --t-end 1 --inputs one.csv --between $between
  check "one row, $between: a constant" cmp out want
done
runs run chaos --t-end 0.01 --set r0=0.2 --inputs one.csv --between held
check 'a parameter that the table gives' says 'r0=0.2 has no effect&one.csv'
runs run driven --t-end 0.1 --inputs one.csv --between held
check 'both are told' says 'profile of the scene, linear&one.csv, held'

# Another start: omega0 at t = 0 decides about v.
printf 't,omega0\n0,-0.5\n' >speed.csv
runs run chaos --t-end 0.2 --set omega0=-0.5 --out want
runs run chaos --t-end 0.2 --inputs speed.csv --between linear
check 'the start is that of the inputs' cmp out want

# Rows of one time are a jump: between two steps as rows that are held, and
# within a step at its start. 307/1024 = 0.2998.
printf 't,omega0\n0,-1\n0.3,-1\n0.3,-0.8\n' >jump.csv
printf 't,omega0\n0,-1\n0.3,-0.8\n' >held.csv
printf 't,omega0\n0,-1\n0.2998046875,-0.8\n' >early.csv
printf 'based-on chaos\nprofile 0:-1 0.3:-1 0.3:-0.8\n' >jump.scene
for scheme in moreau located compensated; do
  set -- --t-end 0.5 --scheme $scheme
  runs run chaos "$@" --inputs held.csv --between held --out want
  runs run chaos "$@" --inputs jump.csv --between linear
  check "a jump between two steps, $scheme" cmp out want
  runs run jump.scene "$@"
  check "a jump of a scene, $scheme" cmp out want
done
set -- run chaos --dt 0x1p-10 --t-end 0.5
runs "$@" --inputs early.csv --between held --out want
runs "$@" --inputs jump.csv --between linear
check 'a jump within a step' cmp out want
check 'it is counted' says '1 times of rows lie within a step, 1 of them'
runs "$@" --inputs jump.csv --between linear --scheme located
check 'located: none lies within a step' not says 'lie within a step'

# The only inputs that are told are those of the table.
runs run driven --t-end 0.1 --inputs jump.csv --between linear
check 'the profile is not what was applied' not says 'profile of the scene'
check 'the table is' says 'jump.csv, linear&applied omega0 in [-1, -1] rad/s'

# A step is told omega0 at its end and its mean slope, whatever lies within it:
# a table with that row at each of its ends alone is the same to it. The rows
# are in units of a step, and reverse and have their kinks at steps and within.
awk 'BEGIN { split("0 100 100.5 120 120.25 300", t)
  split("-1 -0.75 -0.5 -0.875 -0.5 -1", w)
  print "t,omega0" >"kinks.csv"; print "t,omega0" >"ends.csv"
  for (i = 1; i <= 6; i++) printf "%.17g,%s\n", t[i] / 1024, w[i] >"kinks.csv"
  for (n = 0; n <= 300; n++) {
    for (i = 1; i < 5 && t[i + 1] <= n; i++) continue
    printf "%.17g,%.17g\n", n / 1024,
      w[i] + (w[i + 1] - w[i]) * ((n - t[i]) / (t[i + 1] - t[i])) >"ends.csv"
  } }'
for scheme in moreau compensated; do
  set -- run chaos --dt 0x1p-10 --t-end 0.3 --scheme $scheme --between linear
  runs "$@" --inputs ends.csv --out want
  check 'rows at the ends of steps' not says 'lie within a step'
  runs "$@" --inputs kinks.csv
  check "a step is told its ends, $scheme" cmp out want
  check 'of kinks: how many' says '2 times of rows lie within a step, 0 of'
done

# A located step is split at rows, so its end is that of steps that end there:
# ramp, steps, sine, reversal, kinks at steps of 10 ms and within those of 37.
shape() { # NAME, then rows as T:OMEGA0
  { echo t,omega0; shift; printf '%s\n' "$@" | tr : ,; } >shape.csv
}
followed() { # NAME
  for dt in 0.001 0.01 0.037 0.111; do
    runs run coulomb --set omega0=-1 --set tolerance=1e-11 \
      --set segments=1000 --t-end 1.11 \
      --scheme located --inputs shape.csv --between linear --dt $dt
    [ $dt = 0.001 ] && want=$(tail -n 1 out | cut -d, -f2)
    within "$1: located at $dt" "$(tail -n 1 out | cut -d, -f2)" "$want" 1e-8
  done
}
shape ramp 0:-1 1:-0.5
followed ramp
shape steps 0:-1 0.2:-1 0.2:-0.8 0.5:-0.8 0.5:-1.1 0.83:-1.1 0.83:-1
followed steps
# shellcheck disable=SC2046  # a row is a word
shape sine $(awk 'BEGIN { for (t = 0; t <= 1.2; t += 0.02)
  printf "%.2f:%.17g ", t, -1 + 0.3 * sin(7 * t) }')
followed sine
shape reversal 0:-1 0.3:-1 0.31:1 0.32:-1 1:-1
followed reversal
shape kinks 0:-1 0.111:-0.9 0.13:-1.1 0.4:-1 0.777:-0.7 0.8:-1
followed kinks

# A long one.
awk 'BEGIN { print "t,force"; for (i = 0; i < 300000; i++)
  print i * 1e-5 "," 1e-3 * (i % 7) }' |
  "$T" run chaos --t-end 3 --dt 1e-5 --every 1000 --inputs - --between held \
    >out 2>err
equal 'many rows: code' $? 0
check 'many rows: all of them' says '300000 of 300000 rows'

# What is wrong.
# A table may say how long it is, by the trailer of this program's files or by
# a comment before its rows.
printf 't,force\n0,1\n1,0.25\n' >told.csv
printf '# shard 1/1: 2 rows, crc32 %s, run 0\n' "$(crc32 <told.csv)" >>told.csv
runs run chaos --t-end 0 --inputs told.csv --between held
check 'a table that says its length is read' not says told.csv:
sed 's/0.25/0.2/' told.csv >changed.csv
expect 3 'changed.csv: cut off or changed' \
  run chaos --t-end 0 --inputs changed.csv --between held
for rows in 2 3; do
  { echo "# $rows rows" && sed '$d' told.csv; } >"$rows.csv"
done
runs run chaos --t-end 0 --inputs 2.csv --between held
expect 3 '3.csv: cut off' run chaos --t-end 0 --inputs 3.csv --between held
printf 't,force\n0,1\n1,0.2' >open.csv
{ echo '# 2 rows' && cat open.csv; } >cut.csv
expect 3 'cut.csv: cut off' run chaos --t-end 0 --inputs cut.csv --between held
runs run chaos --t-end 0 --inputs open.csv --between held
check 'nor is a cut one unnoticed' says 'note: open.csv:3: the last line has no'

wrong_files wrong.csv run chaos --inputs wrong.csv --between held <<'WORDS'
2|t,force\n0,1\n1,1x\n|3: column 2: '1x' is not a number
3|t,force\n0,nan\n|2: column 2: force = nan must lie in [-1e+09, 1e+09] N
3|t,force,r0\n0,1,inf\n|2: column 3: r0 = inf must lie in
3|t,force\ninf,1\n|2: column 1: t = inf must lie in
3|t,force\n0,1\n1,1\n0.5,2\n|4: column 1: '0.5' is earlier than t in the
3|t,force\n0,1\n1,1\n1,2\n1,2\n|5: column 1: '1' is t of two rows before
2|t,forec\n|1: unknown column 'forec'&did you mean 'force'
2|force,t\n|1: column 1: 'force' is misplaced
2|t,t\n|1: column 2: 't' is misplaced
2|t,force,force\n|1: column 3: 'force' comes twice
2|t\n|1: column 1: 't' is alone
2|t,force\n0,1,2\n|2: more than the 2 columns
2|t,force,r0\n0,1\n|2: fewer than the 3 columns
2|t,force\n0,\n|2: column 2: '' is not a number
2|# nothing\n| no header
2|t,force\n| no row
2|t,\0force\n|1: a zero, or a line
2|t,force\n0,1\n1,2\0,3|3: a zero, or a line
2|t,force\n0,1\r2\n|2: column 2&is not a number
WORDS
expectations run <<'WORDS'
2 chaos --inputs one.csv|say what holds between two rows
2 chaos --between held|--between: only with --inputs
2 chaos --inputs one.csv --between cubic|--between cubic: must be held or linear
2 chaos --inputs none.csv --between held|none.csv: No such file
2 chaos --inputs . --between held|Is a directory
2 chaos --inputs= --between held|the name of the file is empty
WORDS
finish
