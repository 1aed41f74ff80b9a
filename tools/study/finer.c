// finer - follows motions of the wheel under a law of friction without a jump,
// in one precision of arithmetic: the paper's law with sign(h) replaced by
// phi(x), x = h / width. In the layer |x| = O(1) such a law is stick, and as
// the width goes to 0 each but the last becomes the law with the jump. A motion
// goes from the sliding region through the two-fold to where it leaves the
// layer, and on to where g changes its sign, or h = g = 0 is reached under a
// law of the slip angle.
//
// usage: finer [form=FORM] [NAME=VALUE]...
//
// The names and their defaults stand in OPTIONS. Writes a line for each motion
// under one that names the columns.
//
// The equations of motion and the steps are the reference's (tests/reference),
// in the precision of REF_BITS.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tests/reference/extrapolate.h"

typedef ref_real_t real_t;

// Of a step: above what rounding makes of an extrapolated one, or no step would
// meet it.
#define TOLERANCE (REF_EPSILON * (REF_BITS > 64 ? 0x100000 : 0x100))
enum { COLUMNS = REF_BITS > 64 ? 10 : REF_BITS > 53 ? 7 : 6 };

typedef enum {
  FORM_ALGEBRAIC, // x / sqrt(1 + x^2), the core's law `smooth`
  FORM_TANH,      // tanh x
  FORM_ARCTAN,    // (2/pi) atan x
  FORM_CUBIC,     // (3 x - x^3)/2, +-1 from |x| = 1 on
  FORM_SKEW,      // algebraic, and for x > 0 three times as steep near 0: not
                  // odd
  FORM_CORNER,    // |h|, |g| are sqrt(h^2 + width^2), sqrt(g^2 + width^2) in
                  // the force and the moment: smooth at h = g = 0, too
  FORM_ANGLE,     // x = h / (width |g|), clipped: the string's linear start
  FORM_TWO_PIECE, // Appendix B before the jump, k = 1 / width
  FORMS
} form_t;

static const char *const form_names[FORMS] = {"algebraic", "tanh",     "arctan",
                                              "cubic",     "skew",     "corner",
                                              "angle",     "two_piece"};

// Name and default of each option. The machine, as scene `chaos` has it; width
// [m/s], or rad (angle), or 1/k (two_piece). until [s]; fold: r of the two-fold
// [m]; exit: a motion has left where |h| is that many widths, and only=1 ends
// it there; kick: what is added to h at the two-fold [m/s]. r, w, x: the start,
// x is h in widths, by default where `chaos` lands in the sliding region before
// the two-fold.
// samples, seed, delta: that many motions, in which kick is multiplied and w
// changed (by the share delta) by draws from (-1, 1).
#define OPTIONS(X)                  \
  X(m, 1)                           \
  X(d, 1)                           \
  X(beta, 0.05)                     \
  X(k2, 2.2270992253886014441)      \
  X(c1, 1e-3)                       \
  X(c2, 1e-3)                       \
  X(r0, 0.1)                        \
  X(omega0, -1)                     \
  X(mu, 1)                          \
  X(kappa, 0.27241153714062027818)  \
  X(gamma, -2.35619449019234492885) \
  X(width, 1e-4)                    \
  X(until, 3)                       \
  X(fold, 0.1859)                   \
  X(exit, 3)                        \
  X(only, 0)                        \
  X(kick, 0)                        \
  X(r, 0.191960972)                 \
  X(w, -1.053244828)                \
  X(x, 0)                           \
  X(samples, 1)                     \
  X(seed, 0)                        \
  X(delta, 0)
#define AS_TEXT(name, value) #name,
#define AS_DOUBLE(name, value) double name;
#define AS_DEFAULT(name, value) value,

static const char *const names[] = {OPTIONS(AS_TEXT)};
static struct { OPTIONS(AS_DOUBLE) } given = {OPTIONS(AS_DEFAULT)};
static form_t form = FORM_ALGEBRAIC;

typedef struct {
  ref_machine_t machine;
  real_t width;
} motion_t;

// phi
static real_t share(real_t x) {
  if (form == FORM_TANH) return REF_FN(tanh)(x);
  if (form == FORM_ARCTAN) return 2 / REF_PI * ref_atan2(x, 1);
  if (form == FORM_CUBIC) {
    x = ref_smaller(1, ref_larger(-1, x));
    return x * (3 - x * x) / 2;
  }
  // sqrt(1 + x^2) + 2 x - 1 rises from -1 to 3 x
  if (form == FORM_SKEW) x += ref_sqrt(1 + x * x) + x - 1;
  return x / ref_sqrt(1 + x * x);
}

