/* The border of a step: what each scheme refuses and leaves untouched. That a
 * step is the equations of motion is test_scheme's. */
#include "sim.h"

static const tf_state_t good_state = {
    .r = TF_R(0.5), .v = TF_R(0.3), .w = TF_R(-0.5), .seed = 3, .tick = 7};

/* The located step knows no law that is single-valued. */
static bool takes(scheme_t scheme, tf_tyre_law_t law) {
  return scheme != LOCATED || tf_tyre_is_set_valued(law) || law == TF_TYRE_NONE;
}

/* A state or input that every entry refuses without touching it. */
static void refused(const sim_t *bad) {
  const tf_report_t before = bad->report;
  for (int scheme = 0; scheme < SCHEMES; scheme++) {
    if (!takes((scheme_t)scheme, bad->params.law)) continue;
    sim_t s = *bad;
    CHECK(sim_step(&s, (scheme_t)scheme) == TF_BAD_STATE);
    CHECK(s.report.status == TF_BAD_STATE);
    CHECK(memcmp(&s.x, &bad->x, sizeof s.x) == 0);
  }
  sim_t s = *bad;
  CHECK(sim_begin(&s) == TF_BAD_STATE);
  CHECK(memcmp(&s.x, &bad->x, sizeof s.x) == 0);
  CHECK(memcmp(&s.report, &before, sizeof before) == 0);
}

static sim_t good(const tf_params_t *params) {
  sim_t s = sim_of(params);
  memset(&s.report, 0x5A, sizeof s.report);
  memcpy(&s.x, &good_state, sizeof s.x);
  return s;
}

/* Member n of what a step reads: r, v, w, omega0, r0, force, torque. */
static void refused_with(const tf_params_t *params, int n, tf_real_t value) {
  sim_t s = good(params);
  tf_real_t *const member[] = {&s.x.r,  &s.x.v,     &s.x.w,     &s.u.omega0,
                               &s.u.r0, &s.u.force, &s.u.torque};
  *member[n] = value;
  const int before = tap.bad;
  refused(&s);
  if (tap.bad > before)
    printf("# accepted: member %d = %Lg, law %d\n", n, wide(value),
           (int)params->law);
}

TEST(bad_states_are_refused) {
  const tf_real_t bad[] = {(tf_real_t)NAN,       (tf_real_t)INFINITY,
                           -(tf_real_t)INFINITY, TF_R(1.001e9),
                           TF_R(-1e30),          TF_REAL_MAX};
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_params_t *params = &tf_scenes[i]->params;
    for (int n = 0; n < 7; n++)
      for (int b = 0; b < 6; b++) refused_with(params, n, bad[b]);
    const unsigned mode[] = {TF_MODES + 1, 127, 255};
    sim_t s = good(params);
    for (int n = 0; n < 3; n++) {
      s.x.mode = (uint8_t)mode[n];
      refused(&s);
    }
    /* To tf_begin any mode will do, a step refuses it. */
    for (int scheme = 0; scheme < SCHEMES; scheme++) {
      if (!takes((scheme_t)scheme, params->law)) continue;
      s = good(params);
      s.x.mode = TF_NO_MODE;
      CHECK(sim_step(&s, (scheme_t)scheme) == TF_BAD_STATE);
      CHECK(sim_begin(&s) == TF_OK);
      CHECK(sim_step(&s, (scheme_t)scheme) == TF_OK);
    }
  }
}

/* The limit itself: the sum of all seven magnitudes. A heavy, damped machine
 * comes back into the range of states by itself, which is not a excuse. */
TEST(inputs_beyond_the_limit_are_refused) {
  tf_params_t params = tf_scenes[0]->params;
  params.m = params.c1 = params.c2 = TF_R(1e12);
  params.k2 = 0;
  params.dt = 1;
  for (int n = 0; n < 7; n++) refused_with(&params, n, 2 * TF_STATE_LIMIT);
}

/* r passes 0 within the step, and the slider has no arm (d) to hold on. */
TEST(a_step_too_long_is_refused) {
  tf_params_t params = tf_scenes[0]->params;
  params.d = TF_R(0.1);
  params.dt = 1;
  const tf_machine_t machine = prepared(&params);
  const tf_input_t input = tf_input_default(&machine);
  tf_state_t x, before;
  tf_report_t report;
  memcpy(&before, &good_state, sizeof before);
  before.r = 1;
  before.v = -1;
  memcpy(&x, &before, sizeof x);
  CHECK(tf_step(&machine, &x, &input, &report) == TF_STEP_TOO_LONG);
  CHECK(report.status == TF_STEP_TOO_LONG);
  CHECK(memcmp(&x, &before, sizeof x) == 0);
  /* a fast disc makes det S positive again, but not the effective mass */
  x.w = before.w = -2;
  CHECK(tf_step(&machine, &x, &input, &report) == TF_STEP_TOO_LONG);
  CHECK(memcmp(&x, &before, sizeof x) == 0);
  x.v = 1;
  CHECK(tf_step(&machine, &x, &input, &report) == TF_COARSE);
}

/* r moves in one step just so far that the disc has no inertia left, to the
 * last bit; Coriolis' force alone would make a number of it. */
TEST(no_inertia_left_is_refused) {
  tf_params_t p = tf_scenes[0]->params;
  p.m = 1;
  p.d = p.k2 = p.c1 = p.c2 = 0;
  p.beta = p.dt = (tf_real_t)(0.5);
  p.theta = 1;
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    p.law = (tf_tyre_law_t)law;
    p.epsilon = p.k = p.delta = p.a = p.rho = 1;
    tf_compensated_t k;
    CHECK(tf_prepare_compensated(&k, &p, NULL) == TF_OK);
    for (int less = 0; less < 2; less++) {
      const tf_input_t u = tf_input_default(&k.machine);
      tf_state_t x = {.r = 1, .v = (tf_real_t)(less ? -0.75 : -1), .w = 1};
      tf_state_t twin = x;
      tf_compensation_t compensation = {0, 0, 0, 0};
      tf_report_t report;
      const tf_status_t status = tf_step(&k.machine, &x, &u, &report);
      CHECK((status == TF_STEP_TOO_LONG) == !less);
      CHECK(tf_step_compensated(&k, &twin, &compensation, &u, &report) ==
            status);
    }
  }
}

TEST(a_diverging_step_is_refused) {
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    tf_params_t params = params_of_law((tf_tyre_law_t)law);
    params.m = TF_R(1e-3);
    params.k2 = 0;
    params.dt = TF_R(0.1);
    const tf_machine_t machine = prepared(&params);
    tf_input_t input = tf_input_default(&machine);
    tf_state_t x, before;
    tf_report_t report;
    memcpy(&before, &good_state, sizeof before);
    memcpy(&x, &before, sizeof x);
    input.force = TF_R(0.9e9);
    CHECK(tf_step(&machine, &x, &input, &report) == TF_DIVERGED);
    CHECK(report.status == TF_DIVERGED);
    CHECK(memcmp(&x, &before, sizeof x) == 0);
    input.force = 1;
    CHECK(tf_step(&machine, &x, &input, &report) == TF_COARSE);
  }
}
