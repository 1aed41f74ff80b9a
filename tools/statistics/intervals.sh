# shellcheck shell=sh
# Intervals of 95 % as functions of awk, for the scripts that source this.
# shellcheck disable=SC2034  # they use them

# wilson(k, n): the share k / n with Wilson's interval, in the format `share`.
shares='
  function wilson(k, n,    p, z, c, h) {
    if (n == 0) return "-"
    z = 1.959964; p = k / n
    c = (p + z * z / (2 * n)) / (1 + z * z / n)
    h = z / (1 + z * z / n) * sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return sprintf(share, p, c - h < 1e-12 ? 0 : c - h,
      c + h > 1 - 1e-12 ? 1 : c + h)
  }'

# quantile(p, n): of the sorted numbers x[1] to x[n], in the format `three`: the
# ranks n p and n p -+ 1.96 sqrt(n p (1 - p)).
quantiles='
  function rank(r, n) { r = int(r + 0.5); return x[r < 1 ? 1 : r > n ? n : r] }
  function quantile(p, n,    d) {
    d = 1.959964 * sqrt(n * p * (1 - p))
    return sprintf(three, rank(n * p, n), rank(n * p - d, n),
      rank(n * p + d, n))
  }'
