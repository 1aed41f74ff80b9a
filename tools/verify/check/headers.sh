#!/bin/sh
# The core includes five standard headers and its own (which: check `arrows`),
# and nothing of a board.
. "$(dirname "$0")/lib.sh"
files_in '*.[ch]' src include >"$BUILD/headers.list"
xargs grep -nE '^[[:space:]]*#[[:space:]]*include' <"$BUILD/headers.list" |
  grep -vE '#include (<(stdint|stdbool|stddef|float|limits)\.h>|"[^"]*")' &&
  wrong "a header that a freestanding core may not have"
# A board or a scene is data or a folder under port/, never a branch in src/.
# real.h and rounding.h ask the compiler for its arithmetic.
xargs grep -nE '^[[:space:]]*#[[:space:]]*(if|elif|ifdef|ifndef)' \
  <"$BUILD/headers.list" |
  grep -vE -e 'TF_[A-Z0-9_]+_H$|TWOFOLD_[A-Z0-9_]*H$' \
    -e 'TF_REAL_FLOAT|TF_API|TF_STEP_MACHINE$' |
  grep -vE '__cplusplus$|^(include/twofold/real|src/num/rounding)\.h:' &&
  wrong "a branch of the preprocessor that is not about the real type"
checked "$(wc -l <"$BUILD/headers.list") files of the core"
