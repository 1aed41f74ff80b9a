#!/bin/sh
# Builds for double and for float cannot be linked by mistake: every symbol
# of a library carries its real type, and a program of the other type does not
# link.
. "$(dirname "$0")/lib.sh"
need nm binutils
cat >"$BUILD/user.c" <<'END'
#include "twofold.h"
int main(void) {
  static tf_machine_t machine;
  return tf_prepare(&machine, &tf_scenes[0]->params, 0);
}
END
for real in double float; do
  suffix=_f64 define=
  [ "$real" = double ] || suffix=_f32 define=-DTF_REAL_FLOAT
  core_library "$real" ||
    wrong "$library does not compile"
  nm -g --defined-only -f posix "$library" |
    awk -v suffix="$suffix\$" 'NF > 1 && $1 !~ suffix { print $1; bad = 1 }
      END { exit bad }' || wrong "symbols of $library without $suffix"
  # shellcheck disable=SC2086  # $define is one word or none
  quietly gcc -std=c99 -Iinclude $define -c "$BUILD/user.c" \
    -o "$BUILD/user-$real.o" || wrong "the program does not compile"
done
for user in double float; do
  for real in double float; do
    core_library "$real"
    gcc "$BUILD/user-$user.o" "$library" \
      -o "$BUILD/user" >"$BUILD/user.log" 2>&1
    linked=$?
    if [ "$user" = "$real" ]; then
      if [ "$linked" -ne 0 ] || ! "$BUILD/user"; then
        wrong "$real does not link or run"
      fi
    elif [ "$linked" -eq 0 ]; then
      wrong "a program in $user links with the library in $real"
    elif ! grep -q 'undefined reference' "$BUILD/user.log"; then
      wrong "$user with $real fails for another reason"
    fi
  done
done
checked "double with float does not link, like with like does"
