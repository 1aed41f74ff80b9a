#!/bin/sh
# What writes the reports (tools/tables and the scripts that use it): answers
# that others have published, and small runs, without the studies themselves.
. "$(dirname "$0")/lib.sh"
[ -x /usr/bin/python3 ] || {
  echo 'missing: /usr/bin/python3 (apt-get install python3)'
  exit 3
}
/usr/bin/python3 -c 'import matplotlib, numpy, scipy' 2>/dev/null || {
  echo 'missing: python3-numpy, python3-scipy, python3-matplotlib (apt-get)'
  exit 3
}
need clang clang
setting gcc -O3
in_common "$place/double/twofold" || wrong 'the command line does not build'
TWOFOLD=$place/double/twofold /usr/bin/python3 -B -m unittest discover -v \
  -s tools/tables -t tools >"$BUILD/tables.said" 2>&1 || wrong 'a test fails'
[ "$BAD" -eq 0 ] || cat "$BUILD/tables.said"
checked "$(grep '^Ran ' "$BUILD/tables.said")"
