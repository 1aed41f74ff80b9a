#!/bin/sh
# The core has no mutable static data: .data, .bss and common symbols are
# empty. Tables of pointers to constants are in .data.rel.ro, which is constant
# after relocation.
. "$(dirname "$0")/lib.sh"
need objdump binutils
for real in double float; do
  core_library "$real" ||
    wrong "$library does not compile"
  objdump -t "$library" | awk -v library="$library" '
    { section = ""
      for (i = 2; i <= NF; i++)
        if ($i ~ /^(\.(data|bss|tdata|tbss)|\*COM\*)/) { section = $i; break }
      if (section == "" || section ~ /^\.data\.rel\.ro/) next
      if ($NF == section) next
      print library ": " $NF " is in " section
      bad = 1 }
    END { exit bad }' || BAD=$((BAD + 1))
done
checked "no byte of static data can change, both real types"
