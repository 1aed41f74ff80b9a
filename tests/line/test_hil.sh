#!/bin/sh
# A controller in one process, the host port's firmware in another, a
# pseudo-terminal between them: the closed loop is that of a pure run, in real
# time and in lockstep, and a loop that is not is found out. `make test` has
# made BUILD/REAL/hil and the firmware $FIRMWARE-REAL/firmware-line.elf.
# usage: test_hil.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
builds=${T%/*/twofold}
firmware=${FIRMWARE:-build/boards/host/chaos}
case $firmware in /*) ;; *) firmware=$root/$firmware ;; esac
board=
at_exit() { [ -z "$board" ] || kill "$board" 2>/dev/null; }

# plug REAL: a board on a line, whose name is in $line.
named() { line=$(grep -so '^/dev/.*' said); }
plug() {
  rm -f said # the last board's, until the shell of this one empties it
  TWOFOLD_PORT=pty "$firmware-$1/firmware-line.elf" 2>said </dev/null &
  board=$!
  poll named
}
unplug() {
  kill "$board"
  wait "$board"
  board=
}

# drive NAME CODE REAL OPTION...: whether `hil` ends with that code.
drive() {
  name=$1 want=$2 program=$builds/$3/hil
  shift 3
  "$program" "$line" --steps 600 --every 10 "$@" >err 2>&1
  equal "$name" $? "$want"
}

for real in double float; do
  other=float
  [ $real = double ] || other=double
  check "$real: a board on a line" plug $real
  drive "$real: in real time" 0 $real
  check "$real: states and inputs are counted" \
    grep -q 'states .* inputs: the same bits' err
  drive "$real: late inputs" 0 $real --delay 0
  check "$real: late inputs are reported" grep -q '[1-9][0-9]* late' err
  drive "$real: in lockstep" 0 $real --lockstep --csv one
  drive "$real: in lockstep again" 0 $real --lockstep --csv two
  check "$real: lockstep depends on no clock" cmp one two
  drive "$real: another speed is asked for" 0 $real --lockstep --speed -0.8 \
    --csv two
  check "$real: and is another motion" not cmp -s one two
  # No room for the rows: what was there stays, and the loop says so.
  cp one kept
  (
    trap '' XFSZ
    ulimit -f 8
    exec "$builds/$real/hil" "$line" --steps 600 --every 10 --lockstep \
      --csv kept >err 2>&1
  )
  equal "$real: no room for the rows" $? 4
  check "$real: it says so" grep -q 'kept: File too large' err
  check "$real: the rows of before are there" cmp one kept
  # A controller that fails: its last input expires, here as in the twin. Where
  # a busy computer delivers inputs late, an earlier one may expire as well.
  while IFS='|' read -r how times; do
    # shellcheck disable=SC2086  # options
    drive "$real: silent after a while, $how" 0 $real $how --silent 200 \
      --deadman 100
    check "$real: the inputs expire, $how" \
      grep -q "held for 100 steps, expired $times times" err
  done <<'END'
--lockstep|1
--delay 20|[1-9]
END
  # Inputs that never come in time.
  drive "$real: too slow" 0 $real --lockstep --every 20 --deadman 5 --csv slow
  check "$real: each expires" grep -q 'expired 30 times' err
  drive "$real: without a dead-man" 0 $real --lockstep --silent 200 --deadman 0
  check "$real: none expires" grep -q 'without end, expired 0 times' err
  # The first constant of SipHash, as this kind of processor has it in code.
  [ "$(uname -m)" != x86_64 ] || {
    check "$real: hil can make tags" grep -q uespemos "$builds/$real/hil"
    check "$real: firmware without a key contains nothing of them" \
      not grep -q uespemos "$firmware-$real/firmware-line.elf"
  }
  drive "$real: does not compare with $other" 3 $other
  # A machine that is not the scene's is found by its hash.
  run monitor "$line" --send set:mu=1.5
  drive "$real: other parameters" 3 $real
  unplug
done
# Over a line that repeats and loses frames: see relays.py.
TWOFOLD=$T HIL=$builds/double/hil FIRMWARE=$firmware-double/firmware-line.elf
export TWOFOLD HIL FIRMWARE
relays=$root/tests/line/relays.py
if [ -x /usr/bin/python3 ]; then
  for name in $("$relays"); do
    "$relays" "$name" >err 2>&1
    result $? "$name" "failed: $relays $name"
  done
else
  lacks 'a relay on the line' python3
fi
line=/dev/null
drive 'no board' 4 double
drive 'usage: delay' 2 double --delay 21
drive 'usage: number' 2 double --speed fast
"$builds/double/hil" >err 2>&1
equal 'usage: no device' $? 2
finish
