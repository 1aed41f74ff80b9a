// kappa and k2 from a wished two-fold. The spring enters h' linearly, and not
// at all where it is at rest, so h' is taken there.
#include "twofold/design.h"

#include <stddef.h>

#include "field.h"

#define LEAST_HOLD TF_R(1e-6) // of sin(gamma) on v, as in tf_speed_for_slip

static bool in_its_range(size_t offset, tf_real_t value) {
  int i = 0;
  for (int n = 0; n < TF_PARAMETERS; n++)
    if (tf_parameter_ranges[n].offset == offset) i = n;
  return value >= tf_parameter_ranges[i].low &&
         value <= tf_parameter_ranges[i].high;
}

// What can be told before anything is computed.
static tf_design_obstacle_t obstacle_of(const tf_machine_t *k,
                                        const tf_input_t *input, tf_real_t r,
                                        tf_real_t w) {
  const tf_state_t at_r = {.r = r}, at_w = {.w = w};
  if (k->tyre.law != TF_TYRE_JUMP || !(k->tyre.mu > 0)) return TF_DESIGN_LAW;
  if (!(magnitude(k->sin_gamma) >= LEAST_HOLD) ||
      !(magnitude(k->cos_gamma) >= LEAST_HOLD))
    return TF_DESIGN_GAMMA;
  if (r == 0 || !in_range(&at_r, input)) return TF_DESIGN_R;
  if (w - input->omega0 == 0 || !in_range(&at_w, input)) return TF_DESIGN_OMEGA;
  return TF_DESIGN_FOUND;
}

// (singKappa), (singK2) by h' = 0 at lambda = 0.
static tf_design_obstacle_t solve(const tf_machine_t *k,
                                  const tf_input_t *input,
                                  const tf_surface_point_t *place,
                                  tf_design_t *out) {
  const tf_real_t r = place->r, arm = r * k->cos_gamma;
  const tf_real_t J = inertia_at(k, r);
  const tf_real_t sine = k->sin_gamma;
  const tf_real_t reach = (r * r + k->beta2 * sine * sine) / arm;
  tf_input_t slack = *input;
  slack.r0 = r;
  const field_point_t x = point_at(k, &slack, r, place->v, place->w, 0);
  const tf_real_t hold = (sine / k->m + k->d * arm / J) * (input->r0 - r);
  out->kappa = place->g < 0 ? reach : -reach;
  if (hold == 0) return TF_DESIGN_SPRING;
  out->k2 = x.a.N / hold;
  if (!within(out->kappa, TF_REAL_MAX)) return TF_DESIGN_R;
  if (!within(out->k2, TF_REAL_MAX)) return TF_DESIGN_SPRING;
  if (!in_its_range(offsetof(tf_params_t, kappa), out->kappa))
    return TF_DESIGN_KAPPA;
  if (!in_its_range(offsetof(tf_params_t, k2), out->k2)) return TF_DESIGN_K2;
  return TF_DESIGN_FOUND;
}

static tf_design_obstacle_t grant(const tf_machine_t *machine,
                                  const tf_input_t *input, tf_real_t r,
                                  tf_real_t w, tf_design_t *out) {
  const tf_real_t z = w - input->omega0, g = r * z / machine->sin_gamma;
  const tf_surface_point_t place = {r, machine->d * z - machine->cos_gamma * g,
                                    w, g};
  const tf_design_obstacle_t obstacle = solve(machine, input, &place, out);
  if (obstacle == TF_DESIGN_R || obstacle == TF_DESIGN_SPRING) return obstacle;
  tf_machine_t wished = *machine;
  wished.stick_kappa = out->kappa; // all that the normal form asks of the two
  wished.k2 = out->k2;
  return tf_normal_form(&wished, input, &place, &out->at) == TF_OK
             ? obstacle
             : TF_DESIGN_R;
}

TF_API tf_status_t tf_design_two_fold(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out) {
  tf_design_t wish = {0};
  tf_design_obstacle_t obstacle = obstacle_of(machine, input, r, w);
  if (obstacle == TF_DESIGN_FOUND)
    obstacle = grant(machine, input, r, w, &wish);
  if (obstacle != TF_DESIGN_FOUND && obstacle < TF_DESIGN_KAPPA)
    wish = (tf_design_t){0};
  wish.obstacle = (uint8_t)obstacle;
  *out = wish;
  return obstacle == TF_DESIGN_FOUND ? TF_OK : TF_BAD_PARAMETER;
}
