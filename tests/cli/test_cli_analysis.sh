#!/bin/sh
# test_cli_analysis.sh - singularities, regions, design and atlas keep the
# contract of the command line: exit codes, columns, JSON that closes, refusals
# that name option, value and range, and no file where a command was refused.
#
# usage: test_cli_analysis.sh TWOFOLD

T=${1:?usage: test_cli_analysis.sh TWOFOLD}
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
close=1e-12
"$T" --version | grep -q float && close=1e-4

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

check() {
  check_name=$1
  shift
  "$@"
  result $? "$check_name" "failed: $*"
}

equal() {
  [ "$2" = "$3" ]
  result $? "$1" "got '$2', want '$3'"
}

# within NAME GOT WANTED TOLERANCE
within() {
  awk -v a="$2" -v b="$3" -v e="$4" \
    'BEGIN { d = a - b; exit !(a != "" && d <= e && -d <= e) }'
  result $? "$1" "got '$2', want '$3' within $4"
}

run() {
  "$T" "$@" > out 2> err
  code=$?
}

# expect NAME CODE TEXT ARGS...: the exit code, TEXT within standard error, and
# nothing on standard output where the command line was refused.
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

column() { awk -F, -v n="$2" -v c="$3" 'NR == n { print $c }' "$1"; }

# json NAME N: the Nth number that stands under NAME in out.
json() {
  sed -n "s/.*\"$1\": \\[*\\([-+.0-9e]*\\).*/\\1/p" out | sed -n "${2}p"
}

# Brackets match, strings are closed, no comma before a closing bracket.
closes() {
  tr '\n' ' ' < "$1" | awk '{
    gsub(/"[^"]*"/, "s")
    if (/"/ || /, *[]}]/ || /[[{] *,/) exit 1
    n = length($0)
    for (i = 1; i <= n; i++) {
      c = substr($0, i, 1)
      if (c == "{" || c == "[") stack = stack c
      if (c == "}" || c == "]") {
        top = substr(stack, length(stack))
        if (top != (c == "}" ? "{" : "[")) exit 1
        stack = substr(stack, 1, length(stack) - 1)
      }
    }
    exit stack != ""
  }'
}

test_singularities() {
  run singularities chaos
  equal 'singularities succeeds' "$code" 0
  check 'its JSON closes' closes out
  equal 'two two-folds' "$(json count 1)" 2
  within 'r' "$(json r 1)" 0.1859 $close
  within 'v' "$(json v 1)" -0.0301217 $close
  within 'omega' "$(json omega 1)" -1.037 $close
  within 'g' "$(json g 1)" 0.009727385146 $close
  within 'K++' "$(json K++ 1)" -0.0023567513838866354 $close
  within 'K+-' "$(json K+- 1)" 0.0032510430314189251 $close
  within 'K-+' "$(json K-+ 1)" -0.0027567704314507111 $close
  within 'K--' "$(json K-- 1)" 0.0028510239838548495 $close
  within 'J1' "$(json J1 1)" -1.0635141712155655 $close
  within 'J2' "$(json J2 1)" -1.2541959590469642 $close
  within 'weak eigenvalue first' "$(json eigenvalues 1)" -0.15432040368 1e-4
  check 'a Teixeira singularity' grep -q '"type": "invisible", "case": 1' out
  check 'the other is visible' grep -q '"type": "visible", "case": null' out
  cp out first.json
  run singularities chaos --out file.json
  check '--out holds the same' cmp -s first.json file.json
  equal '--out leaves standard output empty' "$(wc -c < out)" 0
  while read -r scene reason; do
    run singularities "$scene"
    equal "$scene succeeds" "$code" 0
    check "$scene: its JSON closes" closes out
    equal "$scene has none" "$(json count 1)" 0
    check "$scene says why" grep -qF "\"reason\": \"$reason" out
  done << END
gamma_right kappa |cos gamma| < 2 beta |sin gamma|
coulomb without a moment
smooth the friction does not jump
frictionless the friction does not jump
END
  run singularities gamma_zero
  check 'gamma = 0: continuous' grep -q '"type": "continuous"' out
  within 'gamma = 0: |r| is kappa' "$(json r 1)" 0.27241153714062027818 $close
  run singularities chaos --set kappa=0.09
  equal 'parameters count' "$(json count 1)" 0
}

