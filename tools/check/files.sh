#!/bin/sh
# What holds for files as such: none over 500 lines, no line of C, Python, make
# or of a *.sh over 80 columns, no marker of unfinished work, no path of one
# machine.
. "$(dirname "$0")/lib.sh"
ROOMS='Makefile .ci include src port tests tools'

# shellcheck disable=SC2086  # a list of rooms
files_in '*' $ROOMS >"$BUILD/files.list"
while read -r file; do
  lines=$(wc -l <"$file")
  [ "$lines" -le 500 ] || wrong "$file: $lines lines, at most 500"
  case $file in
  *.[ch] | *.sh | *.py | *.mk | Makefile) ;;
  *) continue ;;
  esac
  awk -v file="$file" '
    length($0) > 80 { print file ":" FNR ": " length($0) " columns"; bad = 1 }
    END { exit bad }' "$file" || BAD=$((BAD + 1))
done <"$BUILD/files.list"

find . -path ./.git -prune -o -path ./build -prune -o -path "./$BUILD" -prune \
  -o -type f -print | sort >"$BUILD/files.all"
xargs grep -InE '\b(TO''DO|FIX''ME|X''XX|HA''CK)\b' <"$BUILD/files.all" &&
  wrong "markers of unfinished work"
# The brackets keep the pattern from finding itself.
xargs grep -InE '(^|[^[:alnum:]_.}])/([w]ork|[h]ome|[r]oot|[U]sers)/' \
  <"$BUILD/files.all" && wrong "paths of one machine"
checked "$(wc -l <"$BUILD/files.list") files <= 500 lines," \
  "C, Python, make and *.sh in 80 columns;" \
  "no markers, no machine's paths in $(wc -l <"$BUILD/files.all") files"
