/* common.h - what most tests of machines need: long double to judge in, random
 * numbers of the real type, a machine made ready, the paper's view of it. */
#ifndef TESTS_SUPPORT_COMMON_H
#define TESTS_SUPPORT_COMMON_H

#include "paper.h"
#include "reference.h"
#include "tap.h"
#include "twofold.h"

#define EPSILON ((real)TF_REAL_EPSILON)
#define IS_DOUBLE (sizeof(tf_real_t) == 8)
#ifdef TF_REAL_FLOAT
#define NEXT(x, to) nextafterf((x), (to))
#else
#define NEXT(x, to) nextafter((x), (to))
#endif

/* TF_OK; in float also TF_STALLED, because there a slow motion stands still at
 * the steps of these tests. */
static inline int ok_to_resolution(tf_status_t status) {
  return status == TF_OK || (!IS_DOUBLE && status == TF_STALLED);
}

static inline real wide(tf_real_t x) { return (real)x; }

static inline tf_real_t uniform(double low, double high) {
  return (tf_real_t)tap_uniform(low, high);
}

/* Each decade is as likely as any other. */
static inline tf_real_t log_uniform(double low, double high) {
  return (tf_real_t)exp(tap_uniform(log(low), log(high)));
}

static inline tf_real_t *member(tf_params_t *p, int i) {
  return (tf_real_t *)(void *)((char *)p + tf_parameter_ranges[i].offset);
}

/* The machine of a row of numbers, in the order of tf_params_t: m, d, beta, k2,
 * c1, c2, r0, omega0, mu, kappa, gamma; all else is that of the paper. */
#define MACHINE 11
static inline tf_params_t params_from(const double row[MACHINE]) {
  tf_params_t p = tf_scenes[0]->params;
  for (int i = 0; i < MACHINE; i++) *member(&p, i) = (tf_real_t)row[i];
  return p;
}

/* A machine that every law accepts; no two of their constants are equal. */
static inline tf_params_t params_of_law(tf_tyre_law_t law) {
  tf_params_t p = tf_scenes[0]->params;
  p.law = law;
  p.epsilon = 1;
  p.k = 2;
  p.delta = 3;
  p.sigma = TF_R(0.25);
  p.rho = TF_R(0.5);
  p.a = TF_R(0.75);
  return p;
}

/* Of either sign. */
static inline tf_real_t of_any_sign(tf_real_t x) {
  return tap_bits() & 1u ? -x : x;
}

/* A machine from wide ranges of all that a motion depends on. */
static inline tf_params_t wide_params(void) {
  tf_params_t p = tf_scenes[0]->params;
  p.m = log_uniform(0.3, 3);
  p.beta = log_uniform(0.05, 1);
  p.d = uniform(0.2, 2);
  p.c1 = uniform(0, 1);
  p.c2 = uniform(0, 1);
  p.k2 = uniform(0, 30);
  p.r0 = uniform(-0.5, 0.5);
  p.omega0 = uniform(-2, 2);
  p.mu = log_uniform(0.1, 3);
  p.kappa = uniform(1e-3, 1);
  p.gamma = uniform(-3.14, 3.14);
  return p;
}

/* Constants of ordinary size for the laws that have some. */
static inline void draw_law_constants(tf_params_t *p) {
  p->epsilon = uniform(0.1, 0.5);
  p->k = uniform(1, 20);
  p->delta = uniform(1, 10);
  p->sigma = uniform(0, 1);
  p->rho = uniform(0.3, 1);
  p->a = uniform(0.1, 0.5);
}

static inline paper_t paper_of(const tf_params_t *p) {
  return (paper_t){PARAMETERS_OF(real, p)};
}

/* The reference of a machine under its inputs; the turntable goes on at alpha
 * for a second. A law that the reference lacks is that of the paper. */
static inline ref_machine_t reference_of(const tf_params_t *p,
                                         const tf_input_t *u) {
  static const ref_law_t laws[TF_TYRE_LAWS] = {[TF_TYRE_JUMP] = REF_JUMP,
                                               [TF_TYRE_COULOMB] = REF_COULOMB,
                                               [TF_TYRE_SMOOTH] = REF_SMOOTH,
                                               [TF_TYRE_STRING] = REF_STRING,
                                               [TF_TYRE_NONE] = REF_FREE};
  const real w = wide(u->omega0), F = wide(u->force), M = wide(u->torque);
  ref_machine_t q = {PARAMETERS_OF(real, p), .law = laws[p->law], .knots = 2};
  q.r0 = wide(u->r0);
  q.epsilon = wide(p->epsilon);
  q.k = wide(p->k);
  q.delta = wide(p->delta);
  q.sigma = wide(p->sigma);
  q.rho = wide(p->rho);
  q.a = wide(p->a);
  q.knot[0] = (ref_knot_t){0, w, F, M};
  q.knot[1] = (ref_knot_t){1, w + wide(u->alpha), F, M};
  ref_prepare(&q);
  return q;
}

/* The loads under which friction of F and M keeps r and w as they are. */
static inline void load_for(const tf_params_t *p, tf_input_t *u, tf_real_t r,
                            tf_real_t w, real F, real M) {
  u->force = u->torque = 0;
  const ref_machine_t q = reference_of(p, u);
  ref_state_t at = ref_state(&q, wide(r), 0, wide(w));
  at.piece = 1;
  const ref_rate_t off = ref_rate(&q, at, (ref_force_t){F, M});
  const real inertia = q.m * (q.beta * q.beta + at.r * at.r);
  u->force = (tf_real_t)(-q.m * off.p);
  u->torque = (tf_real_t)(q.d * q.m * off.p - inertia * off.z);
}

/* A scene by its name. */
static inline const tf_scene_t *scene_named(const char *name) {
  for (int i = 0; i < TF_SCENES; i++)
    if (!strcmp(tf_scenes[i]->name, name)) return tf_scenes[i];
  printf("# no scene is called %s\n", name);
  CHECK(0);
  return tf_scenes[0];
}

static inline tf_machine_t prepared(const tf_params_t *params) {
  tf_machine_t machine;
  memset(&machine, 0, sizeof machine);
  CHECK(tf_prepare(&machine, params, NULL) == TF_OK);
  return machine;
}

#endif
