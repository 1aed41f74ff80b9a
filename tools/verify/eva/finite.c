// A step of every machine whose parameters are in their ranges, from every
// state and under all inputs: what an accepted step leaves is finite, and the
// state in its range. On the way there may be infinities and NaN, as an
// overflow makes them: they are numbers of IEEE 754, and the end of the step
// refuses them.
#include <stddef.h>

#include "any.h"
#include "twofold/step.h"

static void step_of(const tf_machine_t *machine, int mode) {
  tf_state_t state = any_state();
  tf_input_t input = any_input();
  tf_report_t report;
  tf_status_t status;
  state.mode = (uint8_t)mode;
  status = tf_step(machine, &state, &input, &report);
  if (status < 0) return;
  //@ check IN_REACH(state.r) && IN_REACH(state.v) && IN_REACH(state.w);
  //@ check \is_finite(report.slip.h) && \is_finite(report.slip.g);
  //@ check \is_finite(report.delassus);
  //@ check \is_finite(report.force.F);
  //@ check \is_finite(report.force.M);
  //@ check \is_finite(report.residual);
}

ENTRY(step_finite) {
  tf_params_t params = params_in_range();
  tf_machine_t machine;
  //@ loop unroll TF_TYRE_LAWS;
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    params.law = (tf_tyre_law_t)law;
    tf_prepare(&machine, &params, NULL);
    // The mode does nothing to a law that is single-valued.
    const int modes = tf_tyre_is_set_valued(params.law) ? TF_MODES : 1;
    //@ loop unroll TF_MODES;
    for (int mode = 0; mode < modes; mode++) step_of(&machine, mode);
  }
  //@ check reached: \false;
}