test_regions() {
  run regions chaos --r 0.17:0.2:3 --omega -1.05:-1:3
  equal 'regions succeeds' "$code" 0
  equal 'its header' "$(head -n 1 out)" r,omega,region,lambda,delassus
  equal 'a row a point' "$(wc -l < out)" 10
  equal 'omega is inner' "$(cut -d , -f 1,2 out | sed -n 2,4p | tr '\n' ' ')" \
    '0.17,-1.05 0.17,-1.025 0.17,-1 '
  equal 'its regions' "$(sed 1d out | cut -d , -f 3 | tr '\n' ' ')" \
    "crossing_up escaping codimension2 crossing_up escaping codimension2 $(
    )sliding crossing_down codimension2 "
  equal 'h = g = 0 has no lambda' "$(sed -n 4p out)" 0.17,-1,codimension2,,
  within 'A is that of tf_step' "$(column out 8 5)" 0.0641221403 1e-6
  # The four regions meet at the two-fold.
  run regions chaos --r 0.1:0.3:41 --omega -1.2:-0.9:41
  equal 'all regions are there' "$(sed 1d out | cut -d , -f 3 | sort -u |
    tr '\n' ' ')" 'crossing_down crossing_up escaping sliding '
  awk -F, 'NR > 1 && ($3 ~ /ing$/) != ($4 >= -1 && $4 <= 1) { bad = 1 }
    NR > 1 && $3 == "sliding" && $5 <= 0 { bad = 1 }
    NR > 1 && $3 == "escaping" && $5 >= 0 { bad = 1 } END { exit bad }' out
  result $? 'stick is where lambda is within mu'
  # A run that begins there has the futures of its region.
  run regions chaos --r 0.11:0.31:5 --omega -1.4:-0.8:8
  sed 1d out > grid
  while IFS=, read -r r omega region _; do
    run run chaos --t-end 0 --set h=0 --set "r=$r" --set "omega=$omega"
    case $region,$(sed -n 2p out | cut -d , -f 9,10) in
      sliding,stick?,1 | escaping,*,3 | crossing_up,slip+,1) ;;
      crossing_down,slip-,1) ;;
      *) equal "r = $r, omega = $omega" "$(sed -n 2p out)" "$region" ;;
    esac
  done < grid
  equal 'regions are what a run begins with' "$(sed -n '$p' grid |
    cut -d , -f 1,2)" "$(sed -n 2p out | cut -d , -f 2,4)"
  run regions coulomb --r 0:1:3 --omega -1:1:3
  check 'coulomb never escapes' test "$(grep -c escaping out)" -eq 0
  run regions chaos --r 0.2:0.2:1 --omega -1.1:-1.1:1 --out one.csv
  equal 'one point' "$(wc -l < one.csv)" 2
  expect 'a law without a jump' 3 'scene smooth: regions needs law jump' \
    regions smooth --r 0:1:2 --omega 0:1:2
  expect 'a law without a jump, typed' 3 '--set law=none: regions needs' \
    regions chaos --set law=none --r 0:1:2 --omega 0:1:2
  expect 'gamma = 0' 3 'scene gamma_zero: regions needs |sin(gamma)| in' \
    regions gamma_zero --r 0:1:2 --omega 0:1:2
  expect 'gamma = 0, typed' 3 '--set gamma=0: regions needs' \
    regions chaos --set gamma=0 --r 0:1:2 --omega 0:1:2
  run regions chaos --r 0:1e9:2 --omega 0:1e9:2
  equal 'a point out of reach stops' "$code" 4
  check 'it says where' grep -q 'stopped at r = ' err
  check 'the rows before it are whole' test -z "$(tail -c 1 out)"
}

