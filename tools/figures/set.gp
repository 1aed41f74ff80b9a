# The paper's figure 6, the blocks: slip off the escaping region, each future
# until it is back at the two-fold or 2.3 s are over, seen from two sides. The
# third axis is h, so that the surface is the floor of the picture.
wide = 1700; high = 1000
@OPEN
set xrange [0.178:0.194]
set yrange [-1.07:-0.985]
set zrange [-0.004:0.016]
set xtics 0.178,0.004 offset 0,-0.5
set ytics 0.02 offset 0.6,-0.3
set ztics 0.005
set border 4095 lw 1
set xyplane at -0.004
set hidden3d back noundefined
unset hidden3d
set multiplot
# Points of one mode, with a gap where it ends.
mode(m) = sprintf("< awk 'function out() { print $2, $3, $4 } " \
  ."/^#/ { print \"\"; last = 0; next } !NF { next } " \
  ."$6 == %d || last == %d { out() } $6 != %d && last == %d { print \"\" } " \
  ."{ last = $6 }' %s", m, m, m, m, data.'/set.dat')
array turn[2] = [40, 130]
do for [i=1:2] {
  set lmargin at screen 0.06 + 0.49 * (i - 1)
  set rmargin at screen 0.49 + 0.49 * (i - 1)
  set bmargin at screen 0.14
  set tmargin at screen 0.92
  set view 62, turn[i], 1, 1
  set xlabel 'r [m]' offset 0,-1.2
  set ylabel 'ω [rad/s]' offset 0,-1.2
  set zlabel 'h [m/s]' rotate by 90 offset -1.5
  set key at screen 0.5,0.985 center top horizontal maxrows 1
  splot for [m=1:4] mode(m) using 1:2:3 with lines lw (m < 3 ? 0.7 : 2) \
      lc rgb mode_colour[m] notitle, \
    '+' using (0.1859):(-1.037):(0) every ::0::0 with points pt 7 ps 1.8 \
      lc rgb black title (i == 1 ? 'two-fold' : ''), \
    for [m=1:4] '+' using (NaN):(NaN):(NaN) with lines lw 4 \
      lc rgb mode_colour[m] title (i == 1 ? mode_name[m] : '')
}
unset multiplot
