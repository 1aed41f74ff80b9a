/* The ensemble against the single step, which is its definition: every member
 * of every state and report has to have the same bits, whatever the machine,
 * the input, the size of the ensemble and what has become of its states. */
#include "same_state.h"
#include "sample.h"
#include "sim.h"

#define MOST 72 /* states: whole blocks and a rest */

/* The same states twice: one by one, and as an ensemble. */
typedef struct {
  tf_machine_t machine;
  size_t n, steps, alone;
  size_t seen[9]; /* statuses, from TF_STEP_TOO_LONG to TF_STALLED */
  tf_state_t states[MOST];
  tf_report_t reports[MOST];
  tf_state_block_t state_blocks[TF_BLOCKS(MOST + 1)];
  tf_report_block_t report_blocks[TF_BLOCKS(MOST + 1)];
} twins_t;

static twins_t twins;

/* Copies the states, with reports that hold what no step writes. */
static void twin(size_t n) {
  tf_report_t nothing;
  memset(&nothing, 0, sizeof nothing);
  memset(twins.report_blocks, 0, sizeof twins.report_blocks);
  memset(twins.state_blocks, 0, sizeof twins.state_blocks);
  memset(twins.seen, 0, sizeof twins.seen);
  twins.n = n;
  twins.steps = twins.alone = 0;
  for (size_t i = 0; i < n; i++) {
    twins.reports[i] = nothing;
    tf_ensemble_put(twins.state_blocks, i, &twins.states[i]);
  }
}

/* Notes whether a state and its report are the same alone and in its lane. */
static void compare_twin(size_t i) {
  const tf_state_t x = tf_ensemble_get(twins.state_blocks, i);
  const tf_report_t report = tf_ensemble_report(twins.report_blocks, i);
  CHECK(same_state(&x, &twins.states[i]) &&
        same_report(&report, &twins.reports[i]));
}

/* One step of both. The lane beyond the last state is not written. */
static void step_twins(const tf_input_t *u) {
  const tf_state_t beyond = tf_ensemble_get(twins.state_blocks, twins.n);
  const tf_report_t unsaid = tf_ensemble_report(twins.report_blocks, twins.n);
  twins.alone += tf_ensemble_step(&twins.machine, twins.state_blocks, twins.n,
                                  u, twins.report_blocks);
  twins.steps += twins.n;
  const tf_state_t last = tf_ensemble_get(twins.state_blocks, twins.n);
  const tf_report_t told = tf_ensemble_report(twins.report_blocks, twins.n);
  CHECK(same_state(&beyond, &last) && same_report(&unsaid, &told));
  for (size_t i = 0; i < twins.n; i++) {
    const tf_status_t status =
        tf_step(&twins.machine, &twins.states[i], u, &twins.reports[i]);
    compare_twin(i);
    twins.seen[status - TF_STEP_TOO_LONG]++;
  }
}

/* n states around the start of scene chaos, each with a seed of its own: all
 * phases of the motion, under rules that leave it apart. */
static void chaos_twins(tf_rule_t rule, size_t n, int steps) {
  sim_t s = {.params = scene_named("chaos")->params};
  s.params.rule = rule;
  s.params.dt = TF_R(4e-4); /* 6000 steps are a cycle of chaos */
  s.params.with_angle = true;
  for (size_t i = 0; i < n; i++) {
    CHECK(sim_place(&s, tap_uniform(0.175, 0.185), tap_uniform(-1.042, -1.032),
                    1e-10, TF_NO_MODE) == TF_OK);
    s.x.seed = (uint32_t)(i + 1);
    s.x.tick = i << 40;
    twins.states[i] = s.x;
  }
  twins.machine = s.k;
  twin(n);
  for (int i = 0; i < steps; i++) step_twins(&s.u);
}

TEST(ensemble_is_the_single_step) {
  chaos_twins(TF_RULE_RANDOM, 70, samples(24000));
  chaos_twins(TF_RULE_SLIP_PLUS, MOST, samples(24000));
  chaos_twins(TF_RULE_SLIP_MINUS, MOST, samples(24000));
}

TEST(ensemble_of_any_size) {
  for (size_t n = 0; n <= MOST; n++) chaos_twins(TF_RULE_PERSIST, n, 100);
}