test_design() {
  run design chaos --r 0.1859 --omega -1.037
  equal 'design succeeds' "$code" 0
  check 'its JSON closes' closes out
  within 'kappa' "$(json kappa 1)" 0.27241153714062027818 $close
  within 'k2' "$(json k2 1)" 2.2270992253886014441 $close
  run design chaos --r 0.25 --omega -1.06
  settings=$(sed -n 's/.*"set": "\(.*\)".*/\1/p' out)
  # shellcheck disable=SC2086 # two settings are four words
  run singularities chaos $settings
  within 'a designed two-fold is found: r' "$(json r 1)" 0.25 $close
  within 'a designed two-fold is found: omega' "$(json omega 1)" -1.06 1e-4
  run design coulomb --set law=jump --r 0.1859 --omega -1.037
  equal 'a scene without kappa can be designed' "$code" 0
  expect 'kappa out of range' 3 '--r 0.1859 --omega 1: kappa would be -0.27' \
    design chaos --r 0.1859 --omega 1
  check 'its range is told' grep -qF 'must lie in [1e-09, 1e+06] m' err
  expect 'k2 out of range' 3 '--r 0.05 --omega -2.5: k2 would be -3.7' \
    design chaos --r 0.05 --omega -2.5
  check 'its range is told' grep -qF '[0, 1e+15] N/m' err
  expect 'r = 0' 3 '--r 0: r must not be 0' design chaos --r 0 --omega 1
  expect 'r = r0' 3 '--r 0.1: k2 does not act' design chaos --r 0.1 --omega 1
  expect 'omega = omega0' 3 '--omega -1: omega must differ from omega0 = -1' \
    design chaos --r 0.2 --omega -1
  expect 'no moment' 3 'scene coulomb: design needs law jump' \
    design coulomb --r 0.2 --omega -1.1
  expect 'no force' 3 '--set mu=0: design needs mu > 0' \
    design chaos --set mu=0 --r 0.2 --omega -1.1
  expect 'gamma = pi/2' 3 'scene gamma_right: design needs |sin(gamma)| and' \
    design gamma_right --r 0.2 --omega -1.1
  expect 'what it finds is not set' 0 'kappa=1 has no effect: design finds it' \
    design chaos --r 0.1859 --omega -1.037 --set kappa=1
}

test_atlas() {
  run atlas chaos --r 0.1:0.1859:2 --omega -1.037:-1:2
  equal 'atlas succeeds' "$code" 0
  columns='r,omega,v,g,kappa,k2,K++,K+-,K-+,K--,J1,J2,K--_positive,'
  columns=$columns'K++_negative,J1_negative,J2_negative,J1J2_above_1,'
  equal 'its header' "$(head -n 1 out)" \
    "${columns}kappa_positive,k2_positive,overlap"
  equal 'a wish that cannot be' "$(sed -n 2p out)" \
    0.1,-1.037,,,,,,,,,,,,,,,,,,0
  equal 'the paper'\''s point is in the overlap' \
    "$(sed -n 4p out | cut -d , -f 13-)" 1,1,1,1,1,1,1,1
  within 'kappa' "$(column out 4 5)" 0.27241153714062027818 $close
  within 'J1' "$(column out 4 11)" -1.0635141712155655 $close
  run atlas chaos --r 0.01:1:60 --omega -3:1:61
  awk -F, 'NR == 1 { next } NF != 20 { bad = 1 }
    $5 == "" { if ($20 != 0) bad = 1; next }
    { all = 1; for (i = 13; i < 20; i++) { all = all && $i; n[i] += $i }
      if ($20 != all) bad = 1
      if ($13 != ($10 > 0) || $14 != ($7 < 0)) bad = 1
      if ($18 != ($5 > 0) || $19 != ($6 > 0)) bad = 1
      total++; over += all }
    END { for (i = 13; i < 20; i++) if (!n[i] || n[i] == total) bad = 1
      exit bad || !over || over == total }' out
  result $? 'each condition holds somewhere and not everywhere'
  expect 'gamma' 3 'gamma_zero: atlas needs |sin(gamma)|' \
    atlas gamma_zero --r 0:1:2 --omega 0:1:2
  expect 'no moment' 3 '--set law=coulomb: atlas needs law jump' \
    atlas chaos --set law=coulomb --r 0:1:2 --omega 0:1:2
}

