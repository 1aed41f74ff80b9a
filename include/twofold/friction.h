/// @file
/// The inclusion of one step and its whole solution set.
///
/// With the free end-of-step slip speeds (friction left out) the law at the
/// end of the step reads, for s = sign(g+) and F = lambda, M = s kappa lambda,
///   h+ = h_free + h1[s] lambda + h2[s] lambda^2 = h_s(lambda)
///   g+ = g_free + g1[s] lambda + g2[s] lambda^2 = g_s(lambda)
///   lambda in mu Sgn(h+),  s in Sgn(g+)                              (incl)
/// The quadratic terms come from r+ moving with v+. Up to five modes solve it.
#ifndef TWOFOLD_FRICTION_H
#define TWOFOLD_FRICTION_H

#include <stdint.h>

#include "twofold/real.h"
#include "twofold/tyre.h"

/// The five modes of contact.
typedef enum {
  TF_SLIP_PLUS,   ///< h > 0
  TF_SLIP_MINUS,  ///< h < 0
  TF_STICK_PLUS,  ///< h = 0, g > 0
  TF_STICK_MINUS, ///< h = 0, g < 0
  TF_PINNED       ///< h = g = 0
} tf_mode_t;
#define TF_MODES 5
#define TF_MODE_BIT(mode) (1u << (mode))

/// Name of a mode: "slip+" "slip-" "stick+" "stick-" "pinned".
/// Scheme: none.
/// mode: in.
/// Returns: a constant string, never NULL.
/// Cost: one table look-up. Stack: 32 B.
/// Memory: static storage, reentrant.
/// Claims: mode_names_are_the_contract
#define tf_mode_name TF_LINK(tf_mode_name)
TF_API const char *tf_mode_name(unsigned mode);

/// The inclusion (incl) of one step. Index 0 is s = +1, index 1 is s = -1.
typedef struct {
  tf_real_t mu;             ///< [N], >= 0
  tf_real_t kappa;          ///< [m]; 0 where stick carries no moment
  tf_real_t h_free, g_free; ///< slip speeds at lambda = 0 [m/s]
  tf_real_t h1[2], g1[2];   ///< [m/s/N]; -h1/dt is the Delassus scalar
  tf_real_t h2[2], g2[2];   ///< [m/s/N^2]
  tf_real_t h_MM, g_MM;     ///< second-order answer to M alone [m/s/(N m)^2]
  tf_real_t g_now;          ///< g before the step: decides a tie of s
  tf_force_t pin;           ///< the F, M that end the step at h = g = 0
  uint8_t signs;            ///< which s can occur: bit 0 +1, bit 1 -1. Members
                            ///< of an s that cannot are not read, and pin is
                            ///< read only where both can
} tf_inclusion_t;

/// All solutions of (incl).
typedef struct {
  uint8_t set;          ///< bit TF_MODE_BIT(mode) for each consistent mode
  uint8_t attracting;   ///< bits of the sticks with a positive Delassus scalar
  uint8_t near_stick;   ///< the stick on the present side of g: decides a tie
  tf_real_t lambda[2];  ///< F of stick+, stick- where in the set, in [-mu, mu]
  tf_real_t tau[2];     ///< M / (kappa F) at h -> 0 of slip+, slip-
  tf_real_t h_limit[2]; ///< h+ of slip+, slip- under the force at h -> 0
} tf_solutions_t;

/// Enumerates the consistent modes, in closed form, never by iteration.
/// Scheme: (incl). Whether stick exists is read off the signs of h_s(+-mu)
///   (intermediate value theorem), so the count is 1 or 3 by construction and
///   never hangs on a division by a Delassus scalar near 0.
/// inclusion: in, all members finite.
/// solutions: out.
/// Returns: nothing; an empty set is possible (friction is not associated).
/// Cost: 130 operations, 3 divisions and a square root a stick. Stack: 160 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: enumeration_against_grid_search, one_or_three_solutions
#define tf_friction_solve TF_LINK(tf_friction_solve)
TF_API void tf_friction_solve(const tf_inclusion_t *inclusion,
                              tf_solutions_t *solutions);

/// How far a contact force is from the law at slip (h, g): its zero set is the
/// law's graph, without a tolerance and without the enumeration.
/// Scheme: natural map of F in mu Sgn(h), and the distance of M from kappa F
///   Sgn(g): |F - clip(F + h, -mu, mu)| + |M - kappa F sign(g)|, with 1 m/s
///   counted as 1 N and 1 N m as 1 N; at g = 0 the nearest of the segment.
/// mu: in [N].
/// kappa: in [m], 0 where no moment hangs on sign(g).
/// force: in.
/// h, g: in, slip [m/s].
/// Returns: residual >= 0 [N]; of rounding size at a solution.
/// Cost: 14 operations. Stack: 48 B.
/// Memory: none kept, reentrant.
/// Claims: residual_vanishes_at_solutions_only
#define tf_law_residual TF_LINK(tf_law_residual)
TF_API tf_real_t tf_law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g);

#endif
