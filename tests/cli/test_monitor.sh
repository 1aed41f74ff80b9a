#!/bin/sh
# test_monitor.sh - `run --format frames` and `monitor`: the rows of a decoded
# stream are those of `run --format csv` byte for byte, what a line breaks is
# left out and counted, and nothing else is taken for a stream.
#
# usage: test_monitor.sh TWOFOLD, from the root of the project

T=${1:?usage: test_monitor.sh TWOFOLD}
case $T in /*) ;; *) T=$PWD/$T ;; esac
document=$PWD/docs/PROTOCOL.md
D=$(mktemp -d) || exit 1
trap 'rm -rf "$D"' EXIT
cd "$D" || exit 1
LC_ALL=C
export LC_ALL

count=0
failed=0
header='t,r,v,omega,h,g,F,M,mode,choices'

# check NAME COMMAND...: the command succeeds.
check() {
  count=$((count + 1))
  name=$1
  shift
  if "$@"; then
    echo "ok $count - $name"
  else
    failed=$((failed + 1))
    echo "not ok $count - $name"
    echo "# failed: $*"
    sed 's/^/#   /' err | head -n 5
  fi
}

# record SCENE OPTION...: the same run as csv and as frames.
record() {
  "$T" run "$@" --out want 2>err && "$T" run "$@" --format frames --out frames \
    2>err
}

# monitor EXIT OPTION...: rows in out, the rest in err.
monitor() {
  wanted=$1
  shift
  "$T" monitor "$@" >out 2>err
  [ $? -eq "$wanted" ]
}

# told TEXT: standard error says so.
told() { grep -qF -e "$1" err; }

# not COMMAND...: it fails.
not() { ! "$@"; }

# The stream comes by a pipe.
# shellcheck disable=SC2002  # a pipe is what is tested
read_pipe() { cat frames | "$T" monitor - --csv >out 2>err; }

# Rows of out that are not in want.
wrong_rows() {
  sort want >a
  sort out | comm -13 a -
}

# The output cannot be written.
full_disk() {
  [ -w /dev/full ] || return 0
  "$T" monitor frames --csv >/dev/full 2>err
  [ $? -eq 4 ]
}

# damage FROM TO: some bytes of the stream are other ones.
damage() {
  head -c "$1" frames
  printf 'garbage%.0s' 1 2 3 4 5
  tail -c "+$(($2 + 1))" frames
}

for scene in $("$T" scenes | cut -d ' ' -f 1); do
  check "$scene: recorded" record "$scene" --t-end 0.5 --every 3
  check "$scene: read" monitor 0 frames --csv
  check "$scene: the same rows" cmp out want
  check "$scene: nothing lost" told '0 lost, 0 broken, 0 too long'
done
check 'located: recorded' record chaos --t-end 3 --scheme located --every 100
check 'located: read' monitor 0 frames --csv --out rows
check 'located: the same rows' cmp rows want
check 'random: recorded' record chaos --t-end 3 --select random:5 --dt 1e-3
check 'a pipe: read' read_pipe
check 'a pipe: the same rows' cmp out want
check 'no steps: recorded' record chaos --t-end 0
check 'no steps: read' monitor 0 frames --csv
check 'no steps: one row' cmp out want

check 'to be damaged: recorded' record chaos --t-end 0.1
size=$(wc -c <frames)
damage $((size / 3)) $((size / 3 + 20)) >bad
check 'damaged: read' monitor 0 bad --csv
missing=$(($(wc -l <want) - $(wc -l <out)))
check 'damaged: rows are left out' [ "$missing" -gt 0 ]
check 'damaged: at most three' [ "$missing" -le 3 ]
check 'damaged: no row is wrong' [ -z "$(wrong_rows)" ]
check 'damaged: it is counted' not told '0 lost, 0 broken'
{ head -c 3000 /dev/zero | tr '\0' x; cat frames; } >bad
check 'garbage in front: read' monitor 0 bad --csv
check 'garbage in front: all rows' cmp out want
check 'garbage in front: counted' told '1 too long'
tail -c +5000 frames >bad
check 'without a schema: read' monitor 0 bad --csv
check 'without a schema: no row' [ "$(cat out)" = "$header" ]
check 'without a schema: counted' not told ' 0 without a match'
cat frames frames >bad
check 'twice: read' monitor 0 bad --csv
check 'twice: a restart, no loss' told '0 lost, 0 broken, 0 too long, 0 of'
check 'twice: a restart' told '1 restarts'
tail -n +2 want | cat want - >both
check 'twice: all rows twice' cmp out both

# The examples of the document: a board in float, whatever this program is.
# shellcheck disable=SC2016  # awk's own variables
bytes_of() {
  awk -v name="$1" '
    $0 == "```hex " name { inside = 1; next }
    /^```/ { inside = 0 }
    inside' "$document" | tr ' ' '\n' | while read -r byte; do
    # shellcheck disable=SC2059  # the format is the byte
    [ -z "$byte" ] || printf "\\$(printf %o "0x$byte")"
  done
}
{
  bytes_of schema
  bytes_of layout
  bytes_of state
  bytes_of report
  bytes_of compact
  bytes_of heartbeat
} >frames
check 'document: read' monitor 0 frames --csv
start='0.099999994,0.18,-0.5,-1.037'
printf '%s\n' "$header" "$start,0,-0.25,0.75,-0.2,stick-,2" \
  "$start,,,,,stick-,2" >want
check 'document: a row of state and report, and one of compact' cmp out want
check 'document: the sender' told 'demo, scene chaos, float, dt = 0.0001 s'
check 'document: the heartbeat' told '1000 steps, 2 overruns, 3 frames dropped'
check 'document: summary alone' monitor 0 frames
check 'document: no rows without --csv' [ ! -s out ]

"$T" run chaos --t-end 0.01 >text 2>err
check 'text is no stream' monitor 4 text --csv
check 'text: told' told 'no frame of protocol version 1'
: >text
check 'an empty file is no stream' monitor 4 text
check 'no such file' monitor 4 missing --csv
check 'no such file: told' told 'missing: No such file or directory'
check 'usage: no source' monitor 2
check 'usage: two sources' monitor 2 a b
check 'usage: unknown option' monitor 2 frames --cvs
check 'usage: the closest' told "did you mean '--csv'?"
check 'usage: --out alone' monitor 2 frames --out x
check 'usage: --baud' monitor 2 frames --baud fast
check 'usage: an option twice' monitor 2 frames --baud 1 --baud 2
check 'usage: the option, told' told '--baud was already given'
check 'usage: value missing' monitor 2 frames --csv --out
for bad in strat set:mu set:muu=1 set:mu=1x select:rand select:random:x \
  input:1,2,3 input:1,2,3,4,5 input:1,,3,4; do
  check "usage: --send $bad" monitor 2 frames --send "$bad"
done
check 'usage: --send, the closest' monitor 2 frames --send strat
check 'usage: --send, told' told "did you mean 'start'?"
check 'help' monitor 0 --help
check 'help: the options' grep -q -e --follow out
check 'a full disk' full_disk

echo "1..$count"
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
