#!/bin/sh
# The core needs nothing of a host but a square root and memory functions that
# every compiler may call, with every compiler and optimisation at hand.
. "$(dirname "$0")/lib.sh"
need nm binutils
ALLOWED='sqrt sqrtf memcpy memset memmove memcmp'
libraries=0
for compiler in gcc clang; do
  command -v "$compiler" >/dev/null || continue
  for opt in ${FULL:+-O0 -O2} -Os; do
    setting "$compiler" "$opt"
    for real in double float; do
      library=$place/$real/libtwofold.a
      in_common "$library" || {
        wrong "$library does not compile"
        continue
      }
      libraries=$((libraries + 1))
      nm -g --defined-only -f posix "$library" | awk 'NF > 1 { print $1 }' |
        sort -u >"$BUILD/defined"
      nm -u -f posix "$library" | awk 'NF > 1 { print $1 }' | sort -u |
        comm -23 - "$BUILD/defined" >"$BUILD/undefined"
      while read -r symbol; do
        case " $ALLOWED " in
        *" $symbol "*) ;;
        *) wrong "$library needs $symbol" ;;
        esac
      done <"$BUILD/undefined"
    done
  done
done
checked "$libraries libraries need nothing beyond: $ALLOWED"
