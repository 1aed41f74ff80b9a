/// @file
/// The surface h = 0 as a plane: what it is at (r, omega).
#ifndef TWOFOLD_FIGURES_PLACE_H
#define TWOFOLD_FIGURES_PLACE_H

#include "twofold.h"

static inline tf_surface_t surface_at(const tf_machine_t *machine,
                                      const tf_input_t *input, double r,
                                      double w) {
  tf_surface_t at = {.region = TF_REGION_CODIM2};
  tf_real_t v = 0;
  (void)tf_speed_for_slip(machine, (tf_real_t)r, (tf_real_t)w, input->omega0, 0,
                          &v);
  (void)tf_surface_at(machine, input, (tf_real_t)r, v, (tf_real_t)w, &at);
  return at;
}

#endif
