#!/bin/sh
# Every C file is as .clang-format lays it out.
. "$(dirname "$0")/lib.sh"
need clang-format clang-format
files_in '*.[ch]' include src port tests tools >"$BUILD/format.list"
xargs clang-format --dry-run -Werror <"$BUILD/format.list" ||
  wrong "to format: clang-format -i FILE"
checked "$(wc -l <"$BUILD/format.list") files, $(clang-format --version)"
