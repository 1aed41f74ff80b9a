# Errors of runs with carried and plain steps against the reference run in
# double. Input: lines `run dt real scheme r v w`. Output: CSV with the errors
# of
#   scheme         the carried step in double: its own error, no rounding
#   double plain, float plain, float carried
# then ratio = float carried / scheme, the ulp of float at the largest of r, v
# and w at the end, and what that says. Where a float cannot tell the ends of
# the two runs apart, the ratio says nothing.
function error(k, of, i, m, d) {
  m = 0
  for (i = 1; i <= 3; i++) {
    d = x[k, i] - x[of, i]
    if (d < 0) d = -d
    if (d > m) m = d
  }
  return m
}
function ulp(k, i, m, d) {
  m = 0
  for (i = 1; i <= 3; i++) {
    d = x[k, i] < 0 ? -x[k, i] : x[k, i]
    if (d > m) m = d
  }
  d = 1
  while (d > m) d /= 2
  while (d * 2 <= m) d *= 2
  return d * 2 ^ -23
}
{
  k = $1 " " ($4 == "reference" ? "" : $2 " ") $3 " " $4
  for (i = 1; i <= 3; i++) x[k, i] = $(4 + i)
  if ($4 != "reference" && !(($1, $2) in seen)) {
    seen[$1, $2]
    row[++rows] = $1 " " $2
  }
}
END {
  print "run,dt,scheme,double plain,float plain,float carried,ratio,ulp,verdict"
  for (r = 1; r <= rows; r++) {
    split(row[r], f, " ")
    true = f[1] " double reference"
    scheme = error(row[r] " double carried", true)
    kept = error(row[r] " float carried", true)
    last = ulp(true)
    verdict = "within 3"
    if (!(kept <= 3 * scheme))
      verdict = kept <= last ? "below one ulp of a float" : "not reached"
    printf "%s,%s,%.2e,%.2e,%.2e,%.2e,%s,%.1e,%s\n", f[1], f[2], scheme,
      error(row[r] " double plain", true), error(row[r] " float plain", true),
      kept, (scheme > 0) ? sprintf("%.3g", kept / scheme) : "-", last, verdict
  }
}
