#!/bin/sh
# Flash, RAM and stack of a few firmwares (with FULL=yes of all boards and
# scenes) are at most 2 % above what docs/bench/sizes.csv has.
. "$(dirname "$0")/lib.sh"
log=$BUILD/sizes.said
tools/bench/run sizes --check ${FULL:+--all} >"$log" 2>&1 ||
  wrong 'a firmware has grown, or cannot be built'
cat "$log"
checked "$(tail -n 1 "$log")"
