/* sim.h - a machine under way by any of the three schemes. */
#ifndef TESTS_SUPPORT_SIM_H
#define TESTS_SUPPORT_SIM_H

#include "common.h"

typedef enum { MOREAU, COMPENSATED, LOCATED, SCHEMES } scheme_t;
static inline const char *scheme_name(scheme_t scheme) {
  static const char *const names[SCHEMES] = {"moreau", "compensated",
                                             "located"};
  return names[scheme];
}

typedef struct {
  tf_params_t params;
  tf_compensated_t pairs;
  tf_machine_t k; /* of pairs */
  tf_input_t u;
  tf_state_t x;
  tf_compensation_t low;
  tf_report_t report;
} sim_t;

/* Of moderate speeds: a step of 50 ms has few events. */
static inline tf_params_t moderate_params(void) {
  tf_params_t p = tf_scenes[0]->params;
  p.gamma = uniform(-3.1, 3.1);
  p.beta = uniform(0.05, 0.5);
  p.kappa = uniform(0.02, 0.6);
  p.d = uniform(-1, 1);
  p.k2 = uniform(0.5, 30);
  p.mu = uniform(0.1, 2);
  return p;
}

/* The machine of its parameters, whatever ran before. */
static inline tf_status_t sim_prepare(sim_t *s) {
  const tf_status_t status =
      tf_prepare_compensated(&s->pairs, &s->params, NULL);
  s->k = s->pairs.machine;
  return status;
}

/* r, v, w and phi by both members of each pair. */
static inline void sim_whole(const sim_t *s, real x[4]) {
  x[0] = wide(s->x.r) + wide(s->low.r);
  x[1] = wide(s->x.v) + wide(s->low.v);
  x[2] = wide(s->x.w) + wide(s->low.w);
  x[3] = wide(s->x.phi) + wide(s->low.phi);
}

/* Under the inputs of its parameters, in no mode yet. */
static inline sim_t sim_of(const tf_params_t *params) {
  sim_t s;
  memset(&s, 0, sizeof s);
  s.params = *params;
  CHECK(sim_prepare(&s) == TF_OK);
  s.u = tf_input_default(&s.k);
  s.x.mode = TF_NO_MODE;
  return s;
}

static inline tf_status_t sim_begin(sim_t *s) {
  return tf_begin(&s->k, &s->x, &s->u, &s->report);
}

/* A machine, how it starts, and what acts on it all the time. */
typedef struct {
  tf_params_t params;
  double r, v, w, alpha, force, torque;
} motion_t;

static inline sim_t sim_under(const motion_t *m, double dt) {
  tf_params_t p = m->params;
  p.dt = (tf_real_t)dt;
  sim_t s = sim_of(&p);
  s.u.alpha = (tf_real_t)m->alpha;
  s.u.force = (tf_real_t)m->force;
  s.u.torque = (tf_real_t)m->torque;
  s.x.r = (tf_real_t)m->r;
  s.x.v = (tf_real_t)m->v;
  s.x.w = (tf_real_t)m->w;
  CHECK(sim_begin(&s) == TF_OK);
  return s;
}

/* The turntable goes on by a step. */
static inline void sim_turn(sim_t *s, const motion_t *m) {
  s->u.omega0 = m->params.omega0 +
                (tf_real_t)(m->alpha * (double)(s->x.tick + 1)) * s->k.dt;
}

static inline double sim_apart(const tf_state_t *a, const tf_state_t *b) {
  return fabs((double)a->r - (double)b->r) + fabs((double)a->v - (double)b->v) +
         fabs((double)a->w - (double)b->w);
}

/* Of these parameters, at the start of a scene. */
static inline sim_t sim_at_start(const tf_scene_t *scene,
                                 const tf_params_t *params, uint32_t seed) {
  sim_t s = sim_of(params);
  CHECK(tf_scene_start(scene, &s.k, seed, &s.x, &s.report) == TF_OK);
  return s;
}

/* The machine of the parameters begins at r and w on a slip h, in this mode
 * where it is consistent. */
static inline tf_status_t sim_place(sim_t *s, double r, double w, double h,
                                    unsigned mode) {
  tf_status_t status = sim_prepare(s);
  if (status != TF_OK) return status;
  s->u = tf_input_default(&s->k);
  s->x =
      (tf_state_t){.r = (tf_real_t)r, .w = (tf_real_t)w, .mode = (uint8_t)mode};
  status = tf_speed_for_slip(&s->k, s->x.r, s->x.w, s->u.omega0, (tf_real_t)h,
                             &s->x.v);
  return status == TF_OK ? sim_begin(s) : status;
}

static inline tf_status_t sim_step(sim_t *s, scheme_t scheme) {
  if (scheme == LOCATED)
    return tf_step_located(&s->k, &s->x, &s->u, &s->report);
  if (scheme == COMPENSATED)
    return tf_step_compensated(&s->pairs, &s->x, &s->low, &s->u, &s->report);
  return tf_step(&s->k, &s->x, &s->u, &s->report);
}

#endif
