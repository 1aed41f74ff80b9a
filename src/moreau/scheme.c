#include "scheme.h"

TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start) {
  step_end_t to;
  (void)end_of_step(k, state, input, start, true, &to);
  if (to.outcome.status >= TF_OK && needs_check(k, state, input, &to))
    return tf_checked_end(k, state, input, to);
  return to;
}
