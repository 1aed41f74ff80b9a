#!/bin/sh
# `twofold diverge`: the same bytes whatever the shards, exits from the two-fold
# where and as often as declared, refusals that say why and leave no file, whole
# cycles on disk after an interrupt. usage: test_cli_diverge.sh TWOFOLD
# shellcheck disable=SC2016  # expressions of awk stand in single quotes
. "$(dirname "$0")/../support/tap.sh"
tools=$root/tools

diverge() { "$T" diverge chaos "$@" 2>err; }

# same A B WHAT: exits and returns of two runs are the same rows.
same() {
  for kind in e r; do
    grep -v '^#' "$kind.$1" >one
    grep -v '^#' "$kind.$2" >other
    check "$3: $kind" cmp -s one other
  done
}

# joined PREFIX SUFFIX: what three shards made, one after the other.
joined() {
  cat "$1-exits.1.csv" "$1-exits.2.csv" "$1-exits.3.csv" >e.join
  cat "$1-returns.1.csv" "$1-returns.2.csv" "$1-returns.3.csv" >r.join
}

# share NAME EXPRESSION LOW HIGH FILE: share of rows for which it holds.
share() {
  awk -F, "NR > 1 && !/^#/ { n++; k += ($2) ? 1 : 0 }
    END { printf \"%g\", k / n; exit !(k / n >= $3 && k / n <= $4) }" \
    "$5" >got
  result $? "$1" "share $(cat got), want $3 to $4"
}

# Shards.
for kind in 'random --codim2 even --cycles 3' 'noise --size 1e-6' \
  'smoothing --size 1e-5' 'hysteresis --size 5e-5' 'delay --size 5e-5'; do
  # shellcheck disable=SC2086  # a list of options
  set -- --by $kind --samples 7 --patience 0.3 --seed 5
  diverge "$@" --exits e.all --returns r.all
  for i in 1 2 3; do
    diverge "$@" --shard "$i/3" --exits "s-exits.$i.csv" \
      --returns "s-returns.$i.csv"
  done
  joined s
  same all join "shards concatenate to one run: ${kind%% *}"
done
equal 'columns of the exits' "$(head -n 1 e.all)" \
  sample,cycle,time,r,omega,g,side,phase,how,section_time
equal 'columns of the returns' "$(head -n 1 r.all)" "sample,cycle,outcome,$(
  )time,arrived,exit_r,landing_time,landing_r,landings,windings"
diverge --samples 2 --shard 3/3 >out
equal 'a shard without samples has no row' "$(sed 's/, run .*//' out)" \
  '# shard 3/3: 0 rows, crc32 00000000'
diverge --samples 4 --shard 2/2 --header --rate 0 --patience 1 >out
check 'a header if asked for; a rate of 0 ends' grep -q '^sample,cycle' out
# Where a shard is stopped, that of an earlier run is still there: the last line
# tells them apart.
run_of() { tail -n 1 "$1" | sed 's/.*, run //'; }
set -- --samples 7 --patience 0.3 --seed 5 --shard 2/3
diverge "$@" --returns r.one
check 'a shard ends with its count' grep -Eqx \
  "# shard 2/3: [0-9]+ rows, crc32 [0-9a-f]{8}, run [0-9a-f]{8}" r.one
while read -r other; do
  # shellcheck disable=SC2086  # options
  diverge --patience 0.3 --shard 2/3 $other --returns r.other
  check "a shard with $other is of another run" \
    [ "$(run_of r.other)" != "$(run_of r.one)" ]
done <<END
--samples 7 --seed 6
--samples 7 --seed 5 --codim2 even
--samples 7 --seed 5 --set mu=1.01
--samples 7 --seed 5 --set h=0 --set r=0.18 --set omega=-1.03
END

# Workers.
set -- --samples 7 --codim2 even --cycles 3 --patience 3 --seed 5
diverge "$@" --exits e.all --returns r.all
diverge "$@" --exits e.again --returns r.again
same all again 'a seed is a run'
if /usr/bin/python3 -c 'import pandas, statsmodels, tabulate' 2>/dev/null; then
  mkdir parts
  shards() { TMPDIR=$D/parts TWOFOLD=$T JOBS=2 "$tools/study/run" shards "$@"; }
  shards "$D/joined" chaos "$@" 2>err
  mv joined-exits.csv e.join
  mv joined-returns.csv r.join
  same all join 'workers'
  shards "$D/joined" chaos --rate -1 >out 2>err
  check 'a shard that fails is a failure' [ $? -eq 3 ]
  check 'and leaves nothing' [ ! -e joined-exits.csv ]
  check 'and no temporary directory' [ -z "$(ls parts)" ]
else
  lacks 'workers' python3-pandas
fi
TWOFOLD=$T sh "$tools/study/shards/shards.sbatch" task diverge chaos >out 2>err
check 'outside of an array it says how to start it' [ $? -eq 2 ]
diverge --samples 7 --seed 6 --patience 0.3 --exits e.other --returns r.other
check 'another seed gives other exits' not cmp -s e.all e.other

# The rows say what the rule declares. 2000 exits, four standard deviations.
diverge --samples 2000 --rate 200 --patience 0.2 --seed 3 --exits e \
  --returns r
share 'exits at the rate: 1 - 1/e before 1/rate' '$3 < 0.005' 0.589 0.675 e
share 'all exits lie behind the two-fold' '$4 < 0.1859' 1 1 e
share 'exits lie on its weak direction' '($4 - 0.1859) ^ 2 + 1e-12 > \
  ($5 + 1.037 + 10.244253 * ($4 - 0.1859)) ^ 2' 1 1 e
