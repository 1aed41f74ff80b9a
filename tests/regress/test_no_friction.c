/* A jump law with mu = 0 must not hold a wheel at h = g = 0, nor report a force
 * of TF_REAL_MAX: 1/mu counts as 0, so every force of a pinned wheel looks like
 * one of the law. */
#include <string.h>

#include "tap.h"
#include "twofold/compensated.h"
#include "twofold/ensemble.h"
#include "twofold/located.h"
#include "twofold/scene.h"
#include "twofold/step.h"

/* Momentum of a torque of 1 N m over one step. */
static const tf_real_t gain = TF_R(0.004);

static tf_params_t params_of(tf_real_t mu, tf_real_t gamma) {
  tf_params_t p = tf_scenes[0]->params;
  p.d = p.r0 = p.c1 = p.c2 = 0;
  p.beta = TF_R(0.5);
  p.mu = mu;
  p.gamma = gamma;
  p.dt = TF_R(1e-3);
  return p;
}

TEST(without_friction_nothing_is_pinned) {
  const tf_real_t mus[] = {0, TF_REAL_MIN / 2}, gammas[] = {0, TF_R(0.7)};
  for (int n = 0; n < 4; n++) {
    const tf_params_t p = params_of(mus[n / 2], gammas[n % 2]);
    tf_compensated_t machine;
    CHECK(tf_prepare_compensated(&machine, &p, NULL) == TF_OK);
    const tf_machine_t *k = &machine.machine;
    tf_input_t input = tf_input_default(k);
    input.torque = 1;
    tf_state_t x;
    memset(&x, 0, sizeof x);
    x.w = k->omega0;
    x.mode = TF_PINNED;
    tf_report_t report;
    for (int scheme = 0; scheme < 4; scheme++) {
      static tf_state_block_t blocks[TF_BLOCKS(TF_LANES)];
      static tf_report_block_t reports[TF_BLOCKS(TF_LANES)];
      tf_state_t to = x;
      tf_compensation_t compensation = {0, 0, 0, 0};
      if (scheme == 0) tf_step(k, &to, &input, &report);
      if (scheme == 1)
        tf_step_compensated(&machine, &to, &compensation, &input, &report);
      if (scheme == 2) tf_step_located(k, &to, &input, &report);
      if (scheme == 3) {
        for (size_t i = 0; i < TF_LANES; i++) tf_ensemble_put(blocks, i, &x);
        tf_ensemble_step(k, blocks, TF_LANES, &input, reports);
        to = tf_ensemble_get(blocks, TF_LANES - 1);
        report = tf_ensemble_report(reports, TF_LANES - 1);
      }
      const tf_real_t off = to.w - x.w - gain;
      CHECK(off < TF_R(1e-6) && off > TF_R(-1e-6));
      CHECK(report.status >= 0 && !(report.set & TF_MODE_BIT(TF_PINNED)));
      CHECK(report.force.F <= p.mu && report.force.F >= -p.mu);
    }
  }
}
