#!/bin/sh
# Everything compiles without a warning: warnings.sh COMPILER.
. "$(dirname "$0")/lib.sh"
need "$1" "$1"
setting "$1" -O3
in_common -k all || wrong "warnings of $1"
checked "$(find "$place" -name '*.o' | wc -l) objects, both real types," \
  "$("$1" --version | head -n 1)"