test_usage() {
  echo keep > kept
  for command in singularities regions design atlas; do
    expect "$command: no scene" 2 "$command: which scene" $command
    expect "$command: unknown scene" 2 "mean 'chaos'" $command choas
    expect "$command: two scenes" 2 'one scene' $command chaos coulomb
    expect "$command: unknown option" 2 'unknown option --sett' \
      $command chaos --sett m=1
    case $command in
      singularities) place= ;;
      design) place='--r 0.2 --omega 0' ;;
      *) place='--r 0:1:2 --omega 0:1:2' ;;
    esac
    # shellcheck disable=SC2086 # options and their values
    expect "$command: bad parameter" 3 '--set m=0: m must lie in [' \
      $command chaos --set m=0 $place --out kept
    for page in "help $command" "$command --help"; do
      # shellcheck disable=SC2086 # two words are two arguments
      run $page
      equal "$page succeeds" "$code" 0
      check "$page prints" grep -q "usage: twofold $command SCENE" out
    done
    run help
    check "help lists $command" grep -q "^  $command " out
  done
  for command in regions atlas; do
    expect "$command: --r is missing" 2 '--r A:B:N is missing' $command chaos
    expect "$command: --omega is missing" 2 '--omega A:B:N is missing' \
      $command chaos --r 0:1:2
    for range in '' 1 1:2 1:2:3:4 :: 1:2: 1:2:0 1:2:-1 1:2:1.5 1:2:1000001 \
      1:2:1 x:1:2 1:x:2; do
      expect "$command: --r '$range'" 2 "--r $range" \
        $command chaos --r "$range" --omega 0:1:2 --out kept
    done
    for range in 1e10:1:2 0:-1e10:2 nan:1:2 0:inf:2; do
      expect "$command: --omega $range" 3 "--omega $range" \
        $command chaos --omega "$range" --r 0:1:2 --out kept
      check "its range is told: $range" grep -qF '[-1e+09, 1e+09] rad/s' err
    done
  done
  for value in '' x 1:2:3; do
    expect "design: --r '$value'" 2 "--r $value" \
      design chaos --r "$value" --omega 1 --out kept
  done
  expect 'design: r out of range' 3 'r must lie in [-1e+09, 1e+09] m' \
    design chaos --r 1e10 --omega 1 --out kept
  expect 'design: --omega is missing' 2 '--omega W is missing' \
    design chaos --r 1
  expect 'given twice: --r' 2 '--r 2: --r was already given' \
    design chaos --r 1 --r 2 --omega 1
  expect 'given twice: --out' 2 '--out was already given' \
    singularities chaos --out kept --out kept
  expect 'empty name' 2 '--out: the name of the file is empty' \
    singularities chaos --out=
  expect 'singularities takes no place' 2 'unknown option --r' \
    singularities chaos --r 1
  expect 'the start has no effect' 0 '--set r=1 has no effect' \
    singularities chaos --set r=1
  equal 'a refused command leaves the file alone' "$(cat kept)" keep
}

test_output() {
  expect 'a file that cannot be opened' 4 '/nowhere/x' \
    singularities chaos --out /nowhere/x
  if [ -c /dev/full ]; then
    expect 'JSON on a full device' 4 '/dev/full: No space left' \
      singularities chaos --out /dev/full
    expect 'rows on a full device' 4 '/dev/full: No space left' \
      regions chaos --r 0:1:100 --omega 0:1:100 --out /dev/full
    "$T" design chaos --r 0.1859 --omega -1.037 > /dev/full 2> err
    equal 'standard output on a full device' $? 4
  fi
  (
    ulimit -f 8 || exit 4
    exec "$T" atlas chaos --r 0:1:1000 --omega 0:1:1000 --out quota.csv 2> err
  )
  equal 'a file at its quota' $? 4
  check 'it ends with a whole row' test -z "$(tail -c 1 quota.csv)"
  equal 'and every row is whole' "$(awk -F, 'NF != 20' quota.csv | wc -l)" 0
  { "$T" atlas chaos --r 0:1:1000 --omega 0:1:1000 2> err; echo $? > code; } |
    head -n 1 > out
  equal 'a closed pipe stops it' "$(cat code)" 4
}

test_singularities
test_regions
test_design
test_atlas
test_usage
test_output

echo "1..$count"
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
