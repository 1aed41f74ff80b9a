// Regions of h = 0 and the field along it. Which region it is comes from the
// same enumeration of futures that the located step uses.
#include "twofold/surface.h"

#include "../friction/consistent.h"
#include "field.h"

TF_API const char *tf_region_name(unsigned region) {
  static const char *const names[TF_REGIONS] = {
      "sliding", "escaping", "crossing_up", "crossing_down", "codimension2"};
  return region < TF_REGIONS ? names[region] : "unknown";
}

#define SLIP_PLUS TF_MODE_BIT(TF_SLIP_PLUS)
#define SLIP_MINUS TF_MODE_BIT(TF_SLIP_MINUS)

static unsigned region_of(unsigned set) {
  switch (set & (SLIP_PLUS | SLIP_MINUS)) {
    case SLIP_PLUS | SLIP_MINUS:
      return TF_REGION_ESCAPING;
    case SLIP_PLUS:
      return TF_REGION_UP;
    case SLIP_MINUS:
      return TF_REGION_DOWN;
    default:
      return TF_REGION_SLIDING;
  }
}

// A (svf) = A f(x, 0) + N f_lambda. Its r component is A v.
static tf_rate_t scaled_field(const tf_machine_t *k, const tf_input_t *input,
                              const field_point_t *x, tf_real_t A) {
  const tf_rate_t f0 = field(k, input, x, 0);
  const tf_real_t N = x->a.N;
  return (tf_rate_t){A * f0.r, A * f0.v + N * (x->a.Fp + k->d * x->lever),
                     A * f0.w + N * x->lever};
}

static tf_surface_t look(const tf_machine_t *k, const tf_input_t *input,
                         const field_point_t *x, tf_slip_t slip) {
  tf_surface_t out = {.slip = slip};
  tf_consistent_t futures;
  surface_modes(k, &x->a, x->s, &futures);
  const tf_real_t A = x->a.A[x->s], lambda = x->a.N / A;
  out.region = (uint8_t)region_of(futures.solutions.set);
  out.lie_plus = futures.solutions.h_limit[0];
  out.lie_minus = futures.solutions.h_limit[1];
  out.delassus = A;
  out.lambda_is_given = within(lambda, TF_REAL_MAX);
  out.lambda = out.lambda_is_given ? lambda : 0;
  out.plus = field(k, input, x, k->tyre.mu);
  out.minus = field(k, input, x, -k->tyre.mu);
  out.scaled = scaled_field(k, input, x, A);
  if (out.region <= TF_REGION_ESCAPING)
    out.stick = field(k, input, x, futures.lambda[x->s]);
  return out;
}

TF_API tf_status_t tf_surface_at(const tf_machine_t *machine,
                                 const tf_input_t *input, tf_real_t r,
                                 tf_real_t v, tf_real_t w, tf_surface_t *out) {
  const tf_state_t state = {.r = r, .v = v, .w = w};
  if (!tf_tyre_is_set_valued(machine->tyre.law)) return TF_BAD_PARAMETER;
  if (!in_range(&state, input)) return TF_BAD_STATE;
  const tf_slip_t slip = slip_speeds(machine, r, v, w - input->omega0);
  // Without a moment s has no say, and h = g = 0 is a point like any other.
  if (machine->stick_kappa > 0 && !(slip.g > 0) && !(slip.g < 0)) {
    *out = (tf_surface_t){.slip = slip, .region = TF_REGION_CODIM2};
    return TF_OK;
  }
  const field_point_t x = point_at(machine, input, r, v, w, slip.g < 0);
  const tf_surface_t seen = look(machine, input, &x, slip);
  if (!within(size_of_rate(&seen.plus) + size_of_rate(&seen.minus) +
                  size_of_rate(&seen.scaled) + magnitude(seen.lie_plus) +
                  magnitude(seen.lie_minus),
              TF_REAL_MAX))
    return TF_BAD_STATE;
  *out = seen;
  return TF_OK;
}
