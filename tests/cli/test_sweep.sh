#!/bin/sh
# `twofold sweep`: a row is what `run` does with the same settings, shards and
# resumed files have the bytes of one run, a point that is refused has a row
# that says why, and errors name axis and range. usage: test_sweep.sh TWOFOLD
# shellcheck disable=SC2016  # expressions of awk stand in single quotes
. "$(dirname "$0")/../support/tap.sh"
tools=$root/tools

sweep() { "$T" sweep "$@" 2>err; }

# columns FILE NAME...: these columns of the rows, by name.
columns() {
  columns_file=$1
  shift
  awk -F, -v names="$*" '/^#/ { next }
    !n { n = split(names, name, " ")
         for (i = 1; i <= NF; i++) at[$i] = i
         next }
    { line = ""
      for (i = 1; i <= n; i++) line = line (i > 1 ? "," : "") $at[name[i]]
      print line }' "$columns_file"
}

# A row is what `run` finds.
all=modes,final,changes,rest,arrivals,arrival,recurrence,ambiguous
all=$all,ambiguous_share,stick_share,energy,energy_change,r_low,r_high
all=$all,end_r,end_v,end_omega,end_h,end_g
set -- chaos --over kappa=0.25:0.29:2 --over h=-0.01:0.01:3 --dt 1e-3 \
  --t-end 4 --set mu=1.5
runs sweep "$@" --outcome "$all"
mv out all.csv
equal 'a row a point' "$(grep -vc '^#' all.csv)" 7
equal 'the last axis is the inner loop' \
  "$(columns all.csv point kappa h | tr '\n' ' ')" \
  "0,0.25,-0.01 1,0.25,0 2,0.25,0.01 3,0.29,-0.01 4,0.29,0 5,0.29,0.01 "
columns all.csv kappa h >points
: >ends
: >modes
: >arrivals
while IFS=, read -r kappa h; do
  run run chaos --dt 1e-3 --t-end 4 --set mu=1.5 --set "kappa=$kappa" \
    --set "h=$h"
  row '$' 1-6 out >>ends
  awk -F, '
    NR == 1 { next }
    { seen[$9]; if (NR > 2 && $9 != mode) changes++; mode = $9 }
    $10 > 1 { if (!n++) first = $1 }
    NR == 2 || $2 < low { low = $2 }
    NR == 2 || $2 > high { high = $2 }
    END {
      n = split("slip+ slip- stick+ stick- pinned", names, " ")
      for (i = 1; i <= n; i++) if (names[i] in seen)
        all = all (all == "" ? "" : "|") names[i]
      print all "," mode "," changes + 0 "," first "," low "," high
    }' out >>modes
  arrivals=$(sed -n 's/.*two-fold reached \([0-9]*\).*/\1/p' err | head -n 1)
  echo "${arrivals:-0}" >>arrivals
done <points
columns all.csv t end_r end_v end_omega end_h end_g >got
check 'the ends are those of run, bit for bit' cmp -s got ends
columns all.csv modes final changes ambiguous r_low r_high >got
check 'modes, changes, first ambiguous time, range of r' cmp -s got modes
columns all.csv arrivals >got
check 'arrivals at the two-fold' cmp -s got arrivals
runs sweep chaos --over r=0.1:0.3:2 --set omega=-1 --set h=0 --set mu=1 \
  --outcome rest,modes
equal 'pinned to the end is rest, pinned for a while is not' \
  "$(columns out rest modes | tr '\n' ' ')" \
  ',slip+|slip-|stick+|stick-|pinned 0,pinned '
for t_end in 0 2; do
  sweep chaos --over mu=1.5:1.5:1 --t-end $t_end --outcome \
    energy,energy_change >out
  columns out energy energy_change
done | tr '\n' ' ' >got
check 'the change of energy is that since t = 0' awk '{
  split($1, a, ","); split($2, b, ","); d = b[1] - a[1] - b[2]
  exit !(a[1] > 0 && a[2] == 0 && b[2] != 0 && d < 1e-6 && -d < 1e-6) }' got
