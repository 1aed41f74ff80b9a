/* The border of a Moreau step: what it refuses and leaves untouched, and that
 * one short step is the equations of motion. Its difference quotient, taken at
 * two step sizes and extrapolated to none, is the right-hand side of the paper
 * (or of the mass matrix, with external inputs, which the paper has not). */
#include "common.h"

TEST(default_inputs_are_those_of_the_parameters) {
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    const tf_machine_t machine = prepared(&scene->params);
    const tf_input_t rest = tf_input_default(&machine);
    const tf_input_t same = {.omega0 = scene->params.omega0,
                             .r0 = scene->params.r0,
                             .force = 0,
                             .torque = 0};
    CHECK(memcmp(&rest, &same, sizeof rest) == 0);
    tf_state_t a, b;
    memset(&a, 0, sizeof a);
    a.r = scene->r;
    a.v = TF_R(0.1);
    a.w = scene->omega;
    a.mode = TF_NO_MODE;
    memcpy(&b, &a, sizeof b);
    tf_report_t report;
    CHECK(tf_begin(&machine, &a, &rest, &report) == TF_OK);
    CHECK(tf_begin(&machine, &b, &same, &report) == TF_OK);
    for (int n = 0; n < 100; n++) {
      const tf_input_t again = tf_input_default(&machine);
      CHECK(tf_step(&machine, &a, &again, &report) == TF_OK);
      CHECK(tf_step(&machine, &b, &same, &report) == TF_OK);
      CHECK(memcmp(&a, &b, sizeof a) == 0);
    }
    CHECK(a.tick == 100);
  }
}

/* Rate of change of (r, v, w) over one step of dt from x. */
static void quotient(tf_params_t params, tf_real_t dt, tf_state_t x,
                     const tf_input_t *input, real rate[3]) {
  params.dt = dt;
  const tf_machine_t machine = prepared(&params);
  tf_state_t end = x;
  tf_report_t report;
  end.mode = TF_NO_MODE;
  CHECK(tf_begin(&machine, &end, input, &report) == TF_OK);
  CHECK(tf_step(&machine, &end, input, &report) >= TF_OK);
  rate[0] = (wide(end.r) - wide(x.r)) / wide(dt);
  rate[1] = (wide(end.v) - wide(x.v)) / wide(dt);
  rate[2] = (wide(end.w) - wide(x.w)) / wide(dt);
}

/* (ds1)-(ds3) in physical time; external force and torque by the inverse of
 * the mass matrix, [[beta^2 + r^2 + d^2, d], [d, 1]] / (m (beta^2 + r^2)). */
static void rates_of_the_paper(const tf_params_t *params, const tf_state_t *x,
                               const tf_input_t *u, real rate[3]) {
  paper_t p = paper_of(params);
  const real at[3] = {wide(x->r), wide(x->v), wide(x->w)};
  const real r2 = p.beta * p.beta + at[0] * at[0];
  const real Q_r = wide(u->force), Q_phi = wide(u->torque);
  real F = 0, M = 0;
  p.omega0 = wide(u->omega0);
  p.r0 = wide(u->r0);
  if (params->law == TF_TYRE_JUMP)
    paper_friction(&p, paper_h(&p, at), paper_g(&p, at), &F, &M);
  paper_rhs_time(&p, at, F, M, rate);
  rate[1] += ((r2 + p.d * p.d) * Q_r + p.d * Q_phi) / (p.m * r2);
  rate[2] += (p.d * Q_r + Q_phi) / (p.m * r2);
}

/* The quotient is the rate + c dt + O(dt^2): dt and dt/2 remove c. And it is
 * the rate in the middle of the step to the same order, as theta is 1/2. */
static void judge_rates(const tf_params_t *params, const tf_state_t *x,
                        const tf_input_t *input) {
  const tf_real_t dt = sizeof dt == 4 ? TF_R(0x1p-8) : TF_R(0x1p-15);
  real whole[3], half[3], want[3], middle[3];
  quotient(*params, dt, *x, input, whole);
  quotient(*params, dt / 2, *x, input, half);
  rates_of_the_paper(params, x, input, want);
  const tf_state_t mid = {.r = x->r + dt / 4 * (tf_real_t)want[0],
                          .v = x->v + dt / 4 * (tf_real_t)want[1],
                          .w = x->w + dt / 4 * (tf_real_t)want[2]};
  rates_of_the_paper(params, &mid, input, middle);
  const real size = 1 + fabsl(want[0]) + fabsl(want[1]) + fabsl(want[2]);
  const real h = wide(dt), rounding = 64 * EPSILON / h * size;
  for (int i = 0; i < 3; i++) {
    CHECK_NEAR(half[i], middle[i], 100 * h * h * size + rounding);
    CHECK_NEAR(2 * half[i] - whole[i], want[i], 4000 * h * h * size + rounding);
  }
}

