// How a motion begins: which mode a state is in, and the law at that instant.
// In continuous time the accelerations in p = v - d w and w are
//   m p' = Q_r + F sin(gamma),  m (beta^2 + r^2) w' = Q_phi + d Q_r
//                                                     + F r cos(gamma) + M
// so on h = 0 with F = lambda, M = s kappa lambda:  h' = N - A(s) lambda.
#include "linear.h"
#include "twofold/step.h"

typedef struct {
  tf_real_t N;    // h' without friction [m/s^2]
  tf_real_t A[2]; // Delassus scalar for s = +1, -1 [1/kg]
} rates_t;

static rates_t slip_rates(const tf_machine_t *k, const tf_state_t *x,
                          const tf_input_t *input) {
  const tf_real_t mr = k->m * x->r;
  const tf_real_t z = x->w - input->omega0;
  const tf_real_t Q_r = k->k2 * (input->r0 - x->r) - k->c2 * x->v +
                        mr * x->w * x->w + input->force;
  const tf_real_t Q_phi = input->torque - k->c1 * x->w - 2 * mr * x->v * x->w;
  const tf_real_t J = k->m * (k->beta2 + x->r * x->r);
  const tf_real_t arm = x->r * k->cos_gamma;
  const tf_real_t dp = Q_r / k->m, dw = (Q_phi + k->d * Q_r) / J;
  rates_t rates;
  rates.N = -dp * k->sin_gamma - (x->r * dw + x->v * z) * k->cos_gamma;
  for (int s = 0; s < 2; s++)
    rates.A[s] = k->sin_gamma * k->sin_gamma / k->m +
                 arm * (arm + (s ? -k->stick_kappa : k->stick_kappa)) / J;
  return rates;
}

// The modes that are possible at this instant, as a set; lambda of the stick.
static unsigned possible_modes(const tf_machine_t *k, tf_slip_t slip,
                               tf_real_t rounding, const rates_t *rates,
                               tf_real_t *lambda) {
  *lambda = 0;
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return TF_MODE_BIT(slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS);
  if (slip.h > rounding) return TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip.h < -rounding) return TF_MODE_BIT(TF_SLIP_MINUS);
  if (within(slip.g, rounding) && k->stick_kappa > 0)
    return TF_MODE_BIT(TF_PINNED);
  const int s = slip.g < 0;
  const tf_real_t N = rates->N, Amu = rates->A[s] * k->tyre.mu;
  const bool plus = N - Amu > 0, minus = N + Amu < 0;
  unsigned set = 0;
  if (plus) set |= TF_MODE_BIT(TF_SLIP_PLUS);
  if (minus) set |= TF_MODE_BIT(TF_SLIP_MINUS);
  if (plus == minus) {
    set |= TF_MODE_BIT(s ? TF_STICK_MINUS : TF_STICK_PLUS);
    if (rates->A[s] != 0)
      *lambda = clip(N / rates->A[s], -k->tyre.mu, k->tyre.mu);
  }
  return set;
}

// The mode wished if it is in the set, else stick before slip. A slip that is
// wished at an h below rounding is no error where only stick is possible: the
// real type cannot tell that h from 0.
static unsigned first_mode(unsigned set, unsigned wished) {
  static const unsigned order[TF_MODES] = {
      TF_STICK_PLUS, TF_STICK_MINUS, TF_PINNED, TF_SLIP_PLUS, TF_SLIP_MINUS};
  if ((set >> wished) & 1u) return wished;
  int i = 0;
  while (!((set >> order[i]) & 1u)) i++; // the set is never empty
  return order[i];
}

TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report) {
  if (state->mode > TF_MODES || !in_range(state, input)) return TF_BAD_STATE;
  const tf_slip_t slip =
      tf_slip(machine, state->r, state->v, state->w, input->omega0);
  const tf_real_t z = magnitude(state->w - input->omega0);
  const tf_real_t rounding =
      8 * TF_REAL_EPSILON *
      (magnitude(state->v) + (magnitude(machine->d) + magnitude(state->r)) * z);
  const rates_t rates = slip_rates(machine, state, input);
  tf_real_t lambda;
  const unsigned set = possible_modes(machine, slip, rounding, &rates, &lambda);
  const unsigned mode = first_mode(set, state->mode);
  state->mode = (uint8_t)mode;
  report->mode = (uint8_t)mode;
  report->set = (uint8_t)set;
  report->choices = 0;
  for (unsigned bit = 0; bit < TF_MODES; bit++)
    report->choices = (uint8_t)(report->choices + ((set >> bit) & 1u));
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
