#!/bin/sh
# Worst stack: no function of the core calls itself, through others or through
# a pointer, and each needs what its header says ("Stack: N B"): the worst over
# x86-64 and the 32-bit boards as they compile, in both real types, rounded up
# to a multiple of 16. Less is a broken promise, more a figure that no longer
# holds. Every figure is in BUILD/stack.table: "function target real bytes".
. "$(dirname "$0")/lib.sh"
BOARDS='microbit stm32f405 mps2-an500 hifive1 rv32fd'
need gcc gcc

fact() { "$MAKE" -s --no-print-directory "board-$2" BOARD="$1"; }

# Recursion, of tail calls too, which a compiler that optimises them turns into
# jumps that no call graph has. It must find one that is planted.
# recursion PLACE FILE...: fails where there is any.
recursion() {
  place=$1
  shift
  rm -rf "$place"
  mkdir -p "$place"
  for file; do
    (cd "$place" && gcc -std=c99 -O1 -fno-optimize-sibling-calls -fno-inline \
      -ffreestanding -I"$OLDPWD/include" -fcallgraph-info=su -S "$OLDPWD/$file")
  done
  awk -f tools/check/stack.awk "$place"/*.ci >"$place/worst" 2>"$place/said"
}
cat >"$BUILD/recursion-seed.c" <<'END'
unsigned hail(unsigned n, unsigned steps);
unsigned hail(unsigned n, unsigned steps) {
  return n == 1 ? steps : hail(n % 2 ? 3 * n + 1 : n / 2, steps + 1);
}
END
recursion "$BUILD/recursion-seed" "$BUILD/recursion-seed.c" &&
  wrong "a planted recursion is not found"
recursion "$BUILD/recursion" src/*/*.c || {
  cat "$BUILD/recursion/said"
  wrong "the core calls itself"
}

# "name bytes" of every public function.
# shellcheck disable=SC2016  # awk's own variables
files_in '*.h' include | xargs awk '
  /^\/\/\// { text = text " " substr($0, 4); next }
  /^#define tf_[a-z_0-9]+ TF_LINK/ { name = $2; next }
  (/^(TF_API|static inline) / && /\(/) {
    if (match($0, /tf_[a-z_0-9]+\(/) && name == "")
      name = substr($0, RSTART, RLENGTH - 1)
    sub(/ +/, " ", text)
    match(text, /Stack: +[0-9]+ B/)
    split(substr(text, RSTART, RLENGTH), row, " ")
    print name, row[2] + 0
  }
  { text = name = "" }' >"$BUILD/stack.claims"
[ -s "$BUILD/stack.claims" ] || wrong "no header claims a stack"

# graphs PLACE COMPILER FLAG...: compiles the core, a file that holds all its
# inline functions and the memory functions of the boards, one at a time.
graphs() {
  place=$1
  shift
  rm -rf "$place"
  mkdir -p "$place"
  echo '#include "twofold.h"' >"$place/inline.c"
  root=$PWD
  (cd "$place" && "$@" -std=c99 -ffp-contract=off -fno-math-errno \
    -ffreestanding -I"$root/include" -I"$root/src" -fcallgraph-info=su -S \
    "$root"/src/*/*.c) || wrong "$place: the core does not compile"
  (cd "$place" && "$@" -std=c99 -ffreestanding -I"$root/include" -S \
    -fcallgraph-info=su -fkeep-inline-functions inline.c) ||
    wrong "$place: the inline functions do not compile"
}

# libraries PLACE BOARD COMPILER FLAG...: what functions of the C library and
# of soft float take, into PLACE/library, from their instructions.
libraries() {
  place=$1 board=$2
  shift 2
  root=$PWD
  (cd "$place" && "$@" -std=c99 -S -fcallgraph-info=su \
    "$root/port/arch/memory.c") || wrong "$board: memory.c does not compile"
  wanted=$(sed -n 's/^edge:.* targetname: "\([^":]*\)".*/\1/p' "$place"/*.ci |
    sort -u | grep -vE '^(tf_|mem)' | sed 's/^/-Wl,-u,/')
  # The linker script of the board has no room for all of it at once.
  link=$(fact "$board" LINK | tr ' ' '\n' | grep -v '^-T')
  # shellcheck disable=SC2086  # lists
  "$@" $wanted $link -Wl,-e,0 -Wl,--no-gc-sections -o "$place/library.elf" ||
    wrong "$board: its libraries do not link"
  tools=$(fact "$board" TOOLS)
  { "${tools}nm" "$place/library.elf"
    "${tools}objdump" -d --no-show-raw-insn "$place/library.elf"; } |
    awk -f tools/check/frames.awk >"$place/library" ||
    wrong "$board: the stack of its libraries has no bound"
}

# judge TARGET REAL PLACE [FLAG OF AWK...]: lines of the table.
judge() {
  target=$1 real=$2 place=$3
  shift 3
  suffix=_f64
  [ "$real" = double ] || suffix=_f32
  [ -e "$place/library" ] || : >"$place/library"
  awk "$@" -f tools/check/stack.awk "$place/library" "$place"/*.ci \
    "$place"/*.s >"$place/worst" || wrong "$target: no bound of the stack"
  awk -v target="$target" -v real="$real" -v suffix="$suffix" '
    FNR == NR { claimed[$1]; next }
    { sub(suffix "$", "", $1) }
    $1 in claimed { print $1, target, real, $2 }' \
    "$BUILD/stack.claims" "$place/worst" >>"$BUILD/stack.table"
}

define_of() {
  [ "$1" = double ] && echo -UTF_REAL_FLOAT || echo -DTF_REAL_FLOAT
}

: >"$BUILD/stack.table"
for real in double float; do
  graphs "$BUILD/stack-x86-64-$real" gcc -O2 "$(define_of "$real")"
  judge x86-64 "$real" "$BUILD/stack-x86-64-$real"
done
for board in $BOARDS; do
  compiler=$(fact "$board" CC)
  compiler=${compiler:-$(fact "$board" TOOLS)gcc}
  need "$compiler" "$(fact "$board" PACKAGES)"
  optimise=$(fact "$board" OPT)
  for real in $(fact "$board" REALS); do
    place=$BUILD/stack-$board-$real
    # shellcheck disable=SC2046  # a list of flags
    set -- "$compiler" "${optimise:--Os}" $(fact "$board" FLAGS) \
      "$(define_of "$real")"
    graphs "$place" "$@"
    libraries "$place" "$board" "$@"
    judge "$board" "$real" "$place" -v LIBRARY=-1
  done
done

# Of each function: claimed, worst, rounded, where.
awk 'FNR == NR { claimed[$1] = $2; next }
  !($1 in worst) || $4 > worst[$1] { worst[$1] = $4; where[$1] = $2 " in " $3 }
  END {
    for (name in claimed)
      print name, claimed[name], worst[name] + 0, \
        int((worst[name] + 15) / 16) * 16, \
        (name in where) ? where[name] : "in no library"
  }' "$BUILD/stack.claims" "$BUILD/stack.table" | sort >"$BUILD/stack.worst"
while read -r name claimed worst rounded where; do
  [ "$claimed" -eq "$rounded" ] ||
    wrong "$name: its header says $claimed B, it needs $worst B ($where)," \
      "that is $rounded B"
done <"$BUILD/stack.worst"
[ "$BAD" -eq 0 ] ||
  echo 'figures that hold, into the rows: make bounds && make keep-bounds'
checked "$(wc -l <"$BUILD/stack.claims") functions need what they claim," \
  "no recursion; x86-64 and $(echo "$BOARDS" | wc -w) boards, both real types"
