/// @file
/// The switching surface h = 0 as that of a Filippov system (Filippov,
/// Differential Equations with Discontinuous Righthand Sides, 1988): its
/// sliding, escaping and crossing regions, and the field along it, without a
/// step. All of it is in physical time. On h = 0, F = lambda and M = s kappa
/// lambda with s = sign(g), so that f(x, lambda) is affine in lambda, |lambda|
/// <= mu.
#ifndef TWOFOLD_SURFACE_H
#define TWOFOLD_SURFACE_H

#include "twofold/machine.h"

TF_BEGIN_C

/// How the state changes: a value of the right-hand side f.
typedef struct {
  tf_real_t r, v, w; ///< d/dt of each [m/s], [m/s^2], [rad/s^2]
} tf_rate_t;

/// What becomes of a motion at a point of h = 0. The borders of the regions
/// belong to SLIDING.
typedef enum {
  TF_REGION_SLIDING,  ///< both slips lead to it: attracting stick, A > 0
  TF_REGION_ESCAPING, ///< both slips lead away: stick may end, A < 0
  TF_REGION_UP,       ///< crossed from h < 0 to h > 0
  TF_REGION_DOWN,     ///< crossed from h > 0 to h < 0
  TF_REGION_CODIM2    ///< h = g = 0, of codimension two: s may be either
} tf_region_t;
#define TF_REGIONS 5

/// "sliding" "escaping" "crossing_up" "crossing_down" "codim2".
#define tf_region_name TF_LINK(tf_region_name)
TF_API const char *tf_region_name(unsigned region);

/// The surface at one point.
typedef struct {
  tf_slip_t slip; ///< h, g [m/s]; h says how far the point is from h = 0
  tf_real_t lie_plus, lie_minus; ///< h_x . f(x, +mu), h_x . f(x, -mu) [m/s^2]
  tf_real_t delassus;            ///< A = -h_x . f_lambda [1/kg]
  tf_real_t lambda;      ///< (muCalc) [N]; |lambda| > mu where h = 0 is crossed
  tf_rate_t plus, minus; ///< f(x, +mu), f(x, -mu)
  tf_rate_t stick;       ///< (svf) in sliding and escaping regions, else 0
  tf_rate_t scaled;      ///< A (svf) [1/kg of it]: regular at a two-fold
  uint8_t region;        ///< tf_region_t
  bool lambda_is_given;  ///< false, lambda = 0: A is 0, or N/A overflows
} tf_surface_t;

/// The surface at a point of it: h' = N - A lambda, N = h_x . f(x, 0);
/// (slidCond), (muCalc), (svf), and scaled = A f(x, 0) + N f_lambda, which is
/// (slidRescale) with the opposite sign, so that it points along (svf) where
/// A > 0 and against it where A < 0.
/// machine: in, of a law that jumps (JUMP, COULOMB).
/// input: in; the acceleration of the turntable is part of h'.
/// r [m], v [m/s], w [rad/s]: in; on h = 0 by the caller (tf_speed_for_slip).
/// out: out. At h = g = 0 slip and region are set and all else is 0.
/// Returns: TF_OK; TF_BAD_PARAMETER (the law is single-valued: no surface),
///   TF_BAD_STATE (out of range, or a product overflows): out is untouched.
#define tf_surface_at TF_LINK(tf_surface_at)
TF_API tf_status_t tf_surface_at(const tf_machine_t *machine,
                                 const tf_input_t *input, tf_real_t r,
                                 tf_real_t v, tf_real_t w, tf_surface_t *out);

TF_END_C

#endif
