# Whether rows "Cost" hold: judge.awk CLAIMS WAYS FOUND FOUND, with lines "name A
# B W", "name longest way" of double and "name units count genes" of double, then
# of float. A count above A + B units
# breaks the promise; where the row says more than 1.25 times the most that was
# found, its figure no longer holds. So with W and the longest way, which no
# count is above. Prints what is wrong.
FNR == 1 { part++ }

part == 1 {
  claimed[$1] = $2
  slope[$1] = $3
  ways[$1] = $4
  next
}

part == 2 {
  if ($2 != "-") longest[$1] = $2
  next
}

part == 3 && $1 in longest && $3 > longest[$1] {
  print $1 ": took " $3 ", its longest way has " longest[$1]
}

!($1 in claimed) {
  print $1 ": no row of a header has its cost"
  next
}

{
  bound = claimed[$1] + slope[$1] * $2
  if ($3 > bound)
    print $1 ": its header says " bound " instructions for " $2 \
      " units, it took " $3 " (" $4 ")"
  searched[$1]
  if ($3 > most[$1, $2 + 0]) most[$1, $2 + 0] = $3
}

END {
  for (name in claimed) {
    if (!(name in searched)) {
      print name ": tools/cost does not call it"
      continue
    }
    if (ways[name] > 0 && \
        (ways[name] < longest[name] || ways[name] > 1.25 * longest[name]))
      print name ": its header says that no way has more than " ways[name] \
        " instructions, the longest has " longest[name]
  }
  for (key in most) {
    split(key, part, SUBSEP)
    bound = claimed[part[1]] + slope[part[1]] * part[2]
    if (bound > 1.25 * most[key])
      print part[1] ": its header says " bound " instructions for " part[2] \
        " units, " most[key] " is the most that was found"
  }
}
