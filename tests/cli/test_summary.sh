#!/bin/sh
# What programs read: the summary as JSON, and rows that say what they are of
# in a form that numpy, R and gnuplot skip. usage: test_summary.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
python=/usr/bin/python3

# The summary is one line, the last one, whatever comes before it.
runs run chaos --t-end 3 --every 100 --summary json --set rate=3 --out rows
tail -n 1 err >told
check 'one line' [ "$(grep -c '^{' err)" -eq 1 ]
check 'after the notes' says 'note: --set rate=3 has no effect'
if [ -x $python ]; then
  # field NAME: of the summary, as Python writes it.
  field() {
    $python -c 'import json, sys
value = json.load(open("told"))
for key in sys.argv[1].split("."):
    value = value[int(key) if key.isdigit() else key]
print(value)' "$1"
  }
  equal 'the scene' "$(field scene)" chaos
  equal 'the steps' "$(field steps)" 30000
  equal 'the end' "$(field end)" 'done'
  equal 'the state has all digits' "$(field final.r)" \
    "$(tail -n 1 rows | cut -d , -f 2)"
  equal 'the two-fold' "$(field events.two_fold)" 1
  equal 'the first event' "$(field events.list.0.kinds)" \
    "['slip_to_stick', 'codim2']"
  "$T" run driven --t-end 1 --every 100 --out rows --summary json 2>told
  equal 'the profile' "$(field profile.rows)" 5
  printf 't,force\n0,1\n' >'a "b" \.csv'
  "$T" run chaos --t-end 1 --out rows --summary json --between held \
    --inputs 'a "b" \.csv' 2>told
  equal 'a path is quoted' "$(field inputs.name)" 'a "b" \.csv'
  "$T" run chaos --t-end 1 --dt 0.01 --out rows --summary json 2>told
  equal 'the exit code' "$(field exit)" $?
  "$T" run chaos --set v=9e8 --dt 0.1 --summary json >rows 2>err
  equal 'a refusal: code' $? 4
  tail -n 1 err >told
  equal 'a refusal is reported' "$(field end) $(field exit)" 'refused 4'
  "$T" sweep chaos --over mu=1:2:3 --over r=0:1e9:2 --t-end 0.1 --out rows \
    --summary json 2>told
  equal 'sweep: points' "$(field points) $(field 'done') $(field kept)" \
    "6 $(grep -c ',done,' rows) 0"
  equal 'sweep: build' "$(field version) $(field number)" "$("$T" --version |
    sed 's/twofold \(.*\), .* is /\1 /')"
  "$T" diverge chaos --samples 3 --cycles 2 --returns rows --summary json 2>told
  equal 'diverge: samples' "$(field samples) $(field 'done') $(field cycles)" \
    "3 3 $(grep -c '^[0-9]' rows)"
  "$T" diverge chaos --exhaustive --depth 1 --grid 0.1 --patience 1 \
    --branches rows --summary json 2>told
  equal 'all branches' "$(field branches)" "$(grep -c '^[0-9]' rows)"
  "$T" run chaos --t-end 0.005 --format frames --out frames 2>err
  "$T" monitor frames --csv --summary json --out rows 2>told
  equal 'monitor: rows' "$(field rows) $(field last.step) $(field exit)" \
    "$(grep -c '^[0-9]' rows) 50 0"
  equal 'what a two-fold is of' \
    "$("$T" singularities chaos >told && field parameters) $(field units.r)" \
    "$("$T" monitor frames --summary json 2>told && field parameters) m"
else
  lacks 'the summary is JSON' python3
fi

# A terminal shows how long a job still takes.
for words in 'diverge chaos --samples 1000 --cycles 1000 --returns rows' \
  'diverge chaos --exhaustive --grid 1e-6 --count 1000000 --branches rows' \
  'sweep chaos --over mu=1:2:100000 --out rows' \
  'run chaos --t-end 1e6 --every 1000000 --out rows'; do
  [ -x $python ] || continue
  rm -f rows.part
  # shellcheck disable=SC2086  # a list of words
  check "time left: $words" $python -c 'import os, pty, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], sys.argv[1:])
seen = b""
while b" s left" not in seen:
    seen += os.read(terminal, 4096)
os.kill(pid, 9)' "$T" $words
done

# Four comment lines; without them the file is the same.
set -- run chaos --t-end 0.2 --every 10
runs "$@" --out plain
runs "$@" --provenance --out told
tail -n +5 told >rest
check 'below the comments: the same rows' cmp rest plain
equal 'comments' "$(head -n 4 told | grep -c '^# ')" 4
check 'version, type' \
  grep -q "^# twofold [0-9.]*, commit .*, numbers are $real\$" told
check 'scene, rule' \
  grep -q '^# scene chaos, parameters [0-9a-f]\{8\}, law jump, rule' told
check 'scheme, step' grep -q '^# scheme moreau, dt 0.0001 s' told
check 'units' grep -q '^# units: t s, r m, v m/s, omega rad/s, h m/s' told
runs run chaos --t-end 0.005 --format frames --out frames
run monitor frames --csv --out rows
hash=$(sed -n 's/.*parameters \([0-9a-f]*\),.*/\1/p' told)
check 'the hash is that of the frames' says "$hash"
# The other files of rows: the same lines, and without them the same file.
for words in 'regions chaos --r 0.1:0.2:2 --omega=-1:1:2' \
  'atlas chaos --r 0.1:0.2:2 --omega=-1.1:-1.05:2' \
  'diverge chaos --samples 3 --returns -' \
  'diverge chaos --samples 3 --by noise --size 1e-4 --exits -' \
  'diverge chaos --exhaustive --depth 1 --grid 0.1 --patience 1' \
  'monitor frames --csv'; do
  # shellcheck disable=SC2086  # a list of words
  set -- $words
  runs "$@"
  mv out plain
  runs "$@" --provenance
  head -n 4 out >comments
  tail -n +5 out >rest
  check "$1: below the comments the same rows" cmp rest plain
  equal "$1: version, commit, scene, units" "$(grep -c \
    -e '^# twofold .*commit' -e '^# scene chaos, parameters' -e '^# units: ' \
    comments)" 3
done
set -- run chaos --t-end 0.2 --every 10
expect 2 '--provenance: only with --format csv' "$@" --provenance \
  --format plotter
expect 2 '--summary xml: must be text or json' "$@" --summary xml
if $python -c 'import numpy' 2>/dev/null; then
  $python -c 'import numpy
one = numpy.genfromtxt("told", delimiter=",", names=True, dtype=None,
                       encoding="ascii", skip_header=4)
two = numpy.loadtxt("told", delimiter=",", usecols=range(8), skiprows=5)
assert one.dtype.names[:3] == ("t", "r", "v") and len(one) == len(two) == 201
assert (one["r"] == two[:, 1]).all()' 2>err
  result $? 'numpy reads it'
else
  lacks 'numpy reads it' python3-numpy
fi
if command -v gnuplot >/dev/null; then
  gnuplot -e 'set datafile separator ","; set key autotitle columnhead;
    stats "told" using 1:2 nooutput; print STATS_records' 2>err
  equal 'gnuplot reads it' "$(tail -n 1 err)" 201
else
  lacks 'gnuplot reads it' gnuplot-nox
fi
if command -v Rscript >/dev/null; then
  equal 'R reads it' "$(Rscript -e \
    'cat(nrow(read.csv("told", comment.char = "#")))')" 201
else
  lacks 'R reads it' r-base-core
fi
finish
