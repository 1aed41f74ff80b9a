/// @file
/// Every consistent mode of an instant, and the declared rule that takes one.
#ifndef REFERENCE_CONSISTENT_H
#define REFERENCE_CONSISTENT_H

#include "model.h"

/// The laws of rest at h = g = 0.
typedef enum {
  REF_BOW_TIE, ///< |M| <= kappa |F|, |F| <= mu
  REF_SQUARE,  ///< |M| <= kappa mu, |F| <= mu
  REF_HEXAGON, ///< |M| <= kappa mu, |F| <= 4 mu/3 - |M|/(3 kappa)
  REF_LAWS
} ref_law_t;

/// One way in which the motion goes on.
typedef struct {
  ref_mode_t mode;
  bool attracting; ///< stick: A > 0. Slip at h = g = 0: angle is attracting
  real_t rate;     ///< at h = g = 0: d rho/dt of leaving, > 0
  real_t angle;    ///< slip at h = g = 0: atan2(h, g) [rad], 0 to 2 pi
  bool family;     ///< slip at h = g = 0: many motions share the direction
} ref_consistent_mode_t;

#define REF_MAX_CONSISTENT 24
typedef struct {
  ref_consistent_mode_t list[REF_MAX_CONSISTENT];
  int count;
  bool rests[REF_LAWS]; ///< h = g = 0: rest is possible under the law
  ref_force_t resting;  ///< force that it takes
  int arriving;         ///< limit directions and sticks that come in
  bool spiral;          ///< winds out, with no limit direction
  real_t winding;       ///< change of ln rho in a turn; 0 where none turns
} ref_consistent_t;

/// The consistent modes at h = 0, g != 0.
void ref_consistent_edge(const ref_machine_t *machine, ref_state_t x,
                         ref_consistent_t *out);
/// The consistent modes at h = g = 0: limit directions, sticks that leave,
/// rest.
void ref_consistent_codim2(const ref_machine_t *machine, ref_state_t x,
                           ref_consistent_t *out);
/// Set of modes, one bit each; rest by the law.
unsigned ref_consistent_set(const ref_consistent_t *consistent, ref_law_t law);
/// The declared rule where the mode is lost: attracting stick, slip along an
/// attracting direction, rest, other slip, escaping stick; of one kind the one
/// that leaves faster. Returns an index of the list, REF_REST or REF_NONE.
#define REF_REST (-1)
#define REF_NONE (-2)
int ref_choose(const ref_consistent_t *consistent, ref_law_t law,
               int from_stick);

#endif
