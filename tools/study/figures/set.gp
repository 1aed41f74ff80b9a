# The paper's figure 5, the blocks: futures of the two-fold until they are back
# at it, over (r, v, omega), from both sides of the surface h = 0. They stay
# within 0.2 mm/s of it, so v is drawn `far` times as far from it.
wide = 1500; high = 900
@OPEN
load data.'/numbers.dat'
far = 150
on(r, w) = 1e3 * (w + 1) * (1 - r)
v(r, w, h) = on(r, w) + 1e3 * far * sqrt(2) * h
f = data.'/set.curves.dat'
set xrange [0.1812:0.188]
set yrange [-1.056:-0.99]
set zrange [-52:25]
set xtics 0.182,0.002 offset 0,-0.4
set ytics 0.02 offset 0.4,-0.4
set ztics 20
set border 31 lw 1
set xyplane at -52
set grid xtics ytics
set margins 0, 0, 0, 0
set size 0.45, 0.86
array tilt[2] = [58, 72]
array turn[2] = [25, 215]
array pane[5] = [shade[1], shade[2], '#f4f4f4', '#e4e4e4', shade[1]]
clear(colour) = '#60'.colour[2:]
do for [i=1:2] {
  set origin 0.5 * i - 0.46, 0.03
  set view tilt[i], turn[i], 1.15, 1.25
  near = i == 1 ? -1.056 : -0.99 # edges of the box: omega, r
  right = i == 1 ? 0.188 : 0.1812
  left = 0.3692 - right
  set label 1 sprintf("(%s; distance\nfrom h = 0 drawn %d-fold", \
    i == 1 ? 'a) from above' : 'b) from below', far) \
    at screen 0.5 * i - 0.25, 0.875 center
  set label 2 'r [m]' at 0.1846,near,-52 right offset -3,-2.2
  set label 3 'ω [rad/s]' at right,-2.046-near,-52 center offset 0,1
  set label 4 'v [mm/s]' at left,near,31 center
  # What is behind the surface is drawn before it.
  splot f index 'mode '.(3 - i) using 1:2:(v($1,$2,$3)) with lines lw 1.5 \
      lc rgb mode_colour[3 - i], \
    for [p=1:5] f index 4+p using 1:2:(on($1,$2)) with polygons \
      fc rgb clear(pane[p]), \
    f index 'mode '.i using 1:2:(v($1,$2,$3)) with lines lw 1.5 \
      lc rgb mode_colour[i], \
    for [m=3:4] f index 'mode '.m using 1:2:(on($1,$2)) with lines lw 3 \
      lc rgb mode_colour[m], \
    f index 'stick' using 1:2:(on($1,$2)) with lines lw 4 lc rgb blue, \
    '+' using (r_star):(w_star):(on(r_star,w_star)) every ::0::0 with points \
      pt 7 ps 2*P lc rgb black
}
set size 1,1
set origin 0,0
@KEYROW
plot -1 notitle, \
  keyentry with points pt 7 ps 2*P lc rgb black title 'two-fold', \
  for [m=1:4] keyentry with lines lw 4 lc rgb mode_colour[m] \
    title mode_name[m], \
  for [p=1:2] keyentry with boxes fs solid fc rgb shade[p] \
    title word('sliding escaping', p)
