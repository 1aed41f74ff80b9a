// Which futures there are at h = g = 0, where slip leaves along its limit
// directions.
#ifndef TF_CORNER_H
#define TF_CORNER_H

#include "consistent.h"

// The limit direction of one quadrant of the (g, h) plane to which slip near
// h = g = 0 turns, whether it falls in or leaves: its cot(psi). False where
// there is none.
#define tf_corner_attractor TF_LINK(tf_corner_attractor)
TF_API bool tf_corner_attractor(const tf_machine_t *k, const tf_rates_t *a,
                                int roll, int side, tf_real_t *T);

// At h = g = 0 under a law with a moment.
#define tf_corner_futures TF_LINK(tf_corner_futures)
TF_API void tf_corner_futures(const tf_machine_t *k, const tf_rates_t *a,
                              tf_futures_t *out);

#endif
