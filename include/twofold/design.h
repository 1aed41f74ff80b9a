/// @file
/// The kappa and k2 that put a two-fold at a given point, in closed form.
#ifndef TWOFOLD_DESIGN_H
#define TWOFOLD_DESIGN_H

#include "twofold/singularity.h"

TF_BEGIN_C

/// Why there can be no two-fold at the point; the first that applies.
typedef enum {
  TF_DESIGN_FOUND,  ///< there can
  TF_DESIGN_LAW,    ///< stick has no moment under this law, or mu = 0
  TF_DESIGN_GAMMA,  ///< |sin(gamma)| < TF_MIN_SINE (then w = omega0, r =
                    ///< -+kappa), or |cos(gamma)| is (A > 0 for every kappa)
  TF_DESIGN_R,      ///< r = 0, out of range, or a product overflows
  TF_DESIGN_OMEGA,  ///< w = omega0 (then g = 0), or out of range
  TF_DESIGN_SPRING, ///< r = r0 or p2(r) = 0: h' does not depend on k2
  TF_DESIGN_KAPPA,  ///< kappa would be out of its range
  TF_DESIGN_K2      ///< k2 would be out of its range
} tf_design_obstacle_t;

/// kappa and k2 that make the given point a two-fold.
typedef struct {
  tf_real_t kappa, k2;    ///< [m], [N/m]
  tf_two_fold_t two_fold; ///< the normal form under them
  uint8_t obstacle;       ///< tf_design_obstacle_t; where it is not FOUND the
                          ///< other members are 0, but those of KAPPA and K2,
                          ///< which are filled
} tf_design_t;

/// Puts a two-fold at (r, w): (stickV), (singKappa) with sign(g), (singK2) with
/// p2(r).
/// machine: in; its own kappa and k2 are not used. input: in.
/// r [m], w [rad/s]: in. out: out.
/// Returns: TF_OK (obstacle TF_DESIGN_FOUND); TF_BAD_PARAMETER (any other
///   obstacle; out is filled as tf_design_t says).
#define tf_design_two_fold TF_LINK(tf_design_two_fold)
TF_API tf_status_t tf_design_two_fold(const tf_machine_t *machine,
                                      const tf_input_t *input, tf_real_t r,
                                      tf_real_t w, tf_design_t *out);

TF_END_C

#endif
