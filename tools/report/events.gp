# Times of events and drift in stick over the step.
# Usage: gnuplot -e "work='D'" events.gp
set terminal svg size 1700,690 font 'Helvetica,26' background '#ffffff'
set output work.'/events.svg'
set datafile separator ','
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set grid lc rgb '#dddddd'
csv = work.'/sweep.csv'
rows(part, scheme, dial, real, field) = sprintf("< awk -F, '$1==\"%s\" && " \
  ."$2==\"%s\" && $4==\"%s\" && $3==\"%s\" && $16 != \"refused\" && " \
  ."$%d !~ /nan/ && $%d > 0' '%s'", part, scheme, dial, real, field, field, csv)
set multiplot title 'Times of events and drift in stick' font ',31'
set xlabel 'step dt [s]' offset 0,0.5
set xrange [1e-6:0.3]
unset key
array part[2] = ['crossings', 'cycle']
array title_of[2] = ['crossings, double', 'chaos to t = 2, double']
do for [p=1:2] {
  set origin (p - 1) / 3.0, 0.1
  set size 0.333, 0.84
  set title title_of[p] offset 0,-0.6
  set ylabel 'largest error of the time of an event [s]' offset 1
  set yrange [1e-14:1]
  plot rows(part[p], 'moreau', 'dt', 'double', 10) using 5:10 with linespoints \
      pt 5 ps 0.38 lc rgb '#D55E00', \
    rows(part[p], 'carried', 'dt', 'double', 10) using 5:10 with linespoints \
      pt 7 ps 0.38 lc rgb '#E69F00', \
    rows(part[p], 'located', 'dt', 'double', 10) using 5:10 with linespoints \
      pt 9 ps 0.45 lc rgb '#0072B2', \
    x with lines dt 2 lw 2 lc rgb '#777777'
}
set origin 2 / 3.0, 0.1
set size 0.333, 0.84
set title 'chaos to t = 2' offset 0,-0.6
set ylabel 'largest |h| in stick [m/s]' offset 1
set yrange [1e-23:1e-6]
plot rows('cycle', 'moreau', 'dt', 'double', 11) using 5:11 with linespoints \
    pt 5 ps 0.38 lc rgb '#D55E00', \
  rows('cycle', 'carried', 'dt', 'double', 11) using 5:11 with linespoints \
    pt 7 ps 0.38 lc rgb '#E69F00', \
  rows('cycle', 'located', 'dt', 'double', 11) using 5:11 with linespoints \
    pt 9 ps 0.45 lc rgb '#0072B2', \
  rows('cycle', 'moreau', 'dt', 'float', 11) using 5:11 with linespoints \
    dt 2 pt 4 ps 0.38 lc rgb '#D55E00', \
  rows('cycle', 'carried', 'dt', 'float', 11) using 5:11 with linespoints \
    dt 2 pt 6 ps 0.38 lc rgb '#E69F00', \
  rows('cycle', 'located', 'dt', 'float', 11) using 5:11 with linespoints \
    dt 2 pt 8 ps 0.45 lc rgb '#0072B2'
# The legend has a place of its own, below.
unset border
unset tics
unset grid
unset logscale
unset xlabel
unset ylabel
unset title
unset arrow
set lmargin 1
set rmargin 1
set xrange [0:1]
set yrange [0:1]
set origin 0, 0
set size 1, 0.1
set key center center horizontal samplen 2 width 1 font ',24'
plot NaN with linespoints pt 5 ps 0.5 lc rgb '#D55E00' title 'moreau', \
  NaN with linespoints pt 7 ps 0.5 lc rgb '#E69F00' title 'carried', \
  NaN with linespoints pt 9 ps 0.55 lc rgb '#0072B2' title 'located', \
  NaN with linespoints dt 2 pt 4 ps 0.5 lc rgb '#D55E00' title 'moreau, float', \
  NaN with linespoints dt 2 pt 6 ps 0.5 lc rgb '#E69F00' title 'carried, float', \
  NaN with linespoints dt 2 pt 8 ps 0.55 lc rgb '#0072B2' \
    title 'located, float', \
  NaN with lines dt 2 lw 2 lc rgb '#777777' title 'dt'
unset multiplot
