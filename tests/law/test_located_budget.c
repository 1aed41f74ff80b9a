/* The budget of the located step: so many segments, then the fixed step. */
#include "common.h"

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  tf_state_t state;
} start_t;

static void start_at(start_t *s, tf_params_t params, double r, double w,
                     double h) {
  tf_report_t report;
  CHECK(tf_prepare(&s->machine, &params, NULL) == TF_OK);
  s->input = tf_input_default(&s->machine);
  s->state =
      (tf_state_t){.r = (tf_real_t)r, .w = (tf_real_t)w, .mode = TF_NO_MODE};
  CHECK(tf_speed_for_slip(&s->machine, s->state.r, s->state.w, s->input.omega0,
                          (tf_real_t)h, &s->state.v) == TF_OK);
  CHECK(tf_begin(&s->machine, &s->state, &s->input, &report) == TF_OK);
}

typedef struct {
  tf_state_t state;
  tf_report_t report;
  tf_status_t status;
} end_t;

static end_t step_within(const start_t *s, int segments) {
  tf_machine_t k = s->machine;
  end_t end;
  memset(&end, 0, sizeof end);
  end.state = s->state;
  k.segments = (uint16_t)segments;
  end.status = tf_step_located(&k, &end.state, &s->input, &end.report);
  return end;
}

/* A step needs so many segments: with those or more of them it ends in the same
 * bits, with fewer it says that it is coarse. Machines at random, in steps that
 * are long for them. */
TEST(located_budget_is_kept) {
  int needed[4] = {0, 0, 0, 0}, short_of = 0;
  for (int i = 0; i < 2000; i++) {
    tf_params_t p = tf_scenes[0]->params;
    p.gamma = (tf_real_t)tap_uniform(0.3, 2.8);
    p.beta = (tf_real_t)tap_uniform(0.05, 0.5);
    p.kappa = (tf_real_t)tap_uniform(0.02, 0.6);
    p.k2 = (tf_real_t)tap_uniform(0.5, 30);
    p.mu = (tf_real_t)tap_uniform(0.1, 2);
    p.dt = (tf_real_t)tap_uniform(0.01, 0.2);
    start_t s;
    start_at(&s, p, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
             tap_uniform(-0.2, 0.2));
    const end_t want = step_within(&s, TF_LOCATED_MAX_SEGMENTS);
    if (want.status != TF_OK) continue;
    int least = 1;
    for (; step_within(&s, least).status != TF_OK; least++) {
      const end_t end = step_within(&s, least);
      short_of++;
      CHECK(end.report.status == end.status);
      if (end.status < TF_OK) { /* what is left is too long for tf_step */
        CHECK(!memcmp(&end.state, &s.state, sizeof s.state));
      } else {
        CHECK(end.status == TF_COARSE || end.status == TF_DEGRADED);
        CHECK(end.report.set & TF_MODE_BIT(end.report.mode));
        CHECK(end.state.tick == s.state.tick + 1);
      }
      if (!CHECK(least < TF_LOCATED_MAX_SEGMENTS)) return;
    }
    for (int n = least; n < least + 8; n++) {
      const end_t end = step_within(&s, n);
      CHECK(end.status == TF_OK);
      CHECK(!memcmp(&end.state, &want.state, sizeof want.state));
    }
    needed[least == 1 ? 0 : least == 2 ? 1 : least < 8 ? 2 : 3]++;
  }
  printf(
      "# segments needed: one %d, two %d, up to seven %d, more %d; short of "
      "them %d times\n",
      needed[0], needed[1], needed[2], needed[3], short_of);
  for (int i = 0; i < 4; i++) CHECK(needed[i] > 20);
}

/* What is left is done by the fixed step, from where the segments have come to:
 * a slider on a spring without contact, in a step of two turns. */
TEST(located_more_segments_are_better) {
  tf_params_t p = tf_scenes[0]->params;
  p.law = TF_TYRE_NONE;
  p.m = 1;
  p.k2 = 10000;
  p.dt = TF_R(0.125);
  p.tolerance = IS_DOUBLE ? TF_R(1e-10) : 0;
  start_t s;
  start_at(&s, p, 0.1, -1, 0.1);
  const end_t exact = step_within(&s, TF_LOCATED_MAX_SEGMENTS);
  CHECK(exact.status == TF_OK);
  double error[TF_LOCATED_MAX_SEGMENTS] = {0};
  int n = 1;
  for (;; n++) {
    const end_t end = step_within(&s, n);
    if (end.status == TF_OK || n == TF_LOCATED_MAX_SEGMENTS - 1) break;
    CHECK(end.status == TF_COARSE);
    error[n] = fabs((double)end.state.r - (double)exact.state.r) +
               fabs((double)end.state.v - (double)exact.state.v) / 100;
  }
  printf(
      "# %d segments needed; errors %.1e with one, %.1e with half of them, "
      "%.1e with one less\n",
      n, error[1], error[n / 2], error[n - 1]);
  CHECK(n > 8);
  CHECK(error[n / 2] < error[1] && error[n - 1] < error[1] / 20);
}

/* A budget of 0 is that of the build, what is behind the point is dropped, so
 * what is below 1 is 0, and what is beyond the range is refused by name. */
TEST(located_budget_is_a_parameter) {
  const struct {
    double given;
    int want;
  } cases[] = {{0, TF_LOCATED_SEGMENTS},
               {0.5, TF_LOCATED_SEGMENTS},
               {0.999, TF_LOCATED_SEGMENTS},
               {1, 1},
               {7.9, 7},
               {1000, 1000}};
  tf_params_t p = tf_scenes[0]->params;
  tf_machine_t k;
  for (int i = 0; i < 6; i++) {
    p.segments = (tf_real_t)cases[i].given;
    CHECK(tf_prepare(&k, &p, NULL) == TF_OK && k.segments == cases[i].want);
  }
  const double refused[] = {-1, 1001, NAN};
  for (int i = 0; i < 3; i++) {
    int offender = -1;
    p.segments = (tf_real_t)refused[i];
    CHECK(tf_prepare(&k, &p, &offender) == TF_BAD_PARAMETER);
    CHECK(offender >= 0 && offender < TF_PARAMETERS &&
          !strcmp(tf_parameter_ranges[offender].name, "segments"));
  }
}
