# Stack of functions of a library, from what objdump -d says of a program that
# is linked from it (Arm Thumb and RISC-V):
#   { nm PROGRAM; objdump -d --no-show-raw-insn PROGRAM; } | awk -f frames.awk
# prints "name bytes". From each symbol on every way through the code is
# walked with the depth of the stack; a function is as deep as its deepest
# place, calls included. Behind a jump through a table every instruction of the
# function may follow, at that depth: an upper bound. What is not understood
# (recursion, a call through a pointer, a stack pointer out of a register) is
# told and ends with exit code 1.
BEGIN { symbols = count = rooms = 0 }

# nm: "address type name"; one place may have several names.
/^[0-9a-f]+ [TtWw] [^$]/ {
  sub(/^0+/, "", $1)
  start[symbols] = $1
  name_of[symbols++] = $3
  next
}

/^[0-9a-f]+ <.*>:$/ {
  rooms++
  next
}

# "address: mnemonic operands"
/^ *[0-9a-f]+:\t/ {
  address = $1
  sub(/:/, "", address)
  line = $0
  sub(/^[^\t]*\t/, "", line)
  sub(/[ \t]*[;@#] .*$/, "", line) # a comment
  text[count] = line
  at[address] = count
  room[count++] = rooms
}

function refuse(what) {
  print what >"/dev/stderr"
  bad = 1
}

# How many bytes the registers "{r4, r5, d8-d9}" take.
function size_of(list, each, n, i, bytes, ends) {
  gsub(/.*\{|\}.*/, "", list)
  n = split(list, each, /, */)
  for (i = 1; i <= n; i++) {
    ends = 1
    if (match(each[i], /-/))
      ends = substr(each[i], RSTART + 2) - substr(each[i], 2, RSTART - 2) + 1
    bytes += ends * (each[i] ~ /^d/ ? 8 : 4)
  }
  return bytes
}

# The number behind "#", or at the end of RISC-V's operands.
function number(line) {
  sub(/.*[#,]/, "", line)
  return line + 0
}

# By how much an instruction deepens the stack; one that pops on a condition may
# not have done so.
function change(line) {
  if (line ~ /^(v?push|stmdb)/) return (line ~ /stmdb/ && line !~ /sp!/) ? \
    0 : size_of(line)
  if (line ~ /^(v?pop|ldmia)[.w]*\t/) return (line ~ /ldmia/ && line !~ /sp!/) ? \
    0 : -size_of(line)
  if (line ~ /^sub[.w]*\tsp, (sp, )?#/) return number(line)
  if (line ~ /^add[.w]*\tsp, (sp, )?#/) return -number(line)
  if (line ~ /\[sp, #-[0-9]+\]!/) {
    sub(/\]!.*/, "", line)
    return -number(line)
  }
  if (line ~ /^v?ldrd?[.w]*\t.*\[sp\], #/) return -number(line)
  if (line ~ /^(c\.)?add(i|i16sp)?\tsp,sp,-?[0-9]/) return -number(line)
  if (line ~ /^sub\tsp,sp,t1/) return t1
  if (line ~ /^[a-z.0-9]+\tsp *,/ && line !~ /^(cmp|str|sw|sd|s[bh])/)
    refuse(line ": a stack pointer out of a register")
  return 0
}

# The address that an instruction names, "" where there is none.
function target_of(line) {
  if (!match(line, /[0-9a-f]+ </)) return ""
  return substr(line, RSTART, RLENGTH - 2)
}

function follow(i, deep) {
  if (!((walk, i) in seen) || seen[walk, i] < deep) {
    if (deep > 4096) {
      refuse(text[i] ": a stack without a bound")
      return
    }
    seen[walk, i] = deep
    to_do[++waiting] = i
  }
}

# What no way has come to yet in the function of instruction i, at one depth.
function follow_all(i, deep, j) {
  for (j = i; j > 0 && room[j - 1] == room[i]; j--) continue
  for (; j < count && room[j] == room[i]; j++)
    if (!((walk, j) in seen)) follow(j, deep)
}

# A jump through a table, which waits until no other way is left.
function open_table(i, deep) {
  if (!(walk in table) || table_deep[walk] < deep) {
    table[walk] = i
    table_deep[walk] = deep
  }
}

# One way: what is behind instruction i.
function pass(i, line, deep, target) {
  line = text[i]
  deep = seen[walk, i] + change(line)
  if (deep > most[walk]) most[walk] = deep
  if (line ~ /^li\tt1,/) t1 = number(line)
  target = target_of(line)
  if (line ~ /^\./) return # data
  if (line ~ /^(ret|jr\tra|bx\tlr|mov\tpc, lr)/) return
  if (line ~ /^((pop|ldmia[.w]*)\t.*pc\}|ldr[.w]*\tpc,)/) return
  if (line ~ /^jr\tt0/) {
    follow(behind[walk], deep)
    return
  }
  if (line ~ /^(mov\tpc,|(tbb|tbh|bx|jr)\t)/) {
    open_table(i, deep)
    return
  }
  if (line ~ /^jal\tt0,/) { # a prologue that is shared
    behind[walk] = i + 1
    follow(at[target], deep)
    return
  }
  if (line ~ /^(jalr?|bl[a-z]*)\t/ && line !~ /^bl(s|tu|eu|tz|ez|e|t)\t/) {
    if (target == "") refuse(line ": a call through a pointer")
    else calls[walk] = calls[walk] " " at[target] ":" deep
    if (line ~ /__gnu_thumb1_case/) open_table(i, deep)
  } else if (target != "" && line ~ /^(b|j|cb)/) {
    follow(at[target], deep)
    if (line ~ /^(j|b|b\.[nw])\t/) return
  }
  if (i + 1 < count) follow(i + 1, deep)
}

function worst(i, was, list, n, one, deep) {
  if (i in depth) return depth[i]
  if (i in open) {
    refuse(text[i] ": recursion")
    return 0
  }
  open[i] = 1
  was = walk
  walk = i
  most[i] = 0
  follow(i, 0)
  while (waiting > 0) {
    pass(to_do[waiting--])
    if (waiting == 0 && i in table) {
      follow_all(table[i], table_deep[i])
      delete table[i]
    }
  }
  walk = was
  n = split(calls[i], list, " ")
  deep = most[i]
  for (; n > 0; n--) {
    split(list[n], one, ":")
    one[2] += worst(one[1] + 0)
    if (one[2] > deep) deep = one[2]
  }
  delete open[i]
  return depth[i] = deep
}

END {
  for (s = 0; s < symbols; s++)
    if (start[s] in at) print name_of[s], worst(at[start[s]])
  exit bad
}
