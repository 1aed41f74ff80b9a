/* What a step promises to every machine within the documented ranges and to
 * every state up to the limit, however stiff, far or small: a step that is
 * accepted leaves finite numbers only, in the state and in the report; a step
 * that is refused leaves the state as it was, bit for bit; the report has the
 * status that was returned. */
#include "extremes.h"
#include "same_state.h"
#include "sim.h"

static long accepted, refused[-TF_STEP_TOO_LONG + 1];

static int all_finite(const tf_state_t *x, const tf_report_t *o) {
  return isfinite(x->r) && isfinite(x->v) && isfinite(x->w) &&
         isfinite(x->phi) && isfinite(o->force.F) && isfinite(o->force.M) &&
         isfinite(o->slip.h) && isfinite(o->slip.g) && isfinite(o->delassus) &&
         isfinite(o->residual);
}

/* Up to `steps` steps of one machine, until one is refused. */
static void run(scheme_t scheme, const tf_params_t *p, tf_state_t x,
                const tf_input_t *input, int steps) {
  sim_t s = sim_of(p);
  if (input) s.u = *input;
  s.x = x;
  for (int n = 0; n < steps; n++) {
    const tf_state_t old = s.x;
    memset(&s.report, 0x7f, sizeof s.report);
    memset(&s.low, 0, sizeof s.low); /* each step begins without it */
    const tf_status_t status = sim_step(&s, scheme);
    CHECK(isfinite(s.low.r) && isfinite(s.low.v) && isfinite(s.low.w));
    CHECK(s.report.status == status);
    if (status < TF_OK) {
      CHECK(same_state(&old, &s.x));
      CHECK(status >= TF_STEP_TOO_LONG);
      refused[-(int)status]++;
      return;
    }
    accepted++;
    CHECK(s.report.mode == s.x.mode && s.x.mode < TF_MODES);
    CHECK(s.x.tick == old.tick + 1);
    if (!CHECK(all_finite(&s.x, &s.report))) return;
  }
}

static void run_schemes(const tf_params_t *p, const tf_state_t *x,
                        const tf_input_t *input, int steps) {
  for (int s = 0; s < SCHEMES; s++) run((scheme_t)s, p, *x, input, steps);
}

TEST(random_machines_keep_every_number_finite) {
  for (int n = 0; n < samples(50000); n++) {
    const tf_params_t p = draw_machine();
    const tf_real_t limit = one_in(4) ? TF_STATE_LIMIT / 2 : 10;
    const tf_state_t x = draw_state(limit);
    const tf_input_t u = {.omega0 = anything(100),
                          .r0 = anything(100),
                          .force = anything(1000),
                          .torque = anything(1000)};
    const bool driven = one_in(4);
    run_schemes(&p, &x, driven ? &u : NULL, 5);
  }
  CHECK_ABOVE(accepted, samples(100000));
  for (int i = 2; i <= 4; i++) CHECK_ABOVE(refused[i], samples(100));
}

/* Slopes of h and g that overflow in float: the first made a stick of 8e11 m/s
 * consistent with an infinite Delassus scalar, and that of the second is
 * infinite while its end is in reach. */
TEST(overflow_of_a_slope_keeps_every_number_finite) {
  static const struct {
    double machine[MACHINE];
    tf_real_t dt;
    tf_rule_t rule;
    tf_state_t x;
  } edges[] = {
      {{1e-12, -1e6, 7e-8, 0, 0, 0, 1e6, 1e6, 6e-6, 5000, -0.965},
       TF_R(0.005),
       TF_RULE_SLIP_MINUS,
       {.r = TF_R(-6.7e-33), .w = TF_R(-0.46), .mode = TF_STICK_MINUS}},
      {{2.9e-11, 8, 2.6e-8, 0, 0, 0, 2500, 0.0039, 0.069, 9.6e4, -0.63},
       TF_R(0.47),
       TF_RULE_PERSIST,
       {.r = TF_R(-1e-30), .v = TF_R(-4e-9), .w = -19, .mode = TF_PINNED}}};
  for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
    tf_params_t p = params_from(edges[i].machine);
    p.theta = 1;
    p.dt = edges[i].dt;
    p.rule = edges[i].rule;
    run_schemes(&p, &edges[i].x, NULL, 1);
  }
}
