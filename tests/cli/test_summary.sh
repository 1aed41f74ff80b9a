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
    "['slip_to_stick', 'codimension_two']"
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
  equal 'a refusal is told' "$(field end) $(field exit)" 'refused 4'
else
  lacks 'the summary is JSON' python3
fi

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
runs run chaos --t-end 0.01 --format frames --out frames
run monitor frames --csv --out rows
hash=$(sed -n 's/.*parameters \([0-9a-f]*\),.*/\1/p' told)
check 'the hash is that of the frames' says "$hash"
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
