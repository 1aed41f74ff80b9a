/// @file
/// Equations of motion, slip, tyre law and surface; see model.h.
#include "model.h"

#include <math.h>

static const real_t half_pi = 1.57079632679489661923132169163975144L;

void ref_prepare(ref_machine_t *machine) {
  machine->sine = sinl(machine->gamma);
  machine->cosine = cosl(machine->gamma);
  machine->a = atanl(6 * machine->kappa) / half_pi;
}

ref_state_t ref_state(const ref_machine_t *machine, real_t r, real_t v,
                      real_t w) {
  const real_t z = w - machine->omega0;
  return (ref_state_t){r, v - machine->d * z, z};
}

real_t ref_v(const ref_machine_t *machine, ref_state_t x) {
  return x.p + machine->d * x.z;
}

real_t ref_w(const ref_machine_t *machine, ref_state_t x) {
  return x.z + machine->omega0;
}

ref_slip_t ref_slip(const ref_machine_t *machine, ref_state_t x) {
  const real_t s = machine->sine, c = machine->cosine;
  return (ref_slip_t){-x.p * s - x.r * x.z * c, -x.p * c + x.r * x.z * s};
}

ref_state_t ref_from_slip(const ref_machine_t *machine, real_t r,
                          ref_slip_t slip) {
  const real_t s = machine->sine, c = machine->cosine;
  return (ref_state_t){r, -slip.h * s - slip.g * c,
                       (-slip.h * c + slip.g * s) / r};
}

ref_state_t ref_on_surface(const ref_machine_t *machine, ref_state_t x) {
  const real_t in_p = machine->sine, in_z = x.r * machine->cosine;
  const real_t in_r = x.z * machine->cosine;
  const real_t square = in_p * in_p + in_z * in_z + in_r * in_r;
  if (square > 0) {
    const real_t h = ref_slip(machine, x).h / square;
    x.r += h * in_r;
    x.p += h * in_p;
    x.z += h * in_z;
  }
  return x;
}

// m p' = Q + F sin(gamma), and with J = m (beta^2 + r^2)
// J z' = d Q - c1 w - 2 m r v w + F r cos(gamma) + M,
// Q = k2 (r0 - r) - c2 v + m r w^2; then p' and (r z)' turn into h', g'.
ref_rate_t ref_rate(const ref_machine_t *machine, ref_state_t x,
                    ref_force_t force) {
  const ref_machine_t *q = machine;
  const real_t w = ref_w(q, x), v = ref_v(q, x);
  const real_t Q = q->k2 * (q->r0 - x.r) - q->c2 * v + q->m * x.r * w * w;
  const real_t J = q->m * (q->beta * q->beta + x.r * x.r);
  ref_rate_t rate;
  rate.r = v;
  rate.p = (Q + force.F * q->sine) / q->m;
  rate.z = (q->d * Q - (q->c1 + 2 * q->m * x.r * v) * w +
            force.F * x.r * q->cosine + force.M) /
           J;
  const real_t rz = v * x.z + x.r * rate.z;
  rate.h = -rate.p * q->sine - rz * q->cosine;
  rate.g = -rate.p * q->cosine + rz * q->sine;
  return rate;
}

ref_affine_t ref_affine(const ref_machine_t *machine, ref_state_t x) {
  const ref_machine_t *q = machine;
  const real_t s = q->sine, c = q->cosine;
  const real_t J = q->m * (q->beta * q->beta + x.r * x.r);
  const ref_rate_t rate = ref_rate(q, x, (ref_force_t){0, 0});
  return (ref_affine_t){
      .h = rate.h,
      .h_F = -s * s / q->m - x.r * x.r * c * c / J,
      .h_M = -x.r * c / J,
      .g = rate.g,
      .g_F = -s * c / q->m + x.r * x.r * s * c / J,
      .g_M = x.r * s / J,
  };
}

ref_force_t ref_slip_force(const ref_machine_t *machine, ref_slip_t slip,
                           int side, int sign_g) {
  const ref_machine_t *q = machine;
  if (q->coulomb) {
    return (ref_force_t){side * q->mu, 0};
  }
  const real_t angle = atan2l(sign_g * slip.g, side * slip.h);
  const real_t end = 6 * q->kappa;
  const real_t T = angle <= half_pi
                       ? tanl(q->a * angle)
                       : end + q->a * (1 + end * end) * (angle - half_pi);
  return (ref_force_t){
      side * q->mu * (4.0L / 3 - T / (18 * q->kappa)),
      side * sign_g * q->mu / 6 * T,
  };
}

ref_edge_t ref_edge(const ref_machine_t *machine, ref_state_t x, int s) {
  const ref_affine_t f = ref_affine(machine, x);
  const real_t kappa = machine->coulomb ? 0 : machine->kappa;
  ref_edge_t edge = {.N = f.h, .A = -f.h_F - s * kappa * f.h_M};
  edge.plus = edge.N - edge.A * machine->mu;
  edge.minus = edge.N + edge.A * machine->mu;
  return edge;
}

ref_force_t ref_stick_force(const ref_machine_t *machine, int s,
                            real_t lambda) {
  const real_t kappa = machine->coulomb ? 0 : machine->kappa;
  return (ref_force_t){lambda, s * kappa * lambda};
}

real_t ref_speed_scale(const ref_machine_t *machine, real_t r) {
  const ref_machine_t *q = machine;
  return fabsl(q->omega0) * (fabsl(r) + q->beta) +
         sqrtl(q->k2 / q->m) * fabsl(r - q->r0) + 1e-3L;
}
