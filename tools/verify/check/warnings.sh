#!/bin/sh
# Everything compiles without a warning: warnings.sh COMPILER. Those of gcc
# depend on what it optimises; clang's do not, which does so with FULL=yes only.
. "$(dirname "$0")/lib.sh"
need "$1" "$1"
[ "$1$FULL" = clang ] && opt=-O0 || opt=-O3
setting "$1" "$opt"
in_common -k all || wrong "warnings of $1"
checked "$(find "$place" -name '*.o' | wc -l) objects, both real types," \
  "$("$1" --version | head -n 1)"
