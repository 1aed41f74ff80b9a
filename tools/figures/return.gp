# New: the return map. From an exit to the landing on the upper sliding region,
# and from the landing to the two-fold.
wide = 1700; high = 760
@OPEN
exits = data.'/exits-random.csv'
returns = data.'/returns-random.csv'
# exit time, side, landing r, return time, landings
pair = "< paste -d, '".exits."' '".returns."' | awk -F, 'NR > 1 && $17 != \"\" " \
  ."{ print $3, ($7 == \"slip+\" ? 1 : -1), $17, $13, $18 }'"
first = "< awk -F, 'NR > 1 && $14 != \"\" { print $7, ($6 == \"slip+\" ? 1 : -1), $14 }' " \
  .data."/branches.csv"
rest = system("awk -F, 'NR > 1 && $7 > 2.3 { print $8; exit }' " \
  .data."/branches.csv") + 0
set multiplot
set bmargin at screen 0.14
set tmargin at screen 0.77
set grid lc rgb '#dddddd'
set lmargin at screen 0.095
set rmargin at screen 0.48
set title '(a) from the exit to the landing' offset 0,-0.4
set xrange [0:0.4]
set yrange [0.1816:0.1836]
set xtics 0.1
set ytics 0.0005
set format y '%.4f'
set xlabel 'time in the escaping region [s]'
set ylabel 'landing on the upper sliding region at r [m]' offset 0.2
set key at screen 0.29,0.99 center top horizontal maxrows 2 font ',19'
plot pair using 1:3 with points pt 7 ps 0.35 lc rgb grey notitle, \
  first using 1:($2 > 0 && $1 < 0.4 ? $3 : 1/0) with points pt 7 ps 0.8 \
    lc rgb red notitle, \
  first using 1:($2 < 0 && $1 < 0.4 ? $3 : 1/0) with points pt 5 ps 0.7 \
    lc rgb blue notitle, \
  rest with lines lw 2 dt (6,4) lc rgb black notitle, \
  NaN with points pt 7 ps 1.5 lc rgb red title 'slip+, straight', \
  NaN with points pt 5 ps 1.4 lc rgb blue title 'slip–, straight', \
  NaN with points pt 7 ps 1.2 lc rgb grey title 'after a rest at h = g = 0'
set lmargin at screen 0.60
set rmargin at screen 0.98
set title '(b) from the exit to the next two-fold' offset 0,-0.4
set xrange [0.1816:0.1836]
set yrange [1.5:200]
set logscale y
set xtics 0.0005
set ytics (2, 5, 10, 20, 50, 100, 200)
set format y '%g'
set xlabel 'first landing at r [m]'
set ylabel 'time to return [s]' offset 1
set key at screen 0.79,0.99 center top horizontal maxrows 2 font ',19'
set arrow 1 from rest,1.5 to rest,200 nohead lw 2 dt (6,4) lc rgb black front
plot pair using 3:($5 == 1 ? $4 : 1/0) with points pt 7 ps 0.5 lc rgb green \
    notitle, \
  pair using 3:($5 == 2 ? $4 : 1/0) with points pt 7 ps 0.5 lc rgb orange \
    notitle, \
  pair using 3:($5 > 2 ? $4 : 1/0) with points pt 7 ps 0.4 lc rgb pink \
    notitle, \
  NaN with points pt 7 ps 1.5 lc rgb green title '1 landing', \
  NaN with points pt 7 ps 1.5 lc rgb orange title '2', \
  NaN with points pt 7 ps 1.5 lc rgb pink title '3 or more', \
  NaN with lines lw 2 dt (6,4) lc rgb black title 'rest'
unset multiplot
