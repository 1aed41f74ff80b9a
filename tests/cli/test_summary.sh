#!/bin/sh
# What programs read: the summary as JSON, and rows that say what they are of:
# see summary.py. usage: test_summary.sh TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
TWOFOLD=$T
export TWOFOLD
summary=$root/tests/cli/summary.py
if [ -x /usr/bin/python3 ]; then
  for name in $("$summary"); do
    "$summary" "$name" >out 2>err
    code=$?
    if [ $code -eq 77 ]; then
      lacks "$name" "$(cat out)"
    else
      result $code "$name" "failed: $summary $name"
    fi
  done
  check 'there are tests' [ "$count" -gt 10 ]
else
  lacks 'what programs read' python3
fi
finish