diverge --samples 40 --codim2 even --patience 200 --seed 4 >r
share 'drawn at h = g = 0, the two-fold is reached again' \
  '$3 == "returned"' 0.95 1 r
diverge --samples 40 --codim2 attracting --patience 20 --seed 4 >r
diverge --samples 40 --codim2 attracting --patience 20 --seed 4 >again
check '--codim2 and its old name give the same bytes' cmp -s r again
share 'by the attracting stick there it is not' '$3 == "small_cycle"' 0.9 1 r

# Steps that do not resolve the noise at h = g = 0 have half of these rest there
# before they have wound, for longer than this patience.
diverge --by noise --size 1e-5 --fine 4 --samples 10 --patience 30 --seed 3 \
  --section 2e-3 --exits e --returns r
share 'by noise every exit winds' '$7 != ""' 1 1 e
share 'and the two-fold is reached again' '$3 == "returned"' 1 1 r

# Numbers of places are those of the first rows that lead to them.
diverge --exhaustive --depth 1 --grid 0.1 --patience 0.5 >out
check 'both sides at every multiple of the grid' awk -F, '
  NR > 1 { n[$6, $7]++ }
  END { exit !(n["slip+", 0.1] == 1 && n["slip-", 0.1] == 1 &&
               n["slip+", 0.3] == 1) }' out
diverge --exhaustive --depth 1 --grid 0.1 --patience 0.5 --branches b
check 'the file is what goes to standard output' cmp -s b out
# The first h = g = 0 of `chaos` as a start: a branch for each of its modes, of
# which the first row of a run has as many.
at='--set r=0.17986265324413 --set omega=-1 --set h=0'
for law in 'hull slip- stick+ stick- pinned' 'bow_tie slip- stick+ stick-'; do
  # shellcheck disable=SC2086  # a list of words, and of options
  set -- $law
  # shellcheck disable=SC2086
  diverge --exhaustive --depth 1 $at --set "rest=$1" >out
  # shellcheck disable=SC2086
  "$T" run chaos $at --set "rest=$1" --t-end 1e-4 >row 2>err
  equal "every future of h = g = 0 under $1" \
    "$1 $(awk -F, 'NR > 1 { printf "%s ", $6 }' out)$(
      sed -n '2s/.*,//p' row)" "$law $(($# - 1))"
done
diverge --exhaustive --depth 4 --grid 0.2 --patience 3 >out
check 'all modes of h = g = 0 are followed' awk -F, '
  $3 == "codim2" { seen[$6] = 1 }
  END { exit !(seen["slip-"] && seen["stick-"] && seen["pinned"]) }' out
check 'branches that end at the two-fold have its number' awk -F, '
  $10 == "two-fold" { n++; bad += $11 != 0 } END { exit !(n > 1 && !bad) }' \
  out
check 'branches that end at one place are joined' awk -F, '
  NR > 1 && $10 == "codim2" && $11 != "" {
    n++
    if ($11 in r && (r[$11] - $13) ^ 2 > 4e-12) bad = 1
    if (!($11 in r)) for (i in r) if (r[i] == $13) bad = 1
    if (!($11 in r)) { r[$11] = $13; places++ }
  }
  END { exit !(n > places && places > 1 && !bad) }' out
diverge --exhaustive --depth 3 --grid 0.1 --patience 1 --count 5 >out
check 'no more places than --count' awk -F, '
  NR > 1 && ($1 > 4 || $11 > 4) { bad = 1 } END { exit bad || NR < 5 }' out

# Refusals, which leave no file.
files='--exits e.csv --returns r.csv'
rm -f e.csv r.csv
for option in '--depth 2' '--count 5' '--grid 0.1' '--branches b.csv'; do
  echo "2 chaos $option $files|only with --exhaustive"
done >rows
cat - >>rows <<END
3 chaos --rate nan $files|--rate nan: rate must lie in [0, 1e+09] 1/s
3 chaos --by noise --size inf $files|--size inf: must lie in (0, 1]
3 chaos --set r=0.3 --set omega=-0.5 --set h=0.1 $files|has one future
2 chaos --by delay $files|give --size
2 chaos --size 1 $files|has a --rate
3 chaos --shard 5/4 $files|I must lie in
2 chaos --shard 3 $files|expected I/N
3 coulomb $files|no two-fold
3 driven $files|driven
2 chaos --exhaustive --shard 1/2|--exhaustive
2 chaos --resume|--resume: only with
4 chaos --exits e.csv --returns no/such/r.csv|No such
4 chaos --exhaustive --branches no/such/b.csv|--branches no/such/b.csv: No such
END
expectations diverge <rows
equal 'none of them makes a file' "$(find . -name '[er].csv')" ''
check 'none of them writes a row' [ ! -s out ]

# An escaping start.
diverge --set r=0.18 --set omega=-1.02 --set h=0 --samples 20 --rate 100 \
  --patience 0.5 --exits e --returns r
equal 'an escaping start is left' "$(grep -vc '^#' e)" 21

# What has ended is whole and on disk.
interrupt INT r 21 diverge chaos --samples 1000000 --codim2 even \
  --cycles 1000 --exits e --returns r
check 'every row is whole' whole_rows r.part 10
equal 'as many exits as returns' "$(wc -l <e.part)" "$(wc -l <r.part)"
finish
