# shellcheck shell=sh
# What the tests in sh share: a temporary folder to work in, the command line
# that is tested, and results in TAP. A test is started with the path of the
# command line, sources this file and ends with `finish`:
#   . "$(dirname "$0")/../support/tap.sh"
# Then T is the command line, root the project's folder, real its real type.
# What runs leaves its output in the files out and err, its exit code in $code.
# Nothing waits for a fixed time: what has to happen first is polled for.
set -u
LC_ALL=C
export LC_ALL
T=${1:?usage: $0 TWOFOLD}
case $T in /*) ;; *) T=$PWD/$T ;; esac
# shellcheck disable=SC2034  # for those that source this
root=$(cd "$(dirname "$0")/../.." && pwd) || exit 1
D=$(mktemp -d "${TMPDIR:-/tmp}/twofold-test.XXXXXX") || exit 1
at_exit() { :; } # a test that starts something redefines it
trap 'at_exit; rm -rf "$D"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
cd "$D" || exit 1
count=0 failed=0 skipped=0

# result STATUS NAME [DIAGNOSTIC]: one line of TAP; 0 is a pass.
result() {
  count=$((count + 1))
  if [ "$1" -eq 0 ]; then
    echo "ok $count - $2"
    return
  fi
  failed=$((failed + 1))
  echo "not ok $count - $2"
  [ -z "${3-}" ] || echo "# $3"
  [ ! -s "$D/err" ] || sed 's/^/#   /' "$D/err" | tail -n 5
}

# skip NAME REASON: what cannot be tested here is neither passed nor failed.
skip() {
  count=$((count + 1))
  skipped=$((skipped + 1))
  echo "ok $count - $1 # SKIP $2"
}

# lacks NAME PACKAGE: a test that cannot be made without the package: skipped,
# or failed where the file REQUIRED lists the package (.ci/required).
lacks() {
  if [ -n "${REQUIRED-}" ] &&
    { [ ! -r "$REQUIRED" ] || grep -q " $2\$" "$REQUIRED"; }; then
    result 1 "$1" "missing, and required: $2"
  else
    skip "$1" "missing: $2"
  fi
}

# The CRC-32 of standard input, which gzip has as well.
crc32() { gzip -c | tail -c 8 | od -An -N4 -tx1 | awk '{ print $4 $3 $2 $1 }'; }

finish() {
  echo "1..$count"
  [ "$skipped" -eq 0 ] || echo "# $skipped skipped"
  echo "$((count - failed - skipped)) passed, $failed failed"
  [ "$failed" -eq 0 ]
}

if ! real=$("$T" --version | sed 's/.* is //') || [ -z "$real" ]; then
  result 1 "$T can be executed"
  finish
  exit
fi

# check NAME COMMAND...: the command succeeds.
check() {
  check_name=$1
  shift
  "$@"
  result $? "$check_name" "failed: $*"
}

not() { ! "$@"; }

# equal NAME GOT WANTED
equal() {
  [ "$2" = "$3" ]
  result $? "$1" "got '$2', want '$3'"
}

# within NAME GOT WANTED TOLERANCE
within() {
  awk -v a="$2" -v b="$3" -v e="$4" \
    'BEGIN { d = a - b; exit !(a != "" && d <= e && -d <= e) }'
  result $? "$1" "got '$2', want '$3' within $4"
}

run() {
  "$T" "$@" >out 2>err
  code=$?
}

# runs ARGS...: and ends well.
runs() {
  run "$@"
  equal "$* succeeds" "$code" 0
}

# says TEXT&TEXT...: standard error holds every TEXT.
says() (
  set -f
  IFS='&'
  # shellcheck disable=SC2086  # split on purpose
  for text in $1; do grep -qF -e "$text" err || exit 1; done
)

# expect CODE TEXT&TEXT... ARGS...: the exit code, each TEXT in standard error,
# and no row where the command line was refused (2, 3).
expect() {
  want=$1 texts=$2
  shift 2
  run "$@"
  [ "$code" -eq "$want" ] && says "$texts" &&
    case $want in 2 | 3) [ ! -s out ] ;; esac
  result $? "twofold $*: $want, $texts" "code $code"
}

# expectations [WORD...]: reads rows CODE ARGS|TEXT&TEXT... and expects that of
# the command line WORD... ARGS.
expectations() {
  while IFS='|' read -r words texts; do
    # shellcheck disable=SC2086  # a list of words
    expect "${words%% *}" "$texts" "$@" ${words#* }
  done
}

# wrong_files FILE ARGS...: reads rows CODE|LINES|TEXT&TEXT..., and expects that
# of the command with a FILE of these lines, as printf has them. The first TEXT
# stands behind the name of the FILE.
wrong_files() {
  wrong_file=$1
  shift
  while IFS='|' read -r number lines texts; do
    # shellcheck disable=SC2059  # a format on purpose
    printf "$lines" >"$wrong_file"
    expect "$number" "$wrong_file:$texts" "$@"
  done
}

# row N FIELDS FILE: these fields of line N, as `cut` names them.
row() { sed -n "$1p" "$3" | cut -d , -f "$2"; }

# whole_rows FILE FIELDS [PATTERN]: it ends with a newline, every row has all
# fields, the last one of the PATTERN, and there is one below the header;
# comments are not rows.
whole_rows() {
  [ -s "$1" ] && [ -z "$(tail -c 1 "$1")" ] &&
    awk -F, -v n="$2" -v last="^${3-.*}\$" '
      /^#/ { next }
      NF != n || (NR > 1 && $n !~ last) { bad = 1 }
      { rows++ }
      END { exit bad || rows < 2 }' "$1"
}

# poll COMMAND...: until the command succeeds; fails after a minute.
poll() {
  tries=600
  until "$@"; do
    tries=$((tries - 1))
    [ "$tries" -gt 0 ] || return 1
    sleep 0.1 2>/dev/null || sleep 1
  done
}

has_lines() { [ -f "$1" ] && [ "$(wc -l <"$1")" -ge "$2" ]; }

# ended PID: the process has ended, even if it still waits to be reaped.
ended() {
  case $(ps -o stat= -p "$1" 2>/dev/null) in '' | Z*) ;; *) return 1 ;; esac
}

# interrupt SIGNAL FILE LINES ARGS...: the signal comes when FILE.part has so
# many lines, ends the run with code 4, and is reported; FILE is not made. The
# file out is standard output, which has no part.
interrupt() {
  signal=$1 file=$2 part=$2.part lines=$3
  shift 3
  [ "$file" != out ] || part=out
  rm -f "$file" "$part"
  "$T" "$@" >out 2>err &
  pid=$!
  check "SIG$signal, $1: rows reach the file while the run goes on" \
    poll has_lines "$part" "$lines"
  kill -s "$signal" $pid
  poll ended $pid || kill -s KILL $pid
  wait $pid
  equal "SIG$signal, $1: code" $? 4
  check "SIG$signal, $1: it is reported" \
    grep -Eq 'interrupted|by a signal' err
  [ "$file" != out ] || return 0
  check "SIG$signal, $1: where its rows are" says "its rows so far are in&$part"
  check "SIG$signal, $1: no part passes for a whole file" [ ! -e "$file" ]
}

# full_device ARGS...: standard output on a full device gives code 4.
full_device() {
  if [ ! -c /dev/full ]; then
    skip "twofold $* on a full device" 'no /dev/full'
    return
  fi
  "$T" "$@" >/dev/full 2>err
  equal "twofold $* on a full device" $? 4
}

# failing_output FIELDS ARGS...: a command that writes rows without end, or
# nearly so, to what takes none or only some.
failing_output() {
  fields=$1
  shift
  expect 4 /nowhere/x "$@" --out /nowhere/x
  expect 4 "$D" "$@" --out "$D" # a directory
  full_device "$@"
  [ ! -c /dev/full ] ||
    expect 4 '/dev/full: No space left' "$@" --out /dev/full
  (
    ulimit -f 8 || exit 4
    exec "$T" "$@" --out quota.csv 2>err
  )
  equal "$1, a file at its quota" $? 4
  check "$1, a file at its quota has whole rows" \
    whole_rows quota.csv.part "$fields"
  check "$1, and does not pass for a whole one" [ ! -e quota.csv ]
  { "$T" "$@" 2>err; echo $? >code; } | head -n 1 >out
  equal "$1, a closed pipe ends it" "$(cat code)" 4
  equal "$1, the reader got the header" "$(cat out)" \
    "$(head -n 1 quota.csv.part)"
}
