// The machine: its constants from parameters, its kinematics, its energy, and
// its field at h = g = 0.
#include "twofold/machine.h"

#include <stddef.h>

#include "../friction/tyre_law.h"
#include "mechanics.h"
#include "rates.h"

// From parameters to a machine: validate once, derive the constants, and trust
// them from then on. No step calls this.

#define ALL_LAWS ((1u << TF_TYRE_LAWS) - 1u)
#define LAW(name) (1u << TF_TYRE_##name)
#define KAPPA_LAWS (LAW(JUMP) | LAW(TWO_PIECE) | LAW(SMOOTH))
#define STRING_LAWS (LAW(STRING) | LAW(TWO_PIECE))
#define RANGE(member, unit, laws, low, high) \
  { #member, unit, offsetof(tf_params_t, member), laws, TF_R(low), TF_R(high) }
// The nearest number to pi: a larger gamma would name an angle twice.
#define PI_HERE TF_R(3.14159265358979323846)

TF_API const tf_parameter_range_t tf_parameter_ranges[TF_PARAMETERS] = {
    RANGE(m, "kg", ALL_LAWS, 1e-12, 1e12),
    RANGE(d, "m", ALL_LAWS, -1e6, 1e6),
    RANGE(beta, "m", ALL_LAWS, 1e-9, 1e6),
    RANGE(k2, "N/m", ALL_LAWS, 0.0, 1e15),
    RANGE(c1, "N m s", ALL_LAWS, 0.0, 1e12),
    RANGE(c2, "N s/m", ALL_LAWS, 0.0, 1e12),
    RANGE(r0, "m", ALL_LAWS, -1e6, 1e6),
    RANGE(omega0, "rad/s", ALL_LAWS, -1e6, 1e6),
    RANGE(mu, "N", ALL_LAWS, 0.0, MAX_MU),
    RANGE(kappa, "m", KAPPA_LAWS, MIN_KAPPA, MAX_KAPPA),
    {"gamma", "rad", offsetof(tf_params_t, gamma), ALL_LAWS, -PI_HERE, PI_HERE},
    RANGE(epsilon, "m/s", LAW(SMOOTH), 1e-12, 1e6),
    RANGE(k, "1/m^2", STRING_LAWS, 1e-9, 1e12),
    RANGE(delta, "1/m", LAW(STRING), 1e-9, 1e9),
    RANGE(sigma, "m", LAW(STRING), 0.0, 1e6),
    RANGE(rho, "1", LAW(STRING), 1e-6, 1.0),
    RANGE(a, "m", LAW(STRING), 1e-9, 1e6),
    RANGE(theta, "1", ALL_LAWS, 0.5, 1.0),
    RANGE(dt, "s", ALL_LAWS, 1e-9, 1.0),
    RANGE(rate, "1/s", ALL_LAWS, 0.0, MAX_RATE),
    RANGE(tolerance, "1", ALL_LAWS, 0.0, 1e-3),
    {"segments", "1", offsetof(tf_params_t, segments), ALL_LAWS, 0,
     TF_LOCATED_MAX_SEGMENTS}};

// Index of the first member out of range, or -1. Members that the law does not
// need are not checked: a scene leaves them 0. NaN fails every comparison.
static int first_offender(const tf_params_t *params) {
  if ((unsigned)params->law >= TF_TYRE_LAWS) return TF_PARAMETERS;
  if ((unsigned)params->rule >= TF_RULES) return TF_PARAMETERS;
  if ((unsigned)params->rest >= TF_REST_LAWS) return TF_PARAMETERS;
  for (int i = 0; i < TF_PARAMETERS; i++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[i];
    const tf_real_t *value =
        (const tf_real_t *)(const void *)((const char *)params + range->offset);
    const bool needed = (range->laws >> params->law) & 1u;
    if (needed && !(*value >= range->low && *value <= range->high)) return i;
  }
  return -1;
}

static void prepare_tyre(tf_tyre_t *tyre, const tf_params_t *params) {
  *tyre = (tf_tyre_t){.law = params->law, .mu = params->mu};
  switch (params->law) {
    case TF_TYRE_SMOOTH:
      tyre->epsilon = params->epsilon;
      tyre->kappa = params->kappa;
      tf_prepare_angle_kernel(tyre, params->kappa);
      break;
    case TF_TYRE_JUMP:
      tyre->kappa = params->kappa;
      tf_prepare_angle_kernel(tyre, params->kappa);
      break;
    case TF_TYRE_TWO_PIECE: // Appendix B's choice of constants
      tyre->stiffness = params->k;
      tyre->delta = 1 / (3 * params->kappa);
      tyre->rho = TF_R(2.0) / 3;
      tyre->a = 3 * params->kappa;
      break;
    case TF_TYRE_STRING:
      tyre->stiffness = params->k;
      tyre->delta = params->delta;
      tyre->sigma = params->sigma;
      tyre->rho = params->rho;
      tyre->a = params->a;
      break;
    case TF_TYRE_COULOMB:
    case TF_TYRE_NONE:
    default:
      break;
  }
}

TF_API tf_status_t tf_prepare(tf_machine_t *machine, const tf_params_t *params,
                              int *offender) {
  const int first = first_offender(params);
  if (first >= 0) {
    if (offender) *offender = first;
    return TF_BAD_PARAMETER;
  }
  const tf_real_t d = params->d, dt = params->dt;
  *machine = (tf_machine_t){.m = params->m,
                            .d = d,
                            .k2 = params->k2,
                            .c1 = params->c1,
                            .c2 = params->c2,
                            .r0 = params->r0,
                            .omega0 = params->omega0,
                            .beta2 = params->beta * params->beta,
                            .theta = params->theta,
                            .with_angle = params->with_angle};
  prepare_tyre(&machine->contact.tyre, params);
  tf_complete_contact(&machine->contact, params->rest, params->rule,
                      params->rate * dt);
  set_step_length(machine, dt);
  tf_sine_cosine(params->gamma, &machine->sin_gamma, &machine->cos_gamma);
  // No number is pi. On the axis A and N vanish with r only where this is 0:
  // with the 1e-16 that rounding leaves of it no stick would get past r = 0.
  if (within(machine->sin_gamma, TF_REAL_EPSILON * magnitude(params->gamma)))
    machine->sin_gamma = 0;
  machine->minus_sin_gamma = -machine->sin_gamma;
  machine->d_sin_gamma = d * machine->sin_gamma;
  const tf_real_t mu = params->mu;
  machine->mu_sin_gamma = mu * machine->sin_gamma;
  machine->mu_d_sin_gamma = mu * machine->d_sin_gamma;
  // An error below its rounding is beyond any series.
  const tf_real_t finest = 64 * TF_REAL_EPSILON;
  machine->tolerance = params->tolerance > finest ? params->tolerance : finest;
  const uint16_t segments = (uint16_t)params->segments;
  machine->segments = segments > 0 ? segments : TF_LOCATED_SEGMENTS;
  return TF_OK;
}

// Kinematics and energy of the prepared machine.

TF_API tf_input_t tf_input_default(const tf_machine_t *machine) {
  return (tf_input_t){machine->omega0, machine->r0, 0, 0, 0};
}

TF_API void tf_turntable_to(tf_input_t *input, tf_real_t omega0, tf_real_t dt) {
  input->alpha = (omega0 - input->omega0) / dt;
  input->omega0 = omega0;
}

TF_API tf_slip_t tf_slip(const tf_machine_t *machine, tf_real_t r, tf_real_t v,
                         tf_real_t w, tf_real_t omega0) {
  return slip_speeds(machine, r, v, w - omega0);
}

TF_API tf_status_t tf_speed_for_slip(const tf_machine_t *machine, tf_real_t r,
                                     tf_real_t w, tf_real_t omega0, tf_real_t h,
                                     tf_real_t *v) {
  const tf_real_t z = w - omega0;
  if (!(magnitude(machine->sin_gamma) >= TF_MIN_SINE)) return TF_BAD_STATE;
  *v = machine->d * z - (h + r * z * machine->cos_gamma) / machine->sin_gamma;
  return TF_OK;
}

TF_API tf_real_t tf_energy(const tf_machine_t *machine, const tf_state_t *state,
                           tf_real_t r0) {
  return twice_energy(machine, state->r, state->v, state->w, r0) / 2;
}

// The field of the machine at h = g = 0.

TF_API rates_t tf_rates_at(const tf_machine_t *k, const tf_input_t *input,
                           tf_real_t r, tf_real_t p, tf_real_t z,
                           tf_real_t omega) {
  return rates_at(k, input, r, p, z, omega);
}

TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates) {
  const tf_slip_t free = slip_from_pq(k, rates->dp, rates->dq);
  const tf_slip_t F = slip_from_pq(k, rates->Fp, rates->Fq);
  const tf_slip_t M = slip_from_pq(k, 0, rates->Mq);
  const tf_contact_t *contact = &k->contact;
  const tf_real_t mu = contact->tyre.mu, kappa_mu = contact->kappa_mu;
  return (codim2_field_t){{free.h, mu * F.h, kappa_mu * M.h},
                          {free.g, mu * F.g, kappa_mu * M.g},
                          {rates->pinning.F * contact->inv_mu,
                           rates->pinning.M * contact->inv_kappa_mu}};
}
