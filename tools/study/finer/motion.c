#include "motion.h"

#include <math.h>

motion_t motion_of(const machine_t *machine, double tolerance) {
  const machine_t *p = machine;
  const real_t t = tangent((real_t)p->gamma / 4); // |gamma| <= pi
  const real_t half = 2 * t / (1 - t * t);        // tan(gamma/2)
  const real_t square = half * half;
  return (motion_t){
      .law = law_of(p),
      .m = (real_t)p->m,
      .d = (real_t)p->d,
      .beta2 = (real_t)p->beta * (real_t)p->beta,
      .k2 = (real_t)p->k2,
      .c1 = (real_t)p->c1,
      .c2 = (real_t)p->c2,
      .r0 = (real_t)p->r0,
      .omega0 = (real_t)p->omega0,
      .sine = 2 * half / (1 + square),
      .cosine = (1 - square) / (1 + square),
      .tolerance = tolerance > 0 ? (real_t)tolerance : TOLERANCE,
  };
}

// (h), (g)
slip_t slip_at(const motion_t *k, const real_t x[STATES]) {
  const real_t z = x[2] - k->omega0, p = x[1] - k->d * z, q = x[0] * z;
  return (slip_t){-p * k->sine - q * k->cosine, -p * k->cosine + q * k->sine};
}

real_t speed_for(const motion_t *k, real_t r, real_t w, real_t h) {
  const real_t z = w - k->omega0;
  return k->d * z - (h + r * z * k->cosine) / k->sine;
}

// In physical time: (v', w') = Mass^-1 (Q_r, Q_phi), the paper's (ds2), (ds3)
// divided by m (beta^2 + r^2).
static void rate(const motion_t *k, const real_t x[STATES], real_t dx[STATES]) {
  const real_t r = x[0], v = x[1], w = x[2];
  const slip_t slip = slip_at(k, x);
  const force_t f = force_at(&k->law, slip.h, slip.g);
  const real_t Q_r =
      k->k2 * (k->r0 - r) - k->c2 * v + k->m * r * w * w + f.F * k->sine;
  const real_t Q_phi = -k->c1 * w - 2 * k->m * r * v * w +
                       f.F * (r * k->cosine - k->d * k->sine) + f.M;
  const real_t gyration2 = k->beta2 + r * r, D = k->m * gyration2;
  dx[0] = v;
  dx[1] = ((gyration2 + k->d * k->d) * Q_r + k->d * Q_phi) / D;
  dx[2] = (k->d * Q_r + Q_phi) / D;
}

real_t layer_width(const motion_t *k, real_t g) {
  return k->law.form >= FORM_ANGLE ? k->law.width * absolute(g) : k->law.width;
}

// r and w do not change across it. The force acts on h' by (r^2 + beta^2
// sin^2)/D, the moment by r cos/D.
real_t layer_rate(const motion_t *k, const real_t x[STATES]) {
  const slip_t s = slip_at(k, x);
  const real_t r = x[0], D = k->m * (k->beta2 + r * r);
  const real_t by = layer_width(k, s.g) / 1000;
  const force_t low = force_at(&k->law, s.h - by, s.g);
  const force_t high = force_at(&k->law, s.h + by, s.g);
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

real_t leap(const motion_t *k, const point_t *from, real_t dt, int columns,
            point_t *to) {
  real_t table[COLUMNS][STATES], error = 0;
  for (int row = 0; row < columns; row++) {
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
    to->x[i] = table[columns - 1][i];
    const real_t e = absolute(to->x[i] - table[columns - 2][i]);
    if (e > error || e != e) error = e;
  }
  to->t = from->t + dt;
  return error;
}

void advance(motion_t *k, const point_t *from, real_t *dt, point_t *to) {
  for (;;) {
    const real_t error = leap(k, from, *dt, COLUMNS, to);
    const double ratio = (double)(error / k->tolerance);
    const double change =
        ratio == ratio ? 0.8 * pow(ratio + 1e-9, -1.0 / (2 * COLUMNS - 1))
                       : 0.2;
    const real_t taken = *dt;
    *dt *= (real_t)(change > 2 ? 2 : change < 0.2 ? 0.2 : change);
    if (*dt > REAL(0.01)) *dt = REAL(0.01);
    if (ratio <= 1 || taken < REAL(1e-12)) {
      k->steps++;
      k->error += error;
      return;
    }
  }
}
