#!/bin/sh
# Builds for double and for float cannot be linked by mistake: every symbol
# of a library carries its real type, so a program that linked with the other
# one would miss all of them.
. "$(dirname "$0")/lib.sh"
need nm binutils
for real in double float; do
  suffix=_f64
  [ "$real" = double ] || suffix=_f32
  core_library "$real" ||
    wrong "$library does not compile"
  nm -g --defined-only -f posix "$library" |
    awk -v suffix="$suffix\$" 'NF > 1 && $1 !~ suffix { print $1; bad = 1 }
      NF > 1 { count++ }
      END { exit bad || !count }' || wrong "symbols of $library without $suffix"
done
checked "every symbol of the core carries its real type"
