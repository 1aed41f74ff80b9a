# New: slip next to h = g = 0, where the direction of the force depends on the
# direction of slip alone.
wide = 1600; high = 800
@OPEN
set multiplot
set lmargin at screen 0.08; set rmargin at screen 0.45
set bmargin at screen 0.13; set tmargin at screen 0.83
set border 15 lw 1.5
set title '(a) slip in the plane of (g, h), r = 0.183 m' offset 0,-0.4
set xrange [-1:1]; set yrange [-1:1]
set xtics 0.5; set ytics 0.5
set xlabel 'rolling speed g [any unit]'
set ylabel 'lateral speed h [the same]' offset 1.5
set key at screen 0.265,0.99 center top horizontal font ',19'
f = data.'/corner.dat'
r0 = 0.183
set angles degrees
at = sprintf("< awk '$1 == %g' %s/directions.dat", r0, data)
plot 0 with lines lw 5 lc rgb green notitle, \
  '+' using (abs($0) < 50 ? $0/50.-1 : NaN):(0) with lines lw 5 lc rgb green \
    title 'stick–', \
  '+' using ($0/99.):(0) with lines lw 5 lc rgb grey title 'stick+, may end', \
  f using 1:2 with lines lw 1.5 lc rgb '#444444' title 'slip', \
  f using 1:($3 != 0 || $4 != 0 ? $2 : NaN):3:4 with vectors head filled \
    size screen 0.012,22,90 fixed lw 1.5 lc rgb '#444444' notitle, \
  at using ($3 < 0 ? cos($2) : NaN):(sin($2)):(-cos($2)):(-sin($2)) \
    with vectors nohead lw 3 lc rgb blue title 'falls in', \
  at using (0):($3 > 0 ? 0 : NaN):(cos($2)):(sin($2)) \
    with vectors nohead lw 3 lc rgb red title 'leaves'
set lmargin at screen 0.56; set rmargin at screen 0.975
set title '(b) limit directions at every r' offset 0,-0.4
set xrange [0.10:0.28]; set yrange [0:360]
set xtics 0.05; set ytics 45
set xlabel 'slider displacement r [m]'
set ylabel 'direction atan2(h, g) [degrees]' offset 1
set palette maxcolors 2 defined (-1 '#ffffff', 1 '#e6e6e6')
set cbrange [-1:1]
unset colorbox
set key at screen 0.77,0.99 center top horizontal maxrows 2 font ',19'
d = data.'/directions.dat'
plot data.'/turning.dat' using 1:2:3 with image notitle, \
  d using ($3 < 0 && $4 < 0 ? $1 : NaN):2 with points pt 7 ps 0.9 lc rgb blue notitle, \
  d using ($3 < 0 && $4 > 0 ? $1 : NaN):2 with points pt 6 ps 0.9 lc rgb blue notitle, \
  d using ($3 > 0 && $4 < 0 ? $1 : NaN):2 with points pt 7 ps 0.9 lc rgb red notitle, \
  d using ($3 > 0 && $4 > 0 ? $1 : NaN):2 with points pt 6 ps 0.9 lc rgb red notitle, \
  NaN with points pt 7 ps 1.5 lc rgb blue title 'in, attracts', \
  NaN with points pt 6 ps 1.5 lc rgb blue title 'in, repels', \
  NaN with points pt 7 ps 1.5 lc rgb red title 'out, attracts', \
  NaN with points pt 6 ps 1.5 lc rgb red title 'out, repels'
unset multiplot
