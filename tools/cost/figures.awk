# Figures of the rows "Cost" from the longest ways ("name way") and what the
# search found ("name units count genes"), in two files: lines "name Cost A B W",
# two leading digits rounded up, so that a search which finds a little more does
# not break a row. Where the longest way is hardly longer than what was found, A
# is that: no input whatever takes more.
function up(x, unit) {
  for (unit = 1; x / unit > 100; unit *= 10) continue
  return int((x + unit - 1) / unit) * unit
}

FNR == NR {
  way[$1] = $2
  next
}

{
  if (!($1 in last)) order[names++] = $1
  if ($3 + 0 >= at[$1, $2] + 0) at[$1, $2] = $3
  if ($2 + 0 >= last[$1] + 0) last[$1] = $2
  sizes[$1] = sizes[$1] " " $2
}

END {
  for (i = 0; i < names; i++) {
    name = order[i]
    if (last[name] == 0) {
      most = up(at[name, 0])
      if (way[name] >= at[name, 0] && way[name] <= 1.25 * at[name, 0])
        most = up(way[name]) <= 1.25 * at[name, 0] ? up(way[name]) : way[name]
      print name, "Cost", most, 0, up(way[name])
      continue
    }
    slope = (at[name, last[name]] - at[name, 0]) / last[name]
    slope = up(int(slope) + (slope > int(slope)))
    n = split(sizes[name], size, " ")
    for (first = 0; n > 0; n--) {
      rest = at[name, size[n]] - slope * size[n]
      if (rest > first) first = rest
    }
    print name, "Cost", up(first), slope, 0
  }
}