// The reference's law at |h|, |g| times the share of the sign of h, and M times
// that of g; |phi| times the law of the side: a skew phi may be < 0 at h > 0.
static ref_force_t force_at(const motion_t *k, ref_slip_t s) {
  const ref_machine_t *q = &k->machine;
  const real_t w = k->width;
  ref_slip_t law = {ref_abs(s.h), ref_abs(s.g)};
  real_t of_h = s.h < 0 ? -1 : 1, of_g = s.g < 0 ? -1 : 1;
  if (form == FORM_CORNER) {
    law = (ref_slip_t){ref_hypot(s.h, w), ref_hypot(s.g, w)};
    of_h = s.h / law.h;
    of_g = s.g / law.g;
  } else if (form < FORM_CORNER) {
    of_h = share(s.h / w);
  } else if (form == FORM_ANGLE && law.h < w * law.g) {
    of_h = s.h / (w * law.g);
  }
  const ref_force_t f = ref_slip_force(q, law, ref_piece_at(q, law, 1));
  return (ref_force_t){of_h * f.F, of_h * of_g * f.M};
}

// The width of the layer in h.
static real_t layer_width(const motion_t *k, real_t g) {
  return form >= FORM_ANGLE ? k->width * ref_abs(g) : k->width;
}

// dh'/dh across the layer; < 0 attracts. r and z do not change across it.
static real_t layer_rate(const motion_t *k, ref_state_t x) {
  const ref_slip_t s = ref_slip(&k->machine, x);
  const real_t by = layer_width(k, s.g) / 1000;
  const ref_force_t low = force_at(k, (ref_slip_t){s.h - by, s.g});
  const ref_force_t high = force_at(k, (ref_slip_t){s.h + by, s.g});
  const ref_affine_t of = ref_affine(&k->machine, x);
  return (of.h_F * (high.F - low.F) + of.h_M * (high.M - low.M)) / (2 * by);
}

static ref_state_t slope(void *motion, ref_state_t x) {
  const motion_t *k = motion;
  const ref_machine_t *q = &k->machine;
  const ref_rate_t f = ref_rate(q, x, force_at(k, ref_slip(q, x)));
  return (ref_state_t){.r = f.r, .p = f.p, .z = f.z};
}

// One step of length dt; returns the estimate of its error.
static real_t leap(motion_t *k, ref_state_t from, real_t dt, ref_state_t *to) {
  ref_state_t coarser;
  *to = ref_extrapolate(slope, k, from, dt, COLUMNS, &coarser);
  to->t = from.t + dt;
  const real_t in_r = ref_abs(to->r - coarser.r);
  const real_t in_p = ref_abs(to->p - coarser.p);
  const real_t in_z = ref_abs(to->z - coarser.z);
  return in_r + in_p + in_z;
}

// One step that meets the tolerance, or is of 1e-12 s; *dt is what it may take,
// and then what the next one may.
static ref_state_t advance(motion_t *k, ref_state_t from, real_t *dt) {
  for (;;) {
    ref_state_t to;
    const real_t error = leap(k, from, *dt, &to), taken = *dt;
    *dt = ref_smaller((real_t)0.01L,
                      taken * ref_step_factor(error / TOLERANCE, COLUMNS));
    if (error <= TOLERANCE || taken < (real_t)1e-12L) return to;
  }
}

// Events: each where its function changes its sign.
typedef real_t (*event_t)(const motion_t *, ref_state_t);

static real_t beyond_fold(const motion_t *k, ref_state_t x) {
  (void)k;
  return x.r - (real_t)given.fold;
}

static real_t rolling(const motion_t *k, ref_state_t x) {
  return ref_slip(&k->machine, x).g;
}

static real_t inside(const motion_t *k, ref_state_t x) {
  const ref_slip_t s = ref_slip(&k->machine, x);
  return (real_t)given.exit * layer_width(k, s.g) - ref_abs(s.h);
}

static bool crosses(const motion_t *k, event_t event, ref_state_t from,
                    ref_state_t to) {
  return (event(k, from) > 0) != (event(k, to) > 0);
}

typedef struct {
  motion_t *motion;
  event_t event;
  ref_state_t from;
  real_t sign; // there
} crossing_t;

static real_t after(void *crossing, real_t dt, ref_state_t *to) {
  const crossing_t *at = crossing;
  leap(at->motion, at->from, dt, to);
  return at->sign * at->event(at->motion, *to);
}

// Where the event lies between two points of one step.
static ref_state_t locate(motion_t *k, event_t event, ref_state_t from,
                          ref_state_t to) {
  crossing_t at = {k, event, from, event(k, from) > 0 ? 1 : -1};
  ref_locate(after, &at, 0, to.t - from.t, &to);
  return to;
}

typedef struct {
  double fold_t, exit_t, exit_r; // NaN where it did not happen
  double before, behind;         // integrals of the layer's rate: to the
                                 // two-fold, and from it to the exit
  int side;                      // of the exit; 0 where there is none
  ref_state_t end;
} outcome_t;

// Notes an exit between two points.
static void note(motion_t *k, ref_state_t x, ref_state_t next, outcome_t *out) {
  if (inside(k, next) >= 0) return;
  const ref_state_t at = inside(k, x) > 0 ? locate(k, inside, x, next) : next;
  out->exit_t = (double)at.t;
  out->exit_r = (double)at.r;
  out->side = ref_slip(&k->machine, at).h > 0 ? 1 : -1;
}

