/// @file
/// Two-folds, in closed form: the points of h = 0 where the fields of both
/// slips are tangent to the surface (Filippov 1988; Teixeira, Stability
/// conditions for discontinuous vector fields, 1990). There lambda is not
/// determined, stick passes from a sliding into an escaping region or back, and
/// the future is not unique.
#ifndef TWOFOLD_SINGULARITY_H
#define TWOFOLD_SINGULARITY_H

#include "twofold/surface.h"

TF_BEGIN_C

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

/// Every two-fold at g != 0, (2foldcond): A(r, s) = 0 is a quadratic in r, and
/// h_x . f(x, 0) = 0 on h = 0 one in g. Not counted is r = 0 with sin(gamma)
/// = 0 (within 4 epsilon): A is 0 all over the surface, and there is no stick.
/// machine: in. input: in; the acceleration of the turntable is part of h'.
/// points: out, [TF_TWO_FOLDS], those of g > 0 first. count: out, how many.
/// absence: out, may be NULL; why there is none.
/// Returns: TF_OK; TF_BAD_STATE (input out of range; nothing touched).
#define tf_two_folds TF_LINK(tf_two_folds)
TF_API tf_status_t tf_two_folds(const tf_machine_t *machine,
                                const tf_input_t *input,
                                tf_surface_point_t points[TF_TWO_FOLDS],
                                int *count, tf_absence_t *absence);

/// Which way the slips curve, by h'' = K++ of slip+ and K-- of slip-. A visible
/// fold curves away from h = 0 on its own side of it.
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
  /// Shares of f(x, +mu) and f(x, -mu) in the motion along it, 1 in all.
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
  uint8_t paper_case;    ///< 1, 2, 3 for type INVISIBLE; else, on borders, 0
} tf_two_fold_t;

/// The normal form at a two-fold: K^{ab} = d/dx (h_x . f(x, a mu)) . f(x, b mu)
/// and (SlidNormForm) with (L+, L-) = h_x . f(x, +-mu) as coordinates,
///   (L- - L+) d/dt (L+, L-) = ((-K+-, K++), (-K--, K-+)) (L+, L-).
/// K++ + K-- = K+- + K-+, for A depends on r alone: both eigenvalues are real,
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

TF_END_C

#endif
