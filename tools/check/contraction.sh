#!/bin/sh
# Bits under foreign build systems: compiled in gnu mode with none of the
# project's flags, the core has no fused operation on five targets that have
# them, the golden hashes hold, and each option that changes bits and that a
# macro tells of is refused. A control shows that each count can see one.
. "$(dirname "$0")/lib.sh"
need gcc gcc
need clang clang
need arm-none-eabi-gcc gcc-arm-none-eabi
need riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf
here=$(pwd)
work=$here/$BUILD/contraction
case $BUILD in /*) work=$BUILD/contraction ;; esac
rm -rf "$work"
mkdir -p "$work"
FUSED='[[:space:]](vfn?m[as]\.|vfn?m(add|sub)|fn?m(add|sub)\.)'
echo 'double f(double a, double b, double c) { return a * b + c; }
float g(float a, float b, float c) { return a * b + c; }' >"$work/control.c"

# fused SOURCE...: how many fused operations `compiler` makes of the sources.
fused() {
  rm -f "$work"/*.s
  # shellcheck disable=SC2086  # the compiler and its options
  (cd "$work" && $compiler -S -I"$here/include" "$@") || return 1
  cat "$work"/*.s | grep -cE "$FUSED"
}

sources=$(find "$here/src" -name '*.c')
# The types that a target computes in hardware, its compiler and options.
while read -r reals compiler; do
  for real in $(echo "$reals" | sed 's/both/double float/'); do
    define=-UTF_REAL_FLOAT
    [ "$real" = double ] || define=-DTF_REAL_FLOAT
    # shellcheck disable=SC2086  # a list of files
    count=$(fused -std=gnu17 -O2 $define $sources)
    [ "$count" = 0 ] ||
      wrong "$compiler, $real: ${count:-no} fused operations"
  done
  control=$(fused -std=gnu17 -O2 -ffp-contract=fast control.c)
  [ "${control:-0}" -gt 0 ] || wrong "$compiler: the control has none"
done <<'END'
float arm-none-eabi-gcc -mcpu=cortex-m33 -mfloat-abi=hard
both arm-none-eabi-gcc -mcpu=cortex-m7 -mfloat-abi=hard
float arm-none-eabi-gcc -mcpu=cortex-m4 -mfloat-abi=hard
float riscv64-unknown-elf-gcc -ffreestanding -march=rv32imafc -mabi=ilp32f
both gcc -march=haswell
double gcc -march=haswell -ffp-contract=fast
both clang -march=haswell
END

# The golden hashes, in gnu mode, on what this processor has.
for compiler in gcc clang; do
  flags="-std=gnu17 -O2 -march=native -Iinclude"
  build CC=$compiler BUILD="$work/$compiler" \
    TESTS='tests/golden/test_golden.c tests/golden/test_population.c' \
    CORE_FLAGS="$flags" TEST_FLAGS="$flags -Itests -Itests/support -Isrc" \
    test || wrong "$compiler: other golden hashes in gnu mode"
done

# What is refused, by compiler and options.
refused=0
while read -r compiler options; do
  # shellcheck disable=SC2086
  if $compiler $options -c -Iinclude src/moreau/step.c -o "$work/step.o" \
    2>/dev/null; then
    wrong "$compiler $options is not refused"
  fi
  refused=$((refused + 1))
done <<'END'
gcc -Ofast
gcc -ffast-math
gcc -funsafe-math-optimizations
gcc -fassociative-math -fno-signed-zeros -fno-trapping-math
gcc -freciprocal-math
gcc -ffinite-math-only
gcc -fno-signed-zeros
gcc -fsingle-precision-constant
gcc -mfpmath=387
clang -Ofast
clang -ffast-math
clang -ffinite-math-only
END
checked "no fused operation in gnu mode on M33, M7, M4F, rv32imafc and x86," \
  "golden hashes hold by gcc and clang, $refused options are refused"
