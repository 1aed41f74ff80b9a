#!/bin/sh
# test_hil.sh - a controller in one process, the host port's firmware in
# another, a pseudo-terminal between them: the closed loop is that of a pure
# run, in real time and in lockstep; and a loop that is not is found out.
#
# usage: test_hil.sh TWOFOLD, from the root of the project; `make test` has made
# BUILD/REAL/hil and the firmware in $FIRMWARE-REAL/firmware-line.elf

T=${1:?usage: test_hil.sh TWOFOLD}
builds=${T%/*/twofold}
firmware=${FIRMWARE:-build/boards/host/chaos}
D=$(mktemp -d) || exit 1
board=
finish() {
  [ -z "$board" ] || kill "$board" 2>/dev/null
  rm -rf "$D"
}
trap finish EXIT
count=0
failed=0

check() {
  count=$((count + 1))
  name=$1
  shift
  if "$@"; then
    echo "ok $count - $name"
  else
    failed=$((failed + 1))
    echo "not ok $count - $name"
    sed 's/^/# /' "$D/out"
  fi
}

# plug REAL: a board on a line, whose name is in $line.
plug() {
  : >"$D/said"
  TWOFOLD_PORT=pty "$firmware-$1/firmware-line.elf" 2>"$D/said" </dev/null &
  board=$!
  tries=0
  until line=$(grep -o '^/dev/.*' "$D/said") || [ "$tries" -eq 200 ]; do
    tries=$((tries + 1))
    sleep 0.05
  done
}
unplug() {
  kill "$board"
  wait "$board"
  board=
}

# drive REAL CODE OPTION...: whether `hil` ends with that code.
drive() {
  program=$builds/$1/hil code=$2
  shift 2
  "$program" "$line" --steps 600 --every 10 "$@" >"$D/out" 2>&1
  [ $? -eq "$code" ]
}

for real in double float; do
  plug "$real"
  check "$real: in real time" drive "$real" 0
  check "$real: told" grep -q 'states .* inputs: the same bits' "$D/out"
  check "$real: late inputs" drive "$real" 0 --delay 0
  check "$real: late inputs are told" grep -q '[1-9][0-9]* late' "$D/out"
  check "$real: in lockstep" drive "$real" 0 --lockstep --csv "$D/one"
  check "$real: in lockstep again" drive "$real" 0 --lockstep --csv "$D/two"
  check "$real: lockstep hangs on no clock" cmp "$D/one" "$D/two"
  check "$real: another wish" drive "$real" 0 --lockstep --speed -0.8 \
    --csv "$D/two"
  # shellcheck disable=SC2016  # the inner shell expands
  check "$real: is another motion" sh -c '! cmp -s "$1" "$2"' sh \
    "$D/one" "$D/two"
  # The other real type is not one to compare with.
  other=float
  [ "$real" = double ] || other=double
  check "$real: not with $other" drive "$other" 3
  # A machine that is not the scene's is found by its hash.
  "$T" monitor "$line" --send set:mu=1.5 >"$D/out" 2>&1
  check "$real: other parameters" drive "$real" 3
  unplug
done
line=/dev/null
check 'no board' drive double 4
usage() {
  "$builds/double/hil" >"$D/out" 2>&1
  [ $? -eq 2 ]
}
check 'usage: no device' usage
check 'usage: delay' drive double 2 --delay 21
check 'usage: number' drive double 2 --speed fast
echo "1..$count"
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
