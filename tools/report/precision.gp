# Work and precision: error at the end over the time of the whole run, a panel a
# part of the motion. Colours are Okabe and Ito's for colour-blind readers, and
# every series has a symbol of its own. Failures have marks of their own. The
# dashed line is the reference's own uncertainty. The best peers are told apart,
# the others are grey.
# Usage: gnuplot -e "work='D'; peers='F or nothing'; best='PEER PEER'; \
#   real='double'" precision.gp
set terminal svg size 1700,1150 font 'Helvetica,26' background '#ffffff'
set output sprintf('%s/precision-%s.svg', work, real)
set datafile separator ','
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set grid lc rgb '#dddddd'
parts = 'smooth crossings stick codim2 approach'
schemes = 'moreau carried located located located located located located'
dials = 'dt dt dt order tolerance@1s tolerance@100ms tolerance@20ms ' \
  .'tolerance@5ms'
colours = '#D55E00 #E69F00 #0072B2 #56B4E9 #8C7A00 #009E73 #666666 #CC79A7'
symbols = '5 7 9 11 3 13 8 15'
csv = work.'/sweep.csv'
low = real eq 'double' ? 1e-17 : 1e-9
top = 10
rows(p, i, what) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && " \
  ."$3==\"%s\" && $4==\"%s\" && (%s)' '%s'", word(parts, p), word(schemes, i), \
  real, word(dials, i), what, csv)
every(p, what) = sprintf("< awk -F, '$1==\"%s\" && $3==\"%s\" && (%s)' '%s'", \
  word(parts, p), real, what, csv)
info(p, field) = system(sprintf("awk -F, '$1==\"%s\" { print $%d }' '%s'", \
  word(parts, p), field, work.'/parts.csv'))
has_peers = strlen(peers) > 0 && real eq 'double'
rival(p) = sprintf("< awk -F, '$1==\"%s\" && $2 !~ /^twofold/ && $5 != \"inf\"'" \
  ." '%s'", info(p, 3), peers)
known = has_peers ? words(best) : 0
peer_colours = '#7B3294 #8B4513 #D40055 #4D7A00'
peer_symbols = '5 9 13 11'
one_rival(p, k) = sprintf("< awk -F, '$1==\"%s\" && $2==\"%s\" && " \
  ."$5 != \"inf\"' '%s'", info(p, 3), word(best, k), peers)
set multiplot title 'Error and time of a run in '.real font ',31'
set xrange [3e-7:0.3]
set yrange [low:top]
unset key
set lmargin 8
set rmargin 1.5
do for [p=1:5] {
  set origin ((p - 1) % 3) / 3.0, 0.96 - 0.48 * ((p - 1) / 3 + 1)
  set size 0.333, 0.48
  set title info(p, 2) offset 0,-0.6
  set xlabel 'time of the run [s]' offset 0,0.5
  set ylabel 'error at the end [m, m/s, rad/s]' offset 1
  doubt = real(info(p, 7))
  floor = doubt > 2 * low ? doubt : 2 * low
  set arrow 1 from graph 0, first floor to graph 1, first floor nohead \
    dt 2 lw 2 lc rgb '#555555'
  set label 1 sprintf('reference: %.0e', doubt) at graph 0.97, first floor * 8 \
    right tc rgb '#555555' font ',22'
  crowd = has_peers && (p == 2 || p == 4)
  plot for [k=1:crowd] rival(p) using ($6 * 1e-9):5 with points pt 7 ps 0.17 \
      lc rgb '#bbbbbb', \
    for [i=1:8] rows(p, i, '$16=="ok" || $16=="flagged"') \
      using ($12 * 1e-9):($8 > low ? $8 : low) with linespoints \
      pt int(word(symbols, i)) ps 0.38 lw 1.5 lc rgb word(colours, i), \
    for [k=1:crowd*known] one_rival(p, k) using ($6 * 1e-9):5 with points \
      pt int(word(peer_symbols, k)) ps 0.32 \
      lc rgb word(peer_colours, k), \
    every(p, '$16=="flagged"') using ($12 * 1e-9):8 with points pt 6 ps 0.75 \
      lw 1.5 lc rgb '#000000', \
    every(p, '$16=="branch"') using ($12 * 1e-9):($8 < top ? $8 : top * 0.6) \
      with points pt 2 ps 0.6 lw 2 lc rgb '#000000', \
    every(p, '$16=="refused"') using ($12 * 1e-9):(top * 0.6) with points \
      pt 1 ps 0.75 lw 2.5 lc rgb '#000000'
}
# The legend takes the place of a sixth panel.
unset arrow
unset label
unset logscale
unset grid
unset border
unset tics
unset xlabel
unset ylabel
unset title
set origin 0.68, 0.0
set size 0.31, 0.46
set lmargin 1
set xrange [0:1]
set yrange [0:1]
set key at graph 0.02, 0.98 left top vertical Left reverse samplen 2 spacing 0.72 \
  font ',23'
plot for [i=1:8] NaN with linespoints pt int(word(symbols, i)) ps 0.55 lw 1.5 \
    lc rgb word(colours, i) title word(schemes, i).', '.word(dials, i) noenhanced, \
  NaN with points pt 6 ps 0.75 lw 1.5 lc rgb '#000000' \
    title 'flagged', \
  NaN with points pt 2 ps 0.6 lw 2 lc rgb '#000000' title 'another branch', \
  NaN with points pt 1 ps 0.75 lw 2.5 lc rgb '#000000' title 'refused', \
  NaN with lines dt 2 lw 2 lc rgb '#555555' title 'doubt of the reference', \
  for [k=1:known] NaN with points pt int(word(peer_symbols, k)) ps 0.5 \
    lc rgb word(peer_colours, k) title 'peer '.word(best, k) noenhanced, \
  for [k=1:has_peers] NaN with points pt 7 ps 0.3 lc rgb '#bbbbbb' \
    title 'other peers (make bench-peers)'
unset multiplot
