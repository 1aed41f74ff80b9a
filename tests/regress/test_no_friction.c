/* A jump law with mu = 0 holds no wheel at h = g = 0, nor reports TF_REAL_MAX:
 * 1/mu counts as 0, so every force of a pinned wheel looks like one of it. */
#include "sim.h"

/* Of a step that began at rest under a torque of 1 N m, of which the disc takes
 * the momentum. */
static void judge(const sim_t *s, tf_state_t end, tf_report_t report) {
  const real mu = wide(s->params.mu);
  CHECK_NEAR(wide(end.w), wide(s->x.w) + 0.004L, 1e-6L);
  CHECK(report.status >= 0 && !(report.set & TF_MODE_BIT(TF_PINNED)));
  CHECK_NEAR(wide(report.force.F), 0, mu);
}

TEST(without_friction_nothing_is_pinned) {
  const tf_real_t mus[] = {0, TF_REAL_MIN / 2}, gammas[] = {0, TF_R(0.7)};
  static tf_state_block_t blocks[TF_BLOCKS(TF_LANES)];
  static tf_report_block_t reports[TF_BLOCKS(TF_LANES)];
  for (int n = 0; n < 4; n++) {
    tf_params_t p = tf_scenes[0]->params;
    p.d = p.r0 = p.c1 = p.c2 = 0;
    p.beta = TF_R(0.5);
    p.mu = mus[n / 2];
    p.gamma = gammas[n % 2];
    p.dt = TF_R(1e-3);
    sim_t s = sim_of(&p);
    s.u.torque = 1;
    s.x.w = s.k.omega0;
    s.x.mode = TF_PINNED;
    for (scheme_t scheme = MOREAU; scheme < SCHEMES; scheme++) {
      sim_t to = s;
      sim_step(&to, scheme);
      judge(&s, to.x, to.report);
    }
    for (size_t i = 0; i < TF_LANES; i++) tf_ensemble_put(blocks, i, &s.x);
    tf_ensemble_step(&s.k, blocks, TF_LANES, &s.u, reports);
    judge(&s, tf_ensemble_get(blocks, TF_LANES - 1),
          tf_ensemble_report(reports, TF_LANES - 1));
  }
}
