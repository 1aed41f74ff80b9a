#!/bin/sh
# `--live` behind a pseudo-terminal (tests/cli/test_live.py): what it draws, and
# that the terminal is given back.
. "$(dirname "$0")/lib.sh"
[ -x /usr/bin/python3 ] || {
  echo 'missing: /usr/bin/python3 (apt-get install python3)'
  exit 3
}
setting gcc -O3
in_common "$place/double/twofold" || wrong 'the command line does not build'
TWOFOLD=$place/double/twofold tests/cli/test_live.py >"$BUILD/live.said" ||
  wrong 'a test fails'
[ "$BAD" -eq 0 ] || cat "$BUILD/live.said"
checked "$(tail -n 1 "$BUILD/live.said")"
