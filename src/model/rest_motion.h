// A wheel at rest on a turntable that changes its speed: the force that holds
// it, and when the rest ends.
#ifndef TF_REST_MOTION_H
#define TF_REST_MOTION_H

#include "mechanics.h"

// No term of the force at rest is beyond those of w^2.
#define REST_ORDER 2

// The force and the moment of a wheel at rest, as polynomials in time.
typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  tf_real_t r, omega;  // omega: of the turntable at time 0
  tf_real_t inverse_m; // 1 / m
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2))
  tf_real_t arm;       // r cos(gamma)
  tf_real_t F[REST_ORDER + 1], M[REST_ORDER + 1];
} rest_motion_t;

#define tf_rest_motion TF_LINK(tf_rest_motion)
TF_API rest_motion_t tf_rest_motion(const tf_machine_t *k, const tf_input_t *u,
                                    tf_real_t r, tf_real_t omega);

// Whether something ends the rest within a time, which then becomes that of the
// first: it leaves its law, an attracting stick begins, or the slip does that
// the exit rule asks for.
#define tf_rest_ends TF_LINK(tf_rest_ends)
TF_API bool tf_rest_ends(const rest_motion_t *rest, tf_real_t *time);

// Whether within a time the rest leaves its law or an attracting stick is
// consistent, but not any more at its end: who looks only there misses it.
#define tf_rest_is_interrupted TF_LINK(tf_rest_is_interrupted)
TF_API bool tf_rest_is_interrupted(const rest_motion_t *rest, tf_real_t time);

#endif
