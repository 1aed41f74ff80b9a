// See physics.h.
#include "physics.h"

void machine_derive(machine_t *p) {
  const real pi = strtoflt128(PI_TEXT, NULL);
  p->s = sinq(p->gamma);
  p->c = cosq(p->gamma);
  // a = 1 - (2/pi) arccot(6 kappa)
  p->share = 1 - 2 / pi * atan2q(1, 6 * p->kappa);
}

ramp_t ramp_at(const machine_t *p, real t) {
  ramp_t ramp = {0, p->omega0, 0, 1000000};
  if (p->knots == 0) return ramp;
  int i = 0;
  while (i + 1 < p->knots && p->knot[i + 1].t <= t) i++;
  ramp.since = p->knot[i].t;
  ramp.base = p->knot[i].omega0;
  if (i + 1 == p->knots) return ramp;
  ramp.until = p->knot[i + 1].t;
  ramp.slope = (p->knot[i + 1].omega0 - ramp.base) / (ramp.until - ramp.since);
  return ramp;
}

real ramp_omega(const ramp_t *ramp, real t) {
  return ramp->base + ramp->slope * (t - ramp->since);
}

// Appendix B: with l = (delta/k) |g/h| there is no slip where l >= 2 a + sigma
// and full slip where l <= sigma.
int zone_of(const machine_t *p, real h, real g) {
  const real H = p->k * fabsq(h), G = p->delta * fabsq(g);
  if (p->law != STRING) return 0;
  if (G >= (2 * p->a + p->sigma) * H) return 0;
  return G > p->sigma * H ? 1 : 2;
}

// Appendix B as corrected, with t = tan(phi) = |h/g|.
static force_t string_force(const machine_t *p, const piece_t *piece, real h,
                            real g) {
  const real k = p->k, a = p->a, sigma = p->sigma, delta = p->delta;
  const real rho = p->rho;
  const real H = piece->side * h, G = piece->roll * g;
  force_t f = {2 * a * rho * delta, 0};
  if (piece->zone == 0) {
    f.F = 2 * a * k * (a + sigma) * (H / G);
    f.M = 2 * a * a * a * k / 3 * (H / G);
  } else if (piece->zone == 1) {
    const real tan_phi = H / G, cot_phi = G / H;
    const real x_s = a + sigma - delta / k * cot_phi;
    f.F = rho * delta * (2 * a + sigma) +
          delta * delta / (2 * k) * (1 - 2 * rho) * cot_phi -
          k * sigma * sigma * tan_phi / 2;
    f.M = (k * k * k * sigma * sigma * (3 * a + sigma) * tan_phi +
           delta * delta * cot_phi *
               (2 * delta * cot_phi - 3 * k * (a + sigma))) /
              (6 * k * k) -
          delta * rho * (x_s * x_s - a * a) / 2;
  }
  f.F *= piece->side * p->mu;
  f.M *= piece->side * piece->roll * p->mu;
  return f;
}

// (force), (moment): cot(psi) = T(|g/h|) = tan(a atan |g/h|).
force_t force_of(const machine_t *p, const piece_t *piece, real h, real g) {
  if (p->law == NONE) return (force_t){0, 0};
  if (p->law == COULOMB) return (force_t){piece->side * p->mu, 0};
  if (p->law == STRING) return string_force(p, piece, h, g);
  const real H = piece->side * h, G = piece->roll * g;
  const real T = tanq(p->share * atan2q(G, H));
  real sign = piece->side;
  if (p->law == SMOOTH) sign = h / sqrtq(h * h + p->epsilon * p->epsilon);
  return (force_t){sign * p->mu * ((real)4 / 3 - T / (18 * p->kappa)),
                   sign * piece->roll * p->mu / 6 * T};
}

void slip_of(const machine_t *p, const motion_t *x, real *h, real *g) {
  const real q = x->r * x->z;
  *h = -x->p * p->s - q * p->c;
  *g = q * p->s - x->p * p->c;
}

motion_t motion_of(const machine_t *p, real r, real h, real g, real t) {
  return (motion_t){r, -h * p->s - g * p->c, (g * p->s - h * p->c) / r, t};
}

// m (v' - d w') = Q_r,  m (beta^2 + r^2) w' = Q_phi + d Q_r
rates_t rates_of(const machine_t *p, const ramp_t *ramp, const motion_t *x,
                 force_t f) {
  const real r = x->r, w = x->z + ramp_omega(ramp, x->t);
  const real v = x->p + p->d * x->z;
  const real J = p->m * (p->beta * p->beta + r * r);
  const real Q_r = p->k2 * (p->r0 - r) - p->c2 * v + p->m * r * w * w;
  const real Q_phi = -p->c1 * w - 2 * p->m * r * v * w;
  rates_t y;
  y.v = v;
  y.dp = (Q_r + f.F * p->s) / p->m + p->d * ramp->slope;
  y.dz = (Q_phi + p->d * Q_r + f.F * r * p->c + f.M) / J - ramp->slope;
  const real dq = v * x->z + r * y.dz;
  y.dh = -y.dp * p->s - dq * p->c;
  y.dg = dq * p->s - y.dp * p->c;
  return y;
}

stick_t stick_of(const machine_t *p, const ramp_t *ramp, const motion_t *x,
                 int roll) {
  const real r = x->r, arm = r * p->c;
  const real kappa = p->law == JUMP ? roll * p->kappa : 0;
  const real b2 = p->beta * p->beta + r * r;
  stick_t y;
  y.free = rates_of(p, ramp, x, (force_t){0, 0});
  y.J = p->m * b2;
  y.JA = p->s * p->s * b2 + arm * (arm + kappa);
  y.JN = y.J * y.free.dh;
  y.g_lambda = r * (arm + kappa) / y.J * p->s - p->s * p->c / p->m;
  return y;
}
