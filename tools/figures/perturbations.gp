# New: distributions by the perturbation that decides where the future is open.
# Shares are of all samples: a curve that ends below 1 did not get there.
wide = 1700; high = 700
@OPEN
kinds = 'random noise smoothing hysteresis delay'
array colour_of[5] = [black, red, blue, green, orange]
array dash[5] = ['solid', '(10,4)', '(4,3)', '(12,3,3,3)', '(2,2)']
array size_of[5] = ['10 1/s', '10^{-4} m s^{-3/2}', '10^{-5} m/s', \
  '10^{-3} m/s', '10^{-3} s']
file(kind, k) = sprintf('%s/%s-%s.csv', data, kind, word(kinds, k))
# Values of a column of the rows in which it stands, sorted, with their share of
# all samples; the outcome, if given, is the third field.
sorted(kind, k, c, outcome) = sprintf("< awk -F, -v n=$(($(wc -l < %s) - 1)) " \
  ."'NR > 1 && $%d != \"\" && (\"%s\" == \"\" || $3 == \"%s\") " \
  ."{ print $%d, 1 / n }' %s | sort -g | awk '{ s += $2; print $1, s }'", \
  file('returns', k), c, outcome, outcome, c, file(kind, k))
set multiplot
set bmargin at screen 0.17
set tmargin at screen 0.74
set grid lc rgb '#dddddd'
set yrange [0:1]
set ytics 0.25
set ylabel 'share of the samples [1]' offset 0.8
set key at screen 0.5,0.99 center top horizontal maxrows 2 font ',19'
set lmargin at screen 0.075; set rmargin at screen 0.33
set title '(a) exit' offset 0,-0.4
set logscale x
set xrange [1e-4:1]
set format x '10^{%T}'
set xlabel 'time after the two-fold [s]'
plot for [k=1:5] sorted('exits', k, 3, '') with steps lw 3 \
  dt k lc rgb colour_of[k] title word(kinds, k).', '.size_of[k]
unset key
set ylabel ''
set format y ''
unset logscale
set format x '%.4f'
set lmargin at screen 0.385; set rmargin at screen 0.64
set title '(b) landing' offset 0,-0.4
set xrange [0.1815:0.1835]
set xtics 0.001
set xlabel 'on the upper sliding region at r [m]'
plot for [k=1:5] sorted('returns', k, 8, '') with steps lw 3 dt k \
  lc rgb colour_of[k]
set lmargin at screen 0.695; set rmargin at screen 0.95
set title '(c) return' offset 0,-0.4
set logscale x
set xrange [1.5:300]
set format x '%g'
set xtics (2, 5, 10, 20, 50, 100, 200)
set xlabel 'time to the two-fold again [s]'
plot for [k=1:5] sorted('returns', k, 4, 'returned') with steps lw 3 dt k \
  lc rgb colour_of[k]
unset multiplot