/* A state as tf_begin may not give it: near h = g = 0, in any mode. */
static tf_state_t difficult_state(tf_real_t omega0) {
  const double away = (double)log_uniform(1e-9, 1);
  tf_state_t x = {.r = uniform(-0.5, 0.5),
                  .v = uniform(-away, away),
                  .w = omega0 + uniform(-away, away),
                  .mode = (uint8_t)(tap_bits() % TF_MODES),
                  .seed = (uint32_t)tap_bits()};
  if (tap_bits() % 8 == 0) x.v = 0;
  if (tap_bits() % 8 == 0) x.w = omega0;
  return x;
}

/* One that tf_step refuses, or nearly so. */
static void spoil(tf_state_t *x) {
  const tf_real_t large = log_uniform(1, 1e9);
  const struct {
    tf_real_t *member, value;
  } bad[] = {{&x->r, (tf_real_t)NAN},
             {&x->v, (tf_real_t)INFINITY},
             {&x->w, 2 * TF_STATE_LIMIT},
             {&x->v, -large},
             {&x->w, large}};
  const uint64_t which = tap_bits() % 6;
  if (which < 5)
    *bad[which].member = bad[which].value;
  else
    x->mode = (uint8_t)(TF_MODES + tap_bits() % 200);
}

/* Machines and states that are hard on a step: every status is seen. */
TEST(ensemble_of_difficult_states) {
  size_t seen[9] = {0};
  for (int m = 0; m < samples(6000); m++) {
    tf_params_t p = scene_named("chaos")->params;
    p.beta = log_uniform(1e-3, 1);
    p.mu = log_uniform(1e-2, 10);
    p.kappa = log_uniform(1e-3, 1);
    p.gamma = uniform(-3.1, 3.1);
    p.theta = uniform(0.5, 1);
    p.dt = log_uniform(1e-5, 1e-1);
    p.rule = (tf_rule_t)(m % TF_RULES);
    if (m % 50 == 7) p.gamma = 0;
    if (m % 8 == 0) p.law = (tf_tyre_law_t)(tap_bits() % TF_TYRE_LAWS);
    p.k = p.delta = p.sigma = p.a = 1;
    p.epsilon = p.rho = TF_R(0.5);
    twins.machine = prepared(&p);
    tf_input_t u = tf_input_default(&twins.machine);
    if (m % 2) u.alpha = uniform(-3, 3);
    if (m % 3 == 0) u.force = uniform(-1, 1), u.torque = uniform(-1, 1);
    const size_t n = 64; /* whole blocks */
    for (size_t i = 0; i < n; i++) {
      twins.states[i] = difficult_state(u.omega0);
      if (tap_bits() % 10 == 0) spoil(&twins.states[i]);
    }
    twin(n);
    for (int i = 0; i < 5; i++) {
      u.omega0 += u.alpha * twins.machine.dt;
      step_twins(&u);
    }
    for (int i = 0; i < 9; i++) seen[i] += twins.seen[i];
  }
  for (int i = TF_STEP_TOO_LONG; i <= TF_STALLED; i++)
    CHECK((seen[i - TF_STEP_TOO_LONG] > 0) ==
          (i != TF_BAD_PARAMETER && i != TF_FELL_BACK &&
           (i != TF_STALLED || !IS_DOUBLE)));
}

/* In steps of 1 ns a slip that begins with v = 0 leaves r as it was, and lanes
 * are asked whether they stall, as single steps are: in double it moves r again
 * after some steps. */
TEST(ensemble_stalls_as_single_steps_do) {
  tf_params_t p = scene_named("chaos")->params;
  p.dt = TF_R(1e-9);
  twins.machine = prepared(&p);
  const tf_input_t u = tf_input_default(&twins.machine);
  for (size_t i = 0; i < TF_LANES; i++) {
    tf_report_t report;
    twins.states[i] = (tf_state_t){.r = uniform(0.1, 0.3),
                                   .w = u.omega0 + uniform(0.1, 0.2),
                                   .mode = TF_NO_MODE};
    CHECK(tf_begin(&twins.machine, &twins.states[i], &u, &report) == TF_OK);
  }
  twin(TF_LANES);
  step_twins(&u);
  CHECK(twins.alone == 0);
  CHECK((twins.seen[TF_STALLED - TF_STEP_TOO_LONG] > 0) == !IS_DOUBLE);
}

/* Many steps of one call are as many calls, whatever the size and the law: the
 * turntable has its alpha in the first. */
