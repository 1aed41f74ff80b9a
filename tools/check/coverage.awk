# Reports of gcov -b -c of many objects as one table, a row a file of src/, and
# what no object reached. A branch is known by its line and its number there;
# where a line is in more than one object (a header), any of them counts. Fails
# where a line or a branch is not reached.
function file_of(line) { sub(/.*0:Source:/, "", line); return line }

/^ *-: *0:Source:/ { file = file_of($0); wanted = file ~ /^src\//; next }
!wanted { next }
/^branch/ {
  key = file SUBSEP line SUBSEP $2
  branches[key] = 1
  if (/taken [1-9]/) taken[key] = 1
  next
}
/^(function|call|unconditional|-----)/ { next }
/^ *[-#=0-9*]+:/ {
  split($0, part, ":")
  gsub(/[ *]/, "", part[1])
  line = part[2] + 0
  if (part[1] == "-" || line == 0) next
  lines[file SUBSEP line] = 1
  text[file SUBSEP line] = $0
  sub(/^[^:]*:[^:]*: */, "", text[file SUBSEP line])
  if (part[1] + 0 > 0) reached[file SUBSEP line] = 1
}

END {
  for (key in lines) {
    split(key, part, SUBSEP)
    all[part[1]]++
    hit[part[1]] += key in reached
    if (key in reached) continue
    missed[key] = "no test reaches"
    bad = 1
  }
  for (key in branches) {
    split(key, part, SUBSEP)
    forks[part[1]]++
    gone[part[1]] += key in taken
    if (!(key in taken) && !((part[1] SUBSEP part[2]) in missed))
      missed[part[1] SUBSEP part[2]] = "no test takes branch " part[3] " of"
    bad = bad || !(key in taken)
  }
  in_order = "sort -t : -k 1,1 -k 2,2n"
  for (key in missed) {
    split(key, part, SUBSEP)
    printf "%s:%d: %s: %s\n", part[1], part[2], missed[key],
      text[key] | in_order
  }
  close(in_order)
  for (file in all) {
    printf "%-28s %5d of %5d lines, %5d of %5d branches\n", file, hit[file],
      all[file], gone[file], forks[file] | in_order
    a += hit[file]; b += all[file]; c += gone[file]; d += forks[file]
  }
  close(in_order)
  printf "%d of %d lines, %d of %d branches of src/\n", a, b, c, d
  exit bad || b == 0
}
