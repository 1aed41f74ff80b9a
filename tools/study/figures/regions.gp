# The paper's figure 5, top left: regions of the surface h = 0, computed, and
# the sticking flow on it.
wide = 1400; high = 1000
@OPEN
load data.'/numbers.dat'
set xlabel 'slider displacement r [m]'
set ylabel 'disc speed ω [rad/s]' offset 1
set xrange [0.10:0.28]
set yrange [-1.16:-0.88]
set xtics 0.04
set ytics 0.05
set palette maxcolors 4 defined (1 shade[1], 2 shade[2], 3 shade[3], 4 shade[4])
set cbrange [0.5:4.5]
unset colorbox
set border 15 lw 1.5
set margins screen 0.11, screen 0.97, screen 0.12, screen 0.87
set style textbox opaque noborder fillcolor rgb '#ffffff'
set label 1 'two-fold' at r_star,w_star front point pt 7 ps 2*P lc rgb black \
  offset 1.5,0.2
set label 2 'S sliding' at 0.235,-1.125 front boxed
set label 3 'S sliding' at 0.235,-0.905 front boxed
set label 4 'E escaping' at 0.122,-1.06 front
set arrow 1 from 0.14,-1.05 to 0.148,-1.017 front lw 2 lc rgb black
set label 5 'C down' at 0.235,-1.025 front
set label 6 'C up' at 0.115,-1.10 front
flow = data.'/flow.dat'
border = data.'/borders.dat'
set datafile separator ', ' # csv and dat in one plot
csv = data.'/regions.csv'
stick = data.'/regions.curves.dat'
plot csv using 'r':'omega':(region(strcol('region'))) with image, \
  flow using 1:($5 > 0 ? $2 : NaN) with lines lw 1.3 lc rgb '#444444', \
  flow using 1:($5 < 0 ? $2 : NaN) with lines lw 1.8 dt (6,4) \
    lc rgb '#444444', \
  flow using 1:($3 != 0 || $4 != 0 ? $2 : NaN):3:4 with vectors \
    head filled size screen 0.012,22,90 fixed lw 1.5 lc rgb '#444444', \
  for [i=0:2:2] border index i using 1:2 with lines lw 4 lc rgb red, \
  for [i=1:3:2] border index i using 1:2 with lines lw 4 lc rgb blue, \
  stick using 1:2 with lines lw 4 lc rgb green
@KEYROW
plot -1 notitle, \
  keyentry with lines lw 2 lc rgb '#444444' title 'stick', \
  keyentry with lines lw 2 dt (6,4) lc rgb '#444444' title 'stick that may end', \
  keyentry with lines lw 4 lc rgb green title 'stick from the two-fold', \
  keyentry with lines lw 4 lc rgb red title 'f_+ tangent', \
  keyentry with lines lw 4 lc rgb blue title 'f_– tangent'
