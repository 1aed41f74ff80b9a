#include "rare_end.h"

#include "balanced.h"
#include "codim2_end.h"
#include "least_violation.h"
#include "single_valued.h"

// The end in a mode that solves the inclusion. A slip that turns within the
// step, see slip_end(), is not TF_OK where a blow does that and it is kept.
TF_INLINE step_end_t chosen_end(const free_motion_t *c, const inclusion_t *in,
                                unsigned signs, const solutions_t *s,
                                bool turns) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const unsigned chosen = choose_mode(k, c->state, s);
  const unsigned mode = turns ? mode_instead(s, chosen) : chosen;
  step_end_t to = {.end = mode_end(c, s, mode)};
  const end_state_t from = {c->state->r, c->state->v, c->state->w};
  const bool unsure = turns && mode == chosen && is_blow(k, from, to.end.at);
  to.outcome.mode = mode;
  to.outcome.set = s->set;
  to.outcome.status = unsure ? TF_COARSE : TF_OK;
  to.outcome.delassus = end_delassus(c, in, signs, &to.end);
  return to;
}

// A build for one scene keeps what its machine needs.
static step_end_t end_anew(const tf_machine_t *machine, const tf_state_t *state,
                           const tf_input_t *input, start_t start,
                           ending_t ending) {
  free_motion_t c = free_motion(machine, state, input, start);
  const tf_machine_t *k = TF_API_MACHINE(&c);
  step_end_t to = {.outcome = {.status = TF_STEP_TOO_LONG}};
  if (!c.linear.definite) return to;
  if (!tf_tyre_is_set_valued(k->tyre.law)) return single_valued_end(&c);
  inclusion_t in = inclusion(&c);
  solutions_t s = {0};
  add_pinned_point(&c, &in);
  // The hull reaches beyond the forces by which signs_of() judges.
  const unsigned signs =
      ending == END_NEAR_CODIM2 ? BOTH_SIGNS : signs_of(&in.g);
  enumerate(&in, signs, &s);
  if (ending == END_IN_DOUBT || ending == END_TURNING)
    return chosen_end(&c, &in, signs, &s, ending == END_TURNING);
  if (k->stick_kappa > 0 && ending == END_NEAR_CODIM2 &&
      tf_codim2_end(&c, input, &in, &s, &to))
    return to;
  return least_violation(&c, &in, &s);
}

TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start,
                              ending_t ending) {
  const step_end_t to = end_anew(k, state, input, start, ending);
  if (to.outcome.status >= TF_OK && is_in_doubt(k, state, input, &to))
    return tf_judged_end(k, state, input, to);
  return to;
}
