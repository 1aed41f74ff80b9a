# New: when, where and in which phase trajectories leave after the two-fold,
# where the exit is drawn at a constant rate (10 1/s), side by side evenly.
wide = 1500; high = 1200
@OPEN
f = data.'/exits.curves.dat'
set grid lc rgb '#dddddd'
set xrange [0:0.5]
set xtics 0.1
set margins screen 0.10, screen 0.475, screen 0.59, screen 0.86
set title '(a) when' offset 0,-0.4
set xlabel 'time from the two-fold to the exit [s]'
set ylabel 'share that has left [1]' offset 0.5
set yrange [0:1]
set ytics 0.25
plot f index 'when' using 1:2 with lines lw 7 lc rgb grey, \
  1 - exp(-10*x) with lines lw 2 dt (6,4) lc rgb black
set lmargin at screen 0.60; set rmargin at screen 0.975
set title '(b) where' offset 0,-0.4
set ylabel 'exit at r [m]' offset 0
set yrange [0.182:0.186]
set ytics 0.001
plot f index 'stick' using 1:2 with lines lw 2 lc rgb black, \
  f index 'where' using 1:($3 > 0 ? $2 : 1/0) with points pt 7 ps 0.9*P \
    lc rgb red, \
  f index 'where' using 1:($3 < 0 ? $2 : 1/0) with points pt 6 ps 1.3*P \
    lw 1.5 lc rgb blue
set margins screen 0.10, screen 0.475, screen 0.10, screen 0.425
set title '(c) in which phase, by the time' offset 0,-0.4
set xrange [0:0.04]
set xtics 0.01
set ylabel 'phase 1 mm behind the two-fold [1]' offset 0.5
set yrange [0:1]
set ytics 0.25
plot f index 'phase' using 1:($3 > 0 ? $2 : 1/0) with points pt 7 ps 0.7*P \
    lc rgb red, \
  f index 'phase' using 1:($3 < 0 ? $2 : 1/0) with points pt 6 ps 0.9*P lw 1.5 \
    lc rgb blue
set lmargin at screen 0.60; set rmargin at screen 0.975
set title '(d) in which phase, all' offset 0,-0.4
set xrange [0:1]
set xtics 0.25
set xlabel 'phase 1 mm behind the two-fold [1]'
set ylabel 'share in a bin of 0.1 [1]' offset 0.5
set yrange [0:0.3]
set ytics 0.1
set style fill solid 0.35 border
set boxwidth 0.09
plot f index 'bins' using 1:2:3 with boxerrorbars lw 2 lc rgb blue, \
  0.1 with lines lw 2 dt (6,4) lc rgb black
@KEYROW
plot -1 notitle, keyentry with points pt 7 ps 1.5*P lc rgb red \
    title 'exit by slip+', \
  keyentry with points pt 6 ps 1.5*P lw 2 lc rgb blue title 'exit by slip–', \
  keyentry with lines lw 7 lc rgb grey title 'all exits', \
  keyentry with lines lw 2 dt (6,4) lc rgb black \
    title '(a) 1 – exp(–10 t), (d) even'
