# The paper's figure 4: where a prescribed two-fold is a Teixeira singularity.
wide = 1600; high = 1000
@OPEN
load data.'/numbers.dat'
set datafile separator ','
csv = data.'/atlas.csv'
set xrange [0:0.5]
set yrange [-1.5:-0.5]
set cbrange [0:1]
unset colorbox
set border 15 lw 1.5
set xtics 0.1,0.2
set ytics 0.5
at(name) = sprintf("column('%s')", name)
array columns[7] = ['overlap', 'K--_positive', 'K++_negative', 'J1_negative', \
  'J2_negative', 'J1J2_above_1', 'k2_positive']
array title_of[7] = ['(a) all of (b) to (g)', '(b) K_{– –} > 0', \
  '(c) K_{+ +} < 0', '(d) J_1 < 0', '(e) J_2 < 0', '(f) J_1 J_2 > 1', \
  '(g) k_2 > 0, κ > 0']
do for [i=1:7] {
  if (i == 1) {
    set margins screen 0.09, screen 0.39, screen 0.25, screen 0.80
    set xlabel 'prescribed r* [m]'
    set ylabel 'prescribed ω* [rad/s]' offset 1
    set palette defined (0 '#ffffff', 1 green)
    set xtics 0,0.1; set ytics -1.5,0.25; set format y '%.2f'
    set label 1 'figure 5' at r_star,w_star front point pt 7 ps 1.6*P \
      lc rgb black offset 1,-0.8
  } else {
    x = 0.495 + 0.17 * ((i - 2) % 3); y = i < 5 ? 0.59 : 0.10
    set margins screen x, screen x + 0.145, screen y, screen y + 0.36
    set xlabel (i < 5 ? '' : 'r* [m]') offset 0,0.3
    set ylabel ((i - 2) % 3 ? '' : 'ω* [rad/s]') offset 1
    set palette defined (0 '#ffffff', 1 sky)
    set xtics 0,0.2; set ytics -1.5,0.5
    set format y ((i - 2) % 3 ? '' : '%.1f')
    set label 1 '' at r_star,w_star front point pt 7 ps 1*P lc rgb black
  }
  set title title_of[i] offset 0,-0.5
  if (i < 7) {
    plot csv using 'r':'omega':columns[i] with image
  } else {
    plot csv using 'r':'omega':columns[i] with image, \
      csv using (column('kappa_positive') == 1 && \
        (int(column('r') * 400 + 0.5) + \
         int((column('omega') + 1.5) * 200 + 0.5)) % 40 < 1 ? \
        column('r') : NaN):'omega' with dots lc rgb black
  }
}
