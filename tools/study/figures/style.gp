# What all figures share: the terminal of the requested type, and the colours of
# Okabe and Ito for colour-blind readers. Terminals differ in what a size
# of points is: P makes them alike. A figure sets `wide` and `high` [pixels] and
# says @OPEN, which begins a multiplot; it reads `data`, the folder of its data.
OPEN = "if (type eq '.svg') { \
  set terminal svg size wide,high font 'Helvetica,22' background '#ffffff'; \
  P = 0.5; \
} else { \
  set terminal pngcairo size wide,high font 'Helvetica,22'; \
  P = 1; \
}; set output out; set multiplot; unset key"
black = '#000000'
orange = '#E69F00'
sky = '#56B4E9'
green = '#009E73'
yellow = '#F0E442'
blue = '#0072B2'
red = '#D55E00'
pink = '#CC79A7'
grey = '#999999'
set encoding utf8
set datafile commentschars '#'
set tics nomirror out
set border 3 lw 1.5
set key samplen 1.6 spacing 1.1
# Pale shades for regions of the surface: sliding, escaping, crossing up, down.
array shade[4] = ['#cfe6f5', '#f7cfb5', '#ffffff', '#eeeeee']
region(name) = name eq 'sliding' ? 1 : name eq 'escaping' ? 2 : \
  name eq 'crossing_up' ? 3 : name eq 'crossing_down' ? 4 : NaN
# Colours of the modes slip+, slip-, stick+, stick-, pinned
array mode_colour[5] = [red, orange, blue, green, black]
array mode_name[5] = ['slip+', 'slip-', 'stick+', 'stick-', 'pinned']
# A row of the key above all panels: say @KEYROW, then plot -1 notitle and the
# entries. The last plot of a multiplot.
KEYROW = "unset title; unset xlabel; unset ylabel; unset label; \
  unset arrow; \
  unset object; unset logscale; unset grid; unset tics; unset border; \
  unset colorbox; \
  set margins screen 0.01, screen 0.99, screen 0.01, screen 0.99; \
  set xrange [0:1]; set yrange [0:1]; \
  set key at screen 0.5,0.985 center top horizontal Left reverse maxrows 2 \
    width 1"
