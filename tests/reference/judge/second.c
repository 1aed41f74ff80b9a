/// @file
/// A second integration; see second.h. Of the reference it uses the struct of
/// parameters only.
#include "second.h"

#include <math.h>
#include <string.h>

typedef struct {
  const ref_machine_t *q;
  int mode;   // +1, -1: slip by the sign of h; 0: stick
  int sign_g; // sign of g
} phase_t;

static real_t h_of(const ref_machine_t *q, const real_t x[3]) {
  const real_t z = x[2] - q->omega0;
  return -(x[1] - q->d * z) * sinl(q->gamma) - x[0] * z * cosl(q->gamma);
}

static real_t g_of(const ref_machine_t *q, const real_t x[3]) {
  const real_t z = x[2] - q->omega0;
  return -(x[1] - q->d * z) * cosl(q->gamma) + x[0] * z * sinl(q->gamma);
}

// Mass u' = (Q_r, Q_phi), u = (v, w).
static void field(const ref_machine_t *q, const real_t x[3], real_t F, real_t M,
                  real_t out[3]) {
  const real_t r = x[0], v = x[1], w = x[2];
  const real_t Qr =
      q->k2 * (q->r0 - r) - q->c2 * v + q->m * r * w * w + F * sinl(q->gamma);
  const real_t Qphi = -q->c1 * w - 2 * q->m * r * v * w +
                      F * (r * cosl(q->gamma) - q->d * sinl(q->gamma)) + M;
  const real_t b2 = q->beta * q->beta, D = q->m * (b2 + r * r);
  out[0] = v;
  out[1] = ((b2 + r * r + q->d * q->d) * Qr + q->d * Qphi) / D;
  out[2] = (q->d * Qr + Qphi) / D;
}

static real_t h_rate(const ref_machine_t *q, const real_t x[3], real_t F,
                     real_t M) {
  real_t f[3];
  field(q, x, F, M, f);
  const real_t s = sinl(q->gamma), c = cosl(q->gamma);
  return -(x[2] - q->omega0) * c * f[0] - s * f[1] +
         (q->d * s - x[0] * c) * f[2];
}

static void slope(const phase_t *phase, const real_t x[3], real_t out[3]) {
  const ref_machine_t *q = phase->q;
  const real_t kappa = (q->law == REF_COULOMB) ? 0 : q->kappa;
  if (phase->mode == 0) {
    const real_t none = h_rate(q, x, 0, 0);
    const real_t one = h_rate(q, x, 1, phase->sign_g * kappa);
    const real_t lambda = none / (none - one);
    field(q, x, lambda, phase->sign_g * kappa * lambda, out);
    return;
  }
  // (force), (moment) with psi as printed, beyond |h/g| = 0 by the odd
  // arctangent.
  real_t F = phase->mode * q->mu, M = 0;
  if (!(q->law == REF_COULOMB)) {
    const real_t h = phase->mode * h_of(q, x), g = g_of(q, x);
    const real_t least = atanl(1 / (6 * q->kappa)), right = atan2l(1, 0);
    const real_t slope_of_psi = 1 - least / right;
    const real_t psi = least + slope_of_psi * (right - atan2l(fabsl(g), h));
    const real_t cot = cosl(psi) / sinl(psi);
    F = phase->mode * q->mu * (4.0L / 3 - cot / (18 * q->kappa));
    M = phase->mode * (g > 0 ? 1 : -1) * q->mu / 6 * cot;
  }
  field(q, x, F, M, out);
}

