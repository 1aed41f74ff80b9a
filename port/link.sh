#!/bin/sh
# Links a firmware: link.sh WHAT LARGER COMMAND...
# What does not fit is reported in one line, by how much and which board LARGER
# has room for it, instead of by the linker's list of what it could not place.
set -u
what=$1 larger=$2
shift 2
said=$("$@" 2>&1) && {
  [ -z "$said" ] || printf '%s\n' "$said" >&2
  exit 0
}
# The linker counts anew for every section that it places: the last is the most.
region=$(printf '%s\n' "$said" |
  sed -n "s/.*region .\(.*\). overflowed by \([0-9]*\) bytes.*/\1 \2/p" |
  sort -k 2n | tail -n 1)
stack=$(printf '%s\n' "$said" | grep -c 'no room for the stack')
if [ -n "$region" ]; then
  lacks="${region#* } bytes too large for the board's memory (${region% *})"
elif [ "$stack" -gt 0 ]; then
  lacks='too large for the RAM: it leaves too little for the stack'
else
  printf '%s\n' "$said" >&2
  exit 1
fi
echo "$what is $lacks${larger:+; BOARD=$larger has room for it}" >&2
exit 1
