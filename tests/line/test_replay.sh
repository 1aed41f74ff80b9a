#!/bin/sh
# The session of a board, with commands while it runs, is replayed on the host
# to the bit: every row that the board sent is a row of the replay, and its last
# state is compared. `make test` has made the firmware.
# usage: test_replay.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
firmware=${FIRMWARE:-build/boards/host/chaos}
case $firmware in /*) ;; *) firmware=$root/$firmware ;; esac
board=
at_exit() { [ -z "$board" ] || kill "$board" 2>/dev/null; }
named() { line=$(grep -o '^/dev/.*' said); }

check "make test has made $firmware-$real/firmware-line.elf" \
  test -x "$firmware-$real/firmware-line.elf"
TWOFOLD_PORT=pty "$firmware-$real/firmware-line.elf" 2>said </dev/null &
board=$!
check 'a board on a line' poll named

# Each command waits for the answer to the one before. The record goes on until
# the rows do.
"$T" monitor "$line" --csv --out rows --record record \
  --send input:-1.5,0.12,0.2,-0.01 --send set:kappa=0.3 --send deadman:50 \
  --send input:-0.7,0.1,0,0 --send snapshot --send select:random:7 \
  --send set:mu=1.25 --send stop --send start --send restore --send input \
  --send set:mu=-1 --send set:rate=100 2>told &
monitor=$!
answered() { grep -q 'set:rate=100: took effect' told && has_lines "$1" 1500; }
check 'all commands are answered' poll answered rows.part
kill -s INT $monitor
wait $monitor
kill "$board"
wait "$board"
board=
cp told err
check 'one was refused' grep -q 'set:mu=-1: refused' told
equal 'the record has those that took effect' \
  "$(grep -c '^[0-9]*,4[0-9a-f],' record)" 12
check 'and a state' grep -q ',03,.*,state$' record

# A step that passes by h = g = 0 may say so: when depends on the commands.
run run chaos --dt 1e-3 --replay record --save at --out again
check 'the record is replayed' test "$code" = 0 -o "$code" = 5
check 'what it did is told' says 'record: 12 commands took effect, 1 states'
# The first row is the start, which a board does not send.
tail -n +2 rows | sort -u >sent
tail -n +2 again | sort -u >had
equal 'every row of the board is in the replay' \
  "$(comm -23 sent had | head -n 2)" ''
check 'there were enough of them' [ "$(wc -l <sent)" -gt 1000 ]
equal 'the last row is the same' "$(tail -n 1 again)" \
  "$(grep "^$(tail -n 1 again | cut -d , -f 1)," rows | tail -n 1)"
needs=$(sed -n 's/^ *which now needs//p' err)
# shellcheck disable=SC2086  # a list of options
run run chaos --dt 1e-3 $needs --from at --t-end 60
equal 'and another run goes on from there' "$(sed -n 2p out)" \
  "$(tail -n 1 again)"
if [ -x /usr/bin/python3 ]; then
  TWOFOLD=$T "$root/tests/line/replayed.py" >said
  result $? 'what is saved goes on to the bit' "$(grep '^not' said)"
else
  lacks 'what is saved goes on to the bit' python3
fi

# Every row counts, and nothing may follow.
check 'the record tells its rows' grep -Eqx \
  '# shard 1/1: 14 rows, crc32 [0-9a-f]{8}, run [0-9a-f]{8}' record
lines=$(wc -l <record)
i=0
while [ $((i += 1)) -lt "$lines" ]; do
  head -n $i record >short
  expect "$([ $i -lt 3 ] && echo 2 || echo 3)" "$(
    [ $i -lt 3 ] && echo 'no record of' || echo 'cut off or changed'
  )" run chaos --dt 1e-3 --replay short
done
head -c -20 record >short
expect 3 'cut off or changed' run chaos --dt 1e-3 --replay short
cat record record >twice
expect 3 'cut off or changed' run chaos --dt 1e-3 --replay twice

# sealed: with the last line that its rows ask for.
sealed() {
  grep -v '^#' >rows_of_it
  cat rows_of_it
  echo "# shard 1/1: $(($(wc -l <rows_of_it) - 1)) rows, crc32 $(
    crc32 <rows_of_it), run $(sed -n 2p rows_of_it | tr -d '\n' | crc32)"
}
sealed <record >other
equal 'sealed again: the same' "$(cat other)" "$(tail -n +2 record)"

# What is not the session is found out.
runs run chaos --dt 1e-3 --out plain
check 'without the commands: another motion' not cmp -s plain again
sed '/input:-1.5/d' record | sealed >other
expect 4 'other: row&the state is not that of the board' \
  run chaos --dt 1e-3 --replay other
expectations run <<'WORDS'
3 chaos --dt 1e-4 --replay record|of the board have the hash&--dt 1/RATE
3 chaos --dt 1e-3 --scheme located --replay record|of the board is moreau
3 coulomb --dt 1e-3 --replay record|have the hash
2 chaos --dt 1e-3 --replay record --t-end 1|not with --t-end
2 chaos --dt 1e-3 --replay record --from x|not with --from
2 chaos --dt 1e-3 --replay rows|rows:1: no record
2 chaos --dt 1e-3 --replay none|none: No such file
WORDS
sed 's/,44,,start/,44,0g,start/' record | sealed >bad
expect 2 'bad:&no record of' run chaos --dt 1e-3 --replay bad
sed 's/^[0-9]*\(,42.*kappa\)/0\1/' record | sealed >early
expect 3 'early: row 2 is at step 0, when the board has taken' \
  run chaos --dt 1e-3 --replay early
# More steps than there are, whose sum passes 2^64.
{
  head -n 3 record
  for i in 1 2 3 4; do
    echo 9000000000000000000,46,,reset
  done
} | sealed >long
expect 3 'long: more than 1e15 steps' run chaos --dt 1e-3 --replay long
# A zero hides what follows it from most readers.
sed 's/,stop$/,st\x00op/' record >bad
expect 2 'bad:&no record of' run chaos --dt 1e-3 --replay bad
finish
