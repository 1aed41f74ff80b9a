#!/bin/sh
# What is interrupted leaves nothing: no process, however it was started and
# whatever it ignores, and nothing temporary. usage: test_drive.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
drive=$root/tools/drive
if ! command -v setsid >/dev/null; then
  lacks 'interrupted drivers leave nothing' util-linux
  finish
  exit
fi

# Processes that were started here know this folder by their environment.
MARK="$D/[m]ark"
left() { grep -la "$MARK" /proc/[0-9]*/environ 2>/dev/null; }
none_left() { [ -z "$(left)" ]; }
has_left() { [ "$(left | wc -l)" -ge "$1" ]; }

# stopped NAME SIGNAL CODE COUNT COMMAND...: the signal comes when COUNT
# processes run, and ends them all.
stopped() {
  name=$1 signal=$2 want=$3 count_wanted=$4
  shift 4
  mkdir -p tmp
  # A shell's background jobs ignore SIGINT; what a terminal starts does not.
  env --default-signal=INT,QUIT MARKED="$D/mark" TMPDIR="$D/tmp" "$@" \
    >out 2>err &
  pid=$!
  check "$name, SIG$signal: processes run" poll has_left "$count_wanted"
  kill -s "$signal" $pid
  wait $pid
  equal "$name, SIG$signal: code" $? "$want"
  check "$name, SIG$signal: no process is left" poll none_left
  equal "$name, SIG$signal: nothing temporary is left" "$(ls -A tmp)" ''
}

# In the background, in a group of their own, deaf, and deaf in another driver.
cat >many <<'END'
touch "$(mktemp)"
sleep 1000 &
timeout 1000 sleep 1000 &
sh -c 'trap "" TERM INT HUP; sleep 1000; sleep 1000' &
"$1" sh -c 'sleep 1000 & mktemp; exec timeout 1000 sleep 1000'
END
stopped 'a script' TERM 143 10 "$drive" sh many "$drive"
GRACE=2
export GRACE
stopped 'a script' INT 130 10 "$drive" sh many "$drive"
stopped 'a script' HUP 129 10 "$drive" sh many "$drive"
stopped 'a script' QUIT 131 10 "$drive" sh many "$drive"
stopped 'a script' USR1 138 10 "$drive" sh many "$drive"
unset GRACE
"$drive" sh -c 'mktemp >name; exit 7'
equal 'a command that ends by itself: its code' $? 7
check 'a command that ends by itself: its files' [ ! -e "$(cat name)" ]
# shellcheck disable=SC2016  # expanded by the script
"$drive" sh -c 'MARKED=$1 sleep 1000 &' - "$D/mark"
check 'a command that leaves a process behind' none_left

# Checks and tests, where they are in the middle of a build or of a test.
unset MAKEFLAGS MAKELEVEL MFLAGS MAKEOVERRIDES DRIVEN
for signal in TERM INT; do
  stopped 'checks' $signal "$([ $signal = TERM ] && echo 143 || echo 130)" 8 \
    env BUILD="$D/build" "$root/tools/verify/check/run" sanitize-gcc gcc
done
cat >slow.sh <<'END'
. "$0.tap"
sleep 1000 &
"$T" run chaos --t-end 1e9 --out "$D/x" &
wait
END
ln -s "$root/tests/support/tap.sh" slow.sh.tap
for signal in TERM INT HUP; do
  TWOFOLD=$T
  export TWOFOLD
  stopped 'tests' $signal 130 5 "$root/tests/run" slow.sh
done
finish
