# The paper's figure 3: stick next to the two-fold, and the loop.
wide = 1500; high = 880
@OPEN
load data.'/numbers.dat'
set margins screen 0.075, screen 0.455, screen 0.15, screen 0.74
set title sprintf("(a) next to the two-fold:\nJ_1 = %.3f, J_2 = %.3f", J1, J2) \
  offset 0,-0.3
set border 15 lw 1.5
set xrange [-1:1]
set yrange [-1:1]
set xtics 0.5
set ytics 0.5
set xlabel 'ξ  (1 is 0.02 rad/s in ω)'
set ylabel 'η' offset 3
set object 1 rectangle from 0,0 to 1,1 fc rgb shade[1] fs solid noborder behind
set object 2 rectangle from -1,-1 to 0,0 fc rgb shade[2] fs solid noborder \
  behind
set label 1 'S sliding' at 0.96,0.92 right front
set label 2 'E escaping' at -0.96,-0.92 left front
set label 3 'C crossing' at -0.96,0.92 left front
set label 4 'C crossing' at 0.96,-0.92 right front
f = data.'/orbits.dat'
plot 0 with lines lw 2.5 lc rgb red notitle, \
  '+' using (0):(2*($0/99.)-1) with lines lw 2.5 lc rgb blue notitle, \
  f using ($5 == 1 ? $1 : 1/0):2 with lines lw 2 lc rgb orange, \
  f using ($5 == 0 ? $1 : 1/0):2 with lines lw 1.6 dt (5,3) lc rgb black, \
  f using ($5 == 1 && ($3 != 0 || $4 != 0) ? $1 : 1/0):2:3:4 with vectors \
    head filled size screen 0.012,22,90 fixed lw 1.5 lc rgb black, \
  data.'/straight.dat' index 0 with lines lw 3 lc rgb green
unset object
unset label
set lmargin at screen 0.58
set rmargin at screen 0.985
set title "(b) two motions from the two-fold;\n". \
  "the thick one returns to it at once" \
  offset 0,-0.3
set xrange [0.1815:0.1875]
set yrange [-1.056:-0.988]
set xtics 0.002
set ytics 0.02
set xlabel 'slider displacement r [m]'
set ylabel 'disc speed ω [rad/s]' offset 0
set label 1 'two-fold' at r_star,w_star front point pt 7 ps 1.6*P lc rgb black \
  offset 0.6,1.3 center
f = data.'/loop.dat'
# r where a motion is in mode m, and where it has just left it.
in_mode(m) = (before = $0 == 0 ? 0 : now, now = $6, \
  now == m || before == m ? $2 : NaN)
plot data.'/normal.curves.dat' index 'stick' using 1:2 with lines lw 4 \
    lc rgb mode_colour[3], \
  for [m=1:4] f index 0 using (in_mode(m)):3 with lines lw 1.5 \
    lc rgb mode_colour[m], \
  for [m=1:4] f index 1 using (in_mode(m)):3 with lines lw 4 \
    lc rgb mode_colour[m]
@KEYROW
plot -1 notitle, \
  keyentry with lines lw 2.5 lc rgb orange title '(a) true stick', \
  keyentry with lines lw 2 dt (5,3) lc rgb black title 'normal form', \
  keyentry with lines lw 3 lc rgb green title 'its straight orbit', \
  keyentry with lines lw 2.5 lc rgb red title 'f_+ tangent', \
  keyentry with lines lw 2.5 lc rgb blue title 'f_– tangent', \
  for [m=1:4] keyentry with lines lw 4 lc rgb mode_colour[m] \
    title (m == 1 ? '(b) ' : '').mode_name[m]
