# The paper's figure 2, computed: what slip near h = 0 does at three places.
wide = 1500; high = 620
@OPEN
array name[3] = ['crossing', 'sliding', 'escaping']
array title_of[3] = ['(a) crossing', '(b) sliding', '(c) escaping']
set xrange [0:2]
set yrange [-16:16]
set xtics 0.5
set ytics 5
set xlabel 'time t [ms]'
set style line 1 lc rgb red lw 3.5
set style line 2 lc rgb blue lw 3.5
f = data.'/surface.curves.dat'
# On one side of h = 0, or on both (side 0).
of(what, side) = sprintf('%s %d', what, side)
do for [i=1:3] {
  x = 0.075 + 0.31 * (i - 1)
  set margins screen x, screen x + 0.28, screen 0.21, screen 0.79
  set title title_of[i] offset 0,-0.4
  if (i == 1) {
    set ylabel 'slip speed h [µm/s]' offset 1.2
  } else {
    unset ylabel
    set format y ''
  }
  set label 1 'h = 0' at 1.98,1.2 right front tc rgb black
  plot 0 with lines lw (i == 1 ? 2 : 7) lc rgb (i == 1 ? black : grey), \
    f index of(name[i], i == 1 ? 0 : 1) using ($1*1e3):($2*1e6) \
      with lines ls 1, \
    f index of(name[i], -1) using ($1*1e3):($2*1e6) with lines ls 2
}
@KEYROW
plot -1 notitle, keyentry with lines ls 1 title 'slip at h > 0, f_+', \
  keyentry with lines ls 2 title 'slip at h < 0, f_–', \
  keyentry with lines lw 7 lc rgb grey title 'stick, f_s'
