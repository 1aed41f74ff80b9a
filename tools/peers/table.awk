# Rows of all rounds in, `problem,peer,setting,steps,error,ns,branch` out to
# CSV, with the median time of the rounds; and a table: for each problem and
# peer the least time at which an error is reached and kept at every finer
# setting of the sweep. Where a peer has two settings (width of a smoothed law,
# then step or tolerance), the best width counts, with the steps or tolerances
# at that width. Fewer than three settings in a row are luck.
# The first line of the CSV says what was measured.
# Usage: awk -F, -v csv=FILE -v stamp=TEXT -f table.awk ROWS
function median(list, n, x, i, j, keep) {
  n = split(list, x, " ")
  for (i = 2; i <= n; i++) {
    keep = x[i] + 0
    for (j = i - 1; j >= 1 && x[j] + 0 > keep; j--) x[j + 1] = x[j]
    x[j + 1] = keep
  }
  return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
}
function shown(ns) {
  if (ns < 1e6) return sprintf("%.3g us", ns / 1e3)
  if (ns < 1e9) return sprintf("%.3g ms", ns / 1e6)
  return sprintf("%.3g s", ns / 1e9)
}
# Least time of one series to keep an error; -1 where it is not kept.
function kept(name, error, i, n, best) {
  best = -1
  n = 0
  for (i = length_of[name]; i >= 1; i--) {
    if (!(rank[name, i] in error_of) || error_of[rank[name, i]] > error) break
    n++
    if (best < 0 || time_of[rank[name, i]] < best)
      best = time_of[rank[name, i]]
  }
  return n < 3 ? -1 : best
}
# Puts the rows of a series in order, the coarsest setting first.
function sort_series(name, n, i, j, keep) {
  n = length_of[name]
  for (i = 2; i <= n; i++) {
    keep = rank[name, i]
    for (j = i - 1; j >= 1 && value[rank[name, j]] < value[keep]; j--)
      rank[name, j + 1] = rank[name, j]
    rank[name, j + 1] = keep
  }
}
# One line of the table.
function print_peer(group, n, j, k, all, wrong, level, least, time, name,
                    series_of) {
  n = split(members[group], series_of, "\n") - 1
  all = wrong = 0
  for (j = 1; j <= n; j++) {
    sort_series(series_of[j])
    for (k = 1; k <= length_of[series_of[j]]; k++) {
      all++
      wrong += !branch[rank[series_of[j], k]]
    }
  }
  split(group, name, ",")
  printf "%-10s %-15s", name[1], name[2]
  for (level = 3; level <= 9; level += 3) {
    least = -1
    for (j = 1; j <= n; j++) {
      time = kept(series_of[j], 10 ^ -level)
      if (time >= 0 && (least < 0 || time < least)) least = time
    }
    printf " %10s", least < 0 ? "never" : shown(least)
  }
  printf "  %d, %d\n", all, wrong
}
NF != 7 { next }
{
  row = $1 "," $2 "," $3
  if (!(row in times)) {
    rows[++count] = row
    head[row] = row "," $4 "," $5
    branch[row] = $7
    error_of[row] = $5 == "inf" || $5 == "Inf" ? 1e300 : $5 + 0
    if (!($1 in seen)) problems[++problem_count] = $1
    seen[$1]
    series = $1 "," $2
    if (split($3, part, " ") > 1) series = series "," part[1]
    value[row] = part[split($3, part, " ")]
    sub(/.*=/, "", value[row])
    value[row] += 0
    if (!(series in length_of)) {
      group = $1 "," $2
      if (!(group in members)) groups[++group_count] = group
      members[group] = members[group] series "\n"
    }
    rank[series, ++length_of[series]] = row
  }
  times[row] = times[row] " " $6
}
END {
  print "# " stamp >csv
  print "problem,peer,setting,steps,error,ns,branch" >csv
  for (i = 1; i <= count; i++) {
    time_of[rows[i]] = median(times[rows[i]])
    printf "%s,%.0f,%d\n", head[rows[i]], time_of[rows[i]], branch[rows[i]] >csv
  }
  printf "%-10s %-15s %10s %10s %10s  %s\n", "problem", "peer", "1e-3", "1e-6",
    "1e-9", "settings, of them wrong branch or failed"
  for (p = 1; p <= problem_count; p++)
    for (i = 1; i <= group_count; i++)
      if (index(groups[i], problems[p] ",") == 1) print_peer(groups[i])
}
