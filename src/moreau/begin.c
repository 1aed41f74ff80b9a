// How a motion begins: which mode a state is in, and the law at that instant.
#include "../friction/consistent.h"
#include "../friction/mode_set.h"
#include "twofold/step.h"

// The modes that are possible at this instant, as a set; lambda of the stick.
static unsigned possible_modes(const tf_machine_t *k, tf_slip_t slip,
                               tf_real_t rounding, const tf_rates_t *rates,
                               tf_real_t *lambda) {
  const int s = slip.g < 0;
  tf_consistent_t futures;
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return TF_MODE_BIT(slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS);
  if (slip.h > rounding) return TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip.h < -rounding) return TF_MODE_BIT(TF_SLIP_MINUS);
  if (within(slip.g, rounding) && k->stick_kappa > 0)
    return TF_MODE_BIT(TF_PINNED);
  surface_modes(k, rates, s, &futures);
  *lambda = futures.lambda[s];
  return futures.solutions.set;
}

// The mode wished if it is in the set, else stick before slip. A slip that is
// wished at an h below rounding is no error where only stick is possible: the
// real type cannot tell that h from 0.
static unsigned first_mode(unsigned set, unsigned wished) {
  static const unsigned order[TF_MODES] = {
      TF_STICK_PLUS, TF_STICK_MINUS, TF_PINNED, TF_SLIP_PLUS, TF_SLIP_MINUS};
  if (has(set, wished)) return wished;
  unsigned mode = wished; // the set is never empty
  for (int i = TF_MODES - 1; i >= 0; i--)
    if (has(set, order[i])) mode = order[i];
  return mode;
}

TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report) {
  if (state->mode > TF_MODES || !in_range(state, input)) return TF_BAD_STATE;
  const tf_slip_t slip =
      tf_slip(machine, state->r, state->v, state->w, input->omega0);
  const tf_real_t turn = state->w - input->omega0, z = magnitude(turn);
  const tf_real_t rounding =
      8 * TF_REAL_EPSILON *
      (magnitude(state->v) + (magnitude(machine->d) + magnitude(state->r)) * z);
  const tf_rates_t rates =
      rates_at(machine, input, state->r, state->v - machine->d * turn, turn,
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
  if (mode <= TF_SLIP_MINUS)
    report->force =
        tf_tyre_force(&machine->tyre, mode ? TF_R(-1.0) : 1, slip.h, slip.g);
  else
    report->force = (tf_force_t){
        lambda,
        (slip.g < 0 ? -machine->stick_kappa : machine->stick_kappa) * lambda};
  return TF_OK;
}
