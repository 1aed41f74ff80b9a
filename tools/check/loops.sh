#!/bin/sh
# Every loop of the core has a bound that a machine finds: clang's syntax tree,
# read by loops.py. (gcc's own analysis of iterations was tried: it is of loops
# as they are after inlining, some of which are no longer there and some twice,
# and it calls 2^64 - 2 a bound.) A bound that is not a constant stands in
# loops.bounds with what it is at most. BUILD/loops.txt is the table of all. No
# recursion: that is stack.py's.
. "$(dirname "$0")/lib.sh"
need clang clang
need /usr/bin/python3 python3

# tree DEFINE FILE WANTED...: the loops of the wanted files.
tree() {
  tree_define=$1 tree_file=$2
  shift 2
  clang -std=c99 "$tree_define" -Iinclude -fsyntax-only -Xclang \
    -ast-dump=json "$tree_file" | tools/check/loops.py "$@"
}

# It must find each of these, and the bound of the last two.
seed=$BUILD/loops-seed.c
cat >"$seed" <<'END'
unsigned seeded(const unsigned *to, unsigned n);
unsigned seeded(const unsigned *to, unsigned n) {
  unsigned at = 0;
  for (;;) if (to[at++] == n) break;
  while (at != n) at = to[at];
  while (at < n) at += to[at];
  for (unsigned i = 0; i < n; i++) if (to[i] == 1) i--;
  for (unsigned i = 0; i < n; i++) n++;
  for (unsigned i = 0; i < n; i--) at++;
  while (at < n) { if (to[at]) continue; at++; }
  while (at < n) { if (to[at]) at++; }
  do at = to[at]; while (at > 0);
  while (at < n) { unsigned by = to[at]; if (by == 0) break; at += by; }
  for (unsigned char i = 0; i < 250; i += 128) at++;
  for (unsigned char i = 0; i <= 255; i++) at++;
  for (unsigned i = 9; i >= 0; i--) at++;
  for (double x = n; x > 1; x *= 10) at++;
  for (double x = n; x > 1; x /= 1) at++;
  for (unsigned i = 0; i < 3; i++) at += i;
  return at;
}
END
tree -UTF_REAL_FLOAT "$seed" "$seed" >"$BUILD/loops.seen"
awk -F '\t' -v OFS='\t' '{ print $3, $4 }' "$BUILD/loops.seen" |
  sort -n >"$BUILD/loops.kinds"
{
  for line in 4 5 6 7 8 9 10 11 12 14 15 16 17 18; do
    printf '%d\tnone\n' "$line"
  done
  printf '13\truntime\n19\tconstant\n'
} | sort -n | diff - "$BUILD/loops.kinds" ||
  wrong "seeded loops are not judged so (<)"

wanted=$(files_in '*.[ch]' src include)
for define in -UTF_REAL_FLOAT -DTF_REAL_FLOAT; do
  for file in src/*/*.c; do
    # shellcheck disable=SC2086  # a list of files
    tree "$define" "$file" $wanted || wrong "$file cannot be read"
  done
done | sed 's/_f\(64\|32\)\t/\t/' | sort -u >"$BUILD/loops.txt"

# None may have escaped: as many as the text has.
found=$(cut -f 1,3 "$BUILD/loops.txt" | sort -u | wc -l)
# shellcheck disable=SC2086
there=$(cat $wanted | sed 's|//.*||' | grep -Eo '\b(for|while|do) *[({]' |
  wc -l)
[ "$found" -eq "$there" ] ||
  wrong "$found lines with loops in the syntax tree, $there in the text"

awk -F '\t' '
  FNR == 1 { files++ }
  files == 1 && (/^#/ || NF == 0) { next }
  files == 1 {
    if (split($0, part, " : ") != 3 || part[3] == "") {
      print "not file function : bound : at most: " $0
      bad = 1
    }
    known[part[1] " : " part[2]] = 1
    next
  }
  $4 == "constant" { next }
  $4 == "runtime" && ((key = $1 " " $2 " : " $5) in known) { used[key]; next }
  { print $1 ":" $3 ": " $2 ": " $4 ", " $5; bad = 1 }
  END {
    for (key in known)
      if (!(key in used)) { print "there is no such loop: " key; bad = 1 }
    exit bad
  }' tools/check/loops.bounds "$BUILD/loops.txt" ||
  wrong "loops without a bound; see tools/check/loops.bounds"
checked "$found loops, $(cut -f 1,3,4 "$BUILD/loops.txt" | sort -u |
  grep -c constant) of constant bounds; seeded ones without are found"
