# New: the return map. From an exit to the first landing on the upper sliding
# region, and from there to the two-fold.
wide = 1600; high = 820
@OPEN
f = data.'/return.curves.dat'
# Where stick from the two-fold tends to rest: one curve of a family.
stats f index 'rest' using 1 nooutput
rest = STATS_max
set margins screen 0.105, screen 0.48, screen 0.165, screen 0.77
set grid lc rgb '#dddddd'
set title '(a) from the exit to the first landing' offset 0,-0.4
set xrange [0:0.4]
set yrange [0.1816:0.1836]
set xtics 0.1
set ytics 0.0005
set format y '%.4f'
set xlabel 'time from the two-fold to the exit [s]'
set ylabel 'landing on upper sliding at r [m]' offset 0.2
plot f index 'sampled' using 1:2 with points pt 7 ps 0.6*P lc rgb grey, \
  f index 'branches' using 1:($2 > 0 && $1 < 0.4 ? $3 : 1/0) \
    with points pt 7 ps 0.8*P \
    lc rgb red, \
  f index 'branches' using 1:($2 < 0 && $1 < 0.4 ? $3 : 1/0) \
    with points pt 5 ps 0.7*P \
    lc rgb blue, \
  rest with lines lw 3 dt (6,4) lc rgb black
set lmargin at screen 0.60
set rmargin at screen 0.98
set title '(b) from the landing to the next two-fold' offset 0,-0.4
set xrange [0.1816:0.1836]
set yrange [1.5:200]
set logscale y
set xtics 0.0005
set format x '%.4f'
set ytics (2, 5, 10, 20, 50, 100, 200)
set format y '%g'
set xlabel 'first landing at r [m]'
set ylabel 'exit to return [s]' offset 0.5
set arrow 1 from rest,1.5 to rest,200 nohead lw 3 dt (6,4) lc rgb black front
plot f index 'sampled' using 2:($4 == 1 ? $3 : 1/0) \
    with points pt 7 ps 0.8*P lc rgb green, \
  f index 'sampled' using 2:($4 == 2 ? $3 : 1/0) \
    with points pt 5 ps 0.7*P lc rgb orange, \
  f index 'sampled' using 2:($4 > 2 ? $3 : 1/0) \
    with points pt 9 ps 0.9*P lc rgb pink
@KEYROW
plot -1 notitle, keyentry with points pt 7 ps 1.5*P lc rgb red \
    title '(a) exit by slip+', \
  keyentry with points pt 5 ps 1.4*P lc rgb blue title 'by slip–', \
  keyentry with points pt 7 ps 1.2*P lc rgb grey title 'sampled, with rests', \
  keyentry with lines lw 3 dt (6,4) lc rgb black title 'r of rest', \
  keyentry with points pt 7 ps 1.5*P lc rgb green title '(b) 1 landing', \
  keyentry with points pt 5 ps 1.4*P lc rgb orange title '2 landings', \
  keyentry with points pt 9 ps 1.6*P lc rgb pink title '3 or more'
