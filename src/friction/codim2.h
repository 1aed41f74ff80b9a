// The consistent modes at h = g = 0, where slip leaves along its limit
// directions (Antali and Stepan 2018).
#ifndef TF_CODIM2_H
#define TF_CODIM2_H

#include "consistent.h"

// The limit direction of one quadrant of the (g, h) plane to which a slip near
// h = g = 0 turns, whether it falls in or leaves: its T = cot(psi). False where
// there is none.
#define tf_codim2_attractor TF_LINK(tf_codim2_attractor)
TF_API bool tf_codim2_attractor(const tf_machine_t *k, const rates_t *rates,
                                int sign_g, int sign_h, tf_real_t *T);

// The consistent modes at h = g = 0 under a law with a moment.
#define tf_codim2_modes TF_LINK(tf_codim2_modes)
TF_API void tf_codim2_modes(const tf_machine_t *k, const rates_t *rates,
                            consistent_modes_t *out);

#endif
