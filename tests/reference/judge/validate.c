/// @file
/// The reference judged before it judges: the numbers of the scene `chaos`
/// that the paper's equations fix, and ten random machines against a second
/// integration.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "classes.h"
#include "second.h"

static int failures;

static void check(const char *name, real_t found, real_t wanted,
                  real_t tolerance) {
  const bool good = fabsl(found - wanted) <= tolerance;
  failures += !good;
  printf("%-4s %-34s %22.15Lf  wanted %22.15Lf  difference %9.2Le\n",
         good ? "ok" : "BAD", name, found, wanted, found - wanted);
}

static ref_machine_t paper(void) {
  const real_t pi = acosl(-1), r = 0.1859L, w = -1.037L;
  ref_machine_t q = {.m = 1,
                     .d = 1,
                     .beta = 0.05L,
                     .c1 = 1e-3L,
                     .c2 = 1e-3L,
                     .r0 = 0.1L,
                     .omega0 = -1,
                     .mu = 1,
                     .gamma = -3 * pi / 4};
  const real_t s = sinl(q.gamma), c = cosl(q.gamma), b2 = q.beta * q.beta;
  const real_t v = (w - q.omega0) * (q.d - r * c / s);
  q.kappa = -(2 * r * r + b2 * (1 - cosl(2 * q.gamma))) / (2 * r * c);
  const real_t p2 = q.d * r * c + (b2 + r * r) * s;
  q.k2 = (s * (b2 + r * r) * (q.m * r * w * w - q.c2 * v) -
          c * (q.c1 * r * w + q.c2 * q.d * r * v +
               q.m * (r * r * (v * (w + q.omega0) - q.d * w * w) +
                      b2 * v * (q.omega0 - w)))) /
         ((r - q.r0) * p2);
  ref_prepare(&q);
  return q;
}

static ref_state_t along(ref_state_t x, ref_rate_t f, real_t t) {
  x.r += t * f.r;
  x.p += t * f.p;
  x.z += t * f.z;
  return x;
}

// K: derivative along f(x, to mu) of h' under f(x, of mu), in the paper's
// time, by differences of order 4.
static real_t K(const ref_machine_t *q, ref_state_t x, int of, int to) {
  const ref_rate_t f = ref_rate(q, x, ref_stick_force(q, 1, to * q->mu));
  const real_t t = 1e-4L, D = q->m * (q->beta * q->beta + x.r * x.r);
  real_t side[4];
  for (int i = 0; i < 4; ++i) {
    static const int steps[4] = {-2, -1, 1, 2};
    const ref_edge_t e = ref_edge(q, along(x, f, steps[i] * t), 1);
    side[i] = of > 0 ? e.plus : e.minus;
  }
  return D * D * (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * t);
}

static void two_fold(const ref_machine_t *q) {
  const real_t r = 0.1859L, w = -1.037L;
  const real_t v = (w + 1) * (q->d - r * q->cosine / q->sine);
  const ref_state_t x = ref_state(q, r, v, w);
  check("kappa", q->kappa, 0.27241153714062027818L, 1e-18L);
  check("k2", q->k2, 2.2270992253886014441L, 1e-17L);
  check("v*", v, -0.0301217L, 1e-12L);
  check("g*", ref_slip(q, x).g, 0.009727385146L, 1e-12L);
  const real_t pp = K(q, x, 1, 1), pm = K(q, x, 1, -1);
  const real_t mp = K(q, x, -1, 1), mm = K(q, x, -1, -1);
  check("K++", pp, -0.0023567513838866354L, 1e-13L);
  check("K+-", pm, 0.0032510430314189251L, 1e-13L);
  check("K-+", mp, -0.0027567704314507111L, 1e-13L);
  check("K--", mm, 0.0028510239838548495L, 1e-13L);
  const real_t J1 = mp / sqrtl(-pp * mm), J2 = -pm / sqrtl(-pp * mm);
  check("J1", J1, -1.0635141712155655L, 1e-11L);
  check("J2", J2, -1.2541959590469642L, 1e-11L);
  check("J1 J2", J1 * J2, 1.3338551759277435L, 1e-11L);
  const real_t root = sqrtl((J1 - J2) * (J1 - J2) + 4);
  check("eigenvalue 1", (J1 + J2 + root) / 2, -0.15432040368L, 1e-10L);
  check("eigenvalue 2", (J1 + J2 - root) / 2, -2.16338972658L, 1e-10L);
  check("A at r*", ref_edge(q, x, 1).A, 0, 1e-17L);
  ref_state_t other = x;
  other.r = q->beta * q->beta * q->sine * q->sine / r;
  check("A at the other zero", ref_edge(q, other, 1).A, 0, 1e-17L);
}

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  const ref_state_t *x = &orbit->x;
  if (event == REF_CODIM2 && orbit->codim2_count == 1) {
    check("h = g = 0 at t", orbit->x.t, 0.009409869L, 1e-9L);
    check("  r", x->r, 0.179862653L, 1e-9L);
  } else if (event == REF_CODIM2) {
    const ref_edge_t edge =
        ref_edge(orbit->machine, (ref_state_t){.r = x->r}, 1);
    check("leaves stick- at t", orbit->x.t, 1.908120383L, 1e-9L);
    check("  r", x->r, 0.192272795344L, 1e-12L);
    check("  lambda of stick+", fabsl(edge.N / edge.A), 1.718L, 1e-3L);
    check("  angle [deg]",
          orbit->consistent.list[orbit->chosen].angle * 180 / acosl(-1),
          359.56L, 5e-3L);
  } else if (event == REF_ENTERS) {
    check("lower sliding region at t", orbit->x.t, 1.922602L, 1e-6L);
    check("  r", x->r, 0.191960972L, 1e-9L);
    check("  w", ref_w(orbit->machine, *x), -1.053244828L, 1e-9L);
  }
}

