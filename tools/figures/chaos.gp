# The README's picture: slider and disc over time, and the same motion on the
# plane (r, omega), coloured by the mode of contact. Colours are Okabe and Ito's
# for colour-blind readers. Usage: gnuplot -e "csv='F'; out='F'" chaos.gp
set terminal pngcairo size 1200,480 font 'Helvetica,13'
set output out
set datafile separator ','
set key outside bottom center horizontal samplen 1
array name[4] = ['slip+', 'slip-', 'stick+', 'stick-']
array colour[4] = ['#D55E00', '#E69F00', '#0072B2', '#009E73']
set multiplot layout 1,2 margins 0.09,0.98,0.26,0.95 spacing 0.12
set grid lc rgb '#dddddd'
set xlabel 'time t [s]'
set ylabel 'slider displacement r [m]' offset 1
plot for [i=1:4] csv every ::1 using 1:(strcol(9) eq name[i] ? $2 : NaN) \
  with points pt 7 ps (i > 2 ? 0.3 : 0.5) lc rgb colour[i] title name[i]
set xlabel 'slider displacement r [m]'
set ylabel 'disc speed omega [rad/s]' offset 1
set label 1 'two-fold' at 0.1859,-1.037 point pt 2 ps 1.2 lw 2 offset 0.8,-0.6
plot for [i=1:4] csv every ::1 using 2:(strcol(9) eq name[i] ? $4 : NaN) \
  with points pt 7 ps (i > 2 ? 0.3 : 0.5) lc rgb colour[i] title name[i]
unset multiplot
