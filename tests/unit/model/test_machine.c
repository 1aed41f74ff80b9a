/* Kinematics, energy, names and the border of a step. The equations of motion
 * are judged by what one short step does: its difference quotient, taken at
 * two step sizes and extrapolated to none, is the right-hand side of the paper
 * (or of the mass matrix, with external inputs, which the paper lacks). */
#include <limits.h>

#include "paper.h"
#include "tap.h"
#include "twofold.h"

typedef long double real;

#define EPSILON ((real)TF_REAL_EPSILON)

static real wide(tf_real_t x) { return (real)x; }

static tf_real_t uniform(double low, double high) {
  return (tf_real_t)tap_uniform(low, high);
}

static tf_machine_t prepared(const tf_params_t *params) {
  tf_machine_t machine;
  memset(&machine, 0, sizeof machine);
  CHECK(tf_prepare(&machine, params, NULL) == TF_OK);
  return machine;
}

static paper_t paper_of(const tf_params_t *p) {
  return (paper_t){.m = wide(p->m),
                   .d = wide(p->d),
                   .beta = wide(p->beta),
                   .k2 = wide(p->k2),
                   .c1 = wide(p->c1),
                   .c2 = wide(p->c2),
                   .r0 = wide(p->r0),
                   .omega0 = wide(p->omega0),
                   .mu = wide(p->mu),
                   .kappa = wide(p->kappa),
                   .gamma = wide(p->gamma)};
}

static tf_params_t random_params(void) {
  tf_params_t p = tf_scenes[0]->params;
  p.d = uniform(-2, 2);
  p.omega0 = uniform(-2, 2);
  p.gamma = uniform(-3.14, 3.14);
  return p;
}

TEST(kinematics_against_the_paper) {
  for (int i = 0; i < 100000; i++) {
    const tf_params_t p = random_params();
    const tf_machine_t machine = prepared(&p);
    paper_t paper = paper_of(&p);
    const tf_real_t omega0 = i & 1 ? p.omega0 : uniform(-3, 3);
    const tf_real_t r = uniform(-2, 2), v = uniform(-2, 2), w = uniform(-2, 2);
    const real x[3] = {wide(r), wide(v), wide(w)};
    paper.omega0 = wide(omega0);
    const real z = fabsl(x[2] - paper.omega0);
    const real size = fabsl(x[1]) + (fabsl(paper.d) + fabsl(x[0])) * z;
    const tf_slip_t slip = tf_slip(&machine, r, v, w, omega0);
    CHECK_NEAR(wide(slip.h), paper_h(&paper, x), 4 * EPSILON * size);
    CHECK_NEAR(wide(slip.g), paper_g(&paper, x), 4 * EPSILON * size);
  }
}

TEST(placed_slip_speed_reads_back) {
  for (int i = 0; i < 100000; i++) {
    const tf_params_t p = random_params();
    const tf_machine_t machine = prepared(&p);
    const real s = fabsl(sinl(wide(p.gamma)));
    const tf_real_t r = uniform(-2, 2), w = uniform(-2, 2);
    const tf_real_t omega0 = uniform(-2, 2);
    const tf_real_t h = i & 1 ? uniform(-1, 1) : (tf_real_t)1e-10;
    tf_real_t v = 77;
    CHECK(tf_speed_for_slip(&machine, r, w, omega0, h, &v) ==
          (s < 1e-6L ? TF_BAD_STATE : TF_OK));
    if (s < 1e-6L) continue;
    const real z = fabsl(wide(w) - wide(omega0));
    const real size = fabsl(wide(v)) + fabsl(wide(h)) +
                      (fabsl(wide(p.d)) + fabsl(wide(r))) * z;
    CHECK_NEAR(wide(tf_slip(&machine, r, v, w, omega0).h), wide(h),
               8 * EPSILON * size);
  }
}

TEST(no_slip_speed_where_v_has_no_hold) {
  const tf_real_t gamma[] = {0, TF_R(0.9e-6), TF_R(-0.9e-6),
                             TF_R(3.1415926535897932)};
  for (int i = 0; i < 4; i++) {
    tf_params_t p = tf_scenes[0]->params;
    tf_real_t v = 77;
    p.gamma = gamma[i];
    tf_machine_t machine = prepared(&p);
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_BAD_STATE);
    CHECK(v == 77);
    p.gamma = TF_R(1.1e-6);
    machine = prepared(&p);
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_OK);
    CHECK(v != 77);
    machine.sin_gamma = i % 2 ? TF_R(-1e-6) : TF_R(1e-6); /* the border */
    CHECK(tf_speed_for_slip(&machine, 1, 1, -1, 0, &v) == TF_OK);
  }
}

