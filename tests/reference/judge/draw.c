/// Random machines from wide ranges, and how to run one again.
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"

static const double pi = 3.14159265358979323846;

// SplitMix64 (Steele, Lea, Flood 2014).
static uint64_t next(draw_t *draw) {
  uint64_t x = draw->state += UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
  return x ^ (x >> 31);
}

draw_t draw_begin(uint64_t seed, uint64_t index) {
  draw_t draw = {seed};
  draw.state = next(&draw) ^ index * UINT64_C(0xd1342543de82ef95);
  next(&draw);
  return draw;
}

double draw_uniform(draw_t *draw, double low, double high) {
  return low + (high - low) * ((double)(next(draw) >> 11) * 0x1p-53);
}

double draw_log(draw_t *draw, double low, double high) {
  return exp(draw_uniform(draw, log(low), log(high)));
}

static bool one_in(draw_t *draw, double n) {
  return draw_uniform(draw, 0, n) < 1;
}

double draw_sign(draw_t *draw) { return one_in(draw, 2) ? 1 : -1; }

static double damping(draw_t *draw) {
  const double kind = draw_uniform(draw, 0, 4);
  return kind < 1 ? 0 : kind < 2 ? 1e-3 : draw_uniform(draw, 0, 1);
}

static double angle(draw_t *draw) {
  if (one_in(draw, 4)) return floor(draw_uniform(draw, -4, 5)) * pi / 4;
  return (float)draw_uniform(draw, -pi, pi);
}

// A parameter at or towards the ends of its documented range.
static double at_an_end(draw_t *draw, const char *name, double wide) {
  double low = 0, high = 0;
  lib_range(name, &low, &high);
  const double kind = draw_uniform(draw, 0, 8);
  if (kind < 4) return wide;
  if (kind < 5) return kind < 4.5 ? low : high;
  return draw_log(draw, low > 0 ? low : 1e-9, high);
}

static void place(draw_t *draw, lib_machine_t *q) {
  const double kind = draw_uniform(draw, 0, 3);
  const double near = kind < 2 ? draw_log(draw, 1e-4, 0.5) : 1;
  q->r = draw_uniform(draw, -0.5, 0.5);
  q->omega = q->omega0 + near * draw_uniform(draw, -1, 1) * fabs(q->omega0);
  q->v = near * draw_uniform(draw, -1, 1);
  q->on_surface = kind < 1 && fabs(sin(q->gamma)) > 1e-3;
}

// The numbers of a machine by their names; the last one is instead of h = 0.
static const struct {
  const char *name;
  size_t at;
} numbers[] = {
#define NUMBER(name) \
  { #name, offsetof(lib_machine_t, name) }
    NUMBER(m),     NUMBER(d),  NUMBER(beta),   NUMBER(k2), NUMBER(c1),
    NUMBER(c2),    NUMBER(r0), NUMBER(omega0), NUMBER(mu), NUMBER(kappa),
    NUMBER(gamma), NUMBER(r),  NUMBER(omega),  NUMBER(dt), NUMBER(v)};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

static double *number_at(lib_machine_t *q, int i) {
  return (double *)(void *)((char *)q + numbers[i].at);
}

lib_machine_t draw_machine(draw_t *draw, bool extreme) {
  lib_machine_t q = {
      .m = draw_log(draw, 0.3, 3),
      .d = draw_uniform(draw, 0.2, 2),
      .beta = draw_log(draw, 0.05, 1),
      .k2 = one_in(draw, 8) ? 0 : draw_uniform(draw, 0, 30),
      .c1 = damping(draw),
      .c2 = damping(draw),
      .r0 = draw_uniform(draw, -0.5, 0.5),
      .omega0 = draw_sign(draw) * draw_log(draw, 0.1, 3),
      .mu = draw_log(draw, 0.1, 3),
      .kappa = one_in(draw, 8) ? draw_log(draw, 1e-8, 1e-3)
                               : draw_uniform(draw, 1e-3, 1),
      .gamma = angle(draw),
      .coulomb = one_in(draw, 20),
      .dt = 1e-4,
  };
  if (extreme) {
    q.m = at_an_end(draw, "m", q.m);
    q.beta = at_an_end(draw, "beta", q.beta);
    q.k2 = at_an_end(draw, "k2", q.k2);
    q.mu = at_an_end(draw, "mu", q.mu);
  }
  place(draw, &q);
  const double gamma = q.gamma, dt = q.dt;
  for (int i = 0; i < NUMBERS; ++i)
    *number_at(&q, i) = (float)*number_at(&q, i);
  q.gamma = gamma;
  q.dt = dt;
  return q;
}

ref_machine_t draw_reference(const lib_machine_t *q) {
  ref_machine_t out = {
      PARAMETERS_OF(real_t, q), .law = q->coulomb ? REF_COULOMB : REF_JUMP,
      .knots = q->knots, .swing = q->swing, .swing_rate = q->swing_rate};
  for (int i = 0; i < q->knots; ++i) {
    const lib_knot_t *u = &q->knot[i];
    out.knot[i] = (ref_knot_t){u->t, u->omega0, u->force, u->torque};
  }
  ref_prepare(&out);
  // The number next to pi stands for pi: a wheel along the slot, whose A and N
  // vanish together on the axis.
  if (ref_abs(out.sine) < 1e-15L && out.gamma != 0) {
    out.gamma = ref_sign(out.gamma) * REF_PI;
    out.sine = 0;
  }
  return out;
}

ref_state_t draw_start(const lib_machine_t *machine, const ref_machine_t *q) {
  const ref_state_t x = ref_state(q, machine->r, machine->v, machine->omega);
  return machine->on_surface ? ref_with_h(q, x, 0) : x;
}

// Shortest decimal that reads back to the same double.
static void number(const char *before, double value) {
  char text[40];
  for (int digits = 6; digits <= 17; ++digits) {
    snprintf(text, sizeof text, "%.*g", digits, value);
    if (strtod(text, NULL) == value) break;
  }
  printf("%s%s", before, text);
}

static void print_inputs(const lib_machine_t *q) {
  printf("printf 't,omega0,force,torque\\n");
  for (int i = 0; i < q->knots; ++i) {
    number("", q->knot[i].t);
    number(",", q->knot[i].omega0);
    number(",", q->knot[i].force);
    number(",", q->knot[i].torque);
    printf("\\n");
  }
  printf("' >in.csv; ");
}

void draw_print(const lib_machine_t *machine, double t_end,
                const char *scheme) {
  lib_machine_t q = *machine;
  if (q.knots > 0) print_inputs(&q);
  printf("twofold run chaos%s", q.coulomb ? " --set law=coulomb" : "");
  for (int i = 0; i < NUMBERS - q.on_surface; ++i) {
    if (!q.coulomb || strcmp(numbers[i].name, "kappa") != 0) {
      printf(" --set %s", numbers[i].name);
      number("=", *number_at(&q, i));
    }
  }
  printf("%s%s --t-end %.9g --scheme %s\n", q.on_surface ? " --set h=0" : "",
         q.knots > 0 ? " --inputs in.csv --between linear" : "", t_end, scheme);
}
