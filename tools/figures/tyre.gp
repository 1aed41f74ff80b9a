# The paper's figure 9: force and moment of the tyre over the slip angle.
wide = 1500; high = 600
@OPEN
f = data.'/tyre.dat'
set multiplot
set xrange [0:90]
set xtics 30
set xlabel 'slip angle φ [degrees]'
set grid lc rgb '#dddddd'
do for [i=1:2] {
  set lmargin at screen (i == 1 ? 0.075 : 0.575)
  set rmargin at screen (i == 1 ? 0.475 : 0.975)
  set bmargin at screen 0.17
  set tmargin at screen 0.72
  if (i == 1) {
    set title '(a) stretched string, k = δ = σ = a = 1' offset 0,-0.4
    set ylabel 'F/μ [1], M/μ [m]' offset 1
    set key at screen 0.275,0.99 center top horizontal
    plot f using 1:2 with lines dt (8,4) lw 4 lc rgb red title 'force', \
      f using 1:3 with lines lw 4 lc rgb blue title 'moment'
  } else {
    set title '(b) the law that jumps; string of k = 10^3, δ = σ = 10^{–3}' \
      offset 0,-0.4
    set ylabel 'F/μ [1], M/(μκ) [1]' offset 1
    set key at screen 0.775,0.99 center top horizontal maxrows 2
    plot f using 1:6 with lines dt (8,4) lw 4 lc rgb red title 'force', \
      f using 1:7 with lines lw 4 lc rgb blue title 'moment', \
      f using 1:($4*1e3) with lines dt (8,4) lw 2 lc rgb orange \
        title 'string: 10^3 F/μ', \
      f using 1:($5*1e3) with lines lw 2 lc rgb sky title '10^3 M/μ'
  }
}
unset multiplot