/* Slider: both components of its velocity; disc; spring. */
TEST(energy_against_its_definition) {
  for (int i = 0; i < 50000; i++) {
    tf_params_t p = random_params();
    p.m = uniform(0.1, 10);
    const tf_machine_t machine = prepared(&p);
    const tf_state_t x = {
        .r = uniform(-2, 2), .v = uniform(-2, 2), .w = uniform(-2, 2)};
    const tf_real_t r0 = uniform(-1, 1);
    const real along = wide(x.v) - wide(p.d) * wide(x.w);
    const real across = wide(x.r) * wide(x.w);
    const real turn = wide(p.beta) * wide(x.w);
    const real stretch = wide(x.r) - wide(r0), m = wide(p.m);
    const real terms = fabsl(wide(x.v)) + fabsl(wide(p.d) * wide(x.w)) +
                       fabsl(across) + fabsl(turn);
    const real size = m * terms * terms + wide(p.k2) * stretch * stretch;
    const real energy = (m * (along * along + across * across + turn * turn) +
                         wide(p.k2) * stretch * stretch) /
                        2;
    CHECK_NEAR(wide(tf_energy(&machine, &x, r0)), energy, 8 * EPSILON * size);
  }
}

TEST(inputs_at_rest_change_nothing) {
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
    a.mode = TF_MODES;
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
  end.mode = TF_MODES;
  CHECK(tf_begin(&machine, &end, input, &report) == TF_OK);
  CHECK(tf_step(&machine, &end, input, &report) == TF_OK);
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

TEST(status_names_are_distinct) {
  const char *name[8];
  for (int i = TF_STEP_TOO_LONG; i <= TF_COARSE; i++) {
    name[i - TF_STEP_TOO_LONG] = tf_status_name((tf_status_t)i);
    CHECK(name[i - TF_STEP_TOO_LONG][0]);
    CHECK(strcmp(name[i - TF_STEP_TOO_LONG], "unknown status") != 0);
    for (int j = TF_STEP_TOO_LONG; j < i; j++)
      CHECK(strcmp(name[i - TF_STEP_TOO_LONG], name[j - TF_STEP_TOO_LONG]));
  }
  const int unknown[] = {TF_COARSE + 1, TF_STEP_TOO_LONG - 1, INT_MAX, INT_MIN};
  for (int i = 0; i < 4; i++)
    CHECK(!strcmp(tf_status_name((tf_status_t)unknown[i]), "unknown status"));
}

TEST(mode_names_are_the_contract) {
  const char *const name[] = {"slip+", "slip-", "stick+", "stick-", "pinned"};
  const unsigned mode[] = {TF_SLIP_PLUS, TF_SLIP_MINUS, TF_STICK_PLUS,
                           TF_STICK_MINUS, TF_PINNED};
  for (unsigned i = 0; i < TF_MODES; i++) {
    CHECK(!strcmp(tf_mode_name(mode[i]), name[i]));
    CHECK(mode[i] == i && TF_MODE_BIT(i) == 1u << i);
  }
  CHECK(!strcmp(tf_mode_name(TF_MODES), "unknown mode"));
  CHECK(!strcmp(tf_mode_name(UINT_MAX), "unknown mode"));
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
    x.mode = TF_MODES; /* no wish to tf_begin, no mode to tf_step */
    tf_report_t report;
    CHECK(tf_step(&machine, &x, &input, &report) == TF_BAD_STATE);
    CHECK(tf_begin(&machine, &x, &input, &report) == TF_OK);
    CHECK(tf_step(&machine, &x, &input, &report) == TF_OK);
  }
}

/* The limit itself: the sum of all seven magnitudes. A heavy, damped machine
 * comes back into the range of states by itself, which is no excuse. */
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
  CHECK(tf_step(&machine, &x, &input, &report) == TF_OK);
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
    CHECK(tf_step(&machine, &x, &input, &report) == TF_OK);
  }
}

int main(int argc, char **argv) {
  tap_begin(argc, argv);
  RUN(kinematics_against_the_paper);
  RUN(placed_slip_speed_reads_back);
  RUN(no_slip_speed_where_v_has_no_hold);
  RUN(energy_against_its_definition);
  RUN(inputs_at_rest_change_nothing);
  RUN(mass_matrix_form_against_ds);
  RUN(status_names_are_distinct);
  RUN(mode_names_are_the_contract);
  RUN(bad_states_are_refused);
  RUN(inputs_beyond_the_limit_are_refused);
  RUN(a_step_too_long_is_refused);
  RUN(a_diverging_step_is_refused);
  return tap_end();
}