// One step; returns the difference of the two orders over the tolerance.
static real_t pair(const phase_t *phase, const real_t x[3], real_t H,
                   real_t tolerance, real_t out[3]) {
  static const real_t a[7][6] = {
      {0},
      {1 / 5.0L},
      {3 / 40.0L, 9 / 40.0L},
      {44 / 45.0L, -56 / 15.0L, 32 / 9.0L},
      {19372 / 6561.0L, -25360 / 2187.0L, 64448 / 6561.0L, -212 / 729.0L},
      {9017 / 3168.0L, -355 / 33.0L, 46732 / 5247.0L, 49 / 176.0L,
       -5103 / 18656.0L},
      {35 / 384.0L, 0, 500 / 1113.0L, 125 / 192.0L, -2187 / 6784.0L,
       11 / 84.0L}};
  static const real_t e[7] = {
      71 / 57600.0L,      0,           -71 / 16695.0L, 71 / 1920.0L,
      -17253 / 339200.0L, 22 / 525.0L, -1 / 40.0L};
  real_t k[7][3], worst = 0;
  for (int i = 0; i < 7; ++i) {
    memcpy(out, x, 3 * sizeof *x);
    for (int j = 0; j < i; ++j) {
      for (int n = 0; n < 3; ++n) {
        out[n] += H * a[i][j] * k[j][n];
      }
    }
    slope(phase, out, k[i]);
  }
  for (int n = 0; n < 3; ++n) {
    real_t sum = 0;
    for (int i = 0; i < 7; ++i) {
      sum += H * e[i] * k[i][n];
    }
    worst = fmaxl(worst, fabsl(sum) / (tolerance * (1e-3L + fabsl(x[n]))));
  }
  return worst;
}

// Smallest of what has to stay positive in the phase.
static real_t margin(const phase_t *phase, const real_t x[3]) {
  const ref_machine_t *q = phase->q;
  const real_t g = phase->sign_g * g_of(q, x);
  if (phase->mode != 0) {
    return fminl(g, phase->mode * h_of(q, x));
  }
  const real_t M = (q->law == REF_COULOMB) ? 0 : phase->sign_g * q->kappa * q->mu;
  const real_t up = h_rate(q, x, q->mu, M), down = h_rate(q, x, -q->mu, -M);
  return fminl(g, up < down ? fminl(-up, down) : fminl(up, -down));
}

// The phase after an event at x; false where h = g = 0 or A = 0 is near.
static bool next(phase_t *phase, const real_t x[3]) {
  const ref_machine_t *q = phase->q;
  const real_t h = h_of(q, x), g = g_of(q, x);
  if (fabsl(h) + fabsl(g) < 1e-7L) {
    return false;
  }
  if (phase->mode != 0 && fabsl(g) < fabsl(h)) {
    phase->sign_g = -phase->sign_g;
    return true;
  }
  const real_t M = (q->law == REF_COULOMB) ? 0 : phase->sign_g * q->kappa * q->mu;
  const real_t up = h_rate(q, x, q->mu, M), down = h_rate(q, x, -q->mu, -M);
  if (phase->mode == 0) {
    phase->mode = fabsl(up) < fabsl(down) ? 1 : -1;
    return up < down;
  }
  phase->mode = up > 0 ? 1 : down < 0 ? -1 : 0;
  return true;
}

static real_t first_zero(const phase_t *phase, const real_t x[3], real_t H,
                         real_t out[3]) {
  real_t low = 0, high = H;
  for (int i = 0; i < 70; ++i) {
    const real_t mid = (low + high) / 2;
    pair(phase, x, mid, 1, out);
    if (margin(phase, out) >= 0) {
      low = mid;
    } else {
      high = mid;
    }
  }
  pair(phase, x, high, 1, out);
  return high;
}

real_t ref_second(const ref_machine_t *machine, real_t x[3], real_t end,
                  real_t tolerance, int *events) {
  phase_t phase = {machine, h_of(machine, x) > 0 ? 1 : -1,
                   g_of(machine, x) > 0 ? 1 : -1};
  real_t t = 0, H = 1e-7L, out[3];
  for (*events = 0; t < end && H > 1e-16L;) {
    H = fminl(H, end - t);
    const real_t e = pair(&phase, x, H, tolerance, out);
    if (e > 1 || !(e >= 0)) {
      H *= e < 1e6L ? 0.9L * powl(e, -0.2L) : 0.1L;
      continue;
    }
    real_t taken = H;
    const bool event = margin(&phase, out) < 0 && margin(&phase, x) >= 0;
    if (event) {
      taken = first_zero(&phase, x, H, out);
    }
    memcpy(x, out, 3 * sizeof *x);
    t += taken;
    H = fminl(1e-3L, H * fminl(2, 0.9L * powl(fmaxl(e, 1e-9L), -0.2L)));
    if (event && (++*events, !next(&phase, x))) {
      break;
    }
  }
  return t;
}