static tf_state_t state_in_slip(const tf_params_t *params, tf_real_t omega0) {
  const tf_machine_t machine = prepared(params);
  for (;;) {
    const tf_state_t x = {
        .r = uniform(0.3, 1.5), .v = uniform(-1, 1), .w = uniform(-2, 2)};
    const tf_slip_t slip = tf_slip(&machine, x.r, x.v, x.w, omega0);
    if (slip.h > TF_R(0.3) || slip.h < TF_R(-0.3)) return x;
  }
}

TEST(mass_matrix_form_against_ds) {
  for (int i = 0; i < 5000; i++) {
    tf_params_t params = tf_scenes[0]->params;
    params.theta = TF_R(0.5);
    if (i % 4 == 3) params.law = TF_TYRE_NONE;
    const tf_machine_t machine = prepared(&params);
    tf_input_t input = tf_input_default(&machine);
    if (i & 1)
      input = (tf_input_t){.omega0 = uniform(-2, 2),
                           .r0 = uniform(-1, 1),
                           .force = uniform(-2, 2),
                           .torque = uniform(-2, 2)};
    const tf_state_t x = state_in_slip(&params, input.omega0);
    judge_rates(&params, &x, &input);
  }
}

static const tf_state_t good_state = {
    .r = TF_R(0.5), .v = TF_R(0.3), .w = TF_R(-0.5), .seed = 3, .tick = 7};

/* A state or input that both entries refuse without touching it. */
static void refused(const tf_machine_t *machine, const tf_state_t *bad,
                    const tf_input_t *input) {
  tf_state_t x;
  tf_report_t report, before;
  memcpy(&x, bad, sizeof x);
  memset(&report, 0x5A, sizeof report);
  memset(&before, 0x5A, sizeof before);
  CHECK(tf_step(machine, &x, input, &report) == TF_BAD_STATE);
  CHECK(report.status == TF_BAD_STATE);
  CHECK(memcmp(&x, bad, sizeof x) == 0);
  memcpy(&x, bad, sizeof x);
  memset(&report, 0x5A, sizeof report);
  CHECK(tf_begin(machine, &x, input, &report) == TF_BAD_STATE);
  CHECK(memcmp(&x, bad, sizeof x) == 0);
  CHECK(memcmp(&report, &before, sizeof report) == 0);
}

/* Member n of what a step reads: r, v, w, omega0, r0, force, torque. */
static void refused_with(const tf_machine_t *machine, int n, tf_real_t value) {
  tf_state_t x;
  tf_input_t u = tf_input_default(machine);
  memcpy(&x, &good_state, sizeof x);
  tf_real_t *const member[] = {&x.r,  &x.v,     &x.w,     &u.omega0,
                               &u.r0, &u.force, &u.torque};
  *member[n] = value;
  const int before = tap.bad;
  refused(machine, &x, &u);
  if (tap.bad > before)
    printf("# accepted: member %d = %Lg, law %d\n", n, wide(value),
           (int)machine->tyre.law);
}

TEST(bad_states_are_refused) {
  const tf_real_t bad[] = {(tf_real_t)NAN,       (tf_real_t)INFINITY,
                           -(tf_real_t)INFINITY, TF_R(1e30),
                           TF_R(-1e30),          TF_REAL_MAX};
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_machine_t machine = prepared(&tf_scenes[i]->params);
    for (int n = 0; n < 7; n++)
      for (int b = 0; b < 6; b++) refused_with(&machine, n, bad[b]);
    const tf_input_t input = tf_input_default(&machine);
    const unsigned mode[] = {TF_MODES + 1, 127, 255};
    tf_state_t x;
    memcpy(&x, &good_state, sizeof x);
    for (int n = 0; n < 3; n++) {
      x.mode = (uint8_t)mode[n];
      refused(&machine, &x, &input);
    }
    x.mode = TF_NO_MODE; /* to tf_begin any mode will do, tf_step refuses it */
    tf_report_t report;
    CHECK(tf_step(&machine, &x, &input, &report) == TF_BAD_STATE);
    CHECK(tf_begin(&machine, &x, &input, &report) == TF_OK);
    CHECK(tf_step(&machine, &x, &input, &report) == TF_OK);
  }
}

/* The limit itself: the sum of all seven magnitudes. A heavy, damped machine
 * comes back into the range of states by itself, which is not a excuse. */
TEST(inputs_beyond_the_limit_are_refused) {
  tf_params_t params = tf_scenes[0]->params;
  params.m = params.c1 = params.c2 = TF_R(1e12);
  params.k2 = 0;
  params.dt = 1;
  const tf_machine_t machine = prepared(&params);
  for (int n = 0; n < 7; n++) refused_with(&machine, n, 2 * TF_STATE_LIMIT);
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
    tf_params_t params = tf_scenes[0]->params;
    params.law = (tf_tyre_law_t)law;
    params.epsilon = params.k = params.delta = params.a = params.rho = 1;
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
