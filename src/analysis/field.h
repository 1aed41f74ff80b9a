// The right-hand side f(x, lambda) on h = 0 at one point, in physical time.
//   r' = v,  p' = a.p + lambda sin(gamma)/m,  z' = a.z + lambda lever
//   v' = p' + d z',  w' = z' + alpha,  lever = (r cos(gamma) + s kappa)/J
#ifndef TF_FIELD_H
#define TF_FIELD_H

#include "../model/rates.h"
#include "twofold/surface.h"

typedef struct {
  tf_rates_t a;
  tf_real_t r, v, w, p, z;
  tf_real_t J, arm; // m (beta^2 + r^2) [kg m^2], r cos(gamma) [m]
  tf_real_t turn;   // arm + s kappa [m]
  tf_real_t lever;  // z' of lambda = 1 N
  int s;            // 0 where g > 0, 1 where g < 0
} field_point_t;

TF_INLINE field_point_t point_at(const tf_machine_t *k, const tf_input_t *input,
                                 tf_real_t r, tf_real_t v, tf_real_t w, int s) {
  field_point_t x = {.r = r, .v = v, .w = w, .z = w - input->omega0, .s = s};
  x.p = v - k->d * x.z;
  x.a = rates_at(k, input, r, x.p, x.z, input->omega0);
  x.J = inertia_at(k, r);
  x.arm = r * k->cos_gamma;
  x.turn = x.arm + signed_kappa(k, s);
  x.lever = x.turn / x.J;
  return x;
}

// (VF)
TF_INLINE tf_rate_t field(const tf_machine_t *k, const tf_input_t *input,
                          const field_point_t *x, tf_real_t lambda) {
  const tf_real_t z = x->a.z + lambda * x->lever;
  return (tf_rate_t){x->v, x->a.p + lambda * x->a.Fp + k->d * z,
                     z + input->alpha};
}

// For a look at several at once: NaN and infinity survive into a sum.
TF_INLINE tf_real_t size_of_rate(const tf_rate_t *f) {
  return magnitude(f->r) + magnitude(f->v) + magnitude(f->w);
}

#endif
