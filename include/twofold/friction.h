/// @file
/// The inclusion of one step and its whole solution set.
///
/// Unknowns are the multipliers x = F / mu and y = M / (kappa mu) of the mean
/// force and moment of the step. The slip speeds at its end are quadratic
/// forms of them (r+ moves with v+), and the law holds there:
///   h+ = h(x, y),  g+ = g(x, y),  y = s x
///   x in Sgn(h+),  s in Sgn(g+)                                     (incl)
/// Up to five modes solve it.
#ifndef TWOFOLD_FRICTION_H
#define TWOFOLD_FRICTION_H

#include <stdbool.h>
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
/// Cost: at most 7 instructions. Stack: 16 B.
/// Memory: static storage, reentrant.
/// Claims: mode_names_are_the_contract
#define tf_mode_name TF_LINK(tf_mode_name)
TF_API const char *tf_mode_name(unsigned mode);

/// c0 + F x + M y + FF x^2 + FM x y + MM y^2, all [m/s].
typedef struct {
  tf_real_t c0, F, M, FF, FM, MM;
} tf_form_t;

/// The inclusion (incl) of one step.
typedef struct {
  tf_form_t h, g;
  tf_real_t g_now;        ///< g before the step: decides a tie of s [m/s]
  bool has_moment;        ///< false: M, FM, MM are 0 and stick depends on no s
  tf_real_t pin_x, pin_y; ///< the x, y that end the step at h = g = 0; read
                          ///< only where tf_friction_signs says both signs
} tf_inclusion_t;

/// Signs that g+ can have under the law: bit 0 for s = +1, bit 1 for s = -1.
/// Scheme: the sign of g at no force and at the corners |x| = |y| = 1; between
///   them g is affine but for terms of third order in dt.
/// inclusion: in. Returns: 1, 2 or 3.
/// Cost: at most 46 instructions. Stack: 144 B.
/// Memory: none kept, reentrant.
/// Claims: enumeration_against_grid_search
#define tf_friction_signs TF_LINK(tf_friction_signs)
TF_API unsigned tf_friction_signs(const tf_inclusion_t *inclusion);

/// All solutions of (incl).
typedef struct {
  uint8_t set;          ///< bit TF_MODE_BIT(mode) for each consistent mode
  uint8_t attracting;   ///< bits of the sticks with a positive Delassus scalar
  uint8_t near_stick;   ///< the stick on the present side of g: decides a tie
  tf_real_t x[2];       ///< of stick+, stick- where in the set, in [-1, 1]
  tf_real_t tau[2];     ///< y / x at h -> 0 of slip+, slip-
  tf_real_t h_limit[2]; ///< h+ of slip+, slip- under the force at h -> 0
} tf_solutions_t;

/// Enumerates the consistent modes, in closed form, never by iteration.
/// Scheme: (incl). Whether stick exists is read off the signs of h at x = +-1
///   (intermediate value theorem), so the count is 1 or 3 by construction and
///   never depends on a division by a Delassus scalar near 0.
/// inclusion: in, all members finite; pin as said there.
/// solutions: out.
/// Returns: nothing; an empty set is possible (friction is not associated).
/// Cost: at most 450 instructions. Stack: 352 B.
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
/// kappa: in [m], 0 where no moment depends on sign(g).
/// force: in.
/// h, g: in, slip [m/s].
/// Returns: residual >= 0 [N]; of rounding size at a solution.
/// Cost: at most 32 instructions. Stack: 128 B.
/// Memory: none kept, reentrant.
/// Claims: residual_vanishes_at_solutions_only
#define tf_law_residual TF_LINK(tf_law_residual)
TF_API tf_real_t tf_law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g);

#endif
