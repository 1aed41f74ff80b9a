#!/bin/sh
# `run --format frames` and `monitor`: the rows of a decoded stream are those of
# `run --format csv` byte for byte, what a line breaks is left out and counted,
# and nothing else is taken for a stream. usage: test_monitor.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
header='t,r,v,omega,h,g,F,M,mode,choices'

# record SCENE OPTION...: the same run as csv and as frames.
record() {
  runs run "$@" --out want
  runs run "$@" --format frames --out frames
}

# decodes NAME FILE WANTED TEXT [CODE]: the stream has these rows, and the
# summary says so.
decodes() {
  expect "${5-0}" "$4" monitor "$2" --csv
  check "$1: the rows" cmp out "$3"
}

# bytes_of NAME...: examples of the document.
bytes_of() {
  for name; do
    awk -v name="$name" '
      $0 == "```hex " name { inside = 1; next }
      /^```/ { inside = 0 }
      inside' "$root/docs/PROTOCOL.md" | tr ' ' '\n' | while read -r byte; do
      # shellcheck disable=SC2059  # the format is the byte
      [ -z "$byte" ] || printf "\\$(printf %o "0x$byte")"
    done
  done
}

# Whole streams.
for scene in $("$T" scenes | cut -d ' ' -f 1); do
  record "$scene" --t-end 0.5 --every 3
  decodes "$scene" frames want '0 lost, 0 broken, 0 too long'
done
record chaos --t-end 3 --scheme located --every 100
runs monitor frames --csv --out rows
check 'located: the same rows' cmp rows want
record chaos --t-end 3 --select random:5 --dt 1e-3
# shellcheck disable=SC2002  # a pipe is what is tested
cat frames | "$T" monitor - --csv >out 2>err
equal 'a pipe: read' $? 0
check 'a pipe: the same rows' cmp out want
record chaos --t-end 0.1 --scheme compensated
decodes 'compensated' frames want ''
for scheme in moreau located compensated; do
  "$T" run chaos --t-end 0 --scheme $scheme --format frames 2>err |
    head -c 40 | cksum
done | sort -u >schemas
equal 'the schema tells the three schemes apart' "$(wc -l <schemas)" 3
record chaos --t-end 0
decodes 'no steps: one row' frames want ''

# Interrupted within a pipe, which has no end that anyone knows, is read; what
# was read of a file is not whole.
mkfifo pipe
"$T" monitor pipe --csv --out live 2>err &
pid=$!
exec 3>pipe
cat frames >&3
poll has_lines live.part "$(wc -l <want)"
kill $pid
wait $pid
equal 'a pipe is read until the signal' $? 0
exec 3>&-
check 'a pipe: the file is whole' cmp -s live want

# Streams that a line broke.
record chaos --t-end 0.1
size=$(wc -c <frames)
{ head -c 3000 /dev/zero | tr '\0' x; cat frames; } >bad
decodes 'garbage in front' bad want '1 too long' 6
tail -c +5000 frames >bad
echo "$header" >none
decodes 'without a schema' bad none '' 6
check 'without a schema: counted' not says ' 0 without a match'
head -c $((size - 1)) frames >bad
decodes 'without the last zero: whole' bad want '0 lost, 0 broken'
# A run that was cut, or repeated: tests/line/test_whole.py.

# Steps that are not to be trusted: the words and the exit code are those of the
# run, whether reports, the heartbeat at the end or both tell of them.
heartbeat=95 # bytes
degraded() { sed -n 's/first reported at/first at/; /^degraded /p' err; }

# coarse OPTION...: a run of coarse steps as frames.
coarse() {
  expect 5 ' coarse, 0 stalled, 0 fell' run chaos --set k2=1e6 --dt 1e-3 \
    --format frames --out frames "$@"
  size=$(wc -c <frames)
}

coarse --t-end 0.1
said=$(degraded)
expect 5 'board      100 steps, 0 overruns' monitor frames
equal 'coarse: the words of the run' "$(degraded)" "$said"
head -c $((size - heartbeat)) frames >bad
expect 6 'ends before its run' monitor bad --csv --out rows
equal 'coarse: reports alone' "$(degraded)" "$said"
check 'coarse: all rows are in the part' [ "$(wc -l <rows.part)" -eq 102 ]
bytes_of heartbeat >bad
expect 5 '4 steps; 1 coarse, 3 stalled, 0 fell back on moreau' monitor bad
check 'coarse: the time is not known' not says 'first'

# A board that stands still repeats its last row, which counts once.
coarse --t-end 0.01 --every 10
small=$size
coarse --t-end 0.01 --every 5
row=$((size - small))
head -c $((size - heartbeat)) frames >still
said=$("$T" monitor still 2>&1 >rows | sed -n '/^degraded/p')
tail -c $row still >again
cat still again >bad
expect 6 '4 rows, 0 without a match&1 restarts' monitor bad
equal 'a board that stands still: counted once' \
  "$(sed -n '/^degraded/p' err)" "$said"

# A board in float, whatever this program is.
bytes_of schema layout state report compact heartbeat >frames
start='0.099999994,0.18,-0.5,-1.037'
printf '%s\n' "$header" "$start,0,-0.25,0.75,-0.2,stick-,2" \
  "$start,,,,,stick-,2" >want
decodes 'a row of state and report, and one of compact' frames want \
  "demo, scene chaos, float, dt = 0.0001 s&1000 steps, 2 overruns, 93 ticks $(
  )without a step, 3 frames dropped&a step takes 5200 to 9100 ns" 5
expect 5 '' monitor frames
check 'no rows without --csv' [ ! -s out ]

# A stream of another version of the protocol: `describe` of version 2.
printf '\0\3\2\112\1\1\1\1\1\1\1\1\1\1\1\1\1\261\327\362\327\214\0' >old
expect 4 'old: its protocol is version 2, here it is 3: build what sends it' \
  monitor old

# A report whose F is not a number: the row is written, and reported.
{
  bytes_of schema state
  printf '\0\5\3\4\35\3\1\1\3\350\3\1\1\1\1\1\1\1\1\1\1\1\3\200\276\1\7\300\177'
  printf '\315\314\114\276\1\1\2\100\1\1\1\4\3\30\2\1\1\367\270\361\371\200\0'
} >bad
expect 6 'values     1 rows with one that is not finite, first at step 1000' \
  monitor bad --csv
check 'not finite: the row is there' grep -q ',nan,.*stick-,2$' out

# What is not a stream, and what cannot be understood.
"$T" run chaos --t-end 0.01 >text 2>err
: >empty
expectations monitor <<END
4 text --csv|no frame of protocol version 3
4 empty|
4 missing --csv|missing: No such file or directory
2 |
2 a b|
2 frames --out x|only with --format
2 frames --as json --csv|one format at a time
2 frames --baud fast|
2 frames --send strat|did you mean 'start'?
END
for bad in set:mu set:muu=1 set:mu=1x select:rand select:random:x \
  input:1,2,3 input:1,2,3,4,5 input:1,,3,4; do
  expect 2 '' monitor frames --send "$bad"
done
full_device monitor frames --csv
finish
