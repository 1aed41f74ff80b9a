#!/bin/sh
# test_cli_diverge.sh - `twofold diverge`: the same bytes whatever the shards,
# the two-fold's exits where and as often as declared, refusals that say why and
# leave no file, whole cycles on disk after an interrupt.
#
# usage: test_cli_diverge.sh TWOFOLD
# Expressions of awk stand in single quotes.
# shellcheck disable=SC2016

T=${1:?usage: test_cli_diverge.sh TWOFOLD}
case $T in /*) ;; *) T=$PWD/$T ;; esac
tools=$(cd "$(dirname "$0")/../../tools" && pwd) || exit 1
D=$(mktemp -d) || exit 1
trap 'rm -rf "$D"' EXIT
cd "$D" || exit 1
LC_ALL=C
export LC_ALL
count=0
failed=0

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

# expect NAME CODE TEXT ARGS...: the exit code, TEXT in standard error, no row,
# and no file.
expect() {
  expect_name=$1 want=$2 wanted=$3
  shift 3
  rm -f e.csv r.csv
  "$T" diverge "$@" > out 2> err
  code=$?
  bad=0
  [ "$code" -eq "$want" ] && grep -qF -- "$wanted" err && [ ! -s out ] &&
    [ ! -e e.csv ] && [ ! -e r.csv ] || bad=1
  result $bad "$expect_name" "diverge $*: code $code, want $want, '$wanted'"
}

diverge() {
  "$T" diverge chaos "$@" 2> err
}

# share NAME EXPRESSION LOW HIGH FILE: share of rows for which it holds.
share() {
  awk -F, "NR > 1 { n++; k += ($2) ? 1 : 0 }
    END { printf \"%g\", k / n; exit !(k / n >= $3 && k / n <= $4) }" \
    "$5" > got
  result $? "$1" "share $(cat got), want $3 to $4"
}

test_shards() {
  for kind in 'random --corner even --cycles 3' 'noise --size 1e-6' \
    'smoothing --size 1e-5' 'hysteresis --size 5e-5' 'delay --size 5e-5'; do
    name=${kind%% *}
    # shellcheck disable=SC2086
    set -- --by $kind --samples 7 --patience 0.3 --seed 5
    diverge "$@" --exits e.all --returns r.all
    rm -f e.join r.join
    for i in 1 2 3; do
      diverge "$@" --shard "$i/3" --exits e.part --returns r.part
      cat e.part >> e.join
      cat r.part >> r.join
    done
    check "shards concatenate to one run: $name" cmp -s e.all e.join
    check "and so do their returns: $name" cmp -s r.all r.join
  done
  diverge --samples 2 --shard 3/3 > out
  check 'a shard without samples is empty' [ ! -s out ]
  diverge --samples 4 --shard 2/2 --header > out
  check 'a header where it is asked for' grep -q '^sample,cycle' out
  set -- --samples 7 --corner even --cycles 3 --patience 3 --seed 5
  diverge "$@" --exits e.all --returns r.all
  diverge "$@" --exits e.again --returns r.again
  check 'a seed is a run' cmp -s r.all r.again
  for launcher in parallel xargs; do
    LAUNCHER=$launcher "$tools/statistics/shards" 2 joined "$T" chaos "$@" \
      2> err
    code=$?
    if [ $code -eq 5 ]; then
      result 0 "workers by $launcher # SKIP not installed"
      continue
    fi
    check "workers by $launcher write the same exits" cmp -s e.all \
      joined-exits.csv
    check "workers by $launcher write the same returns" cmp -s r.all \
      joined-returns.csv
    rm -f joined-*
  done
  "$tools/statistics/shards" 2 joined "$T" chaos --rate -1 > out 2> err
  check 'a shard that fails is a failure' [ $? -eq 4 ]
  check 'and leaves nothing' [ ! -e joined-exits.csv ]
  check 'and no temporary directory' [ -z "$(ls -d joined.* 2> /dev/null)" ]
  test_array "$@"
  diverge --samples 7 --seed 6 --patience 0.3 --exits e.other --returns r.other
  if cmp -s e.all e.other; then same=1; else same=0; fi
  result $same 'another seed gives other exits'
}

# The job array of Slurm, its tasks started by hand in any order.
test_array() {
  for i in 3 1 2; do
    TWOFOLD=$T SLURM_ARRAY_TASK_MAX=3 SLURM_ARRAY_TASK_ID=$i \
      sh "$tools/slurm/diverge.sbatch" task chaos "$@" 2> err
  done
  cat task-exits.1.csv task-exits.2.csv task-exits.3.csv > e.join
  cat task-returns.1.csv task-returns.2.csv task-returns.3.csv > r.join
  check 'tasks of a job array concatenate to one run' cmp -s e.all e.join
  check 'and so do their returns' cmp -s r.all r.join
  TWOFOLD=$T SHARDS=3 SLURM_ARRAY_TASK_ID=2 \
    sh "$tools/slurm/diverge.sbatch" again chaos "$@" 2> err
  check 'a lost task is run again alone' cmp -s task-exits.2.csv \
    again-exits.2.csv
  TWOFOLD=$T sh "$tools/slurm/diverge.sbatch" task chaos > out 2> err
  check 'outside of an array it says how to start it' [ $? -eq 2 ]
}

# The rows say what the rule declares. 2000 exits, four standard deviations.
test_statistics() {
  diverge --samples 2000 --rate 200 --patience 0.2 --seed 3 --exits e \
    --returns r
  share 'either side alike' '$7 == "slip+"' 0.455 0.545 e
  share 'exits at the rate: 1 - 1/e before 1/rate' '$3 < 0.005' 0.589 0.675 e
  share 'all exits lie behind the two-fold' '$4 < 0.1859' 1 1 e
  share 'exits lie on its weak direction' '($4 - 0.1859) ^ 2 + 1e-12 > \
    ($5 + 1.037 + 10.244253 * ($4 - 0.1859)) ^ 2' 1 1 e
  diverge --samples 40 --corner even --patience 200 --seed 4 > r
  share 'drawn at h = g = 0, the two-fold is reached again' \
    '$3 == "returned"' 0.95 1 r
  diverge --samples 40 --corner attracting --patience 20 --seed 4 > r
  share 'by the attracting stick there it is not' '$3 == "small_cycle"' 0.9 1 r
}

# Numbers of places are those of the first rows that lead to them.
test_exhaustive() {
  diverge --exhaustive --depth 1 --grid 0.1 --patience 0.5 > out
  check 'both sides at every multiple of the grid' awk -F, '
    NR > 1 { n[$6, $7]++ }
    END { exit !(n["slip+", 0.1] == 1 && n["slip-", 0.1] == 1 &&
                 n["slip+", 0.3] == 1) }' out
  diverge --exhaustive --depth 2 --grid 0.2 --patience 3 > out
  check 'all modes of h = g = 0 are followed' awk -F, '
    $3 == "corner" { seen[$6] = 1 }
    END { exit !(seen["slip-"] && seen["stick-"] && seen["pinned"]) }' out
  check 'branches that end at the two-fold have its number' awk -F, '
    $10 == "two-fold" { n++; bad += $11 != 0 } END { exit !(n > 1 && !bad) }' \
    out
  check 'branches that end at one place are joined' awk -F, '
    NR > 1 && $10 == "corner" && $11 != "" {
      n++
      if ($11 in r && (r[$11] - $13) ^ 2 > 4e-12) bad = 1
      if (!($11 in r)) for (i in r) if (r[i] == $13) bad = 1
      if (!($11 in r)) { r[$11] = $13; places++ }
    }
    END { exit !(n > places && places > 1 && !bad) }' out
  diverge --exhaustive --depth 3 --grid 0.1 --patience 1 --count 5 > out
  check 'no more places than --count' awk -F, '
    NR > 1 && ($1 > 4 || $11 > 4) { bad = 1 } END { exit bad || NR < 5 }' out
  diverge --exhaustive --depth 1 --grid 0.1 --patience 0.5 --branches b1
  diverge --exhaustive --depth 1 --grid 0.1 --patience 0.5 > b2
  check 'the file is what goes to standard output' cmp -s b1 b2
}

test_refusals() {
  set -- --exits e.csv --returns r.csv
  expect 'a state with one future' 3 'has one future' chaos --set r=0.3 \
    --set omega=-0.5 --set h=0.1 "$@"
  expect 'a negative rate' 3 'rate must lie in' chaos --rate -1 "$@"
  for value in inf -inf 1e999 nan; do
    expect "rate $value" 3 "--rate $value: rate must lie in [0, 1e+09] 1/s" \
      chaos --rate "$value" "$@"
    expect "width $value" 3 "--size $value: must lie in (0, 1]" chaos \
      --by noise --size "$value" "$@"
  done
  expect 'a rate that is no number' 2 'is not a number' chaos --rate x "$@"
  expect 'a negative width' 3 'must lie in' chaos --by smoothing --size -1 "$@"
  expect 'a width of nothing' 3 'must lie in' chaos --by noise --size 0 "$@"
  expect 'no width' 2 'give --size' chaos --by delay "$@"
  expect 'a width of random' 2 'has a --rate' chaos --size 1 "$@"
  expect 'shard 0 of 4' 3 'I must lie in' chaos --shard 0/4 "$@"
  expect 'shard 5 of 4' 3 'I must lie in' chaos --shard 5/4 "$@"
  expect 'shard of no form' 2 'expected I/N' chaos --shard 3 "$@"
  expect 'a scene without a two-fold' 3 'no two-fold' gamma_right "$@"
  expect 'parameters without a two-fold' 3 'no two-fold' chaos \
    --set kappa=0.01 "$@"
  expect 'a law without one' 3 'no two-fold' coulomb "$@"
  expect 'a driven scene' 3 'driven' driven "$@"
  expect 'an unknown kind' 2 'unknown kind' chaos --by luck "$@"
  expect 'an unknown option' 2 'did you mean' chaos --sample 3
  expect 'an option twice' 2 '--seed was already given' chaos --seed 1 --seed 2
  expect 'a flag twice' 2 '--header was already given' chaos --header --header
  for option in '--depth 2' '--count 5' '--grid 0.1' '--branches b.csv'; do
    # shellcheck disable=SC2086  # an option and its value
    expect "$option without --exhaustive" 2 'only with --exhaustive' chaos \
      $option "$@"
  done
  expect 'an unknown scene' 2 'unknown scene' chaoss
  expect 'one file for both' 2 'two files' chaos --exits x --returns x
  expect 'a file that cannot be written' 4 'No such' chaos --exits e.csv \
    --returns no/such/r.csv
  expect 'branches that cannot be written' 4 'cannot be written' chaos \
    --exhaustive --branches no/such/b.csv
  expect 'samples by shards of --exhaustive' 2 '--exhaustive' chaos \
    --exhaustive --shard 1/2
}

test_start() {
  diverge --set r=0.18 --set omega=-1.02 --set h=0 --samples 20 --rate 100 \
    --patience 0.5 --exits e --returns r
  check 'an escaping start is left' awk -F, 'END { exit NR != 21 }' e
}

# Ctrl-C: what has ended is whole and on disk, the code is 4.
test_interrupt() {
  rm -f r
  "$T" diverge chaos --samples 1000000 --corner even --cycles 1000 \
    --exits e --returns r 2> err &
  pid=$!
  tries=600
  until [ -s r ] && [ "$(wc -l < r)" -gt 20 ]; do
    tries=$((tries - 1))
    [ "$tries" -gt 0 ] || break
    sleep 0.1 2> /dev/null || sleep 1
  done
  kill -INT "$pid"
  wait "$pid"
  code=$?
  check 'an interrupt ends with code 4' [ "$code" -eq 4 ]
  check 'what has ended is written' [ "$(wc -l < r)" -gt 20 ]
  check 'every row is whole' awk -F, 'NF != 10 { exit 1 }' r
  lines=$(wc -l < r)
  check 'as many exits as returns' [ "$(wc -l < e)" -eq "$lines" ]
  check 'it says that it was stopped' grep -q 'stopped by a signal' err
}

test_shards
test_statistics
test_exhaustive
test_refusals
test_start
test_interrupt
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
