#!/bin/sh
# singularities, regions, design and atlas keep the contract of the command
# line: exit codes, columns, JSON that closes, refusals that name option, value
# and range, and no file where a command was refused.
# usage: test_cli_analysis.sh TWOFOLD
# shellcheck disable=SC2016  # expressions of awk stand in single quotes
. "$(dirname "$0")/../support/tap.sh"
close=1e-12

# json NAME: the first number that stands under NAME in out.
json() {
  sed -n "s/.*\"$1\": \\[*\\([-+.0-9][-+.0-9e]*\\).*/\\1/p" out | sed -n 1p
}

# numbers: reads rows of NAME, VALUE, TOLERANCE.
numbers() {
  while read -r name value tolerance; do
    within "$name" "$(json "$name")" "$value" "$tolerance"
  done
}

# closes: brackets of out match, strings are closed, no comma before a closing
# bracket.
closes() {
  tr '\n' ' ' <out | awk '{
    gsub(/"[^"]*"/, "s")
    if (/"/ || /, *[]}]/ || /[[{] *,/) exit 1
    gsub(/[^][{}]/, "")
    while (gsub(/\[]|{}/, "")) continue
    exit $0 != ""
  }'
}

# json_of ARGS...: it succeeds and prints JSON.
json_of() {
  runs "$@"
  check "$*: its JSON closes" closes
}

words() { tr '\n' ' '; }

# singularities
json_of singularities chaos
numbers <<END
count 2 0
r 0.1859 $close
v -0.0301217 $close
omega -1.037 $close
g 0.009727385146 $close
J1 -1.0635141712155655 $close
END
check 'a Teixeira singularity' grep -q '"type": "invisible", "case": 1' out
check 'the other is visible' grep -q '"type": "visible", "case": null' out
cp out first.json
runs singularities chaos --out file.json
check '--out holds the same' cmp -s first.json file.json
equal '--out leaves standard output empty' "$(wc -c <out)" 0
while read -r scene reason; do
  json_of singularities "$scene"
  equal "$scene has none" "$(json count)" 0
  check "$scene says why" grep -qF "\"reason\": \"$reason" out
done <<END
gamma_right kappa |cos gamma| < 2 beta |sin gamma|
coulomb without a moment
smooth the friction does not jump
frictionless the friction does not jump
END
run singularities chaos --set kappa=0.09
equal 'parameters count' "$(json count)" 0

# regions
runs regions chaos --r 0.17:0.2:3 --omega -1.05:-1:3
equal 'its rows, of which omega is the inner loop' \
  "$(cut -d , -f 1-3 out | words)" "r,omega,region $(
    )0.17,-1.05,crossing_up 0.17,-1.025,escaping 0.17,-1,codim2 $(
    )0.185,-1.05,crossing_up 0.185,-1.025,escaping 0.185,-1,codim2 $(
    )0.2,-1.05,sliding 0.2,-1.025,crossing_down 0.2,-1,codim2 "
equal 'h = g = 0 has no lambda' "$(sed -n 4p out)" 0.17,-1,codim2,,
within 'A is that of tf_step' "$(row 8 5 out)" 0.0641221403 1e-6
expect 4 'stopped at r = ' regions chaos --r 0:1e9:2 --omega 0:1e9:2
check 'the rows before it are whole' test -z "$(tail -c 1 out)"

# design
json_of design chaos --r 0.1859 --omega -1.037
numbers <<END
kappa 0.27241153714062027818 $close
k2 2.2270992253886014441 $close
END
run design chaos --r 0.25 --omega -1.06
settings=$(sed -n 's/.*"set": "\(.*\)".*/\1/p' out)
# shellcheck disable=SC2086  # two settings are four words
run singularities chaos $settings
within 'its settings are of that two-fold' "$(json r)" 0.25 $close
runs design coulomb --set law=jump --r 0.1859 --omega -1.037

# atlas
runs atlas chaos --r 0.1:0.1859:2 --omega -1.037:-1:2
equal 'its header' "$(head -n 1 out)" "r,omega,v,g,kappa,k2,K++,K+-,K-+,$(
  )K--,J1,J2,K--_positive,K++_negative,J1_negative,J2_negative,$(
  )J1J2_above_1,kappa_positive,k2_positive,overlap"