int class_validate(const options_t *options) {
  const ref_machine_t q = paper();
  (void)options;
  two_fold(&q);
  ref_state_t x = {.r = 0.18L, .z = -0.037L};
  x.p = -(1e-10L + x.r * x.z * q.cosine) / q.sine;
  ref_orbit_t orbit = {.tolerance = 1e-13L, .watch = on_event};
  ref_begin(&orbit, &q, x, REF_MODES);
  ref_run(&orbit, 1);
  check("r(1)", orbit.x.r, 0.185676357258L, 1e-12L);
  check("v(1)", ref_v(&q, orbit.x), 0.010298364853L, 1e-12L);
  check("w(1)", ref_w(&q, orbit.x), -0.987353474328L, 1e-12L);
  ref_run(&orbit, 2.0462L);
  const ref_force_t force = ref_force(&orbit, orbit.x);
  const ref_rate_t rate = ref_rate(&q, orbit.x, force);
  check("lambda/mu near the two-fold", force.F / q.mu, 0.0949L, 2e-4L);
  check("dw/dr near the two-fold", rate.z / rate.r, -10.2367L, 2e-2L);
  ref_run(&orbit, 3);
  check("two-fold at t", orbit.x.t, 2.046269L, 1e-5L);
  check("  r", orbit.x.r, 0.1859L, 1e-9L);
  check("  w", ref_w(&q, orbit.x), -1.037L, 1e-8L);
  printf("%d bad\n", failures);
  return failures > 0;
}

// Ends where the second integration has to: at h = g = 0.
int class_second(const options_t *options) {
  real_t worst = 0;
  printf(
      "machine   t reached  events (both)  codim2_count  largest difference\n");
  for (long i = 0; i < options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)(options->first + i));
    lib_machine_t machine = draw_machine(&draw, options->range);
    machine.on_surface = false;
    ref_machine_t q;
    ref_orbit_t orbit = class_orbit(&machine, &q, &lib_f64);
    real_t x[3] = {orbit.x.r, ref_v(&q, orbit.x), ref_w(&q, orbit.x)};
    int events = 0;
    const real_t end = options->t_end > 0 ? (real_t)options->t_end : 2;
    const real_t t = ref_second(&q, x, end, 1e-13L, &events);
    ref_run(&orbit, t);
    const real_t e =
        fmaxl(fabsl(orbit.x.r - x[0]), fmaxl(fabsl(ref_v(&q, orbit.x) - x[1]),
                                             fabsl(ref_w(&q, orbit.x) - x[2])));
    printf("%7ld %11.6Lf %8d %5d %8d %12.2Le  %s\n", options->first + i, t,
           events, orbit.events, orbit.codim2_count, e,
           ref_stop_name(orbit.stop));
    worst = fmaxl(worst, e);
  }
  printf("worst %.2Le\n", worst);
  return 0;
}
