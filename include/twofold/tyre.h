/// @file
/// Tyre laws: friction force F [N] and aligning moment M [N m] as functions of
/// the slip angle, that is of the ratio g/h of rolling to lateral slip.
#ifndef TWOFOLD_TYRE_H
#define TWOFOLD_TYRE_H

#include "twofold/real.h"

TF_BEGIN_C

/// Which law. Those that jump at h = 0 are set-valued there, the others are
/// single-valued off h = g = 0.
typedef enum {
  TF_TYRE_JUMP,      ///< the paper's law (force), (moment): jumps at h = 0
  TF_TYRE_COULOMB,   ///< F = mu sign(h), no moment: jumps at h = 0
  TF_TYRE_TWO_PIECE, ///< Appendix B before its jump is introduced
  TF_TYRE_STRING,    ///< Appendix B, stretched string, all three cases
  TF_TYRE_SMOOTH,    ///< the paper's law with sign(h) smoothed over epsilon
  TF_TYRE_NONE       ///< no contact
} tf_tyre_law_t;
#define TF_TYRE_LAWS 6

/// "jump" "coulomb" "two_piece" "string" "smooth" "none".
#define tf_tyre_law_name TF_LINK(tf_tyre_law_name)
TF_API const char *tf_tyre_law_name(unsigned law);

/// Anchors of the kernel tan(a atan y): multiples of pi/16 on [0, pi/2].
#define TF_TYRE_ANCHORS 9
/// Taylor coefficients that the real type needs between two anchors.
#ifdef TF_REAL_FLOAT
#define TF_TYRE_TERMS 4
#else
#define TF_TYRE_TERMS 8
#endif

/// Constants of one law, filled by tf_prepare and const from then on.
typedef struct {
  tf_tyre_law_t law;
  tf_real_t mu;                        ///< friction force at h -> 0 [N]
  tf_real_t kappa;                     ///< moment / force at h -> 0 [m]
  tf_real_t inv_18_kappa, inv_6_kappa; ///< 1 / (18 kappa) and so on [1/m]
  tf_real_t T_anchor[TF_TYRE_ANCHORS]; ///< T(tan(n pi/16)), [8] = 6 kappa
  tf_real_t T_series[TF_TYRE_TERMS];   ///< T(y) = y sum c_n y^(2n) near y = 0
  tf_real_t epsilon;                   ///< width of the smoothed sign [m/s]
  tf_real_t stiffness;                 ///< string: stiffness / mu [1/m^2]
  tf_real_t delta;                     ///< string: largest static pressure / mu
  tf_real_t sigma;                     ///< string: relaxation length [m]
  tf_real_t rho;                       ///< string: dynamic / static pressure
  tf_real_t a;                         ///< string: half contact length [m]
} tf_tyre_t;

/// Force and moment on the wheel.
typedef struct {
  tf_real_t F; ///< F > 0 lowers h [N]
  tf_real_t M; ///< on phi alone [N m]
} tf_force_t;

/// Force and moment in slip: (force), (moment) for JUMP; Appendix B for
/// TWO_PIECE and STRING.
/// tyre: in. h, g: in [m/s], finite.
/// side: in, +1 or -1: at a set-valued law, the side of h = 0 whose limit is
///   meant; an h on the other side counts as 0.
/// Returns: F, M; both 0 at h = 0 for the laws that are continuous there, and
///   at h = g = 0 for those where the angle is undefined.
#define tf_tyre_force TF_LINK(tf_tyre_force)
TF_API tf_force_t tf_tyre_force(const tf_tyre_t *tyre, tf_real_t side,
                                tf_real_t h, tf_real_t g);

/// Whether the law is set-valued at h = 0, so that stick exists: 1 or 0.
static inline int tf_tyre_is_set_valued(tf_tyre_law_t law) {
  return law == TF_TYRE_JUMP || law == TF_TYRE_COULOMB;
}

TF_END_C

#endif
