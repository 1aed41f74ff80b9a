// The regions of h = 0 and the field along it (Filippov 1988). The region comes
// from the same enumeration of modes that the located step uses.
#include "../friction/mode_set.h"
#include "../model/rates.h"
#include "field.h"
#include "twofold/singularity.h"

TF_API const char *tf_region_name(unsigned region) {
  static const char *const names[TF_REGIONS] = {
      "sliding", "escaping", "crossing_up", "crossing_down", "codim2"};
  return region < TF_REGIONS ? names[region] : "unknown";
}

// (slidCond), by which of the slips leave.
static unsigned region_of(unsigned set) {
  switch (set & SLIPS) {
    case SLIPS:
      return TF_REGION_ESCAPING;
    case TF_MODE_BIT(TF_SLIP_PLUS):
      return TF_REGION_UP;
    case TF_MODE_BIT(TF_SLIP_MINUS):
      return TF_REGION_DOWN;
    default:
      return TF_REGION_SLIDING;
  }
}

// (slidRescale): A (svf) = A f(x, 0) + N f_lambda. Its r component is A v.
static tf_rate_t rescaled_field(const tf_machine_t *k, const tf_input_t *input,
                                const field_point_t *x) {
  const tf_rate_t f0 = field_under(k, input, x, 0);
  const tf_real_t N = x->rates.N, A = x->rates.A[x->s];
  return (tf_rate_t){A * f0.r,
                     A * f0.v + N * (x->rates.Fp + k->d * x->z_per_lambda),
                     A * f0.w + N * x->z_per_lambda};
}

static tf_surface_t surface_of(const tf_machine_t *k, const tf_input_t *input,
                               const field_point_t *x, tf_slip_t slip) {
  tf_surface_t out = {.slip = slip};
  consistent_modes_t consistent;
  surface_modes(k, &x->rates, x->s, &consistent);
  const slip_limits_t h_rate = slip_limits(k, &x->rates, x->s);
  const tf_real_t A = x->rates.A[x->s], lambda = x->rates.N / A;
  out.region = (uint8_t)region_of(consistent.solutions.set);
  out.lie_plus = h_rate.plus;
  out.lie_minus = h_rate.minus;
  out.delassus = A;
  out.lambda_is_given = within(lambda, TF_REAL_MAX);
  out.lambda = out.lambda_is_given ? lambda : 0;
  out.plus = field_under(k, input, x, k->contact.tyre.mu);
  out.minus = field_under(k, input, x, -k->contact.tyre.mu);
  out.scaled = rescaled_field(k, input, x);
  if (out.region <= TF_REGION_ESCAPING)
    out.stick = field_under(k, input, x, consistent.lambda[x->s]);
  return out;
}

TF_API tf_status_t tf_surface_at(const tf_machine_t *machine,
                                 const tf_input_t *input, tf_real_t r,
                                 tf_real_t v, tf_real_t w, tf_surface_t *out) {
  const tf_state_t state = {.r = r, .v = v, .w = w};
  if (!tf_tyre_is_set_valued(machine->contact.tyre.law))
    return TF_BAD_PARAMETER;
  if (!in_range(&state, input)) return TF_BAD_STATE;
  const tf_slip_t slip = slip_speeds(machine, r, v, w - input->omega0);
  // Without a moment nothing depends on s = sign(g), and h = g = 0 is a point
  // like any other.
  if (machine->contact.stick_kappa > 0 && !(slip.g > 0) && !(slip.g < 0)) {
    *out = (tf_surface_t){.slip = slip, .region = TF_REGION_CODIM2};
    return TF_OK;
  }
  const field_point_t x =
      field_point_at(machine, input, r, v, w, sign_of(slip.g));
  const tf_surface_t at = surface_of(machine, input, &x, slip);
  if (!within(size_of_rate(&at.plus) + size_of_rate(&at.minus) +
                  size_of_rate(&at.scaled) + magnitude(at.lie_plus) +
                  magnitude(at.lie_minus),
              TF_REAL_MAX))
    return TF_BAD_STATE;
  *out = at;
  return TF_OK;
}
