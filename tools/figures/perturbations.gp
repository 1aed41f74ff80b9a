# New: distributions by the perturbation that decides where the future is open.
# Shares are of all samples: a curve that ends below 1 did not get there.
wide = 1700; high = 760
@OPEN
kinds = 'random noise smoothing hysteresis delay'
array colour_of[5] = [black, red, blue, green, orange]
array size_of[5] = ['10 1/s', '10^{-4} m s^{-3/2}', '10^{-5} m/s', \
  '10^{-3} m/s', '10^{-3} s']
file(what, k) = sprintf('%s/%s-%s.csv', data, what, word(kinds, k))
# Quantiles of a column of the rows in which it stands, of all samples; the
# outcome, if given, is the third field. From share 0 on, 100 steps at most.
sorted(what, k, c, outcome) = sprintf("< n=$(($(wc -l < %s) - 1)); " \
  ."awk -F, 'NR > 1 && $%d > 0 && (\"%s\" == \"\" || $3 == \"%s\") " \
  ."{ print $%d }' %s | sort -g | awk -v n=$n '{ v[NR] = $1 } END { " \
  ."if (NR) print v[1], 0; d = int(NR / 100) + 1; " \
  ."for (i = d; i <= NR; i += d) print v[i], i / n; " \
  ."if (NR) print v[NR], NR / n }'", \
  file('returns', k), c, outcome, outcome, c, file(what, k))
came(k) = system(sprintf("awk -F, 'NR > 1 { n++; if ($3 == \"returned\") m++ } " \
  ."END { printf \"%%.0f %%%% of %%d return\", 100 * m / n, n }' %s", \
  file('returns', k)))
set multiplot
unset key
set bmargin at screen 0.16
set tmargin at screen 0.73
set grid lc rgb '#dddddd'
set yrange [0:1.02]
set ytics 0.25
set ylabel 'share of the samples [1]' offset 0.8
set lmargin at screen 0.085; set rmargin at screen 0.335
set title '(a) exit' offset 0,-0.4
set logscale x
set xrange [1e-3:1]
set format x '10^{%T}'
set xlabel 'time after the two-fold [s]'
plot for [k=1:5] sorted('exits', k, 3, '') with lines lw 3.5 \
  lc rgb colour_of[k]
unset ylabel
set format y ''
unset logscale
set format x '%.4f'
set lmargin at screen 0.40; set rmargin at screen 0.65
set title '(b) first landing' offset 0,-0.4
set xrange [0.1815:0.1837]
set xtics 0.1820,0.001
set xlabel 'on the upper sliding region at r [m]'
plot for [k=1:5] sorted('returns', k, 8, '') with lines lw 3.5 \
  lc rgb colour_of[k]
set lmargin at screen 0.715; set rmargin at screen 0.965
set title '(c) return' offset 0,-0.4
set logscale x
set xrange [1.5:300]
set format x '%g'
set xtics (2, 5, 10, 20, 50, 100, 200)
set xlabel 'time from the exit to the return [s]'
plot for [k=1:5] sorted('returns', k, 4, 'returned') with lines lw 3.5 \
  lc rgb colour_of[k]
@KEYROW
plot -1 notitle, for [k=1:5] keyentry with lines lw 4 lc rgb colour_of[k] \
  title sprintf('%s, %s: %s', word(kinds, k), size_of[k], came(k))
unset multiplot
