#!/bin/sh
# Public functions say all that they promise, row by row, and every test that
# a promise names is run.
. "$(dirname "$0")/lib.sh"
need gcc gcc
files_in '*.h' include >"$BUILD/claims.headers"
files_in 'test_*.c' tests/unit tests/law tests/golden tests/regress \
  >"$BUILD/claims.tests"

# Rows in their order before every function; the names after "Claims:".
# shellcheck disable=SC2016  # awk's own variables
rows='
  /^\/\/\// { text = text " " substr($0, 4); next }
  /^#define/ { next }
  /^(TF_API|static inline) / && /\(/ {
    functions++
    at = 0
    n = split("Scheme: Returns: Cost: Stack: Memory: Claims:", row, " ")
    for (i = 1; i <= n; i++) {
      here = index(text, row[i])
      if (here <= at) {
        print FILENAME ":" FNR ": row \"" row[i] "\" is missing or misplaced"
        bad = 1
      } else at = here
    }
    sub(/.*Claims:/, "", text)
    if (text !~ /[^ ]/) {
      print FILENAME ":" FNR ": claims nothing"
      bad = 1
    }
    gsub(/[ ,]+/, "\n", text)
    print text >names
  }
  { text = "" }
  END { print functions + 0 >count; exit bad }'
: >"$BUILD/claims.names"
xargs awk -v names="$BUILD/claims.names" -v count="$BUILD/claims.count" \
  "$rows" <"$BUILD/claims.headers" || wrong "see DESIGN.md for the rows"

# Kernels claim in prose: words in a comment of src/ that look like tests are
# not searched; only the rows are a contract.
grep . "$BUILD/claims.names" | sort -u >"$BUILD/claims.wanted"
xargs -n 1 gcc -fpreprocessed -dD -E -P <"$BUILD/claims.tests" |
  sed -nE 's/^ *RUN\(([a-z0-9_]+)\);.*/\1/p' | sort -u >"$BUILD/claims.have"
comm -23 "$BUILD/claims.wanted" "$BUILD/claims.have" >"$BUILD/claims.missing"
while read -r name; do
  wrong "no test is run as $name: $(grep -rn "\b$name\b" include | head -n 1)"
done <"$BUILD/claims.missing"
checked "$(cat "$BUILD/claims.count") functions," \
  "$(wc -l <"$BUILD/claims.wanted") claims, each held up by a test"
