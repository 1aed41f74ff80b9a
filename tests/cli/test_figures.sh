#!/bin/sh
# make figures: draws a figure where gnuplot is there, says which package to
# install where it is not, and makes nothing then.
# usage: test_figures.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
# Out of what make hands to its recipes: this is another build.
unset MAKEFLAGS MAKELEVEL MFLAGS MAKEOVERRIDES
svg=build/figures/surface.svg

# The program is at hand: a build of its own would cost half a minute. `-o`
# says that it is not to be remade, and what it is made of neither.
mkdir -p build/double
cp "$T" build/double/twofold
figure() {
  make -C "$root" -s -j1 figures FIGURES=surface BUILD="$D/build" \
    -o "$D/build/double/twofold" -o "$D/build/double/libtwofold.a" >err 2>&1
  code=$?
}

# A folder of links to all that make needs, and not to gnuplot.
mkdir bin
for name in sh make awk cat cp mkdir mv rm echo cmp grep sed wc nproc dirname \
  find gcc env sort mktemp tail head; do
  where=$(command -v "$name") && ln -s "$where" "bin/$name" 2>/dev/null
done
full=$PATH
PATH=$D/bin
figure
PATH=$full
check 'without gnuplot make fails' [ "$code" -ne 0 ]
check 'without gnuplot the package is named' says 'apt-get install gnuplot-nox'
check 'without gnuplot there is no picture' [ ! -e $svg ]

if command -v gnuplot >/dev/null && [ -x /usr/bin/python3 ]; then
  figure
  check 'with gnuplot make succeeds' [ "$code" -eq 0 ]
  for text in '<svg' '</svg>' 'slip speed h ['; do
    check "the picture holds $text" grep -qF "$text" $svg
  done
  check 'there is a PNG beside it' [ -s build/figures/surface.png ]
elif [ -x /usr/bin/python3 ]; then
  lacks 'a picture by gnuplot' gnuplot-nox
else
  lacks 'a picture by gnuplot' python3
fi
finish
