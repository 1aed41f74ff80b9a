/* What the analysis of a machine promises, for machines, inputs and states from
 * the whole of what is allowed, as tools/verify/fuzz/analysis.c has it. */
#include "../../tools/verify/fuzz/fuzz.h"
#include "extremes.h"

static void look(const tf_params_t *p, const tf_input_t *input,
                 const tf_state_t *x) {
  tf_machine_t k;
  if (!CHECK(tf_prepare(&k, p, NULL) == TF_OK)) return;
  const tf_input_t u = input ? *input : tf_input_default(&k);
  const char *broken = fuzz_analysis(&k, &u, x);
  if (!CHECK(broken == NULL)) printf("#   %s\n", broken);
}

TEST(analysis_of_any_machine_is_finite_or_refused) {
  for (int n = 0; n < samples(200000); n++) {
    tf_params_t p = draw_machine();
    if (!one_in(4)) p.law = TF_TYRE_JUMP;
    const tf_state_t x = draw_state(one_in(4) ? TF_STATE_LIMIT / 2 : 10);
    tf_input_t u;
    memset(&u, 0, sizeof u);
    u.omega0 = anything(100);
    u.r0 = anything(100);
    u.force = anything(TF_R(1e8));
    u.torque = anything(TF_R(1e8));
    u.alpha = anything(1000);
    look(&p, one_in(2) ? &u : NULL, &x);
  }
}