# In float these seeds would be one real number.
double=$T
for T in "$double" "${double%/*/*}/float/twofold"; do
  [ -x "$T" ] || continue
  runs sweep chaos --over seed=100000000:100000003:4 --select random \
    --t-end 3 --outcome end_r
  columns out seed end_r | sed -n 3p >got
  run run chaos --select random:100000002 --t-end 3
  equal "a seed is that of the random rule, in ${T#"${double%/*/*}"}" \
    "$(cat got)" "100000002,$(row '$' 2 out)"
done
T=$double
runs sweep chaos --over seed=1:300:300 --select random --t-end 0
equal 'whole values of an axis are exact' \
  "$(columns out seed | tr '\n' ' ')" "$(seq 300 | tr '\n' ' ')"
runs sweep chaos --over kappa=0.3:0.3:1 --t-end 0 --outcome \
  modes,rest,recurrence,ambiguous,ambiguous_share,energy_change
equal 'and has no share' "$(columns out ambiguous_share energy_change)" ,0
equal 'no step is no motion' \
  "$(columns out t modes rest recurrence ambiguous)" \
  '0,slip+,,,'

# Inputs over time, in which a row is that of `run`, too: with a step that is
# swept, so that the rows of the table begin at other steps.
printf 't,force,r0\n0,0,0.1\n0.5,0.4,0.12\n1.3,-0.2,0.1\n' >inputs.csv
for between in held linear; do
  set -- chaos --t-end 2 --inputs inputs.csv --between $between
  runs sweep "$@" --over dt=1e-3:4e-3:2 --over mu=1:1.5:2 --outcome \
    end_r,end_v,end_omega,end_h,end_g,energy_change
  mv out swept.csv
  columns swept.csv dt mu >points
  while IFS=, read -r dt mu; do
    run run "$@" --dt "$dt" --set "mu=$mu"
    row '$' 1-6 out
  done <points >wanted
  columns swept.csv t end_r end_v end_omega end_h end_g >got
  check "inputs $between: the ends are those of run" cmp -s got wanted
done
runs sweep chaos --t-end 2 --over mu=1:1:1 --outcome end_r
check 'inputs make a difference' [ "$(columns out end_r)" != \
  "$(columns swept.csv end_r | sed -n 1p)" ]
equal 'an ensemble under inputs: a start each, and a seed each' "$("$T" sweep \
  chaos --inputs inputs.csv --between held --select random --over seed=1:3:3 \
  --over r=0.18:0.19:2 --t-end 3 --outcome end_r 2>err |
  sed -n '/^[0-9]/s/.*,//p' | sort -u | wc -l)" 6
runs sweep chaos --over r0=0.1:0.2:2 --inputs inputs.csv --between held
check 'an axis that the table gives is told' says \
  '--over r0=0.1:0.2:2 has no effect: inputs.csv gives r0'
check 'and is no part of a row' [ "$(columns out reason | sort -u)" = '' ]
set -- chaos --over mu=1:2:3 --t-end 1 --inputs inputs.csv --between held
runs sweep "$@" --out driven
check 'the file tells version, commit and number type' grep -q \
  "^# twofold [0-9.]*, commit [^ ]*, numbers are $real: sweep chaos" driven
check 'the file tells the table' \
  grep -q ' --inputs inputs.csv --between held ' driven
runs sweep "$@" --out driven --resume
printf 't,force\n0,0.1\n' >inputs.csv
expect 3 'driven is of another sweep' sweep "$@" --out driven --resume

# Shards and resumed files.
set -- chaos --over kappa=0.2:0.4:5 --over gamma=0.3:1.2:5 --dt 1e-3
sweep "$@" --out all
for i in 1 2 3; do
  sweep "$@" --shard $i/3 --out part.$i
done
cat part.1 part.2 part.3 | grep -v '^#' >one
grep -v '^#' all >other
check 'shards concatenate to one run' cmp -s one other
runs_of() { sed -n 's/^# shard .*, run //p' "$@" | sort -u | wc -l; }
equal 'all shards name the same run' "$(runs_of part.[123] all)" 1
sweep "$@" --set mu=1.01 --shard 3/3 --out part.other
equal 'and another sweep another one' "$(runs_of part.3 part.other)" 2
sweep "$@" --shard 3/30 --out few
equal 'each has its trailer' "$(tail -n 1 few | cut -c 1-21)" \
  '# shard 3/30: 1 rows,'
# part N: the part of a sweep that was killed behind row N, and in the next.
part() {
  head -n $((3 + $1)) all
  printf '# shard 1/1: %d rows, crc32 %s, run %s\n' "$1" \
    "$(head -n $((3 + $1)) all | grep -v '^#' | crc32)" \
    "$(sed -n 's/^# shard .*, run //p' all)"
  sed -n "$((4 + $1)) s/,[^,]*$//p" all
}
part 8 >again.part
sweep "$@" --out again --resume
check 'a row that is not whole is computed again' cmp -s all again
check 'and what was there is told' says 'points     25 of 25, of which 8 were'
sweep "$@" --out again --resume
check 'of a whole file nothing is done' says 'again has all of its 25 points'
check 'it stays as it is' cmp -s all again
head -n 9 all >again.part
rm again
expect 3 'again.part has rows of a sweep that was stopped: --resume' \
  sweep "$@" --out again
head -n 9 all | cmp -s - again.part
check 'rows of a stopped sweep are not overwritten' [ $? -eq 0 ]
for other in '--set mu=1.1' '--t-end 9' '--outcome rest' '--shard 1/2' \
  '--scheme located'; do
  # shellcheck disable=SC2086  # a list of options
  expect 3 'again.part is of another sweep, or of another build' \
    sweep "$@" $other --out again --resume
  # shellcheck disable=SC2086
  expect 3 'all is of another sweep, or of another build' \
    sweep "$@" $other --out all --resume
done
head -n 9 all | cmp -s - again.part
check 'nor are those of another one' [ $? -eq 0 ]

# The tasks of a job array, started by hand in any order; one is lost.
set -- chaos --over kappa=0.2:0.4:5 --over gamma=0.3:1.2:5 --dt 1e-3
for i in 3 1 2 3; do
  TWOFOLD=$T SLURM_ARRAY_TASK_MAX=3 SLURM_ARRAY_TASK_ID=$i \
    sh "$tools/study/shards/shards.sbatch" task sweep "$@" 2>err
done
cat task.1.csv task.2.csv task.3.csv | grep -v '^#' >one
grep -v '^#' all >other
check 'tasks of a job array concatenate to one run' cmp -s one other
check 'a task that was done is not repeated' says 'has all of its 8 points'

# A machine that is refused has a row that says so.
runs sweep chaos --over gamma=-0.5:0.5:3 --outcome modes
equal 'no speed gives that slip' "$(columns out gamma status t modes |
  sed -n 2p)" '0,refused,,'
check 'its reason names what was refused' awk -F, '$3 == "refused" {
  exit !($4 ~ /no speed v gives the slip speed h/) }' out
runs sweep chaos --over omega=-3e5:3e5:3 --over dt=1e-3:1:2 --set r=100 \
  --outcome modes
check 'a step that is refused stops the motion' awk -F, '$4 == "stopped" {
  n++; if (!($5 ~ /^step [0-9]+: / && $6 >= 0)) bad = 1 }
  END { exit bad || !n }' out
runs sweep chaos --over omega=-30:-1:9 --dt 0.3 --set h=0.1 --outcome modes
check 'steps that are flagged are counted' awk -F, '$3 == "flagged" { n++
  if (!($4 ~ /[0-9]+ steps degraded; [0-9]+ coarse/)) bad = 1 }
  END { exit bad || !n }' out
check 'no field has a comma' whole_rows out 6

# Points of one machine go together, in lanes of an ensemble. A shard of one
# point is followed by single steps, and its row is the same.
lanes() {
  lanes_name=$1
  shift
  runs sweep "$@" --out all
  says 'points/s, in lanes of an ensemble' || echo "$lanes_name: no lanes" >&2
  lanes_points=$(grep -c '^[0-9]' all)
  for i in $(seq "$lanes_points"); do
    sweep "$@" --shard "$i/$lanes_points"
  done | grep '^[0-9]' >alone
  grep '^[0-9]' all >rows
  check "lanes, $lanes_name: the rows of single steps" cmp -s rows alone
  columns all status >>statuses
}
printf 't,force,omega0\n0,0,-1\n0.5,0.4,-1.1\n1.3,-0.2,-1\n' >inputs.csv
: >statuses
lanes 'starts' chaos --over r=0.17:0.19:7 --over h=-0.01:0.01:5 --dt 1e-3 \
  --t-end 3 --outcome "$all"
check 'and what was done in a second is told' \
  grep -Eq '^cost .* s, [0-9.e+]+ points/s, in lanes' err
part 19 >again.part
sweep chaos --over r=0.17:0.19:7 --over h=-0.01:0.01:5 --dt 1e-3 --t-end 3 \
  --outcome "$all" --out again --resume
check 'a stopped sweep goes on in other lanes with the same rows' \
  cmp -s all again
lanes 'seeds' chaos --select random --over seed=1:9:9 --over omega=-1.1:-1:2 \
  --t-end 4 --dt 1e-3 --outcome "$all"
lanes 'inputs' driven --inputs inputs.csv --between linear --t-end 2 \
  --dt 1e-3 --over v=-0.1:0.1:17 --scheme moreau --outcome "$all"
lanes 'starts that are refused' chaos --over r=0:9e8:5 --over omega=-9e8:0:5 \
  --t-end 0.01 --outcome "$all"
lanes 'refused and coarse steps' chaos --over omega=-3e5:-1:19 --set h=0.1 \
  --dt 0.3 --outcome "$all"
equal 'all ends are met' "$(sort -u statuses | tr '\n' ' ')" \
  'done flagged refused stopped '
for other in '--over kappa=0.2:0.3:2' '--over r=0.1:0.2:2 --scheme located' \
  '--over r=0.1:0.2:2 --set law=coulomb' '--over dt=1e-3:2e-3:2'; do
  # shellcheck disable=SC2086  # a list of options
  runs sweep chaos $other --t-end 0.1
  check "one by one: $other" says 'points/s, one by one'
done

# Refusals, which leave no file.
expectations sweep <<END
2 chaos|--over NAME=A:B:N is missing
2 chaos --over kapa=0.1:1:2 --out kept|unknown name 'kapa'; did you mean
2 chaos --over kappa --out kept|--over kappa: expected NAME=A:B:N
3 chaos --over kappa=0:1:2 --out kept|--over kappa=0:1:2: kappa must&[1e-09,
2 chaos --over kappa=0.1:1:2 --set kappa=1 --out kept|kappa was already given
2 chaos --over kappa=0.1:1:2 --over kappa=1:2:2 --out kept|already given
2 chaos --over law=0:1:2 --out kept|unknown law
2 chaos --over seed=1:2:2 --out kept|only with --select random
3 chaos --over seed=1:2:3 --select random|seed must be whole&value 2 is 1.5
2 chaos --over kappa=0.1:1:2 --outcome enrgy --out kept|did you mean 'energy'
2 chaos --over kappa=0.1:1:2 --outcome rest,rest|rest was already given
2 chaos --over kappa=0.1:1:2 --outcome rest,|unknown outcome ''
2 chaos --over kappa=0.1:1:2 --resume|--resume: only with --out FILE
END
check 'none of them makes a file' [ ! -e kept ]
failing_output 11 sweep chaos --over kappa=0.2:0.4:3000 --t-end 0.01 \
  --over gamma=0.3:1.2:1000
finish
