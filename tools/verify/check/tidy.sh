#!/bin/sh
# clang-tidy as .clang-tidy says: the core in double, and of the core in float
# and of the other files an eighth, another one with each commit (with FULL=yes
# all).
. "$(dirname "$0")/lib.sh"
need clang-tidy clang-tidy

# tidy FLAG...: over the files on standard input, one process a processor.
tidy() {
  # shellcheck disable=SC2016  # the inner shell expands
  xargs -P "$(nproc)" -I FILE sh -c '
    file=$1
    shift
    clang-tidy --quiet "$file" -- -std=c99 "$@" 2>/dev/null || {
      echo "clang-tidy: $file"
      exit 1
    }' tidy FILE -Iinclude "$@"
}

# sample: those of the files on standard input whose turn it is.
commit=$(git rev-parse --short=7 HEAD 2>/dev/null || echo 0)
sample() {
  if [ -n "$FULL" ]; then cat; else awk "NR % 8 == $((0x$commit % 8))"; fi
}

files_in '*.c' src >"$BUILD/tidy.core"
# What Frama-C alone compiles is left out, what is for packages, whose headers
# are not here (`make test-dist` compiles it), and what needs constants.
files_in '*.c' tools |
  grep -Ev "^tools/(verify/(eva|cost/board)|package/dist)" | sample \
  >"$BUILD/tidy.tools"
files_in '*.c' tests | grep -v '^tests/target/' | sample >"$BUILD/tidy.tests"
files_in '*.c' tests/target | sample >"$BUILD/tidy.target"
tidy <"$BUILD/tidy.core" || wrong "core in double"
sample <"$BUILD/tidy.core" | tidy -DTF_REAL_FLOAT || wrong "core in float"
tidy -Itools -DFINER_BITS=64 <"$BUILD/tidy.tools" || wrong "tools"
tidy -Itests -Itests/support -Itests/reference -Isrc <"$BUILD/tidy.tests" ||
  wrong "tests"
# Programs of the boards are given a number of steps, and a rate.
tidy -Iport -DSTEPS=1000 -DRATE=1000 -DUPLINK <"$BUILD/tidy.target" ||
  wrong "programs of the boards"
checked "$(cat "$BUILD"/tidy.core "$BUILD"/tidy.tools "$BUILD"/tidy.tests \
  "$BUILD"/tidy.target | wc -l) files, the core in double${FULL:+ and float}"
