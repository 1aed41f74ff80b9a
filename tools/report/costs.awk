# Median, 99 % and largest cost of the steps of a run. Input: lines "REAL SCHEME
# BUILD PART STEPS step cost", the costs of a run in rising order. Output: CSV.
function flush(f) {
  if (n == 0) return
  split(run, f, " ")
  printf "%s,%s,%s,%s,%s,%s,%d,%.5g,%.5g,%.5g\n", unit, f[1], f[2], f[3], f[4],
    f[5], n, x[int((n + 1) / 2)], x[int(0.99 * (n - 1)) + 1], x[n]
}
{
  key = $1 " " $2 " " $3 " " $4 " " $5
  if (key != run) { flush(); run = key; n = 0 }
  x[++n] = $7
}
END { flush() }