TEST(ensemble_takes_many_steps_at_once) {
  for (int m = 0; m < samples(300); m++) {
    tf_params_t p = random_params();
    p.rule = (tf_rule_t)(m % TF_RULES);
    p.law = m % 4 ? TF_TYRE_JUMP : TF_TYRE_COULOMB;
    twins.machine = prepared(&p);
    tf_input_t u = tf_input_default(&twins.machine);
    u.alpha = uniform(-1, 1);
    const size_t n = tap_bits() % MOST;
    const uint32_t steps = (uint32_t)(tap_bits() % 20);
    for (size_t i = 0; i < n; i++) twins.states[i] = difficult_state(u.omega0);
    twin(n);
    const size_t alone = tf_ensemble_run(&twins.machine, twins.state_blocks, n,
                                         &u, steps, twins.report_blocks);
    CHECK(alone <= n * steps && alone >= n % TF_LANES * steps);
    for (uint32_t at = 0; at < steps; at++, u.alpha = 0)
      for (size_t i = 0; i < n; i++)
        tf_step(&twins.machine, &twins.states[i], &u, &twins.reports[i]);
    for (size_t i = 0; i < n; i++) compare_twin(i);
  }
}

/* A state that friction can bring to h = g = 0 within a few steps. */
static tf_state_t near_rest(const tf_machine_t *k, const tf_input_t *u) {
  const double reach = 4 * (double)k->dt;
  tf_state_t x = {.r = uniform(-0.6, 0.6),
                  .seed = (uint32_t)tap_bits(),
                  .mode = (uint8_t)(tap_bits() % TF_MODES)};
  x.w = u->omega0 + uniform(-reach, reach) / (tf_real_t)0.05;
  x.v = uniform(-reach, reach);
  if (tap_bits() % 4 == 0) x.v = 0, x.w = u->omega0; /* it rests */
  if (tap_bits() % 4 == 0) { /* or all but rests: products of slips vanish */
    x.v = uniform(-2, 2) * TF_REAL_MIN * (tf_real_t)exp(tap_uniform(0, 20));
    x.w = u->omega0;
  }
  if (tap_bits() % 4 == 0)
    (void)tf_speed_for_slip(k, x.r, x.w, u->omega0, 0, &x.v);
  return x;
}

/* Near h = g = 0, where every mode may be possible and a motion may end a step
 * pinned, the passes without branches do most of a block. */
TEST(ensemble_is_pinned_as_single_steps_are) {
  size_t alone = 0, steps = 0, rests = 0;
  size_t taken[TF_MODES] = {0}, choices[TF_MODES + 1] = {0};
  for (int i = 0; i < samples(4000); i++) {
    tf_params_t p = random_params();
    p.beta = uniform(0.02, 0.5);
    p.dt = log_uniform(1e-4, 2e-2);
    p.rule = (tf_rule_t)(i % TF_RULES);
    p.rate = 200;
    p.with_angle = i % 2;
    if (i % 5 == 0) p.theta = uniform(0.5, 1);
    twins.machine = prepared(&p);
    tf_input_t u = tf_input_default(&twins.machine);
    if (i % 5 == 0) u.alpha = uniform(-1, 1);
    for (size_t lane = 0; lane < TF_LANES; lane++)
      twins.states[lane] = near_rest(&twins.machine, &u);
    twin(TF_LANES);
    for (int n = 0; n < 8; n++) {
      size_t pinned[2] = {0, 0};
      for (size_t lane = 0; lane < TF_LANES; lane++)
        pinned[0] += twins.states[lane].mode == TF_PINNED;
      u.omega0 += u.alpha * twins.machine.dt;
      step_twins(&u);
      for (size_t lane = 0; lane < TF_LANES; lane++) {
        pinned[1] += twins.states[lane].mode == TF_PINNED;
        taken[twins.reports[lane].mode]++;
        choices[twins.reports[lane].choices]++;
      }
      rests += pinned[1] > pinned[0] ? pinned[1] - pinned[0] : 0;
    }
    alone += twins.alone;
    steps += twins.steps;
  }
  CHECK_ABOVE(rests, samples(500));
  CHECK_BELOW(alone * 3, steps);
  for (int i = 0; i < TF_MODES; i++) CHECK_ABOVE(taken[i], samples(1000));
  for (int i = 1; i <= 3; i++) CHECK_ABOVE(choices[i], samples(100));
}
