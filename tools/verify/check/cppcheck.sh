#!/bin/sh
# cppcheck over the core, in both real types, and over the tools.
. "$(dirname "$0")/lib.sh"
need cppcheck cppcheck
# variableScope is a matter of taste: one line declares what belongs together.
set -- --quiet --std=c99 --inline-suppr --error-exitcode=1 \
  --enable=warning,style,performance,portability -Iinclude -Isrc -Itools \
  --suppress=missingIncludeSystem --suppress=variableScope
cppcheck "$@" -UTF_REAL_FLOAT src || wrong "core in double"
cppcheck "$@" -DTF_REAL_FLOAT=1 src || wrong "core in float"
cppcheck "$@" -UTF_REAL_FLOAT -UREF_BITS -D__x86_64__ \
  -itools/verify/cost/board.c tools || wrong "tools"
# Programs of the boards hold the whole core in one file, where names that were
# local to one of its files shadow those of another; clang-tidy reads them. So
# do the tests of a firmware. Of a struct whose members are read through a
# pointer in another struct it says that none is used. Quadruple constants are
# no C of its own.
cppcheck "$@" -UTF_REAL_FLOAT -UREF_BITS --suppress=unusedStructMember \
  -Itests -Itests/support -Itests/reference \
  -itests/target -itests/support/firmware_start.c -itests/line/test_firmware.c \
  tests || wrong "tests"
checked "src in both real types, tools, tests; $(cppcheck --version)"
