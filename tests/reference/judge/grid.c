/// @file
/// Class (a), second half: the enumeration of the step against a
/// search of the inclusion as its header states it. The forms are those of a
/// linearised step of random machines: p+ and z+ affine in the force, r+ = r +
/// dt (v + v+)/2, so that h+ and g+ are quadratic.
#include <math.h>
#include <string.h>

#include "classes.h"

typedef struct {
  double form[15];
  bool pins; ///< a force that ends at h = g = 0 exists
} step_t;

static double value(const double c[6], double x, double y) {
  return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y +
         c[5] * y * y;
}

// c += a b with a, b = (1, x, y) coefficients.
static void product(double c[6], double factor, const double a[3],
                    const double b[3]) {
  c[0] += factor * a[0] * b[0];
  c[1] += factor * (a[0] * b[1] + a[1] * b[0]);
  c[2] += factor * (a[0] * b[2] + a[2] * b[0]);
  c[3] += factor * a[1] * b[1];
  c[4] += factor * (a[1] * b[2] + a[2] * b[1]);
  c[5] += factor * a[2] * b[2];
}

// The step of a machine from state x: end values as (1, x, y) coefficients.
static step_t step_of(const lib_machine_t *machine) {
  const ref_machine_t q = draw_reference(machine, &lib_f64);
  const ref_state_t x = draw_start(machine, &q, &lib_f64);
  const ref_rate_t f = ref_rate(&q, x, (ref_force_t){0, 0});
  const real_t J = q.m * (q.beta * q.beta + x.r * x.r), dt = machine->dt;
  const double p[3] = {(double)(x.p + dt * f.p),
                       (double)(dt * q.mu * q.sine / q.m), 0};
  const double z[3] = {(double)(x.z + dt * f.z),
                       (double)(dt * q.mu * x.r * q.cosine / J),
                       (double)(dt * q.kappa * q.mu / J)};
  const double one[3] = {1, 0, 0}, v = (double)ref_v(&q, x), d = machine->d;
  double r[3];
  for (int i = 0; i < 3; ++i) {
    r[i] = (i == 0 ? machine->r + machine->dt * v / 2 : 0) +
           machine->dt / 2 * (p[i] + d * z[i]);
  }
  step_t step;
  memset(&step, 0, sizeof step);
  product(step.form, (double)-q.sine, p, one);
  product(step.form, (double)-q.cosine, r, z);
  product(step.form + 6, (double)-q.cosine, p, one);
  product(step.form + 6, (double)q.sine, r, z);
  step.form[12] = (double)ref_slip(&q, x).g;
  step.pins = p[1] != 0 && z[2] != 0;
  if (step.pins) {
    step.form[13] = -p[0] / p[1];
    step.form[14] = -(z[0] + z[1] * step.form[13]) / z[2];
  }
  return step;
}

// Sets a unsure answer's bit where a value is too near 0 to tell.
static bool positive(double value_, double size, bool *unsure) {
  *unsure = *unsure || fabs(value_) < 1e-9 * size;
  return value_ > 0;
}

// Slip with x = side: every s in Sgn(g) leads to an h.
static bool slips(const step_t *step, int side, double h0, double g0,
                  bool *unsure) {
  const double *h = step->form, *g = step->form + 6;
  bool found = false;
  for (int s = -1; s <= 1; s += 2) {
    if (positive(s * value(g, side, s * side), g0, unsure)) {
      found |= positive(side * value(h, side, s * side), h0, unsure);
    }
  }
  enum { POINTS = 2000 };
  for (int i = 0; i < POINTS; ++i) {
    const double a = -1 + 2.0 * i / POINTS, b = a + 2.0 / POINTS;
    const double ga = value(g, side, a * side), gb = value(g, side, b * side);
    if ((ga > 0) != (gb > 0)) {
      const double s = (a * gb - b * ga) / (gb - ga);
      found |= positive(side * value(h, side, s * side), h0, unsure);
    }
  }
  return found;
}

static bool sticks(const step_t *step, int s, double h0, double g0,
                   bool *unsure) {
  enum { POINTS = 4000 };
  const double *h = step->form, *g = step->form + 6;
  bool found = false;
  positive(value(h, 1, s), h0, unsure);
  positive(value(h, -1, -s), h0, unsure);
  for (int i = 0; i < POINTS; ++i) {
    const double a = -1 + 2.0 * i / POINTS, b = a + 2.0 / POINTS;
    const double ha = value(h, a, s * a), hb = value(h, b, s * b);
    if ((ha > 0) != (hb > 0)) {
      const double x = (a * hb - b * ha) / (hb - ha);
      found |= positive(s * value(g, x, s * x), g0, unsure);
    }
  }
  return found;
}

static double size_of(const double c[6]) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) {
    sum += fabs(c[i]);
  }
  return sum;
}

static unsigned search(const step_t *step, bool *unsure) {
  const double h0 = size_of(step->form), g0 = size_of(step->form + 6);
  const double x = step->form[13], y = step->form[14];
  unsigned set = 0;
  *unsure = false;
  set |= slips(step, 1, h0, g0, unsure) ? 1u << REF_SLIP_PLUS : 0;
  set |= slips(step, -1, h0, g0, unsure) ? 1u << REF_SLIP_MINUS : 0;
  set |= sticks(step, 1, h0, g0, unsure) ? 1u << REF_STICK_PLUS : 0;
  set |= sticks(step, -1, h0, g0, unsure) ? 1u << REF_STICK_MINUS : 0;
  if (step->pins && fabs(x) <= 1 && fabs(y) <= fabs(x)) {
    set |= 1u << REF_PINNED;
  }
  *unsure = *unsure || fabs(fabs(x) - 1) < 1e-6 ||
            fabs(fabs(y) - fabs(x)) < 1e-6 * fabs(x);
  return set;
}

static count_t *undecided, *differ, *missing, *empty;

static void begin(void) {
  undecided = count_add(false, "too near a border to judge");
  differ = count_add(true, "set differs from the search");
  missing = count_add(false, "of them a mode is missing");
  empty = count_add(false, "search finds no mode at all");
}

static void judge(trial_t *trial) {
  enum { STARTS = 10 };
  lib_machine_t *machine = &trial->machine;
  for (int n = 0; n < STARTS; ++n) {
    if (n > 0) {
      *machine = draw_machine(&trial->draw, trial->options->range);
    }
    machine->coulomb = false;
    machine->dt = draw_log(&trial->draw, 1e-5, 1e-2);
    trial->t_end = machine->dt;
    bool unsure;
    const step_t step = step_of(machine);
    const unsigned wanted = search(&step, &unsure);
    const unsigned found = lib_f64.enumerate(step.form, true);
    count_try(undecided, trial, unsure);
    if (!unsure) {
      count_try(differ, trial, found != wanted);
      count_try(missing, trial, (wanted & ~found) != 0);
      count_try(empty, trial, wanted == 0);
    }
  }
}

const class_t class_grid = {
    "grid", "(a) the enumeration against a search", 2000, 0, begin, judge,
    NULL};
