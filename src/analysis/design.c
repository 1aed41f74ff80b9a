// kappa and k2 for a two-fold at a given point. There A = 0, which gives kappa,
// and N = 0, which the spring enters linearly.
#include "twofold/design.h"

#include <stddef.h>

#include "field.h"

static bool in_its_range(size_t offset, tf_real_t value) {
  int i = 0;
  for (int n = 0; n < TF_PARAMETERS; n++)
    if (tf_parameter_ranges[n].offset == offset) i = n;
  return value >= tf_parameter_ranges[i].low &&
         value <= tf_parameter_ranges[i].high;
}

// What can be said before anything is computed.
static tf_design_obstacle_t obstacle_at(const tf_machine_t *k,
                                        const tf_input_t *input, tf_real_t r,
                                        tf_real_t w) {
  const tf_state_t at_r = {.r = r}, at_w = {.w = w};
  if (k->contact.tyre.law != TF_TYRE_JUMP || !(k->contact.tyre.mu > 0))
    return TF_DESIGN_LAW;
  if (!(magnitude(k->sin_gamma) >= TF_MIN_SINE) ||
      !(magnitude(k->cos_gamma) >= TF_MIN_SINE))
    return TF_DESIGN_GAMMA;
  if (r == 0 || !in_range(&at_r, input)) return TF_DESIGN_R;
  if (w - input->omega0 == 0 || !in_range(&at_w, input)) return TF_DESIGN_OMEGA;
  return TF_DESIGN_FOUND;
}

// (stickV): the point of h = 0 at (r, w).
static tf_surface_point_t stick_point(const tf_machine_t *k,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w) {
  const tf_real_t z = w - input->omega0, g = r * z / k->sin_gamma;
  return surface_point(k, r, z, w, g);
}

// (singKappa): s kappa from A(r, s) = 0, and (singK2): k2 from N = 0. N is that
// of a spring at rest less k2 times what the spring does to h'.
static tf_design_obstacle_t solve_parameters(const tf_machine_t *k,
                                             const tf_input_t *input,
                                             const tf_surface_point_t *point,
                                             tf_design_t *out) {
  const tf_real_t r = point->r, arm = r * k->cos_gamma;
  const tf_real_t minus_s_kappa = (r * r + delassus_quadratic(k, PLUS).c) / arm;
  tf_input_t spring_at_rest = *input;
  spring_at_rest.r0 = r;
  const field_point_t x =
      field_point_at(k, &spring_at_rest, r, point->v, point->w, PLUS);
  const tf_real_t h_rate_per_k2 =
      (k->sin_gamma / k->m + k->d * arm / x.J) * (input->r0 - r);
  out->kappa = with_sign(sign_of(point->g), -minus_s_kappa);
  if (h_rate_per_k2 == 0) return TF_DESIGN_SPRING;
  out->k2 = x.rates.N / h_rate_per_k2;
  if (!within(out->kappa, TF_REAL_MAX)) return TF_DESIGN_R;
  if (!within(out->k2, TF_REAL_MAX)) return TF_DESIGN_SPRING;
  if (!in_its_range(offsetof(tf_params_t, kappa), out->kappa))
    return TF_DESIGN_KAPPA;
  if (!in_its_range(offsetof(tf_params_t, k2), out->k2)) return TF_DESIGN_K2;
  return TF_DESIGN_FOUND;
}

static tf_design_obstacle_t design_at(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out) {
  const tf_surface_point_t point = stick_point(machine, input, r, w);
  const tf_design_obstacle_t obstacle =
      solve_parameters(machine, input, &point, out);
  if (obstacle == TF_DESIGN_R || obstacle == TF_DESIGN_SPRING) return obstacle;
  // The normal form reads no other constant that depends on kappa or k2.
  tf_machine_t designed = *machine;
  designed.contact.stick_kappa = out->kappa;
  designed.k2 = out->k2;
  return tf_normal_form(&designed, input, &point, &out->two_fold) == TF_OK
             ? obstacle
             : TF_DESIGN_R;
}

TF_API tf_status_t tf_design_two_fold(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out) {
  tf_design_t design = {0};
  tf_design_obstacle_t obstacle = obstacle_at(machine, input, r, w);
  if (obstacle == TF_DESIGN_FOUND)
    obstacle = design_at(machine, input, r, w, &design);
  if (obstacle != TF_DESIGN_FOUND && obstacle < TF_DESIGN_KAPPA)
    design = (tf_design_t){0};
  design.obstacle = (uint8_t)obstacle;
  *out = design;
  return obstacle == TF_DESIGN_FOUND ? TF_OK : TF_BAD_PARAMETER;
}
