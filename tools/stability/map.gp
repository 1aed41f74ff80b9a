# A map of verdicts: one panel a sweep, step size to the right, the parameter
# upwards. Colours are Okabe and Ito's for colour-blind readers, the failures
# darker than what is stable. SETTINGS and DATA come from map.awk.
# Usage: gnuplot -e "settings='F'; data='F'; out='F'" map.gp
load settings
# Of cells by the thousand an SVG has two megabytes, a PNG a fiftieth of it.
set terminal pngcairo size 1100,1750 font 'Helvetica,11' background '#ffffff'
set output out
means = "'stable' 'stable, some steps degraded' 'the motion leaves the range' " \
  ."'refused: step too long' 'refused: scheme diverged' 'energy created' " \
  ."'law not taken' 'promise broken'"
array colour[8] = [0xCFE8F5, 0xF0E442, 0x0072B2, 0xE69F00, 0xD55E00, 0x000000, \
  0xBBBBBB, 0xCC79A7]
columns = 4
lines = (panels + columns) / columns
set multiplot title 'Stability of '.heading.': verdict after 4000 steps' \
  font ',13'
set tics out nomirror
set xrange [-6.25:-0.75]
set format x '10^{%g}'
set xtics -6,2,-2
set mxtics 2
unset key
do for [n = 1:panels] {
  column = (n - 1) % columns
  line = (n - 1) / columns
  set origin column / real(columns), 0.965 - 0.965 * (line + 1) / lines
  set size 1.0 / columns, 0.965 / lines
  set lmargin 13
  set rmargin 2
  set tmargin 1.4
  set bmargin 3.3
  set yrange [-0.5:rows[n] + 0.5]
  eval(value(sprintf('ticks%d', n)))
  set ytics noenhanced
  set title axis[n] offset 0,-0.7 noenhanced
  set xlabel 'step dt [s]' offset 0,0.7
  plot data index n - 1 using 1:2:($1-0.25):($1+0.25):($2-0.5):($2+0.5): \
    (colour[int($3)]) with boxxyerror fill solid 1 border lc rgb '#ffffff' \
    lc rgb variable
}
# The legend takes the place of one more panel.
set origin (panels % columns) / real(columns), \
  0.965 - 0.965 * (panels / columns + 1) / lines
set size 1.0 / columns, 0.965 / lines
unset title
unset xlabel
unset xtics
unset ytics
unset border
set xrange [0:1]
set yrange [0:9]
set lmargin 4
do for [k = 1:8] {
  set object k rectangle from 0.0, 8.6 - k to 0.1, 9.2 - k \
    fillcolor rgb colour[k] fillstyle solid 1 border lc rgb '#666666'
  set label k word(means, k) at 0.14, 8.9 - k
}
plot NaN
unset multiplot
