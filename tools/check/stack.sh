#!/bin/sh
# Worst stack: no function of the core calls itself, through others or through
# a pointer, and none needs more than the header says ("Stack: N B").
. "$(dirname "$0")/lib.sh"
need gcc gcc
: >"$BUILD/stack.claims"
# "name bytes" of every public function.
# shellcheck disable=SC2016  # awk's own variables
files_in '*.h' include | xargs awk '
  /^\/\/\// { text = text " " substr($0, 4); next }
  /^#define tf_[a-z_]+ TF_LINK/ { name = $2; next }
  /^(TF_API|static inline) / && match(text, /Stack: [0-9]+ B/) {
    if (name != "") print name, substr(text, RSTART + 7) + 0
  }
  { text = name = "" }' >"$BUILD/stack.claims"
[ -s "$BUILD/stack.claims" ] || wrong "no header claims a stack"

for real in double float; do
  suffix=f64 define=-UTF_REAL_FLOAT place=$BUILD/stack-$real
  [ "$real" = double ] || suffix=f32 define=-DTF_REAL_FLOAT
  rm -rf "$place"
  mkdir -p "$place"
  for file in src/*.c; do
    gcc -std=c99 -O2 -ffp-contract=off -fno-math-errno -ffreestanding \
      -Iinclude "$define" -fcallgraph-info=su "$file" \
      -S -o "$place/$(basename "$file" .c).s" || wrong "$file does not compile"
  done
  awk -f tools/check/stack.awk "$place"/*.ci "$place"/*.s >"$place/worst" ||
    wrong "the stack of the core has no bound"
  while read -r name bytes; do
    worst=$(awk -v name="${name}_$suffix" '$1 == name { print $2 }' \
      "$place/worst")
    if [ -z "$worst" ]; then
      wrong "$name: claims a stack but is in no library"
    elif [ "$worst" -gt "$bytes" ]; then
      wrong "$name needs $worst B in $real, its header says $bytes B"
    fi
  done <"$BUILD/stack.claims"
done
checked "$(wc -l <"$BUILD/stack.claims") functions need no more than claimed," \
  "no recursion; gcc -O2, both real types"
