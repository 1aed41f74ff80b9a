// What a compensated step needs before it starts: what rounding has left out of
// the constants of a machine, and a start whose slip is as precise.
#include "../model/mechanics.h"
#include "twofold/compensated.h"

static pair_t integer(int n) { return (pair_t){(tf_real_t)n, 0}; }

// sin and cos of x for |x| <= 3.2: the series at x/8, where its terms fall to
// the square of epsilon (2^-104 in double) within 13 of each, then three times
// the double angle.
static void sine_cosine(tf_real_t x, pair_t *sine, pair_t *cosine) {
  const pair_t y = {x / 8, 0}, minus_y2 = pair_negative(pair_product(y, y));
  pair_t s = y, c = {1, 0}, s_term = s, c_term = c;
  for (int n = 1; n <= 13; n++) {
    c_term = pair_quotient(pair_product(c_term, minus_y2),
                           integer((2 * n - 1) * (2 * n)));
    s_term = pair_quotient(pair_product(s_term, minus_y2),
                           integer(2 * n * (2 * n + 1)));
    c = pair_sum(c, c_term);
    s = pair_sum(s, s_term);
  }
  for (int i = 0; i < 3; i++) {
    const pair_t ss = pair_product(s, s), sc = pair_product(s, c);
    s = pair_sum(sc, sc);
    c = pair_difference((pair_t){1, 0}, pair_sum(ss, ss));
  }
  *sine = s;
  *cosine = c;
}

// What rounding has left out of a constant.
static tf_real_t left_out(pair_t exact, tf_real_t constant) {
  return (exact.hi - constant) + exact.lo;
}

TF_API tf_status_t tf_prepare_compensated(tf_compensated_t *machine,
                                          const tf_params_t *params,
                                          int *offender) {
  tf_machine_t *k = &machine->machine;
  const tf_status_t status = tf_prepare(k, params, offender);
  if (status != TF_OK) return status;
  pair_t sine, cosine;
  sine_cosine(params->gamma, &sine, &cosine);
  const pair_t inertia = pair_sum(disc_inertia_pair(k->m, params->beta),
                                  two_product(k->theta_dt, k->c1));
  machine->low_sin_gamma = k->sin_gamma != 0 ? left_out(sine, k->sin_gamma) : 0;
  machine->low_cos_gamma = left_out(cosine, k->cos_gamma);
  machine->low_inertia = left_out(inertia, k->inertia);
  return TF_OK;
}

TF_API tf_status_t tf_speed_for_slip_compensated(
    const tf_compensated_t *machine, tf_state_t *state,
    tf_compensation_t *compensation, tf_real_t omega0, tf_real_t h) {
  const tf_machine_t *k = &machine->machine;
  if (!(magnitude(k->sin_gamma) >= TF_MIN_SINE)) return TF_BAD_STATE;
  const pair_t r = {state->r, compensation->r}, w = {state->w, compensation->w};
  const pair_t sine = {k->sin_gamma, machine->low_sin_gamma};
  const pair_t cosine = {k->cos_gamma, machine->low_cos_gamma};
  const pair_t z = pair_normalized(pair_plus(w, -omega0));
  const pair_t p = pair_negative(pair_quotient(
      pair_plus(pair_product(pair_product(r, z), cosine), h), sine));
  const pair_t v = pair_normalized(pair_sum(p, pair_times(z, k->d)));
  state->v = v.hi;
  compensation->v = v.lo;
  return TF_OK;
}
