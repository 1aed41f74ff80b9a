/* The ensemble near h = g = 0, where every mode may be possible and a motion
 * may end a step pinned: a block has the bits of single steps there too, and
 * the passes without branches do most of it. */
#include "sample.h"

static int same_bits(tf_real_t a, tf_real_t b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static int same(const tf_state_t *x, const tf_state_t *y, const tf_report_t *a,
                const tf_report_t *b) {
  return same_bits(x->r, y->r) && same_bits(x->v, y->v) &&
         same_bits(x->w, y->w) && same_bits(x->phi, y->phi) &&
         x->mode == y->mode && x->tick == y->tick && a->mode == b->mode &&
         a->set == b->set && a->choices == b->choices &&
         a->status == b->status && same_bits(a->force.F, b->force.F) &&
         same_bits(a->force.M, b->force.M) && same_bits(a->slip.h, b->slip.h) &&
         same_bits(a->slip.g, b->slip.g) &&
         same_bits(a->delassus, b->delassus) &&
         same_bits(a->residual, b->residual);
}

/* The states of a block, one by one. */
typedef struct {
  tf_state_t x[TF_LANES];
  tf_report_t report[TF_LANES];
} singles_t;

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

TEST(ensemble_is_pinned_as_single_steps_are) {
  static tf_state_block_t block;
  static tf_report_block_t reported;
  size_t alone = 0, steps = 0, differ = 0, rests = 0;
  size_t taken[TF_MODES] = {0}, choices[TF_MODES + 1] = {0};
  for (int i = 0; i < 4000; i++) {
    tf_params_t p = random_params();
    p.beta = uniform(0.02, 0.5);
    p.dt = (tf_real_t)exp(tap_uniform(log(1e-4), log(2e-2)));
    p.rule = (tf_rule_t)(i % 4);
    p.rate = 200;
    p.with_angle = i % 2;
    if (i % 5 == 0) p.theta = uniform(0.5, 1);
    const tf_machine_t k = prepared(&p);
    const tf_input_t u = tf_input_default(&k);
    singles_t one;
    memset(&one, 0, sizeof one);
    memset(&reported, 0, sizeof reported);
    for (size_t lane = 0; lane < TF_LANES; lane++) {
      one.x[lane] = near_rest(&k, &u);
      tf_ensemble_put(&block, lane, &one.x[lane]);
    }
    for (int n = 0; n < 8; n++) {
      alone += tf_ensemble_step(&k, &block, TF_LANES, &u, &reported);
      steps += TF_LANES;
      for (size_t lane = 0; lane < TF_LANES; lane++) {
        const unsigned before = one.x[lane].mode;
        (void)tf_step(&k, &one.x[lane], &u, &one.report[lane]);
        const tf_state_t y = tf_ensemble_get(&block, lane);
        const tf_report_t other = tf_ensemble_report(&reported, lane);
        differ += !same(&one.x[lane], &y, &one.report[lane], &other);
        rests += before != TF_PINNED && one.x[lane].mode == TF_PINNED;
        taken[one.report[lane].mode]++;
        choices[one.report[lane].choices]++;
      }
    }
  }
  CHECK(differ == 0);
  printf("# %zu of %zu lanes done alone, %zu came to rest; modes", alone, steps,
         rests);
  for (int i = 0; i < TF_MODES; i++) printf(" %zu", taken[i]);
  printf("; choices");
  for (int i = 0; i <= TF_MODES; i++) printf(" %zu", choices[i]);
  printf("\n");
  CHECK(rests > 1000 && alone * 3 < steps);
  for (int i = 0; i < TF_MODES; i++) CHECK(taken[i] > 1000);
  for (int i = 1; i <= 3; i++) CHECK(choices[i] > 100);
}

/* Loads that bring speeds up to the limit of a state within one step, and past
 * it, and numbers that name no mode: lanes are refused where single steps
 * are. */
TEST(ensemble_refuses_what_single_steps_do) {
  static tf_state_block_t block;
  static tf_report_block_t reported;
  size_t refused = 0, differ = 0;
  for (int i = 0; i < 2000; i++) {
    tf_params_t p = random_params();
    p.m = TF_R(0.001);
    p.c1 = p.c2 = p.d = 0;
    const tf_machine_t k = prepared(&p);
    tf_input_t u = tf_input_default(&k);
    u.force = uniform(-1, 1) * (tf_real_t)TF_STATE_LIMIT;
    u.torque = uniform(-1, 1) * (tf_real_t)TF_STATE_LIMIT * k.inertia / k.dt;
    singles_t one;
    memset(&one, 0, sizeof one);
    memset(&reported, 0, sizeof reported);
    for (size_t lane = 0; lane < TF_LANES; lane++) {
      one.x[lane].r = (tf_real_t)exp(tap_uniform(log(1e-12), log(1)));
      one.x[lane].mode = (uint8_t)(tap_bits() % TF_MODES);
      if (i % 16 == 0) one.x[lane].mode = (uint8_t)(32 * (1 + lane % 7));
      tf_ensemble_put(&block, lane, &one.x[lane]);
    }
    (void)tf_ensemble_step(&k, &block, TF_LANES, &u, &reported);
    for (size_t lane = 0; lane < TF_LANES; lane++) {
      (void)tf_step(&k, &one.x[lane], &u, &one.report[lane]);
      const tf_state_t y = tf_ensemble_get(&block, lane);
      const tf_report_t other = tf_ensemble_report(&reported, lane);
      refused += one.report[lane].status < 0;
      differ += !same(&one.x[lane], &y, &one.report[lane], &other);
    }
  }
  printf("# %zu refused\n", refused);
  CHECK(differ == 0 && refused > 1000 && refused < (size_t)1999 * TF_LANES);
}
