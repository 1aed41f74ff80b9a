# After the two-fold: distances of distributions over the time of a run, with
# the band, and the distributions themselves.
# Usage: gnuplot -e "work='D'" scatter.gp
set terminal svg size 1700,1150 font 'Helvetica,26' background '#ffffff'
set output work.'/scatter.svg'
set datafile separator ','
set grid lc rgb '#dddddd'
csv = work.'/scatter.csv'
array length[2] = ['0.08', '0.15']
rows(n, scheme, real) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && " \
  ."$3==\"%s\"' '%s'", length[n], scheme, real, csv)
band(n, real) = real(system(sprintf("awk -F, '$1==\"%s\" && $3==\"%s\" " \
  ."{ print $10; exit }' '%s'", length[n], real, csv)))
set multiplot title 'After the two-fold: distributions of r' font ',31'
do for [n=1:2] {
  set origin 0, 0.96 - 0.48 * n
  set size 0.5, 0.48
  set title length[n].' s after it: distance from the reference ensemble' \
    offset 0,-0.6
  set logscale xy
  set format x '10^{%T}'
  set format y '%g'
  set xlabel 'time of a run [s]' offset 0,0.5
  set ylabel 'Kolmogorov-Smirnov distance [1]' offset 1
  set xrange [3e-7:2e-3]
  set yrange [0.005:10]
  if (n == 1) { set key top right Left reverse samplen 1.5 spacing 0.75 font ',19' } \
    else { unset key }
  plot rows(n, 'moreau', 'double') using ($11*1e-9):9: \
      ($9 > $10 ? $9-$10 : 0.005):($9+$10 < 1 ? $9+$10 : 1) \
      with yerrorlines pt 5 ps 0.4 lc rgb '#D55E00' title 'moreau', \
    rows(n, 'moreau', 'float') using ($11*1e-9):9 with linespoints dt 2 pt 4 \
      ps 0.45 lc rgb '#E69F00' title 'moreau, float', \
    rows(n, 'located', 'double') using ($11*1e-9):9: \
      ($9 > $10 ? $9-$10 : 0.005):($9+$10 < 1 ? $9+$10 : 1) \
      with yerrorbars pt 9 ps 0.45 lc rgb '#0072B2' title 'located', \
    rows(n, 'located', 'float') using ($11*1e-9):9 with points pt 8 ps 0.45 \
      lc rgb '#56B4E9' title 'located, float', \
    band(n, 'double') with lines dt 2 lw 2.5 lc rgb '#000000' \
      title 'band, double', \
    band(n, 'float') with lines dt 3 lw 2.5 lc rgb '#777777' \
      title 'band, float (fewer runs)'
  set origin 0.5, 0.96 - 0.48 * n
  set title length[n].' s after it: the distributions (double)' offset 0,-0.6
  unset logscale
  set format x '%.4f'
  set xtics 0.0004
  set xlabel 'slider displacement r [m]' offset 0,0.5
  set ylabel 'share of runs below r [1]' offset 1
  set autoscale x
  set yrange [0:1]
  set key top left Left reverse samplen 1.5 spacing 0.75 font ',21'
  file = sprintf('%s/quantiles-%s.csv', work, length[n])
  plot file every ::1 using 2:1 with lines lw 6 lc rgb '#BBBBBB' \
      title 'reference', \
    file every ::1 using 3:1 with lines lw 2 dt 3 lc rgb '#D55E00' \
      title 'moreau, dt = 4 ms', \
    file every ::1 using 4:1 with lines lw 2 lc rgb '#D55E00' \
      title 'moreau, dt = 0.1 ms', \
    file every ::1 using 5:1 with lines lw 2 dt 2 lc rgb '#0072B2' \
      title 'located, dt = 10 ms'
  set xtics autofreq
}
unset multiplot
