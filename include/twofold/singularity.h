/// @file
/// Two-folds, in closed form: the points of h = 0 where the fields of both
/// slips are tangent to the surface (Filippov 1988; Teixeira, Stability
/// conditions for discontinuous vector fields, 1990). There lambda is not
/// determined. Stick may pass between a sliding and an escaping region, and the
/// future may not be unique. Also the surface h = 0 itself, and the design of a
/// machine with a two-fold at a point. Labels such as (svf) are the paper's.
#ifndef TWOFOLD_SINGULARITY_H
#define TWOFOLD_SINGULARITY_H

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

/// A point of h = 0.
typedef struct {
  tf_real_t r, v, w; ///< [m], [m/s], [rad/s]
  tf_real_t g;       ///< rolling speed, never 0 [m/s]
} tf_surface_point_t;

/// The most two-folds that a machine can have: two r, two g for each, two signs
/// of g. Few have so many; the paper's has two.
#define TF_TWO_FOLDS 8

/// Why a machine has no two-fold; the first that applies.
typedef enum {
  TF_ABSENCE_NONE,   ///< it has one
  TF_ABSENCE_LAW,    ///< the law does not jump at h = 0, or mu = 0
  TF_ABSENCE_MOMENT, ///< stick has no moment (law COULOMB): A > 0 everywhere
  TF_ABSENCE_ARM,    ///< kappa |cos(gamma)| < 2 beta |sin(gamma)|: likewise
  TF_ABSENCE_BALANCE ///< A vanishes, but h_x . f(x, 0) does not, on h = 0
                     ///< within TF_STATE_LIMIT, with the sign of g that A takes
} tf_absence_t;
#define TF_ABSENCES 5

/// What a tf_absence_t stands for, in words.
#define tf_absence_name TF_LINK(tf_absence_name)
TF_API const char *tf_absence_name(unsigned absence);

/// Every two-fold at g != 0, (2foldcond): A(r, s) = 0 is quadratic in r, and
/// h_x . f(x, 0) = 0 on h = 0 is quadratic in g. r = 0 with sin(gamma) = 0
/// (within 4 epsilon) is left out: A is 0 everywhere, and there is no stick.
/// machine: in. input: in; the acceleration of the turntable is part of h'.
/// points: out, [TF_TWO_FOLDS], those of g > 0 first. count: out, how many.
/// absence: out, may be NULL; why there is none.
/// Returns: TF_OK; TF_BAD_STATE (input out of range; nothing touched).
#define tf_two_folds TF_LINK(tf_two_folds)
TF_API tf_status_t tf_two_folds(const tf_machine_t *machine,
                                const tf_input_t *input,
                                tf_surface_point_t points[TF_TWO_FOLDS],
                                int *count, tf_absence_t *absence);

/// Which way the slips curve, by h'' = K++ of slip+ and K-- of slip-. A fold
/// is visible if its slip curves away from h = 0 on its own side.
typedef enum {
  TF_FOLDS_INVISIBLE,  ///< K++ < 0 < K--: Teixeira singularity, (Invisible)
  TF_FOLDS_VISIBLE,    ///< K++ > 0 > K--
  TF_FOLDS_MIXED,      ///< one of each
  TF_FOLDS_DEGENERATE, ///< K++ or K-- is 0
  TF_FOLDS_CONTINUOUS  ///< sin(gamma) = 0: both slips are one field
} tf_folds_t;
#define TF_FOLDS 5

/// "invisible" "visible" "visible-invisible" "degenerate" "continuous".
#define tf_folds_name TF_LINK(tf_folds_name)
TF_API const char *tf_folds_name(unsigned type);

/// A straight orbit of the stick motion next to a two-fold.
typedef struct {
  tf_real_t value; ///< eigenvalue in units of sqrt|K++ K--|
  /// Shares of f(x, +mu) and f(x, -mu) in the motion along it, with sum 1.
  tf_real_t plus, minus;
  tf_rate_t velocity; ///< plus f(x, +mu) + minus f(x, -mu): its direction and,
                      ///< where the motion sticks, its speed
  tf_real_t lambda;   ///< along it where the motion sticks, else 0 [N]
  bool sticks;        ///< not in crossing regions
} tf_direction_t;

/// The normal form of a two-fold. K is in physical time; the paper's, in its
/// rescaled time tau, is time_scale^2 K. J, eigenvalues and directions are the
/// same in both.
typedef struct {
  tf_surface_point_t point;
  tf_real_t residual;   ///< largest |h_x . f(x, +-mu)|, ideally 0 [m/s^2]
  tf_real_t time_scale; ///< dt/dtau = m (beta^2 + r^2) [kg m^2]
  tf_real_t Kpp, Kpm, Kmp, Kmm; ///< K++, K+-, K-+, K-- [m/s^3]
  tf_real_t J1, J2;             ///< with sqrt|K++ K--|, defined for every type
  /// (L+, L-) = (K++, K--), eigenvalue K-+ - K++ = 2 mu v dA/dr: it sticks
  /// where K++ K-- < 0, and leads from sliding to escaping where the eigenvalue
  /// is negative. The paper's first eigenvector.
  tf_direction_t through;
  /// L+ = L-, eigenvalue K++ - K+-: it lies in crossing regions along r =
  /// const, where A stays 0. The paper's second eigenvector.
  tf_direction_t across;
  tf_rate_t plus, minus; ///< f(x, +mu), f(x, -mu)
  uint8_t type;          ///< tf_folds_t
  uint8_t paper_case;    ///< 1, 2, 3; 0 on borders and for other types
} tf_two_fold_t;

/// The normal form at a two-fold: K^{ab} = d/dx (h_x . f(x, a mu)) . f(x, b mu)
/// and (SlidNormForm) with (L+, L-) = h_x . f(x, +-mu) as coordinates,
///   (L- - L+) d/dt (L+, L-) = ((-K+-, K++), (-K--, K-+)) (L+, L-).
/// K++ + K-- = K+- + K-+, as A depends on r alone: both eigenvalues are real,
/// rational in K. Inputs are held, but the turntable keeps its acceleration.
/// machine: in, of a law that jumps. input: in. out: out.
/// point: in, from tf_two_folds or tf_design_two_fold; r != 0, g != 0.
/// Returns: TF_OK; TF_BAD_PARAMETER (the law does not jump), TF_BAD_STATE
///   (point or input out of range, or a product overflows): out is untouched.
#define tf_normal_form TF_LINK(tf_normal_form)
TF_API tf_status_t tf_normal_form(const tf_machine_t *machine,
                                  const tf_input_t *input,
                                  const tf_surface_point_t *point,
                                  tf_two_fold_t *out);

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
