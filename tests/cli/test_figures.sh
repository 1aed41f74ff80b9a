#!/bin/sh
# test_figures.sh - make figures: draws a figure where gnuplot is there, says
# which package to install where it is not, and makes nothing then.
#
# usage: test_figures.sh TWOFOLD
set -u
LC_ALL=C
export LC_ALL
T=${1:?usage: test_figures.sh TWOFOLD}
case $T in /*) ;; *) T=$PWD/$T ;; esac
# Out of what make hands to its recipes: this is another build.
unset MAKEFLAGS MAKELEVEL MFLAGS MAKEOVERRIDES
cd "$(dirname "$0")/../.." || exit 1
D=$(mktemp -d) || exit 1
trap 'rm -rf "$D"' EXIT

count=0
failed=0
# check NAME COMMAND...: one line of TAP.
check() {
  count=$((count + 1))
  name=$1
  shift
  if "$@"; then
    echo "ok $count - $name"
    return
  fi
  failed=$((failed + 1))
  echo "not ok $count - $name"
  echo "# failed: $*"
  sed 's/^/#   /' "$D/said" | tail -n 5
}

# The program is at hand: a build of its own would cost half a minute. `-o`
# says that it is not to be remade, and what it is made of neither.
mkdir -p "$D/build/double"
cp "$T" "$D/build/double/twofold"
figure() {
  make -s -j1 figures FIGURES=surface BUILD="$D/build" \
    -o "$D/build/double/twofold" -o "$D/build/double/libtwofold.a" \
    >"$D/said" 2>&1
  code=$?
}
svg=$D/build/figures/surface.svg

# A folder of links to all that make needs, and not to gnuplot.
mkdir "$D/bin"
for name in sh make awk cat cp mkdir mv rm echo cmp grep sed wc nproc dirname \
  find gcc env sort mktemp tail head; do
  where=$(command -v "$name") && ln -s "$where" "$D/bin/$name" 2>/dev/null
done
full=$PATH
PATH=$D/bin
export PATH
figure
PATH=$full
check 'without gnuplot make fails' [ "$code" -ne 0 ]
check 'without gnuplot the package is named' \
  grep -q 'apt-get install gnuplot-nox' "$D/said"
check 'without gnuplot there is no picture' [ ! -e "$svg" ]

if command -v gnuplot >/dev/null && [ -x /usr/bin/python3 ]; then
  figure
  check 'with gnuplot make succeeds' [ "$code" -eq 0 ]
  check 'the picture is not empty' [ -s "$svg" ]
  check 'it is SVG' grep -q '<svg' "$svg"
  check 'it is closed' grep -q '</svg>' "$svg"
  check 'it says what the axis is' grep -q 'slip speed h \[' "$svg"
  check 'there is a PNG beside it' [ -s "$D/build/figures/surface.png" ]
else
  echo '# no gnuplot or python3 here: only absence was tested'
fi
echo "$((count - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
