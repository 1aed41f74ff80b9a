/* extremes.h - machines and states from the whole of what is allowed: every
 * decade of a range, its ends, exact angles, zeros, subnormal numbers. */
#ifndef TESTS_SUPPORT_EXTREMES_H
#define TESTS_SUPPORT_EXTREMES_H

#include "common.h"

static inline bool one_in(unsigned n) { return tap_bits() % n == 0; }

/* Each decade is as likely as any other. */
static inline tf_real_t spread(tf_real_t low, tf_real_t high) {
  const double a = log((double)low), b = log((double)high);
  const tf_real_t x = (tf_real_t)exp(tap_uniform(a, b));
  return x < low ? low : x > high ? high : x;
}

/* Of any size down to the subnormal ones, of either sign, 0 or the limit. */
static inline tf_real_t anything(tf_real_t limit) {
  const tf_real_t least =
      one_in(4) ? TF_REAL_MIN * TF_REAL_EPSILON : limit * TF_R(1e-18);
  const tf_real_t size = one_in(8)   ? 0
                         : one_in(8) ? limit
                                     : spread(least, limit);
  return one_in(2) ? -size : size;
}

static inline void draw_member(tf_params_t *p, int i) {
  const tf_parameter_range_t *range = &tf_parameter_ranges[i];
  tf_real_t x;
  if (range->low < 0)
    x = anything(range->high);
  else if (range->low > 0)
    x = spread(range->low, range->high);
  else
    x = (tf_real_t)fabs((double)anything(range->high));
  if (one_in(8)) x = one_in(2) ? range->low : range->high;
  *member(p, i) = x;
}

/* Multiples of pi/4 too: there a sine or cosine is 0 or nearly so. */
static inline tf_real_t draw_gamma(void) {
  const double pi = 3.14159265358979323846;
  if (one_in(2)) return (tf_real_t)tap_uniform(-pi, pi);
  const tf_real_t gamma = (tf_real_t)(((double)(tap_bits() % 8) - 3) * pi / 4);
  return gamma;
}

/* Half of the machines are a scene with three members driven to extremes,
 * half are extreme throughout. */
static inline tf_params_t draw_machine(void) {
  const tf_scene_t *scene = tf_scenes[tap_bits() % TF_SCENES];
  tf_params_t p = scene->params;
  p.law = (tf_tyre_law_t)(tap_bits() % TF_TYRE_LAWS);
  p.rule = (tf_rule_t)(tap_bits() % TF_RULES);
  p.with_angle = one_in(2);
  p.kappa = TF_R(0.27);
  p.epsilon = TF_R(1e-4);
  p.k = p.delta = p.sigma = p.a = 1;
  p.rho = TF_R(0.5);
  if (one_in(2)) {
    for (int n = 0; n < 3; n++)
      draw_member(&p, (int)(tap_bits() % TF_PARAMETERS));
  } else {
    for (int i = 0; i < TF_PARAMETERS; i++) draw_member(&p, i);
  }
  p.gamma = draw_gamma();
  p.dt = spread(TF_R(1e-9), 1);
  p.theta = one_in(3) ? 1 : one_in(2) ? TF_R(0.5) : p.theta;
  return p;
}

static inline tf_state_t draw_state(tf_real_t limit) {
  tf_state_t x;
  memset(&x, 0, sizeof x);
  x.r = anything(limit);
  x.v = anything(limit);
  x.w = anything(limit);
  x.phi = anything(10);
  x.tick = tap_bits();
  x.seed = (uint32_t)tap_bits();
  x.mode = (uint8_t)(tap_bits() % TF_MODES);
  return x;
}

#endif
