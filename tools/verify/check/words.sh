#!/bin/sh
# The core has no heap, no long jump and no text output; that it has no array
# of variable length is -Wvla (check gcc), no recursion: check stack.
. "$(dirname "$0")/lib.sh"
files_in '*.[ch]' src include >"$BUILD/words.list"
CALLS='malloc|calloc|realloc|free|alloca|printf|exit|abort'
WORDS='setjmp|longjmp|goto|asm|__asm__|volatile|_Thread_local'
# Comments may name what the code must not do.
while read -r file; do
  sed -e 's://.*::' -e 's:/\*.*\*/::g' "$file" |
    grep -nE "\b($CALLS) *\(|\b($WORDS)\b" |
    sed "s|^|$file:|"
done <"$BUILD/words.list" >"$BUILD/words.found"
if [ -s "$BUILD/words.found" ]; then
  cat "$BUILD/words.found"
  wrong "words that have no place in the core"
fi
checked "$(wc -l <"$BUILD/words.list") files of the core without heap or jumps"
