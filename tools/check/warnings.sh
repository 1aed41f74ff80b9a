#!/bin/sh
# Everything compiles without a warning: warnings.sh COMPILER.
. "$(dirname "$0")/lib.sh"
need "$1" "$1"
build -k CC="$1" BUILD="$BUILD/$1" EXTRA=-Werror all || wrong "warnings of $1"
checked "$(find "$BUILD/$1" -name '*.o' | wc -l) objects, both real types," \
  "$("$1" --version | head -n 1)"
