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

runs run chaos --dt 1e-3 --replay record --out again
check 'what it did is told' says 'record: 12 commands took effect, 1 states'
# The first row is the start, which a board does not send.
tail -n +2 rows | sort -u >sent
tail -n +2 again | sort -u >had
equal 'every row of the board is in the replay' \
  "$(comm -23 sent had | head -n 2)" ''
check 'there were enough of them' [ "$(wc -l <sent)" -gt 1000 ]
equal 'the last row is the same' "$(tail -n 1 again)" \
  "$(grep "^$(tail -n 1 again | cut -d , -f 1)," rows | tail -n 1)"

# What is not the session is found out.
runs run chaos --dt 1e-3 --out plain
check 'without the commands: another motion' not cmp -s plain again
sed '/input:-1.5/d' record >other
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
sed 's/,44,,start/,44,0g,start/' record >bad
expect 2 'bad:&no record of' run chaos --dt 1e-3 --replay bad
sed '/^#/d; s/^[0-9]*\(,42.*kappa\)/0\1/' record >early
expect 3 'early: row 2 is at step 0, when the board has taken' \
  run chaos --dt 1e-3 --replay early
finish