// Laws of the slip angle alone have no limit there: what follows is rounding.
static bool at_rest(const motion_t *k, ref_state_t x) {
  const ref_slip_t s = ref_slip(&k->machine, x);
  return form >= FORM_ANGLE && ref_abs(s.h) + ref_abs(s.g) < (real_t)1e-8L;
}

static outcome_t follow(motion_t *k, double kick, ref_state_t x) {
  outcome_t out = {NAN, NAN, NAN, 0, 0, 0, x};
  bool over = false;
  real_t dt = (real_t)1e-6L;
  const real_t until = (real_t)given.until;
  while ((double)x.t < given.until - 1e-14 && !over &&
         (given.only == 0 || out.side == 0)) {
    dt = ref_smaller(dt, until - x.t);
    ref_state_t next = advance(k, x, &dt);
    const double grown =
        (double)((next.t - x.t) * (layer_rate(k, x) + layer_rate(k, next)) / 2);
    if (isnan(out.fold_t)) {
      out.before += grown;
      if (crosses(k, beyond_fold, x, next)) {
        next = locate(k, beyond_fold, x, next);
        out.fold_t = (double)next.t;
        next.p -= (real_t)kick / k->machine.sine;
      }
    } else {
      if (out.side == 0) {
        out.behind += grown;
        note(k, x, next, &out);
      }
      over = crosses(k, rolling, x, next) || at_rest(k, next);
    }
    x = next;
  }
  out.end = x;
  return out;
}

// Appendix B with these is F = 4/3 - cot/3, M = kappa cot in partial slip, cot
// = width |g / h| / (18 kappa^2), and linear from cot = 1 on.
static motion_t motion_of_options(void) {
  motion_t k = {.machine = {PARAMETERS_OF(real_t, &given)},
                .width = (real_t)given.width};
  ref_machine_t *q = &k.machine;
  if (form == FORM_TWO_PIECE) {
    q->law = REF_STRING;
    q->rho = 2 / (real_t)3;
    q->a = 3 * q->kappa;
    q->delta = 1 / q->a;
    q->k = 1 / k.width;
  }
  ref_prepare(q);
  return k;
}

static void sample(motion_t k, double delta, double kick) {
  const ref_machine_t *q = &k.machine;
  const real_t w = (real_t)given.w * (1 + (real_t)delta);
  const ref_state_t start = ref_state(q, (real_t)given.r, 0, w);
  const real_t width = layer_width(&k, ref_slip(q, start).g);
  const outcome_t out =
      follow(&k, kick, ref_with_h(q, start, (real_t)given.x * width));
  const ref_slip_t end = ref_slip(q, out.end);
  printf(
      "%s,%d,%.6g,%.6g,%.6g,%d,%.12g,%.12g,%.12g,%.9g,%.9g,%.17g,%.12g,"
      "%.17g,%.17g,%.17g\n",
      form_names[form], REF_BITS, given.width, delta, kick, out.side,
      out.fold_t, out.exit_t, out.exit_r, out.before, out.behind,
      (double)(end.h / layer_width(&k, end.g)), (double)out.end.t,
      (double)out.end.r, (double)ref_v(q, out.end), (double)ref_w(q, out.end));
}

static bool set_option(const char *word) {
  for (int f = 0; f < FORMS; f++)
    if (strncmp(word, "form=", 5) == 0 &&
        strcmp(word + 5, form_names[f]) == 0) {
      form = (form_t)f;
      return true;
    }
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    const size_t length = strlen(names[n]);
    if (strncmp(word, names[n], length) != 0 || word[length] != '=') continue;
    char *end;
    const double value = strtod(word + length + 1, &end);
    memcpy((char *)&given + n * sizeof value, &value, sizeof value);
    return *end == 0 && end != word + length + 1;
  }
  return false;
}

// splitmix64, in (-1, 1)
static double draw(uint64_t *seed) {
  uint64_t z = (*seed += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) / 0x1p52 - 1;
}

int main(int argc, char **argv) {
  for (int n = 1; n < argc; n++)
    if (!set_option(argv[n])) {
      fprintf(stderr, "finer: %s: not NAME=VALUE, or not a name\n", argv[n]);
      return 2;
    }
  if (!(given.width > 0)) {
    fputs("finer: width > 0\n", stderr);
    return 2;
  }
  const motion_t k = motion_of_options();
  uint64_t seed = (uint64_t)given.seed;
  puts(
      "form,bits,width,delta,kick,side,fold_t,exit_t,exit_r,before,behind,x,t,"
      "r,v,w");
  for (int n = 0; n < given.samples; n++) {
    const double of_start = given.samples > 1 ? draw(&seed) : 1;
    const double of_kick = given.samples > 1 ? draw(&seed) : 1;
    sample(k, given.delta * of_start, given.kick * of_kick);
  }
  return 0;
}
