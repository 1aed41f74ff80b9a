#!/bin/sh
# What goes over a line can be read by the tools that it is for: see streams.py.
# `make test` has made the programs that it starts. usage: test_streams.sh
# TWOFOLD
. "$(dirname "$0")/../support/tap.sh"
builds=${T%/*/twofold}
TWOFOLD=$T
ACCEPTED=$builds/double/accepted
FIRMWARE=$builds/boards/host/chaos-float/firmware
export TWOFOLD ACCEPTED FIRMWARE
streams=$root/tests/line/streams.py
if [ -x /usr/bin/python3 ]; then
  for name in $("$streams"); do
    "$streams" "$name" >err 2>&1
    result $? "$name" "failed: $streams $name"
  done
  check 'there are tests' [ "$count" -gt 10 ]
else
  lacks 'parsers of streams' python3
fi
finish
