#!/bin/sh
# MISRA C:2012 over src/, by cppcheck's addon, in double, with FULL=yes in both
# real types. Every rule that is deviated from stands in misra.deviations with
# its reason; what it does not name is wrong, and so is a rule there that
# nothing violates.
. "$(dirname "$0")/lib.sh"
need cppcheck cppcheck
need /usr/bin/python3 python3
addon=
for place in /usr/share/cppcheck/addons /usr/lib/*/cppcheck/addons \
  /usr/local/share/[Cc]ppcheck/addons; do
  [ ! -f "$place/misra.py" ] || addon=$place/misra.py
done
if [ -z "$addon" ]; then
  echo "missing: the addon misra.py of cppcheck (apt-get install cppcheck)"
  exit 3
fi

# judge OPTION... FILE...: "file:line RULE", one a line, sorted.
judge() {
  cppcheck --quiet --std=c99 --addon="$addon" -Iinclude -Isrc \
    --suppress=missingIncludeSystem --template='{file}:{line} {id}' "$@" 2>&1 |
    sed -n 's/ misra-c2012-/ /p' | sort -u
}

for real in -UTF_REAL_FLOAT ${FULL:+-DTF_REAL_FLOAT=1}; do
  judge "$real" src
done | sort -u >"$BUILD/misra.found"
[ -s "$BUILD/misra.found" ] || wrong "the checker says nothing about src/"
awk '
  FNR == 1 { files++ }
  files == 1 && (/^#/ || NF == 0) { next }
  files == 1 {
    if (NF < 2) { print "rule " $1 " has no reason"; bad = 1 }
    if ($1 in reason) { print "rule " $1 " is listed twice"; bad = 1 }
    reason[$1] = 1
    next
  }
  $2 in reason { used[$2]++; next }
  { print $1 ": violates rule " $2 ", which is no deviation"; bad = 1 }
  END {
    for (rule in reason)
      if (!(rule in used)) {
        print "rule " rule " is deviated from but nothing violates it"
        bad = 1
      }
    exit bad
  }' tools/verify/check/misra.deviations "$BUILD/misra.found" ||
  wrong "see tools/verify/check/misra.deviations"
rules=$(grep -vc '^#' tools/verify/check/misra.deviations)
checked "src in double${FULL:+ and float}; $rules rules deviated from," \
  "$(wc -l <"$BUILD/misra.found") places"
