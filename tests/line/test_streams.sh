#!/bin/sh
# What goes over a line can be read by the tools that it is for, and is whole or
# says that it is not: see streams.py and whole.py.
# `make test` has made the programs that it starts. usage: test_streams.sh
# TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
builds=${T%/*/twofold}
TWOFOLD=$T
ACCEPTED=$builds/double/accepted
FIRMWARE=$builds/boards/host/chaos-float/firmware
export TWOFOLD ACCEPTED FIRMWARE
if [ -x /usr/bin/python3 ]; then
  for tests in streams whole; do
    tests=$root/tests/line/$tests.py
    for name in $("$tests"); do
      "$tests" "$name" >err 2>&1
      result $? "$name" "failed: $tests $name"
    done
  done
  check 'there are tests' [ "$count" -gt 10 ]
else
  lacks 'parsers of streams' python3
fi
finish
