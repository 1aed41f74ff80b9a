# The README's picture: slider and disc over time, and the same motion on the
# plane (r, omega), coloured by the mode of contact. Colours are Okabe and Ito's
# for colour-blind readers. The wheel is never pinned for a step: where it comes
# to h = g = 0 the step goes on from there.
# The suffix of `out` says in which form. Usage: make run, then
#   gnuplot -e "csv='build/chaos.csv'; out='docs/chaos.png'" \
#     tools/study/figures/chaos.gp
if (out[strlen(out)-3:] eq '.svg') {
  set terminal svg size 1200,480 font 'Helvetica,13' background '#ffffff'
} else {
  set terminal pngcairo size 1200,480 font 'Helvetica,13'
}
set output out
set datafile separator ','
set key outside bottom center horizontal Left reverse samplen 1 width -1
modes = 4
array name[modes] = ['slip+', 'slip-', 'stick+', 'stick-']
array colour[modes] = ['#D55E00', '#E69F00', '#0072B2', '#009E73']
array size[modes] = [0.5, 0.5, 0.3, 0.3]
set multiplot layout 1,2 margins 0.09,0.97,0.26,0.95 spacing 0.12
set grid lc rgb '#dddddd'
set xlabel 'time t [s]'
set ylabel 'slider displacement r [m]' offset 1
plot for [i=1:modes] csv \
  using 't':(strcol('mode') eq name[i] ? column('r') : NaN) \
  with points pt 7 ps size[i] lc rgb colour[i] notitle, \
  for [i=1:modes] keyentry with points pt 7 ps 1.2 lc rgb colour[i] \
  title name[i]
set xlabel 'slider displacement r [m]'
set ylabel 'disc speed omega [rad/s]' offset 1
set label 1 'two-fold' at 0.1859,-1.037 front \
  point pt 2 ps 1.2 lw 2 offset 0.8,-0.6
plot for [i=1:modes] csv \
  using 'r':(strcol('mode') eq name[i] ? column('omega') : NaN) \
  with points pt 7 ps size[i] lc rgb colour[i] notitle, \
  for [i=1:modes] keyentry with points pt 7 ps 1.2 lc rgb colour[i] \
  title name[i]
unset multiplot
