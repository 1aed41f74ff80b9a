/* codim2_field.h - the field of slip at h = g = 0, by the reference and by the
 * core. */
#ifndef TESTS_SUPPORT_CODIM2_FIELD_H
#define TESTS_SUPPORT_CODIM2_FIELD_H

#include "friction/codim2.h"
#include "sample.h"

#define STICKS (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))

static const ref_rest_t rest_laws[TF_REST_LAWS] = {
    [TF_REST_HULL] = REF_HEXAGON,
    [TF_REST_SQUARE] = REF_SQUARE,
    [TF_REST_BOW_TIE] = REF_BOW_TIE};

/* A machine at h = g = 0, and the field there. */
typedef struct {
  tf_params_t params;
  tf_machine_t k;
  ref_machine_t q;
  ref_affine_t at;
  codim2_field_t field;
} place_t;

/* Slip of 1 m/s at an angle from the h axis of one side: the rate of that angle
 * [rad/s] and of the length of the slip [m/s^2]. */
typedef struct {
  real rotation, growth;
} slip_rate_t;

static inline slip_rate_t slip_rate_at(const place_t *c, int side, real angle) {
  const real from_g = (real)side * (PAPER_PI / 2 - angle);
  const ref_polar_t rate = ref_polar(&c->q, &c->at, from_g, side);
  return (slip_rate_t){-(real)side * rate.turn, rate.growth};
}

/* Whether the stick on a side of g leaves h = g = 0 and attracts. */
static inline bool leaves_attracting(const ref_machine_t *q,
                                     const ref_affine_t *at, int side) {
  return ref_edge_of(q, at, side).A > 0 && ref_stick_growth(q, at, side) > 0;
}

/* Some of the machines as in the other tests, most of extreme shapes, where two
 * directions of one kind are more often close to each other. */
static inline tf_params_t any_params(int n) {
  tf_params_t params = random_params();
  params.omega0 = uniform(-2, 2);
  if (n % 4 == 0) return params;
  params.kappa = uniform(0.5, 20);
  params.beta = uniform(0.001, 0.5);
  params.d = uniform(-5, 5);
  return params;
}

#endif
