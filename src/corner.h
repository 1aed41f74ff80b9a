// Which futures an instant has: on the surface h = 0, and at h = g = 0, where
// slip leaves along its limit directions.
#ifndef TF_CORNER_H
#define TF_CORNER_H

#include "rates.h"
#include "twofold/friction.h"

// Solutions of an instant, for tf_select, and how slip leaves.
typedef struct {
  tf_solutions_t solutions;
  tf_real_t lambda[2]; // of stick+, stick-, where in the set
  tf_real_t T[2];      // cot(psi) along which slip+, slip- leave h = g = 0
  int roll[2];         // sign of g there
} tf_futures_t;

// On h = 0 at g != 0; s: 0 where g > 0, 1 where g < 0.
#define tf_surface_futures TF_LINK(tf_surface_futures)
TF_API void tf_surface_futures(const tf_machine_t *k, const tf_rates_t *a,
                               int s, tf_futures_t *out);

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
