#!/bin/sh
# README.md: at most 120 lines; its C program compiles without a warning
# against the library in both real types, runs and prints something; its
# commands are those that continuous integration runs.
. "$(dirname "$0")/lib.sh"
[ -e README.md ] || {
  wrong "there is no README.md"
  checked
}
lines=$(wc -l <README.md)
[ "$lines" -le 120 ] || wrong "README.md: $lines lines, at most 120"
for command in 'make run' 'make test'; do
  grep -q "$command" README.md || wrong "README.md does not say: $command"
done
grep -q '^make test$' .ci/run || grep -q 'make test' .ci/run ||
  wrong ".ci/run does not run make test"

program=$BUILD/readme.c
awk '/^```c$/ { inside = 1; next } /^```/ { if (inside) exit } inside' \
  README.md >"$program"
[ -s "$program" ] || wrong 'README.md has no block ```c'
for real in double float; do
  define=-UTF_REAL_FLOAT
  [ "$real" = double ] || define=-DTF_REAL_FLOAT
  core_library "$real" ||
    wrong "$library does not compile"
  if ! quietly gcc -std=c99 -O2 -Wall -Wextra -pedantic -Wconversion \
    -Wdouble-promotion -Werror "$define" -ffp-contract=off -Iinclude \
    "$program" "$library" -o "$BUILD/readme-$real"; then
    wrong "the program of README.md does not compile in $real"
  elif ! "$BUILD/readme-$real" >"$BUILD/readme.out"; then
    wrong "the program of README.md fails in $real"
  elif [ ! -s "$BUILD/readme.out" ]; then
    wrong "the program of README.md prints nothing in $real"
  fi
done

# The line that compiles it, as the reader would type it.
sed -n '/^    gcc /,/[^\\]$/p' README.md |
  sed "s| demo\.c | $program |; s|-o demo|-o $BUILD/readme-line|" \
    >"$BUILD/readme-line.sh"
[ -s "$BUILD/readme-line.sh" ] || wrong 'README.md has no line with gcc'
for flag in -ffp-contract=off -fno-math-errno; do
  grep -q -e "$flag" "$BUILD/readme-line.sh" || wrong "README.md: no $flag"
done
quietly sh "$BUILD/readme-line.sh" ||
  wrong "the line of README.md does not compile its program"
"$BUILD/readme-line" >"$BUILD/readme.line"
"$BUILD/readme-double" | cmp - "$BUILD/readme.line" ||
  wrong "the program prints otherwise when compiled by the line of README.md"
checked "$lines lines; its program of $(wc -l <"$program") lines runs"
