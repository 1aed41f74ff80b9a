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
// Integration is by extrapolation of Gragg's midpoint rule with 2, 4, 6, ...
// substeps to order 2 COLUMNS (Deuflhard, SIAM Review 27, 1985). It has no
// table of coefficients, so it is as exact as its arithmetic. No line of it is
// the core's, nor of the references: those have the law with the jump.
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The number type of one build: builds differ in their rounding alone. UNIT is
// half a unit in the last place of 1; TOLERANCE of a step is above what
// rounding makes of an extrapolated step, or no step would meet it.
#if FINER_BITS == 24
typedef float real_t;
#define OF(function) function##f
#define COLUMNS 4
#define TOLERANCE 0x1p-15F
#elif FINER_BITS == 53
typedef double real_t;
#define OF(function) function
#define COLUMNS 6
#define TOLERANCE 0x1p-44
#elif FINER_BITS == 64
typedef long double real_t;
#define OF(function) function##l
#define COLUMNS 7
#define TOLERANCE 0x1p-55L
#elif FINER_BITS == 113
#include <quadmath.h>
__extension__ typedef __float128 real_t;
#define OF(function) function##q
#define COLUMNS 10
#define TOLERANCE ((real_t)0x1p-92L)
#else
#error "FINER_BITS is 24, 53, 64 or 113"
#endif
#define UNIT OF(ldexp)(1, -FINER_BITS)

enum { STATES = 3 }; // r, v, w

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
// [m]; exit: a motion has left where |h| is that many widths; kick: what is
// added to h at the two-fold [m/s]. r, w, x: the start, x is h in widths, by
// default where `chaos` lands in the sliding region before the two-fold.
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
#define AS_REAL(name, value) real_t name;
#define IN_REAL(name, value) .name = (real_t)given.name,

static const char *const names[] = {OPTIONS(AS_TEXT)};
static struct { OPTIONS(AS_DOUBLE) } given = {OPTIONS(AS_DEFAULT)};
static form_t form = FORM_ALGEBRAIC;

// The options in the real type, and what a motion has taken.
typedef struct {
  // cppcheck-suppress unusedStructMember  ; set by their offsets
  OPTIONS(AS_REAL)
  real_t beta2, sine, cosine, a, right;
  long steps;
  real_t error; // the sum of the estimates of all steps
} motion_t;

typedef struct {
  real_t t, x[STATES];
} point_t;

typedef struct {
  real_t h, g;
} slip_t;

typedef struct {
  real_t F, M;
} force_t;

static real_t absolute(real_t x) { return x < 0 ? -x : x; }

static real_t clipped(real_t x) { return x > 1 ? 1 : x < -1 ? -1 : x; }

// phi
static real_t share(const motion_t *k, real_t x) {
  switch (form) {
    case FORM_TANH:
      return OF(tanh)(x);
    case FORM_ARCTAN:
      return OF(atan)(x) / k->right;
    case FORM_CUBIC:
      x = clipped(x);
      return x * (3 - x * x) / 2;
    case FORM_ANGLE:
      return clipped(x);
    case FORM_SKEW: // x + (sqrt(1 + x^2) + x - 1) rises from -1 to 3 x
      x += OF(sqrt)(1 + x * x) + x - 1;
      return x / OF(sqrt)(1 + x * x);
    case FORM_ALGEBRAIC:
    case FORM_CORNER:
    case FORM_TWO_PIECE:
    case FORMS:
    default:
      return x / OF(sqrt)(1 + x * x);
  }
}

// Corrected formulas of Appendix B: linear up to cot = 18 k kappa^2.
static force_t two_piece(const motion_t *k, real_t H, real_t G) {
  const real_t steep = 18 * k->kappa * k->kappa / k->width;
  if (steep * H < G) return (force_t){steep * H / G, k->kappa * steep * H / G};
  const real_t cot = G / (steep * H);
  return (force_t){(real_t)4 / 3 - cot / 3, k->kappa * cot};
}