equal 'no two-fold can be there' "$(sed -n 2p out)" \
  0.1,-1.037,,,,,,,,,,,,,,,,,,0
equal 'the paper'\''s point is in the overlap' "$(row 4 13- out)" \
  1,1,1,1,1,1,1,1
within 'kappa' "$(row 4 5 out)" 0.27241153714062027818 $close
run atlas chaos --r 0.01:1:60 --omega -3:1:61
check 'conditions are those of the numbers' awk -F, '
  NR == 1 { next } NF != 20 { bad = 1 }
  $5 == "" { if ($20 != 0) bad = 1; next }
  { all = 1; for (i = 13; i < 20; i++) all = all && $i
    if ($20 != all) bad = 1
    if ($13 != ($10 > 0) || $14 != ($7 < 0)) bad = 1
    if ($18 != ($5 > 0) || $19 != ($6 > 0)) bad = 1 }
  END { exit bad }' out

# tyre
runs tyre chaos --angle=-45:90:4
equal 'its header' "$(head -n 1 out)" angle,F,M
within 'M at 0, for h > 0' "$(row 3 3 out)" 0.2724115371406203 $close
within 'F at 90 degrees' "$(row 5 2 out)" 1.3333333333333333 $close
within 'F for h < 0 is opposite' "$(row 2 2 out)" "-$(row 4 2 out)" $close

# Refusals.
grid='--r 0:1:2 --omega 0:1:2'
expectations <<END
3 regions smooth $grid|scene smooth: regions needs law jump
3 regions chaos --set law=none $grid|--set law=none: regions needs
3 regions gamma_zero $grid|scene gamma_zero: regions needs |sin(gamma)| in
3 regions chaos --set gamma=0 $grid|--set gamma=0: regions needs
3 atlas gamma_zero $grid|gamma_zero: atlas needs |sin(gamma)|
3 atlas chaos --set law=coulomb $grid|--set law=coulomb: atlas needs law jump
2 design chaos --r 1|--omega W is missing
3 tyre chaos --angle 0:181:2|--angle 0:181:2&[-180, 180] degrees
2 singularities chaos --r 1|unknown option --r
0 singularities chaos --set r=1|--set r=1 has no effect
END
expectations design <<END
3 chaos --r 0.1859 --omega 1|kappa would be -0.27&in [1e-09, 1e+06] m
3 chaos --r 0.05 --omega -2.5|--r 0.05 --omega -2.5: k2 would be -3.7
2 chaos --r 1:2:3 --omega 1|--r 1:2:3
3 chaos --r 0 --omega 1|--r 0: r must not be 0
3 chaos --r 0.1 --omega 1|--r 0.1: k2 does not act
3 chaos --r 0.2 --omega -1|--omega -1: omega must differ from omega0 = -1
3 coulomb --r 0.2 --omega -1.1|scene coulomb: design needs law jump
3 chaos --set mu=0 --r 0.2 --omega -1.1|--set mu=0: design needs mu > 0
3 gamma_right --r 0.2 --omega -1.1|scene gamma_right: design needs |sin(gamma)|
END
expect 0 'kappa=1 has no effect: design finds it' \
  design chaos --r 0.1859 --omega -1.037 --set kappa=1
echo keep >kept
for command in regions atlas; do
  expect 2 '--r A:B:N is missing' $command chaos
  expect 2 '--omega A:B:N is missing' $command chaos --r 0:1:2
done
for range in '' 1 1:2 1:2:3:4 :: 1:2: 1:2:0 1:2:-1 1:2:1.5 1:2:1000001 \
  1:2:1 x:1:2 1:x:2; do
  expect 2 "--r $range" regions chaos --r "$range" --omega 0:1:2 --out kept
done
for range in 1e10:1:2 0:-1e10:2 nan:1:2 0:inf:2; do
  expect 3 "--omega $range&[-1e+09, 1e+09] rad/s" \
    regions chaos --omega "$range" --r 0:1:2 --out kept
done
equal 'a refused command leaves the file alone' "$(cat kept)" keep

# Output that fails.
failing_output 20 atlas chaos --r 0:1:1000 --omega 0:1:1000
finish
