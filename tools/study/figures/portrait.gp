# New: slip next to h = g = 0, where the direction of the force depends on the
# direction of slip alone.
wide = 1600; high = 900
@OPEN
set margins screen 0.08, screen 0.465, screen 0.135, screen 0.80
set border 15 lw 1.5
f = data.'/corner.dat'
r0 = real(word(system("head -n 1 ".f), 3)) # of its line `# r NUMBER`
set title sprintf('(a) slip in the plane of (g, h), r = %g m', r0) \
  offset 0,-0.4
set xrange [-1:1]; set yrange [-1:1]
set xtics 0.5; set ytics 0.5
set xlabel 'rolling speed g [any unit]'
set ylabel 'lateral speed h [the same]' offset 2
set angles degrees
at = data.'/directions.dat'
plot '+' using (-1):(0):(1):(0) every ::0::0 with vectors nohead lw 7 \
    lc rgb green, \
  '+' using (0):(0):(1):(0) every ::0::0 with vectors nohead lw 7 lc rgb grey, \
  f using 1:2 with lines lw 1.8 lc rgb '#444444', \
  f using 1:($3 != 0 || $4 != 0 ? $2 : 1/0):3:4 with vectors head filled \
    size screen 0.012,22,90 fixed lw 1.5 lc rgb '#444444', \
  at using ($1 == r0 && $3 < 0 ? 1.5*cos($2) : 1/0):(1.5*sin($2)): \
    (-1.5*cos($2)):(-1.5*sin($2)) with vectors nohead lw 4 lc rgb blue, \
  at using (0):($1 == r0 && $3 > 0 ? 0 : 1/0):(1.5*cos($2)):(1.5*sin($2)) \
    with vectors nohead lw 4 lc rgb red
set lmargin at screen 0.58; set rmargin at screen 0.975
set title '(b) limit directions at every r' offset 0,-0.4
set xrange [0.10:0.28]; set yrange [-135:225]
set xtics 0.05; set ytics 45
set xlabel 'slider displacement r [m]'
set ylabel 'direction atan2(h, g) [degrees]' offset 1
set palette maxcolors 2 defined (-1 '#ffffff', 1 '#e0e0e0')
set cbrange [-1:1]
unset colorbox
set arrow 1 from r0,-135 to r0,225 nohead lw 1.5 dt (3,3) lc rgb black front
set label 1 'r of (a)' at r0,205 right offset -0.5,0 front
plot data.'/angular.dat' using 1:2:3 with image, \
  at using ($3 < 0 && $4 < 0 ? $1 : 1/0):2 with points pt 7 ps 1*P \
    lc rgb blue, \
  at using ($3 < 0 && $4 > 0 ? $1 : 1/0):2 with points pt 6 ps 1*P \
    lc rgb blue, \
  at using ($3 > 0 && $4 < 0 ? $1 : 1/0):2 with points pt 7 ps 1*P \
    lc rgb red, \
  at using ($3 > 0 && $4 > 0 ? $1 : 1/0):2 with points pt 6 ps 1*P \
    lc rgb red
@KEYROW
plot -1 notitle, keyentry with lines lw 7 lc rgb green title 'stick–', \
  keyentry with lines lw 7 lc rgb grey title 'stick+, may end', \
  keyentry with points pt 7 ps 1.5*P lc rgb blue title 'falls in, attracts', \
  keyentry with points pt 6 ps 1.5*P lc rgb blue title 'falls in, repels', \
  keyentry with points pt 7 ps 1.5*P lc rgb red title 'leaves, attracts', \
  keyentry with boxes fs solid fc rgb '#e0e0e0' title 'turns to larger angles'