// With T = cot psi = tan(a atan(G / H)): F = mu (4/3 - T/(18 kappa)), M = mu
// T/6, times the share of the sign of h, and M times that of g.
static force_t force_at(const motion_t *k, slip_t s) {
  const real_t w = k->width;
  real_t H = absolute(s.h), G = absolute(s.g), of_h, of_g = s.g < 0 ? -1 : 1;
  force_t f;
  if (form == FORM_CORNER) {
    H = OF(sqrt)(s.h * s.h + w * w);
    G = OF(sqrt)(s.g * s.g + w * w);
    of_h = s.h / H;
    of_g = s.g / G;
  } else if (form == FORM_TWO_PIECE) {
    of_h = s.h < 0 ? -1 : 1;
  } else if (form == FORM_ANGLE) {
    of_h = H < w * G ? s.h / (w * G) : s.h < 0 ? -1 : 1;
  } else {
    of_h = share(k, s.h / w);
  }
  if (form == FORM_TWO_PIECE) {
    f = two_piece(k, H, G);
  } else {
    const real_t T = OF(tan)(k->a * OF(atan2)(G, H));
    f = (force_t){(real_t)4 / 3 - T / (18 * k->kappa), T / 6};
  }
  // |phi| times the law of the side: a skew phi may be < 0 at h > 0.
  return (force_t){k->mu * of_h * f.F, k->mu * of_h * of_g * f.M};
}

// (h), (g)
static slip_t slip_at(const motion_t *k, const real_t x[STATES]) {
  const real_t z = x[2] - k->omega0, p = x[1] - k->d * z, q = x[0] * z;
  return (slip_t){-p * k->sine - q * k->cosine, -p * k->cosine + q * k->sine};
}

// In physical time: (v', w') = Mass^-1 (Q_r, Q_phi), the paper's (ds2), (ds3)
// divided by m (beta^2 + r^2).
static void rate(const motion_t *k, const real_t x[STATES], real_t dx[STATES]) {
  const real_t r = x[0], v = x[1], w = x[2];
  const force_t f = force_at(k, slip_at(k, x));
  const real_t Q_r =
      k->k2 * (k->r0 - r) - k->c2 * v + k->m * r * w * w + f.F * k->sine;
  const real_t Q_phi = -k->c1 * w - 2 * k->m * r * v * w +
                       f.F * (r * k->cosine - k->d * k->sine) + f.M;
  const real_t gyration2 = k->beta2 + r * r, D = k->m * gyration2;
  dx[0] = v;
  dx[1] = ((gyration2 + k->d * k->d) * Q_r + k->d * Q_phi) / D;
  dx[2] = (k->d * Q_r + Q_phi) / D;
}

// The width of the layer in h.
static real_t layer_width(const motion_t *k, real_t g) {
  return form >= FORM_ANGLE ? k->width * absolute(g) : k->width;
}

// dh'/dh across the layer; < 0 attracts. r and w do not change across it. The
// force acts on h' by (r^2 + beta^2 sin^2)/D, the moment by r cos/D.
static real_t layer_rate(const motion_t *k, const real_t x[STATES]) {
  const slip_t s = slip_at(k, x);
  const real_t r = x[0], D = k->m * (k->beta2 + r * r);
  const real_t by = layer_width(k, s.g) / 1000;
  const force_t low = force_at(k, (slip_t){s.h - by, s.g});
  const force_t high = force_at(k, (slip_t){s.h + by, s.g});
  return -((r * r + k->beta2 * k->sine * k->sine) * (high.F - low.F) +
           r * k->cosine * (high.M - low.M)) /
         (2 * by * D);
}

static void midpoint(const motion_t *k, const real_t x[STATES], real_t dt,
                     int n, real_t y[STATES]) {
  const real_t h = dt / (real_t)n;
  real_t before[STATES], dx[STATES];
  rate(k, x, dx);
  for (int i = 0; i < STATES; i++) {
    before[i] = x[i];
    y[i] = x[i] + h * dx[i];
  }
  for (int step = 1; step < n; step++) {
    rate(k, y, dx);
    for (int i = 0; i < STATES; i++) {
      const real_t next = before[i] + 2 * h * dx[i];
      before[i] = y[i];
      y[i] = next;
    }
  }
}

