# shellcheck shell=sh
# What every check shares; each sources this file and runs from the root of
# the project. A check prints what is wrong and exits 1, or prints with
# `checked` what it looked at and exits 0. tools/verify/run makes the table.
set -u
LC_ALL=C
export LC_ALL
cd "$(dirname "$0")/../../.." || exit 1
MAKE=${MAKE:-make}
BUILD=${BUILD:-build/check}
FULL=${FULL:-} # what is sampled otherwise, whole
BAD=0
mkdir -p "$BUILD"

# need TOOL PACKAGE: stops where the tool is not installed.
need() {
  command -v "$1" >/dev/null 2>&1 && return
  echo "missing: $1 (apt-get install $2)"
  exit 3
}

# wrong TEXT...: one thing that is wrong; `checked` fails by it.
wrong() {
  echo "$*"
  BAD=$((BAD + 1))
}

# checked TEXT...: the last word of a check that found nothing wrong.
checked() {
  [ "$BAD" -eq 0 ] || exit 1
  [ -z "${CHECK_NOTE:-}" ] || echo "$*" >"$CHECK_NOTE"
  echo "checked: $*"
}

# quietly COMMAND...: its output only where it fails.
quietly() {
  quiet_log=$BUILD/quietly-$$.log
  "$@" >"$quiet_log" 2>&1 || {
    cat "$quiet_log"
    return 1
  }
  rm -f "$quiet_log"
}

# build VARIABLE=VALUE... TARGET...: make, its output only where it fails.
build() {
  quietly "$MAKE" --no-print-directory "$@"
}

# setting COMPILER OPTIMISATION: sets `place` to where what is compiled so is.
setting() {
  compiler=$1 opt=$2
  place=$BUILD/$compiler$(echo "$opt" | tr -d ' =')
}

# in_common [VARIABLE=VALUE...] TARGET...: make in `place`, its output only
# where it fails. Checks share what is there and run side by side: one of them
# builds, the others wait.
in_common() {
  quietly flock "$place.lock" "$MAKE" --no-print-directory CC="$compiler" \
    OPT="$opt" BUILD="$place" EXTRA=-Werror "$@"
}

# files_in PATTERN ROOM...: files of the rooms that exist, one a line, sorted.
files_in() {
  files_pattern=$1
  shift
  for room; do
    [ -e "$room" ] || continue
    find "$room" -type f -name "$files_pattern"
  done | sort
}
