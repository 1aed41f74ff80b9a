# Tables of work and precision, a section a part. Input: parts.csv, sweep.csv.
#
# Slopes are least squares of log(error) over log(dial) on settings that are
# neither another branch nor flagged, coarser than the one of least error, 30
# times above that error, which rounding or the other dial sets, and below a
# tenth of the part's border. `Error for T`: the least error that a setting of at
# most that time has, its two neighbours on the grid included, so that no lucky
# setting counts. `Time to E`: the least time of a setting that has it, the next two included.
FNR == 1 { file++ }
file == 1 {
  split($0, f, ",")
  names[++parts] = f[1]
  text[f[1]] = f[2]
  problem[f[1]] = f[3]
  window[f[1]] = f[4] " s to " f[5] " s"
  border[f[1]] = f[6]
  doubt[f[1]] = f[7]
  source[f[1]] = f[8]
  next
}
FNR == 1 { next }
{
  split($0, f, ",")
  s = f[1] "," f[3] "," f[2] "," f[4]
  if (!(s in n)) { series[f[1], ++count[f[1]]] = s; n[s] = 0 }
  i = ++n[s]
  x[s, i] = f[4] ~ /^tolerance/ ? f[6] : f[5]
  step[s, i] = f[5]
  e[s, i] = f[8] == "inf" ? 1e99 : f[8] + 0
  worst[s, i] = f[9] + 0
  event[s, i] = f[10]
  drift[s] = f[11] + 0 > drift[s] ? f[11] + 0 : drift[s]
  ns[s, i] = f[12]
  mark[s, i] = f[16]
  marks[s, f[16]]++
}
function log10(v) { return log(v) / log(10) }
function max(a, b) { return a > b ? a : b }
function slope(s, part, last, i, low, k, a, b, sx, sy, sxx, sxy, lo, hi) {
  low = 1e99
  last = 0
  for (i = 1; i <= n[s]; i++)
    if (mark[s, i] == "ok" && e[s, i] > 0 && e[s, i] < low) {
      low = e[s, i]
      last = i
    }
  k = sx = sy = sxx = sxy = 0
  lo = 1e99
  hi = 0
  for (i = 1; i < last; i++) {
    if (mark[s, i] != "ok" || e[s, i] < 30 * low) continue
    if (e[s, i] > 0.1 * border[part]) continue
    a = log10(x[s, i])
    b = log10(e[s, i])
    k++; sx += a; sy += b; sxx += a * a; sxy += a * b
    if (x[s, i] < lo) lo = x[s, i]
    if (x[s, i] > hi) hi = x[s, i]
  }
  if (k < 4 || hi < 4 * lo) return "-"
  return sprintf("%.1f", (k * sxy - sx * sy) / (k * sxx - sx * sx))
}
# What theory says: theta = 1/2; a series of order 8, 6 in float. Where slip
# falls into h = g = 0 the tolerance says how near is there, whatever the step.
function expected(part, scheme, real, dial) {
  if (scheme != "located")
    return part == "smooth" || part == "approach" ? "2" : "1"
  if (dial == "dt") return "none: the tolerance holds the error"
  if (dial == "order" && (part == "codim2" || part == "cycle"))
    return "none: the tolerance holds the fall into h = g = 0"
  if (dial == "order")
    return part == "smooth" || part == "approach" \
             ? (real == "double" ? "8" : "6") : ">= 3"
  return "1"
}
function bought(s, budget, i, j, worst3, best) {
  best = 1e99
  for (i = 1; i <= n[s]; i++) {
    if (ns[s, i] > budget) continue
    worst3 = 0
    for (j = max(1, i - 1); j <= i + 1 && j <= n[s]; j++)
      worst3 = max(worst3, mark[s, j] == "refused" ? 1e99 : e[s, j])
    if (worst3 < best) best = worst3
  }
  return best >= 1e99 ? "-" : sprintf("%.0e", best)
}
function time_to(s, error, i, j, good, best) {
  best = 1e99
  for (i = 1; i <= n[s]; i++) {
    good = 1
    for (j = i; j <= i + 2 && j <= n[s]; j++) if (e[s, j] > error) good = 0
    if (good && i < n[s] && ns[s, i] < best) best = ns[s, i]
  }
  return best >= 1e99 ? "-" : sprintf("%.3g", best / 1000)
}
# Largest ratio of the error of an event's time to the step; of LOCATED, whose
# events are inside the step, the largest error.
function events(s, scheme, dial, i, m, any) {
  m = any = 0
  for (i = 1; i <= n[s]; i++) {
    if (event[s, i] ~ /nan/ || mark[s, i] != "ok") continue
    any = 1
    m = max(m, scheme == "located" ? event[s, i] + 0 : event[s, i] / step[s, i])
  }
  if (!any) return "-"
  return scheme == "located" ? sprintf("%.0e s", m) : sprintf("%.2f dt", m)
}
function inside(s, i, m) { # worst over time / final, largest
  m = 1
  for (i = 1; i <= n[s]; i++)
    if (mark[s, i] == "ok" && e[s, i] > 0) m = max(m, worst[s, i] / e[s, i])
  return sprintf("%.3g", m)
}
# The best series of a scheme for a budget.
function best_bought(part, real, scheme, budget, j, f, b, best) {
  best = "-"
  for (j = 1; j <= count[part]; j++) {
    split(series[part, j], f, ",")
    if (f[2] != real || f[3] != scheme) continue
    b = bought(series[part, j], budget)
    if (b != "-" && (best == "-" || b + 0 < best + 0)) best = b
  }
  return best
}
END {
  print "\nError that a scheme buys, in double, its best dial:\n"
  print "| part | moreau: 3 us | 10 us | 100 us | 1 ms | carried: 3 us |" \
    " 10 us | 100 us | 1 ms | located: 3 us | 10 us | 100 us | 1 ms |"
  print "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  for (p = 1; p <= parts; p++) {
    printf "| %s |", text[names[p]]
    for (k = 1; k <= 3; k++)
      for (budget = 1; budget <= 4; budget++)
        printf " %s |", best_bought(names[p], "double",
          k == 1 ? "moreau" : k == 2 ? "carried" : "located",
          budget == 1 ? 3e3 : 10 ^ (budget + 2))
    print ""
  }
  for (p = 1; p <= parts; p++) {
    part = names[p]
    printf "\n### %s\n\n", text[part]
    printf "Problem `%s`, %s. Reference: %s, doubt %s.\n\n", problem[part],
      window[part], source[part], doubt[part]
    print "| real | scheme, dial | slope | expected | error for 3 us |" \
      " 10 us | 100 us | 1 ms | us to 1e-3 | to 1e-6 | to 1e-9 |" \
      " worst over time / final | event time | \\|h\\| in stick [m/s] |" \
      " ok, flagged, other branch, refused |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    for (j = 1; j <= count[part]; j++) {
      s = series[part, j]
      split(s, f, ",")
      printf "| %s | %s, %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |", \
        f[2], f[3], f[4], slope(s, part), expected(part, f[3], f[2], f[4]),
        bought(s, 3e3), bought(s, 1e4), bought(s, 1e5), bought(s, 1e6),
        time_to(s, 1e-3), time_to(s, 1e-6), time_to(s, 1e-9)
      printf " %s | %s | %s | %d, %d, %d, %d |\n", inside(s),
        events(s, f[3], f[4]), (drift[s] > 0) ? sprintf("%.0e", drift[s]) : "-",
        marks[s, "ok"], marks[s, "flagged"], marks[s, "branch"],
        marks[s, "refused"]
    }
  }
}
