#!/bin/sh
# The core has no mutable static data: .data, .bss and common symbols are
# empty. Tables of pointers to constants are in .data.rel.ro, which is constant
# after relocation. And every global symbol carries its real type, so that
# builds for double and for float cannot be linked by mistake.
. "$(dirname "$0")/lib.sh"
need objdump binutils
setting gcc -O3
for real in double float; do
  suffix=_f64
  [ "$real" = double ] || suffix=_f32
  library=$place/$real/libtwofold.a
  in_common "$library" || wrong "$library does not compile"
  objdump -t "$library" | awk -v library="$library" '
    { section = ""
      for (i = 2; i <= NF; i++)
        if ($i ~ /^(\.(data|bss|tdata|tbss)|\*COM\*)/) { section = $i; break }
      if (section == "" || section ~ /^\.data\.rel\.ro/) next
      if ($NF == section) next
      print library ": " $NF " is in " section
      bad = 1 }
    END { exit bad }' || BAD=$((BAD + 1))
  nm -g --defined-only -f posix "$library" |
    awk -v suffix="$suffix\$" 'NF > 1 && $1 !~ suffix { print $1; bad = 1 }
      NF > 1 { count++ }
      END { exit bad || !count }' || wrong "symbols of $library without $suffix"
done
checked "no byte of static data can change, every symbol carries its real type"
