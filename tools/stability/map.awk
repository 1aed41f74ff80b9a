# The data of one map for gnuplot: a block a sweep of its cells (log10 dt, row,
# verdict) to standard output, axes and tick labels to the file SETTINGS.
#   awk -f map.awk -v real=REAL -v scheme=SCHEME -v settings=FILE LIST CELLS
function shorter(number) {
  sub(/e\+0?/, "e", number)
  sub(/e-0/, "e-", number)
  return number
}
BEGIN {
  code["ok"] = 1
  code["degraded"] = 2
  code["physics"] = 3
  code["too_long"] = 4
  code["diverged"] = 5
  code["created"] = 6
  code["bad_parameter"] = 7
  code["touched"] = code["non_finite"] = 8
}
FILENAME != last { file++; last = FILENAME }
file == 1 {
  split($0, part, "|")
  axis[++names] = part[2] (part[3] == "" ? "" : " [" part[3] "]")
  at[part[1]] = names
  next
}
{
  split($0, f, ",")
  if (f[4] != real || f[5] != scheme) next
  n = at[f[1]]
  rows[n] = f[2] > rows[n] ? f[2] : rows[n]
  label[n, f[2]] = shorter(f[3])
  cells[n] = cells[n] sprintf("%.3f %d %d\n", log(f[6]) / log(10), f[2], \
    code[f[7]])
}
END {
  printf "heading = '%s in %s'\npanels = %d\n", scheme, real, names >settings
  printf "array axis[%d]\narray rows[%d]\n", names, names >settings
  for (n = 1; n <= names; n++) {
    printf "axis[%d] = '%s'\nrows[%d] = %d\n", n, axis[n], n, rows[n] >settings
    # At most eight labels, else they touch; names are few and need them all.
    every = rows[n] < 9 ? 1 : int(rows[n] / 7 + 0.99)
    text = ""
    for (i = 0; i <= rows[n]; i += every)
      text = text sprintf("%s\"%s\" %d", i ? ", " : "", label[n, i], i)
    printf "ticks%d = 'set ytics (%s)'\n", n, text >settings
    printf "%s\n\n", cells[n]
  }
}
