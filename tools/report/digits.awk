# Errors of runs with carried and plain steps against the reference run in
# double. Input: lines `part k real scheme r v w`. Output: CSV
#   part,dt,scheme error,double plain,float plain,carried float / scheme,
#   carried float
# where the scheme's error is that of the carried double.
function error(k, i, m, d) {
  m = 0
  for (i = 1; i <= 3; i++) {
    d = x[k, i] - x[part[k] " reference", i]
    if (d < 0) d = -d
    if (d > m) m = d
  }
  return m
}
$4 == "reference" { k = $1 " reference" }
$4 != "reference" { k = $1 " " $2 " " $3 " " $4; if (!(($1, $2) in seen)) {
  seen[$1, $2]; row[++rows] = $1 " " $2 } }
{ part[k] = $1; for (i = 1; i <= 3; i++) x[k, i] = $(4 + i) }
END {
  print "part,dt,scheme,double plain,float plain,ratio,float carried"
  for (r = 1; r <= rows; r++) {
    split(row[r], f, " ")
    scheme = error(row[r] " double carried")
    kept = error(row[r] " float carried")
    printf "%s,%.4g,%.2e,%.2e,%.2e,%.4g,%.2e\n", f[1], 2 ^ -f[2], scheme,
      error(row[r] " double plain"), error(row[r] " float plain"),
      kept / scheme, kept
  }
}
