# The paper's figure 8: force and moment of the tyre over the slip angle.
wide = 1500; high = 660
@OPEN
set datafile separator ','
string = data.'/string.csv'
jump = data.'/tyre.csv'
stats jump using 'M' nooutput
set xrange [0:90]
set xtics 30
set xlabel 'slip angle φ [degrees]'
set grid lc rgb '#dddddd'
set margins screen 0.09, screen 0.475, screen 0.20, screen 0.72
set title '(a) stretched string, k = δ = σ = a = 1' offset 0,-0.4
set ylabel 'F/μ [1],  M/μ [m]' offset 1
set yrange [-0.2:1.6]
set ytics 0.4
plot string using 'angle':'F' with lines dt (8,4) lw 4 lc rgb red, \
  string using 'angle':'M' with lines lw 4 lc rgb blue
set lmargin at screen 0.59
set rmargin at screen 0.975
set title '(b) the law that jumps' offset 0,-0.4
set ylabel 'F/μ [1],  M/(μκ) [1]' offset 1
set yrange [0:1.6]
plot jump using 'angle':'F' with lines dt (8,4) lw 4 lc rgb red, \
  jump using 'angle':(column('M')/STATS_max) with lines lw 4 lc rgb blue, \
  data.'/stiff.csv' using 'angle':(column('F')*1e3) with lines dt (2,3) lw 3 \
    lc rgb black
@KEYROW
plot -1 notitle, keyentry with lines dt (8,4) lw 4 lc rgb red title 'force F', \
  keyentry with lines lw 4 lc rgb blue title 'moment M', \
  keyentry with lines dt (2,3) lw 3 lc rgb black \
    title '10^3 F/μ of the string, k = 10^3, δ = σ = 10^{–3}; its M is 0'
