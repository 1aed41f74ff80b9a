# Work and precision: the largest error at the end over the time of the whole
# integration, one panel a problem. Colours are Okabe and Ito's for colour-blind
# readers, and every peer has a symbol of its own. A setting that failed has no
# point. Usage: gnuplot -e "csv='F'; out='F'" precision.gp
set terminal svg size 1300,1000 font 'Helvetica,13' background rgb 'white'
set output out
set datafile separator ','
peers = 'twofold-moreau twofold-located events-rk4 events-dp5 cvode-adams '. \
  'cvode-bdf arkode-erk5 cvode-smooth rk4-smooth euler octave-ode45 siconos'
# Whether a row is of that peer, and of that problem.
of(i, problem) = strcol('peer') eq word(peers, i) && \
  (problem eq '' || strcol('problem') eq problem)
set datafile columnheaders
which = ''
do for [i=1:words(peers)] {
  stats csv using (of(i, '') ? 1 : 0) nooutput
  if (STATS_sum > 0) { which = which . i . ' ' }
}
unset datafile columnheaders
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set xlabel 'time of one integration [s]'
set ylabel 'largest error of r [m], v [m/s], omega [rad/s]' offset 1
set xrange [1e-6:10]
set yrange [1e-13:10]
set grid lc rgb '#dddddd'
colours = '#000000 #000000 #D55E00 #D55E00 #0072B2 #0072B2 #56B4E9 #009E73 '. \
  '#009E73 #CC79A7 #E69F00 #CC79A7'
symbols = '6 7 4 5 8 9 11 1 2 3 13 12'
set multiplot layout 2,2 margins 0.06,0.84,0.07,0.96 spacing 0.06,0.13
do for [problem in 'chaos crossings stickslip driven'] {
  set title problem
  if (problem eq 'chaos') {
    set key at screen 0.85,0.96 left top vertical Left reverse samplen 1
  } else {
    unset key
    unset ylabel
  }
  plot for [i in which] csv using (of(int(i), problem) ? \
      column('ns') * 1e-9 : NaN):(column('error') <= 0 ? NaN : \
      column('error')) with points pt int(word(symbols, int(i))) \
    ps (int(i) < 3 ? 0.8 : 0.6) lc rgb word(colours, int(i)) \
    title word(peers, int(i))
}
unset multiplot
