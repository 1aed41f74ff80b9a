// How a motion begins: which mode a state is in, and the law at that instant.
#include "../friction/mode_set.h"
#include "../model/rates.h"
#include "twofold/step.h"

// The law at this instant: the modes that are possible, and under each of them
// the force of stick or of what leaves h = g = 0.
typedef struct {
  tf_slip_t slip;
  tf_real_t rounding;
  rates_t rates;
  bool is_codim2; // h = g = 0 under a law with a moment in stick
  consistent_modes_t modes;
} instant_t;

static instant_t instant_of(const tf_machine_t *k, const tf_state_t *x,
                            const tf_input_t *u) {
  tf_real_t r = x->r, z = x->w - u->omega0;
  instant_t at = {.is_codim2 = false};
  at.slip = tf_slip(k, r, x->v, x->w, u->omega0);
  at.rounding = slip_rounding(k, r, x->v, x->w, u->omega0);
  at.rates = tf_rates_at(k, u, r, slider_speed(k, x->v, z), z, u->omega0);
  at.is_codim2 = tf_tyre_is_set_valued(k->contact.tyre.law) &&
                 k->contact.stick_kappa > 0 && within(at.slip.h, at.rounding) &&
                 within(at.slip.g, at.rounding);
  if (!at.is_codim2) return at;
  place_at_codim2(&at.rates, &r, &z);
  at.rates = tf_rates_at(k, u, r, 0, z, u->omega0);
  return at;
}

// Off h = 0 and at g != 0.
static unsigned possible_modes(const tf_machine_t *k, instant_t *at) {
  const tf_slip_t slip = at->slip;
  if (!tf_tyre_is_set_valued(k->contact.tyre.law))
    return TF_MODE_BIT(slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS);
  if (slip.h > at->rounding) return TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip.h < -at->rounding) return TF_MODE_BIT(TF_SLIP_MINUS);
  surface_modes(k, &at->rates, sign_of(slip.g), &at->modes);
  return at->modes.solutions.set;
}

// The preferred mode if it is in the set, else stick before slip. It is no
// error to prefer a slip at an h below rounding where only stick is possible:
// in the real type that h is 0.
static unsigned first_mode(unsigned set, unsigned preferred) {
  static const unsigned order[4] = {TF_STICK_PLUS, TF_STICK_MINUS, TF_SLIP_PLUS,
                                    TF_SLIP_MINUS};
  if (has(set, preferred)) return preferred;
  unsigned mode = preferred; // the set is never empty
  for (int i = 3; i >= 0; i--)
    if (has(set, order[i])) mode = order[i];
  return mode;
}

static tf_force_t first_force(const tf_machine_t *k, const instant_t *at,
                              unsigned mode) {
  const sign_t s = sign_of(at->slip.g);
  if (is_slip(mode))
    return tf_tyre_force(&k->contact.tyre, unit(sign_in(mode)), at->slip.h,
                         at->slip.g);
  const tf_real_t lambda = at->modes.lambda[s];
  return (tf_force_t){lambda, signed_kappa(k, s) * lambda};
}

// At h = g = 0 the wheel rests where its law has the force for it, else goes
// where the rule takes it. A law without a future leaves it at rest.
static unsigned mode_at_codim2(const tf_machine_t *k, const tf_state_t *x,
                               instant_t *at, tf_force_t *force) {
  const codim2_field_t field = tf_codim2_field_of(k, &at->rates);
  tf_codim2_modes(&k->contact, &field, &at->modes);
  const unsigned set = at->modes.solutions.set;
  unsigned mode = has(set, x->mode) ? x->mode : TF_PINNED;
  if (!has(set, mode))
    mode = tf_leave_codim2(&k->contact, &field, mode, false, x->tick, x->seed,
                           &at->modes);
  *force = (tf_force_t){0, 0};
  if (mode == TF_NO_MODE) return TF_PINNED;
  if (mode == TF_PINNED) {
    *force = at->rates.pinning;
    return mode;
  }
  const multipliers_t m = tf_codim2_multipliers(&k->contact, &at->modes, mode);
  *force = force_under(&k->contact, m);
  return mode;
}

TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report) {
  if (state->mode > TF_NO_MODE || !in_range(state, input)) return TF_BAD_STATE;
  instant_t at = instant_of(machine, state, input);
  if (at.is_codim2) {
    state->mode = (uint8_t)mode_at_codim2(machine, state, &at, &report->force);
    report->set = at.modes.solutions.set;
  } else {
    const unsigned set = possible_modes(machine, &at);
    state->mode = (uint8_t)first_mode(set, state->mode);
    report->set = (uint8_t)set;
    report->force = first_force(machine, &at, state->mode);
  }
  report->mode = state->mode;
  report->choices = (uint8_t)size_of(report->set);
  report->slip = at.slip;
  report->delassus = tf_tyre_is_set_valued(machine->contact.tyre.law)
                         ? at.rates.A[sign_of(at.slip.g)]
                         : 0;
  report->residual = 0;
  report->status = TF_OK;
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
