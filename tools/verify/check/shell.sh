#!/bin/sh
# Shell scripts: shellcheck finds nothing wrong.
. "$(dirname "$0")/lib.sh"
need shellcheck shellcheck
{
  files_in '*' .ci tests tools port | while read -r file; do
    head -n 1 "$file" | grep -Eq '^#!.*\b(ba)?sh$' && echo "$file"
  done
  echo tools/verify/check/lib.sh
} >"$BUILD/shell.list"
xargs shellcheck -x -P SCRIPTDIR <"$BUILD/shell.list" || wrong "shellcheck"
checked "$(wc -l <"$BUILD/shell.list") scripts"
