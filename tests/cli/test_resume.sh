#!/bin/sh
# A run that goes on from where another one stands has the rows that one run
# would have, bit for bit; a file that does not belong to it is refused with
# what differs. usage: test_resume.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"

# joined T END EVERY ARGS...: a run to T, and from there to END, joined. The
# last row of the first one is in the whole only where EVERY divides its step.
joined() {
  middle=$1 end=$2 every=$3
  shift 3
  "$T" run "$@" --every "$every" --t-end "$end" --out want 2>err
  whole=$?
  "$T" run "$@" --every "$every" --t-end "$middle" --save at --out one 2>err
  first=$?
  "$T" run "$@" --every "$every" --t-end "$end" --from at --out two 2>err
  second=$?
  # Flagged steps, code 5, lie in one half or in the other.
  [ "$second" -gt "$first" ] && first=$second
  equal "$*: the codes of the halves" "$first" "$whole"
  equal "$*: it begins where the first one ends" "$(tail -n 1 one)" \
    "$(sed -n 2p two)"
  { cat one && tail -n +3 two; } >joined
  grep -q "^$middle," want || {
    { sed '$d' one && tail -n +3 two; } >joined
  }
  check "$*: joined, the same" cmp joined want
}

for scheme in moreau located compensated; do
  joined 1.25 3 1 chaos --scheme $scheme --dt 1e-3
  joined 1.2345 2 10 chaos --scheme $scheme
done
for scene in $("$T" scenes | cut -d ' ' -f 1); do
  joined 1.5 3 100 "$scene"
done
joined 2 3 1 chaos --select random:9 --dt 1e-3
joined 1 2 100 driven --scheme compensated
printf 't,omega0,force\n0,-1,0\n0.4,-1.2,0.1\n1.1,-0.9,0\n' >table.csv
for between in held linear; do
  joined 0.5 1.4 7 chaos --inputs table.csv --between $between
done
# The scheme is that of the file, and told where a run takes another one.
for scheme in moreau located compensated; do
  set -- chaos --dt 0x1p-11
  runs run "$@" --t-end 1 --scheme $scheme --out want
  runs run "$@" --t-end 0.5 --scheme $scheme --save at --out one
  runs run "$@" --t-end 1 --from at --out two
  usual=moreau
  [ "$real" != float ] || usual=compensated
  told="--scheme $scheme, which is that of at"
  [ $scheme = $usual ] || check "$scheme is told" says "$told"
  [ $scheme != $usual ] || check "$scheme is usual" not says "$told"
  equal "goes on by $scheme" "$(tail -n +3 two)" "$(tail -n 1024 want)"
done
echo 'based-on chaos' >mine.scene
runs run chaos --t-end 1 --save at --out one
runs run mine.scene --from at --t-end 2
check 'a scene by another name goes on' says 'scene      mine&10000 of them'
runs run chaos --from at --t-end 1
equal 'nothing left to do: one row' "$(wc -l <out)" 2

# In frames, too: the ticks go on.
runs run chaos --from at --t-end 1.01 --format frames --out frames
runs monitor frames --format csv --out rows
runs run chaos --from at --t-end 1.01
check 'frames go on' cmp rows out

# What ends a run does not lose where it stands.
rm -f at
interrupt TERM big 100 run chaos --t-end 1e9 --every 1000 --save at --out big
check 'a signal: where it stands is written' [ -s at ]
tick=$(sed -n 's/^tick //p' at)
runs run chaos --from at --t-end "$(awk -v n="$tick" 'BEGIN {
  printf "%.10g", (n + 1) * 1e-4 }')"
equal 'and it goes on' "$(sed -n 2p out)" "$(tail -n 1 big.part)"

# A full disk: no state whose rows are in no file.
rm -f at
(
  ulimit -f 8 || exit 4
  exec "$T" run chaos --t-end 1 --save at --out quota 2>err
)
equal 'a full disk: code' $? 4
check 'a full disk: no state' [ ! -e at ]
check 'and that is told' says '--save at: not written&did not reach quota'

# What differs.
runs run chaos --t-end 0.5 --save at --out one
cp at before
printf 't,force\n0,0\n' >force.csv
runs run chaos --t-end 0.1 --inputs force.csv --between held --save driven
expectations run <<'WORDS'
0 chaos --from driven --t-end 0.2|came there with --inputs, and goes on without
0 chaos --from at --inputs force.csv --between held --t-end 1|came there without
0 chaos --from driven --inputs force.csv --t-end 1 --between linear|with another
3 chaos --from at --set kappa=0.3|kappa is 0.27&there and 0.3 here
3 chaos --from at --dt 1e-3|dt is 0.0001 there and 0.001 here
3 chaos --from at --set law=coulomb|law is jump there and coulomb here
3 chaos --from at --set rest=square|rest is hull there and square here
3 chaos --from at --select slip+|rule is persist there and slip+ here
3 chaos --from at --scheme located|scheme is moreau there and located here
3 rolling --from at|with-angle is no there and yes here
3 chaos --from at --t-end 0.4|it stands at t = 0.5 s, after the end at 0.4 s
2 chaos --from at --set r=0.2|--set r=0.2: --from at gives the state
2 chaos --from none|--from none: No such file
2 chaos --from .|--from .: Is a directory
2 chaos --from one|--from one: no file of --save
2 chaos --from=|the name of the file is empty
4 chaos --save /nowhere/at --out one|/nowhere/at
WORDS
cmp -s at before
result $? 'what is refused writes nothing'
runs run chaos --t-end 0.1 --select random:9 --save drawn --out one
expect 3 'the seed is 9 there and 7 here' \
  run chaos --from drawn --select random:7
runs run driven --t-end 0.1 --save drives --out one
sed 's/^profile.*/profile none/; /^crc/d' drives >other
expect 3 'cut off or changed: its checksum is wrong' run driven --from other
# The checksum is right, and no run has left such a state.
while IFS='|' read -r change texts; do
  sed "/^crc32/d; $change" at >forged
  echo "crc32 $(crc32 <forged)" >>forged
  expect 3 "$texts" run chaos --from forged --t-end 0.6
done <<'END'
s/^twofold-state 3/twofold-state 2/|its version (run up to it again, with -
s/^r .*/r nan/|--from forged: r is not finite
s/^compensation-w .*/compensation-w inf/|compensation-w is not finite
s/^delassus .*/delassus 1e999/|delassus is not finite
s/^omega .*/omega 1e10/|beyond 1e+09
END
sed '/^crc32/d' at >forged
printf 'junk\0' >>forged
echo "crc32 $(crc32 <forged)" >>forged
expect 3 'cut off or changed' run chaos --from forged --t-end 0.6
head -c 400 at >short
expect 3 'cut off or changed' run chaos --from short
finish
