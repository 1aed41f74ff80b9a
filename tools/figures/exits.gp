# New: when, where and in which phase trajectories leave after the two-fold,
# where the exit is drawn at a constant rate (10 1/s), side by side evenly.
wide = 1700; high = 680
@OPEN
set datafile separator ','
csv = data.'/exits-random.csv'
side(s, x) = strcol('side') eq s ? x : NaN
set multiplot
set bmargin at screen 0.17
set tmargin at screen 0.80
set grid lc rgb '#dddddd'
set xrange [0:0.6]
set xtics 0.2
set key at screen 0.5,0.99 center top horizontal
# All panels say the same of the two sides: one key.
set lmargin at screen 0.085
set rmargin at screen 0.33
set title '(a) where' offset 0,-0.4
set xlabel 'time in the escaping region [s]'
set ylabel 'exit at r [m]' offset 0.5
set ytics 0.001
set yrange [0.182:0.186]
plot csv using (column('time')):(side('slip+', column('r'))) with points pt 7 \
    ps 0.45 lc rgb red notitle, \
  csv using (column('time')):(side('slip-', column('r'))) with points pt 6 \
    ps 0.6 lc rgb blue notitle, \
  NaN with points pt 7 ps 1.5 lc rgb red title 'exit by slip+', \
  NaN with points pt 6 ps 1.5 lw 2 lc rgb blue title 'exit by slip–', \
  NaN with lines lw 3 lc rgb black title 'all'
set lmargin at screen 0.42
set rmargin at screen 0.665
set title '(b) when' offset 0,-0.4
set ylabel 'share that has left by then [1]' offset 0.5
set yrange [0:1]
set ytics 0.25
unset key
n = real(system("awk 'NR > 1' '".csv."' | wc -l"))
sorted = "< awk -F, 'NR > 1 { print $3 }' '".csv."' | sort -g | awk 'NR % 20 == 1'"
set label 1 '1 – exp(–10 t)' at 0.23,0.78 left
plot sorted using 1:($0*20/n) with lines lw 5 lc rgb grey, \
  1 - exp(-10*x) with lines lw 2 dt (6,4) lc rgb black
unset label 1
set lmargin at screen 0.745
set rmargin at screen 0.985
set title '(c) phase 1 mm behind the two-fold' offset 0,-0.4
set xlabel 'phase in the winding [1]'
set ylabel 'share in a bin of 0.05 [1]' offset 0.5
set xrange [0:1]
set xtics 0.25
set yrange [0:*]
set ytics auto
bin(x) = 0.05 * (floor(x / 0.05) + 0.5)
m = real(system("awk -F, 'NR > 1 && $8 != \"\"' '".csv."' | wc -l"))
set style fill solid 0.35 border
set boxwidth 0.046
set label 2 'even' at 0.98,0.05 right offset 0,0.7
plot csv using (bin(column('phase'))):(1/m) smooth frequency with boxes \
    lc rgb blue notitle, \
  0.05 with lines lw 2 dt (6,4) lc rgb black notitle
unset multiplot
