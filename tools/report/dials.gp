# Error over the dial, in double: the step of every scheme, and the tolerance of
# the located one; straight lines show slopes.
# Usage: gnuplot -e "work='D'" dials.gp
set terminal svg size 1700,1250 font 'Helvetica,26' background '#ffffff'
set output work.'/dials.svg'
set datafile separator ','
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set grid lc rgb '#dddddd'
parts = 'smooth crossings stick codim2 approach'
csv = work.'/sweep.csv'
rows(p, scheme, dial) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && " \
  ."$3==\"double\" && $4==\"%s\" && $16 != \"refused\"' '%s'", word(parts, p), \
  scheme, dial, csv)
marked(p, what) = sprintf("< awk -F, '$1==\"%s\" && $3==\"double\" && " \
  ."$4 !~ /^tol/ && $16==\"%s\"' '%s'", word(parts, p), what, csv)
tolerance_marked(dial) = sprintf("< awk -F, '$1==\"crossings\" && " \
  ."$3==\"double\" && $4==\"%s\" && $16==\"flagged\"' '%s'", dial, csv)
info(p, field) = system(sprintf("awk -F, '$1==\"%s\" { print $%d }' '%s'", \
  word(parts, p), field, work.'/parts.csv'))
set multiplot title 'Error over step and tolerance, in double' font ',31'
set yrange [1e-16:10]
set lmargin 8
set rmargin 2.5
unset key
do for [p=1:6] {
  set origin ((p - 1) % 3) / 3.0, 0.96 - 0.425 * ((p - 1) / 3 + 1)
  set size 0.333, 0.425
  set ylabel 'error at the end [m, m/s, rad/s]' offset 1
  if (p < 6) {
    set title info(p, 2) offset 0,-0.6
    set xlabel 'step dt [s]' offset 0,0.5
    set xrange [5e-7:0.3]
    plot rows(p, 'moreau', 'dt') using 5:8 with linespoints pt 5 ps 0.38 \
        lc rgb '#D55E00', \
      rows(p, 'carried', 'dt') using 5:8 with linespoints pt 7 ps 0.38 \
        lc rgb '#E69F00', \
      rows(p, 'located', 'dt') using 5:8 with linespoints pt 9 ps 0.45 \
        lc rgb '#0072B2', \
      rows(p, 'located', 'order') using 5:8 with linespoints pt 11 ps 0.45 \
        lc rgb '#56B4E9', \
      marked(p, 'flagged') using 5:8 with points pt 6 ps 0.75 lw 1.5 \
        lc rgb '#000000', \
      marked(p, 'branch') using 5:8 with points pt 2 ps 0.6 lw 2 \
        lc rgb '#000000', \
      0.05 * x with lines dt 3 lw 2 lc rgb '#777777', \
      10 * x ** 2 with lines dt 2 lw 2 lc rgb '#777777', \
      1e13 * x ** 8 with lines dt 4 lw 2 lc rgb '#777777'
  } else {
    set title '(b), tolerance of located' offset 0,-0.6
    set xlabel 'tolerance [1]' offset 0,0.5
    set xrange [1e-14:1e-2]
    set xtics 1e-14, 1e4
    plot rows(2, 'located', 'tolerance@100ms') using 6:8 with linespoints pt 13 \
        ps 0.45 lc rgb '#009E73', \
      rows(2, 'located', 'tolerance@5ms') using 6:8 with linespoints pt 15 \
        ps 0.45 lc rgb '#CC79A7', \
      tolerance_marked('tolerance@100ms') using 6:8 with points pt 6 ps 0.75 \
        lw 1.5 lc rgb '#000000', \
      tolerance_marked('tolerance@5ms') using 6:8 with points pt 6 ps 0.75 \
        lw 1.5 lc rgb '#000000', \
      x with lines dt 3 lw 2 lc rgb '#777777'
  }
}
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
set size 1, 0.11
set key center center horizontal maxrows 3 samplen 2 width 1 spacing 0.8 \
  font ',23'
plot NaN with linespoints pt 5 ps 0.5 lc rgb '#D55E00' title 'moreau', \
  NaN with linespoints pt 7 ps 0.5 lc rgb '#E69F00' title 'carried', \
  NaN with linespoints pt 9 ps 0.55 lc rgb '#0072B2' title 'located, 1e-8', \
  NaN with linespoints pt 11 ps 0.55 lc rgb '#56B4E9' \
    title 'located, never split', \
  NaN with linespoints pt 13 ps 0.55 lc rgb '#009E73' \
    title 'located, dt = 100 ms', \
  NaN with linespoints pt 15 ps 0.55 lc rgb '#CC79A7' \
    title 'located, dt = 5 ms', \
  NaN with points pt 6 ps 0.75 lw 1.5 lc rgb '#000000' title 'flagged', \
  NaN with points pt 2 ps 0.6 lw 2 lc rgb '#000000' title 'another branch', \
  NaN with lines dt 3 lw 2 lc rgb '#777777' title 'slope 1', \
  NaN with lines dt 2 lw 2 lc rgb '#777777' title 'slope 2', \
  NaN with lines dt 4 lw 2 lc rgb '#777777' title 'slope 8'
unset multiplot