// One step of length dt; returns the estimate of its error.
static real_t leap(const motion_t *k, const point_t *from, real_t dt,
                   point_t *to) {
  real_t table[COLUMNS][STATES], error = 0;
  for (int row = 0; row < COLUMNS; row++) {
    real_t y[STATES];
    midpoint(k, from->x, dt, 2 * (row + 1), y);
    for (int column = 0; column < row; column++) {
      const real_t ratio = (real_t)(row + 1) / (real_t)(row - column);
      for (int i = 0; i < STATES; i++) {
        const real_t left = table[column][i];
        table[column][i] = y[i];
        y[i] += (y[i] - left) / (ratio * ratio - 1);
      }
    }
    for (int i = 0; i < STATES; i++) table[row][i] = y[i];
  }
  for (int i = 0; i < STATES; i++) {
    to->x[i] = table[COLUMNS - 1][i];
    const real_t e = absolute(to->x[i] - table[COLUMNS - 2][i]);
    if (e > error || e != e) error = e;
  }
  to->t = from->t + dt;
  return error;
}

// One step that meets the tolerance, or is of 1e-12 s; *dt is what it may take,
// and then what the next one may.
static void advance(motion_t *k, const point_t *from, real_t *dt, point_t *to) {
  for (;;) {
    const real_t error = leap(k, from, *dt, to);
    const double ratio = (double)(error / TOLERANCE);
    const double change =
        ratio == ratio ? 0.8 * pow(ratio + 1e-9, -1.0 / (2 * COLUMNS - 1))
                       : 0.2;
    const real_t taken = *dt;
    *dt *= (real_t)(change > 2 ? 2 : change < 0.2 ? 0.2 : change);
    if (*dt > (real_t)0.01) *dt = (real_t)0.01;
    if (ratio <= 1 || taken < (real_t)1e-12) {
      k->steps++;
      k->error += error;
      return;
    }
  }
}

// Events: each where its function changes its sign.
typedef real_t (*event_t)(const motion_t *, const point_t *);

static real_t beyond_fold(const motion_t *k, const point_t *p) {
  return p->x[0] - k->fold;
}

static real_t rolling(const motion_t *k, const point_t *p) {
  return slip_at(k, p->x).g;
}

static real_t inside(const motion_t *k, const point_t *p) {
  const slip_t s = slip_at(k, p->x);
  return k->exit * layer_width(k, s.g) - absolute(s.h);
}

static bool crosses(const motion_t *k, event_t event, const point_t *from,
                    const point_t *to) {
  return (event(k, from) > 0) != (event(k, to) > 0);
}

// Where the event lies between two points of one step: by regula falsi, every
// third time by bisection.
static point_t locate(const motion_t *k, event_t event, const point_t *from,
                      const point_t *to) {
  real_t low = 0, high = to->t - from->t;
  real_t at_low = event(k, from), at_high = event(k, to);
  point_t p = *to;
  for (int n = 0; n < 60 && high - low > 4 * UNIT; n++) {
    const real_t dt = n % 3 == 2
                          ? (low + high) / 2
                          : low + (high - low) * at_low / (at_low - at_high);
    leap(k, from, dt, &p);
    const real_t e = event(k, &p);
    if ((e > 0) == (at_low > 0)) {
      low = dt;
      at_low = e;
    } else {
      high = dt;
      at_high = e;
    }
  }
  return p;
}

typedef struct {
  double fold_t, exit_t, exit_r; // NaN where it did not happen
  double zero_t, zero_r;         // g = 0 behind the two-fold
  double before, behind;         // integrals of the layer's rate: to the
                                 // two-fold, and from it to the exit
  int side, windings;            // of the exit; changes of the sign of h after
  point_t end;
} outcome_t;

