/* sample.h - random machines and the paper's view of them, for tests of the
 * surface h = 0 and its two-folds. */
#ifndef TESTS_SUPPORT_SAMPLE_H
#define TESTS_SUPPORT_SAMPLE_H

#include "common.h"

static inline tf_params_t random_params(void) {
  tf_params_t p = tf_scenes[0]->params;
  p.m = uniform(0.25, 4);
  p.d = uniform(-2, 2);
  p.beta = uniform(0.02, 0.2);
  p.kappa = uniform(0.05, 1);
  p.k2 = uniform(0, 5);
  p.r0 = uniform(-0.5, 0.5);
  p.omega0 = uniform(-2, 2);
  p.mu = uniform(0.5, 2);
  p.c1 = uniform(0, 0.1);
  p.c2 = uniform(0, 0.1);
  do p.gamma = uniform(-3.14, 3.14);
  while (fabs(sin((double)p.gamma)) < 0.05);
  return p;
}

/* A machine, its inputs, and the two-folds that it has. */
typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  paper_t paper;
  tf_surface_point_t at[TF_TWO_FOLDS];
  int count;
  tf_absence_t absence;
} folds_t;

static inline folds_t folds_of(const tf_params_t *params) {
  folds_t f;
  memset(&f, 0, sizeof f);
  f.machine = prepared(params);
  f.input = tf_input_default(&f.machine);
  f.paper = paper_of(params);
  f.count = -1;
  CHECK(tf_two_folds(&f.machine, &f.input, f.at, &f.count, &f.absence) ==
        TF_OK);
  return f;
}

static inline tf_two_fold_t form_at(const folds_t *f, int i) {
  tf_two_fold_t n;
  CHECK(tf_normal_form(&f->machine, &f->input, &f->at[i], &n) == TF_OK);
  return n;
}

/* A machine with a two-fold at a random place, and its normal form. */
typedef struct {
  tf_params_t params;
  tf_machine_t machine;
  tf_input_t input;
  paper_t paper;
  tf_design_t design;
  real x[3], c2; /* clock^2 */
  int s;
} sample_t;

static inline sample_t random_two_fold(void) {
  sample_t c;
  memset(&c, 0, sizeof c);
  for (;;) {
    c.params = random_params();
    c.machine = prepared(&c.params);
    c.input = tf_input_default(&c.machine);
    const tf_real_t r = uniform(-0.6, 0.6);
    const tf_real_t w = c.input.omega0 + uniform(-2, 2);
    if (tf_design_two_fold(&c.machine, &c.input, r, w, &c.design) != TF_OK)
      continue;
    if (c.design.k2 > 100 || c.design.kappa > 5) continue;
    c.params.kappa = c.design.kappa;
    c.params.k2 = c.design.k2;
    c.machine = prepared(&c.params);
    c.paper = paper_of(&c.params);
    c.x[0] = wide(c.design.two_fold.point.r);
    c.x[1] = wide(c.design.two_fold.point.v);
    c.x[2] = wide(c.design.two_fold.point.w);
    c.c2 =
        wide(c.design.two_fold.time_scale) * wide(c.design.two_fold.time_scale);
    c.s = c.design.two_fold.point.g > 0 ? 1 : -1;
    return c;
  }
}

#endif
