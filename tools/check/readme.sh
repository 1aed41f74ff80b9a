#!/bin/sh
# README.md: at most 120 lines; its C program compiles without a warning
# against the library in both real types, runs and prints what is said; its
# commands are those that continuous integration runs; the lines of "use it
# from" run; each promise names a test that exists. What the documents link to
# is there.
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
sed -n '/^    gcc /{:a;/\\$/{N;ba;};p;q;}' README.md |
  sed "s| demo\.c | $program |; s|-o demo|-o $BUILD/readme-line|" \
    >"$BUILD/readme-line.sh"
[ -s "$BUILD/readme-line.sh" ] || wrong 'README.md has no line with gcc'
grep -q -e -fno-math-errno "$BUILD/readme-line.sh" ||
  wrong "README.md: no -fno-math-errno"
quietly sh "$BUILD/readme-line.sh" ||
  wrong "the line of README.md does not compile its program"
"$BUILD/readme-line" >"$BUILD/readme.line"
"$BUILD/readme-double" | cmp - "$BUILD/readme.line" ||
  wrong "the program prints otherwise when compiled by the line of README.md"
# shellcheck disable=SC2016  # marks of code
said=$(sed -n 's/^It prints `\([^`]*\)`.*/\1/p' README.md)
if [ -z "$said" ] || ! grep -qxF "$said" "$BUILD/readme.line"; then
  wrong "the program does not print: $said"
fi

# The table of what it can be used from: its lines as the reader would type
# them, in a build that checks share and a home of their own. Where one makes
# `demo`, it prints what the program prints.
setting gcc -O3
HOME=$(cd "$BUILD" && pwd)/readme-home
PKG_CONFIG_PATH=$HOME/.local/lib/pkgconfig
export HOME PKG_CONFIG_PATH
rm -rf "$HOME" "$place/demo" "$place/py"
make() { in_common "$@"; }
pip() { /usr/bin/python3 -m pip "$@"; }
in_common "$place/double/twofold" || wrong 'the command line does not build'
# shellcheck disable=SC2016  # marks of code
sed -n '/^| use it from /,/^$/p' README.md | sed '1,2d; s/\\|/\v/g' |
  sed -n 's/^|[^|]*| `\([^`]*\)`.*|$/\1/p' | tr '\v' '|' |
  sed "s|build/|$place/|g; s| demo\.c| $program|; s|-o demo\$|-o $BUILD/demo|" \
    >"$BUILD/readme.uses"
[ "$(wc -l <"$BUILD/readme.uses")" -eq \
  "$(sed -n '/^| use it from /,/^$/p' README.md | sed 1,2d | grep -c '^|')" ] ||
  wrong "README.md: each use is a row | from | \`line\` |"
[ -s "$BUILD/readme.uses" ] || wrong 'README.md has no table of uses'
while read -r use; do
  rm -f "$BUILD/demo"
  (eval "$use") </dev/null >"$BUILD/readme.said" 2>&1 || {
    tail -n 20 "$BUILD/readme.said"
    wrong "README.md: this line fails: $use"
  }
  case $use in
  *-o\ "$BUILD/demo")
    "$BUILD/demo" | cmp - "$BUILD/readme.line" ||
      wrong "the program prints otherwise when compiled by $use"
    ;;
  esac
done <"$BUILD/readme.uses"

# The last column of the table of promises: a test, or a file of tests, in
# every row.
sed -n '/^## Promises/,/^## More/p' README.md |
  grep '^|' | sed '1,2d' >"$BUILD/readme.rows"
# shellcheck disable=SC2016
sed -n 's/^| [^|]* | `\([^`]*\)` |$/\1/p' "$BUILD/readme.rows" \
  >"$BUILD/readme.promises"
[ "$(wc -l <"$BUILD/readme.rows")" -eq "$(wc -l <"$BUILD/readme.promises")" ] ||
  wrong "README.md: each promise is a row | promise | \`test\` |"
[ -s "$BUILD/readme.promises" ] || wrong "README.md has no table of promises"
while read -r test; do
  [ -f "$test" ] || grep -qrE "^(TEST|LAW)\($test\)" tests ||
    wrong "README.md promises by a test that does not exist: $test"
done <"$BUILD/readme.promises"

# Links of all documents, from where each lies.
for document in *.md docs/*.md; do
  grep -oE '\]\([^)#:]+\)' "$document" | sed 's/^](//; s/)$//' |
    while read -r target; do
      [ -e "$(dirname "$document")/$target" ] || echo "$document: $target"
    done
done >"$BUILD/readme.dead"
while read -r dead; do wrong "a link leads nowhere: $dead"; done \
  <"$BUILD/readme.dead"

promises=$(wc -l <"$BUILD/readme.promises")
checked "$lines lines, $promises promises with a test, links; its program of" \
  "$(wc -l <"$program") lines and $(wc -l <"$BUILD/readme.uses") uses run"
