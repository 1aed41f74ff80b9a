// How a motion begins: which mode a state is in, and the law at that instant.
#include "../friction/consistent.h"
#include "../friction/mode_set.h"
#include "twofold/step.h"

// The modes that are possible at this instant, as a set; lambda of the stick.
static unsigned possible_modes(const tf_machine_t *k, tf_slip_t slip,
                               tf_real_t rounding, const rates_t *rates,
                               tf_real_t *lambda) {
  const int s = slip.g < 0;
  consistent_modes_t modes;
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return TF_MODE_BIT(slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS);
  if (slip.h > rounding) return TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip.h < -rounding) return TF_MODE_BIT(TF_SLIP_MINUS);
  if (within(slip.g, rounding) && k->stick_kappa > 0)
    return TF_MODE_BIT(TF_PINNED);
  surface_modes(k, rates, s, &modes);
  *lambda = modes.lambda[s];
  return modes.solutions.set;
}

// The preferred mode if it is in the set, else stick before slip. It is no
// error to prefer a slip at an h below rounding where only stick is possible:
// the real type cannot tell that h from 0.
static unsigned first_mode(unsigned set, unsigned preferred) {
  static const unsigned order[TF_MODES] = {
      TF_STICK_PLUS, TF_STICK_MINUS, TF_PINNED, TF_SLIP_PLUS, TF_SLIP_MINUS};
  if (has(set, preferred)) return preferred;
  unsigned mode = preferred; // the set is never empty
  for (int i = TF_MODES - 1; i >= 0; i--)
    if (has(set, order[i])) mode = order[i];
  return mode;
}

TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report) {
  if (state->mode > TF_NO_MODE || !in_range(state, input)) return TF_BAD_STATE;
  const tf_slip_t slip =
      tf_slip(machine, state->r, state->v, state->w, input->omega0);
  const tf_real_t z = state->w - input->omega0;
  const tf_real_t rounding =
      slip_rounding(machine, state->r, state->v, state->w, input->omega0);
  const rates_t rates =
      rates_at(machine, input, state->r, slider_speed(machine, state->v, z), z,
               input->omega0);
  tf_real_t lambda = 0;
  const unsigned set = possible_modes(machine, slip, rounding, &rates, &lambda);
  const unsigned mode = first_mode(set, state->mode);
  state->mode = (uint8_t)mode;
  report->mode = (uint8_t)mode;
  report->set = (uint8_t)set;
  report->choices = (uint8_t)size_of(set);
  report->slip = slip;
  report->delassus =
      tf_tyre_is_set_valued(machine->tyre.law) ? rates.A[slip.g < 0] : 0;
  report->residual = 0;
  report->status = TF_OK;
  if (is_slip(mode))
    report->force =
        tf_tyre_force(&machine->tyre, mode ? TF_R(-1.0) : 1, slip.h, slip.g);
  else
    report->force =
        (tf_force_t){lambda, signed_kappa(machine, slip.g < 0) * lambda};
  return TF_OK;
}

TF_API tf_status_t tf_begin_with_slip(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input, tf_real_t h,
                                      tf_report_t *report) {
  tf_state_t start = *state;
  start.mode = TF_NO_MODE;
  if (h > 0) start.mode = TF_SLIP_PLUS;
  if (h < 0) start.mode = TF_SLIP_MINUS;
  tf_status_t status =
      tf_speed_for_slip(machine, start.r, start.w, input->omega0, h, &start.v);
  if (status == TF_OK) status = tf_begin(machine, &start, input, report);
  if (status == TF_OK) *state = start;
  return status;
}
