/// @file
/// One step into a mode, whatever the rule would take.
#ifndef TWOFOLD_TAKE_H
#define TWOFOLD_TAKE_H

#include "twofold.h"

/// One step of the motion that `of` names: of its state, to its report.
typedef tf_status_t take_step_t(void *of);

/// A step that ends in a mode: the rule's own, or one from that mode on, or by
/// one of many draws that end a rest, as at the h = g = 0 that a step comes to.
/// Where the mode is possible only within the step, it ends in stick or rest,
/// left into the mode at its end.
/// @param contact of the machine of `step`; it is left as it was
/// @return the status of the step; < 0: the state is the one before.
///     TF_BAD_PARAMETER: no step ends in that mode
static inline tf_status_t take_mode(take_step_t *step, void *of,
                                    tf_state_t *state, tf_contact_t *contact,
                                    tf_report_t *report, unsigned mode) {
  const tf_state_t before = *state;
  const tf_contact_t own = *contact;
  tf_status_t status = step(of);
  const unsigned modes = report->set;
  if (status < 0 || report->mode == mode) return status;
  status = TF_BAD_PARAMETER;
  for (unsigned i = TF_MODES; (modes >> mode & 1u) != 0 && i >= TF_STICK_PLUS;
       i--) {
    const unsigned to = i == TF_MODES ? mode : i;
    for (uint32_t draw = 0; (modes >> to & 1u) != 0 && draw < 64; draw++) {
      *state = before;
      state->mode = (uint8_t)(draw == 0 ? to : TF_PINNED);
      state->seed = draw;
      contact->rule = draw == 0 ? TF_RULE_PERSIST : TF_RULE_RANDOM;
      contact->exit_threshold = to == TF_PINNED ? 0 : UINT64_MAX;
      if (step(of) < 0 || report->mode != to) continue;
      state->seed = before.seed;
      state->mode = report->mode = (uint8_t)mode;
      *contact = own;
      return report->status;
    }
  }
  *contact = own;
  *state = before;
  return status;
}

#endif
