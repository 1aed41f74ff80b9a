# New: distributions by the perturbation that decides where the future is open.
# Shares are of all samples: a curve that ends below 1 did not get there.
wide = 1700; high = 760
@OPEN
kinds = 'random noise smoothing hysteresis delay'
array colour_of[5] = [black, red, blue, green, orange]
array size_of[5] = ['10 1/s', '10^{-4} m s^{-3/2}', '10^{-5} m/s', \
  '10^{-3} m/s', '10^{-3} s']
f = data.'/perturbations.curves.dat'
of(what, k) = what.' '.word(kinds, k)
set datafile separator ','
set datafile columnheaders
array came[5]
do for [k=1:5] {
  stats sprintf('%s/returns-%s.csv', data, word(kinds, k)) \
    using (strcol('outcome') eq 'returned') nooutput
  came[k] = sprintf('%.0f %% of %d return', 100 * STATS_mean, STATS_records)
}
set datafile separator whitespace
unset datafile columnheaders
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
plot for [k=1:5] f index of('exit', k) with lines lw 3.5 \
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
plot for [k=1:5] f index of('landing', k) with lines lw 3.5 \
  lc rgb colour_of[k]
set lmargin at screen 0.715; set rmargin at screen 0.965
set title '(c) return' offset 0,-0.4
set logscale x
set xrange [1.5:300]
set format x '%g'
set xtics (2, 5, 10, 20, 50, 100, 200)
set xlabel 'time from the exit to the return [s]'
plot for [k=1:5] f index of('return', k) with lines lw 3.5 \
  lc rgb colour_of[k]
@KEYROW
plot -1 notitle, for [k=1:5] keyentry with lines lw 4 lc rgb colour_of[k] \
  title sprintf('%s, %s: %s', word(kinds, k), size_of[k], came[k])
