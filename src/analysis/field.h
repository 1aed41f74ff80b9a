// The right-hand side f(x, lambda) on h = 0 at one point, in physical time.
//   r' = v,  p' = rates.dp + lambda sin(gamma)/m,
//   z' = rates.dz + lambda (r cos(gamma) + s kappa)/J
//   v' = p' + d z',  w' = z' + alpha
#ifndef TF_FIELD_H
#define TF_FIELD_H

#include "../model/rates.h"
#include "twofold/singularity.h"

// (stickV): the point of h = 0 at r, z = w - omega0 and g.
TF_INLINE tf_surface_point_t surface_point(const tf_machine_t *k, tf_real_t r,
                                           tf_real_t z, tf_real_t w,
                                           tf_real_t g) {
  return (tf_surface_point_t){r, k->d * z - k->cos_gamma * g, w, g};
}

typedef struct {
  rates_t rates;
  tf_real_t r, v, w, p, z;
  tf_real_t J;            // m (beta^2 + r^2) [kg m^2]
  tf_real_t z_per_lambda; // z' of lambda = 1 N
  sign_t s;               // of g
} field_point_t;

TF_INLINE field_point_t field_point_at(const tf_machine_t *k,
                                       const tf_input_t *input, tf_real_t r,
                                       tf_real_t v, tf_real_t w, sign_t s) {
  field_point_t x = {.r = r, .v = v, .w = w, .z = w - input->omega0, .s = s};
  x.p = slider_speed(k, v, x.z);
  x.rates = rates_at(k, input, r, x.p, x.z, input->omega0);
  x.J = inertia_at(k, r);
  x.z_per_lambda = stick_arm(k, r * k->cos_gamma, s) / x.J;
  return x;
}

// (VF)
TF_INLINE tf_rate_t field_under(const tf_machine_t *k, const tf_input_t *input,
                                const field_point_t *x, tf_real_t lambda) {
  const tf_real_t z = x->rates.dz + lambda * x->z_per_lambda;
  return (tf_rate_t){x->v, x->rates.dp + lambda * x->rates.Fp + k->d * z,
                     z + input->alpha};
}

// A sum, to test several numbers at once: NaN and infinity survive into it.
TF_INLINE tf_real_t size_of_rate(const tf_rate_t *f) {
  return magnitude(f->r) + magnitude(f->v) + magnitude(f->w);
}

#endif
