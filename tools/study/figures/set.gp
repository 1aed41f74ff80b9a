# The paper's figure 5, the blocks: slip off the escaping region, each future
# until it is back at the two-fold or 2.3 s are over, seen from two sides. The
# third axis is h, so that the surface is the floor of the picture.
wide = 1700; high = 1000
@OPEN
load data.'/numbers.dat'
set xrange [0.1815:0.1885]
set yrange [-1.055:-0.995]
set zrange [-30:130]
set xtics 0.182,0.002 offset 0,-0.5
set ytics 0.02 offset 0.6,-0.3
set ztics 50
set border 4095 lw 1
set xyplane at -30
f = data.'/set.curves.dat'
border = data.'/borders.dat'
array turn[2] = [40, 130]
drawn(r, w) = r > 0.1815 && r < 0.1885 && w > -1.055
do for [i=1:2] {
  set origin 0.5 * (i - 1), 0.02
  set size 0.5, 0.9
  set lmargin 8
  set rmargin 4
  set view 60, turn[i], 1.0, 1.15
  set title (i == 1 ? '(a)' : '(b) from the other side') offset 0,1
  set xlabel 'r [m]' offset 0,-0.8
  set ylabel 'ω [rad/s]' offset 0,-0.8
  set zlabel 'h [µm/s]' rotate by 90 offset 0
  splot for [i=0:1] border index i using (drawn($1,$2) ? $1 : NaN):2:(0) \
      with lines lw 3 lc rgb grey, \
    for [m=1:4] f index sprintf('mode %d', m) using 1:2:3 \
      with lines lw (m < 3 ? 0.8 : 3) \
      lc rgb mode_colour[m], \
    '+' using (r_star):(w_star):(0) every ::0::0 with points pt 7 ps 2*P \
      lc rgb black
}
set size 1,1
set origin 0,0
@KEYROW
plot -1 notitle, keyentry with points pt 7 ps 2*P lc rgb black title 'two-fold', \
  keyentry with lines lw 3 lc rgb grey title 'borders on h = 0', \
  for [m=1:4] keyentry with lines lw 4 lc rgb mode_colour[m] \
    title mode_name[m]