// What happened between two points, after the two-fold.
static void note(const motion_t *k, const point_t *p, const point_t *next,
                 outcome_t *out) {
  const bool was = slip_at(k, p->x).h > 0, is = slip_at(k, next->x).h > 0;
  if (out->side != 0) {
    out->windings += was != is;
  } else if (inside(k, next) < 0) {
    const point_t at = inside(k, p) > 0 ? locate(k, inside, p, next) : *next;
    out->exit_t = (double)at.t;
    out->exit_r = (double)at.x[0];
    out->side = slip_at(k, at.x).h > 0 ? 1 : -1;
  }
}

// Laws of the slip angle alone have no limit there: what follows is rounding.
static bool at_rest(const motion_t *k, const point_t *p) {
  const slip_t s = slip_at(k, p->x);
  return form >= FORM_ANGLE && absolute(s.h) + absolute(s.g) < (real_t)1e-8;
}

static outcome_t follow(motion_t *k, double kick, point_t p) {
  outcome_t out = {NAN, NAN, NAN, NAN, NAN, 0, 0, 0, 0, p};
  real_t dt = (real_t)1e-6;
  const double end = (double)k->until - 1e-14;
  while ((double)p.t < end && isnan(out.zero_t)) {
    point_t next;
    if (dt > k->until - p.t) dt = k->until - p.t;
    advance(k, &p, &dt, &next);
    const double grown =
        (double)((next.t - p.t) * (layer_rate(k, p.x) + layer_rate(k, next.x)) /
                 2);
    if (isnan(out.fold_t)) {
      out.before += grown;
      if (crosses(k, beyond_fold, &p, &next)) {
        next = locate(k, beyond_fold, &p, &next);
        out.fold_t = (double)next.t;
        next.x[1] -= (real_t)kick / k->sine;
      }
    } else {
      if (out.side == 0) out.behind += grown;
      note(k, &p, &next, &out);
      if (crosses(k, rolling, &p, &next) || at_rest(k, &next)) {
        if (!at_rest(k, &next)) next = locate(k, rolling, &p, &next);
        out.zero_t = (double)next.t;
        out.zero_r = (double)next.x[0];
      }
    }
    p = next;
  }
  out.end = p;
  return out;
}

static motion_t motion_of_options(void) {
  motion_t k = {OPTIONS(IN_REAL)};
  k.beta2 = k.beta * k.beta;
  k.sine = OF(sin)(k.gamma);
  k.cosine = OF(cos)(k.gamma);
  k.right = OF(atan2)(1, 0);
  k.a = OF(atan)(6 * k.kappa) / k.right;
  return k;
}

static void sample(motion_t k, double delta, double kick) {
  const real_t w = k.w * (1 + (real_t)delta), z = w - k.omega0;
  const real_t g = slip_at(&k, (real_t[]){k.r, 0, w}).g;
  const real_t h = k.x * layer_width(&k, g);
  const real_t v = k.d * z - (h + k.r * z * k.cosine) / k.sine;
  const outcome_t out = follow(&k, kick, (point_t){0, {k.r, v, w}});
  printf(
      "%s,%d,%.6g,%.6g,%.6g,%d,%.12g,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,"
      "%d,%ld,%.3g,%.12g,%.17g,%.17g,%.17g\n",
      form_names[form], FINER_BITS, given.width, delta, kick, out.side,
      out.fold_t, out.exit_t, out.exit_r, out.zero_t, out.zero_r, out.before,
      out.behind, out.windings, k.steps, (double)k.error, (double)out.end.t,
      (double)out.end.x[0], (double)out.end.x[1], (double)out.end.x[2]);
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
      "form,bits,width,delta,kick,side,fold_t,exit_t,exit_r,zero_t,zero_r,"
      "before,behind,windings,steps,error,t,r,v,w");
  for (int n = 0; n < given.samples; n++) {
    const double of_start = given.samples > 1 ? draw(&seed) : 1;
    const double of_kick = given.samples > 1 ? draw(&seed) : 1;
    sample(k, given.delta * of_start, given.kick * of_kick);
  }
  return 0;
}
