"""The words of docs/FINER.md; numbers and tables by report.py."""

PAGE = """\
# Finer laws

Made by `make finer`, from `chaos`: what the two-fold becomes where sign(h) has
a width. Motions begin where `chaos` lands in the sliding region before it (r =
0.191960972 m, omega = -1.053244828 rad/s, h = 0), 0.124 s before the two-fold.
A line of `build/finer/runs.csv` is what `build/finer/finer-BITS form=F width=W
...` prints (BITS: 24 float, 53 double, 64 x87, 113 binary128; names:
`tools/study/finer/main.c`, forms: `law.h`). A motion has *left* where |h| is {exit}
widths. The *effective width* is the width over the slope of phi where the
stick through the two-fold runs, phi = lambda/mu = {share:.4f}.

![Left: the kick that decides over the width. Right: where motions
leave](finer.png)

1. Sensitivity to the *start* is lost, not gained. 4 motions each in binary128
   at 1e-6 m/s: w changed by up to 1e-3 at the start moves r at the exit by
   {starts} m, and r where g = 0 next by as little.
2. Sensitivity to a *disturbance at the two-fold* is extreme. The least kick of
   h there that turns the exit to the other side, by bisection in binary128, is
   {turned} of effective width (form algebraic): it falls as
   width^{turn_slope:.1f} over these widths, and steeper the smaller they are;
   for width to 0 theory has (ratio + 1)/2 = {power:.2f}. From E, by theory's
   leading order, it would be {at_6:.0e} m/s at 1e-6 and {at_finest:.0e} at
   {finest:.0e}, with an exponent of {slope:.2f} (+- {error:.2f} by the fit
   alone, {count} motions from 3e-6 m/s down): the magnitude, not the number.
3. So rounding decides below a critical width that is a power of the precision
   u, not of its logarithm as a relation of entry and exit would have it:
   {crit24:.1e} m/s in float, {crit53:.1e} in double, {crit64:.1e} in x87. To
   double these are {up:.1f} and {down:.2f}; u^(1/{power:.2f}) gives 14.5 and
   0.36, 1/ln(1/u) 2.2 and 0.83. (That of float is among wide layers, where most
   motions still rest.)
4. Undisturbed, each form has one future for each width. As the width goes to 0
   the exit comes nearer to the two-fold (t^2 over the width grows like E, the
   logarithm of what is to be grown). Its side shows no limit: of the forms,
   all leave to slip+ at 1.8e-6 m/s, five of seven to slip- at 3.2e-7. Wide
   layers do not leave: stick goes on to rest at h = g = 0.
5. At equal effective width smoothings of sign(h) agree in the time of the exit
   within 5 % where they leave to the same side (3e-6 m/s and below); `corner`
   and `angle` differ by up to 15 %. What follows differs for each.

## The integrator

Extrapolated midpoint rule (Gragg), order 8, 12, 14 and 20 by precision; the
largest sum of its estimated errors in binary128 is {worst:.0e}; a tolerance 20
times smaller moves E at 1e-7 m/s by 0.002 (`tolerance=1e-29`). The core's law
`smooth` (width 1e-3, t = 0.15 s) differs from it by {core}: order 2
(`tools/tables/test_finer.py`).

## What theory says

Across the layer h' = N - A F, and A and N vanish at the two-fold. With s = t
sqrt(|dA/dt| mu/width) a small deviation from the stick through it obeys xi'' -
s xi' + nu xi = 0 with nu = ratio - 1 = {nu:.4f} (`tools/study/finer/theory.py`). The
layer contracts by exp(-C/width), C = {C:.5f} mm/s by the core's set-valued
stick, but that is not what is left of a deviation: a part decays as |s|^nu
only. So the classical relation of entry and exit, equal exponents, does not
hold:

{contraction}

At s = 0 the deviation is of order width^(nu/2), times the width in h: the
exponent (nu + 2)/2. Behind, all grows by Kummer's function M(-nu/2, 1/2, E), E
the integral of the layer's rate. Kicks of h at the two-fold test it without a
fitted number: measured E are above what is predicted by {kick_low:.1g} to
{kick_high:.1g} %, and by {kick_last:.0f} % at the least kick, {kick_least:g}
m/s, which nearly cancels what the motion brings with it. The theory is linear,
and below s^2 = 4 nu, E = {half_four:.0f}, deviations oscillate.

{kicks}

## Which future each form selects

In binary128, undisturbed. Side (slip+ or slip-) and time from the two-fold to
the exit [ms]; then E of all forms, and r where g = 0 next.

{selected}

## Spread of futures under one disturbance

24 motions in x87, a kick drawn evenly from +- the disturbance at the two-fold.

{kicked}

The place of the exit narrows with the width, as the exit comes nearer to the
two-fold. Side and place of landing are drawn by the disturbance, and their
spread does not shrink.

## Precision

The share of 24 starts, which differ in their last bits, whose exit is that of
binary128: the same side, and a time within 5 %. Rounding acts like a kick of
about {units:.0f} u (u: half a unit in the last place of 1; median in double),
from which the critical widths are predicted, with no exponent assumed: where
binary128 brings as much with it. Measured is where the share passes 1/2.

{precision}

## Stretched string

Form `angle` above is the string's linear start at a slope that grows, and
beyond it the law of the jump. The string itself (`two_piece`: Appendix B with
sigma = 0, rho = 2/3) tends to another law as k grows: Coulomb's, |F| = 4 mu/3
and M = 0, which has no two-fold. On the way F rises from mu to 4 mu/3 while M
falls, at slip angles of order 1/k, and there its stick is stable again, next
to either side of h = 0. So the wheel does not leave: it creeps to h = g = 0,
where a law of the slip angle alone has no limit and the run ends. Double and
x87 agree on it up to k = 100. k = 1.224 is the law that the paper stretches:

{stiff}

## gamma as a family

The wheel's angle gamma + pi, with the two-fold held at (0.1859, -1.037); kappa
and k2 by `twofold design chaos --set gamma=G --r 0.1859 --omega=-1.037`. The
jump f+ - f- at the two-fold is 2 mu sin/m in p' (p = v - d omega) and 2 mu
sin^2/(m r cos) in omega'.

{gamma}

* To 0: case 1 ends at {designed:.4f}, so there the choice ends before the jump
  does; the jump vanishes as sin(gamma), and kappa tends to r\\*.
* To pi/2: case 1 for every angle tried. kappa grows as 1/cos, the weak
  eigenvalue vanishes as cos, so the ratio grows as 1/cos and stick through the
  two-fold is ever better aligned (|lambda| to 0); the jump of omega' grows as
  1/cos. The end point has no machine: kappa is infinite.
* With kappa and k2 of `chaos` held, case 1 lasts from {low:.4f} to {high:.4f}
  (`twofold singularities chaos --set gamma=G`).

## The rolling circle r = d tan gamma

There h = 0 gives v = 0 for every omega, so stick keeps r, and (r - d tan
gamma)' = -(omega - omega0) cot(gamma) (r - d tan gamma): it attracts where
omega is above omega0 and repels below. On it omega tends to a root of m R
omega^2 +- c1 omega sin(gamma)/kappa + k2 (r0 - R) = 0, R = 1 m:
{end_minus:.7f} for positive g and
{end_plus:.7f} rad/s for negative g. `twofold run chaos
--scheme located --set r=1 --set omega=W --set h=0 --t-end 20` begun at omega =
-1.45, -1.415, -1.2, 1.415 and 1.6 keeps r to {drift:g} m and ends within
{apart:.0e} rad/s of them. From r = 1.000001 m the distance changes at
{rate_minus:.4f} 1/s at -1.415 and {rate_plus:.4f} 1/s at 1.415 rad/s (at the
roots 0.4145 and -2.4145 by theory). So the second root is a node, an attractor
beside the recurrence; the first is a saddle. Stick on the circle has |F| < mu
for omega from -1.605 to -1.197 and from 1.078 to 1.687; elsewhere the wheel
slips off it.

## Not shown

* A limit of the side as the width goes to 0: E is below 80 here, where the
  last swings before the exit still turn it. A proof that time and place
  converge.
* `corner` and `angle` differ in what follows at h = g = 0, not studied by
  itself.
* What `angle` and `two_piece` do at h = g = 0, where the layer has no width.
* Resonances: at a whole ratio the growth of what the motion carries vanishes
  to first order (1/Gamma(-nu)); `chaos` is {off:.3f} from 14. Other machines.
* The cubic and the clipped forms have kinks, at which steps are short but of
  low order. Laws with a state of their own (LuGre, bristles) are not among
  these.
"""
