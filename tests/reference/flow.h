/// One step of the reference within a mode, up to the first event in it.
#ifndef REFERENCE_FLOW_H
#define REFERENCE_FLOW_H

#include "reference.h"

/// A watched function that reached zero.
typedef enum {
  REF_AT_TIME,  ///< the time asked for
  REF_AT_G,     ///< g = 0
  REF_AT_H,     ///< slip: h = 0
  REF_AT_PLUS,  ///< stick: h' of slip+ turns its sign
  REF_AT_MINUS, ///< stick: h' of slip- does
  REF_AT_FOLD,  ///< stick: A = 0 within the law
  REF_AT_ZONE,  ///< slip: another zone of the string
  REF_AT_HULL,  ///< rest: its force leaves the law of rest
  REF_AT_BOW,   ///< rest: |M| = kappa |F|, where sticks begin or end
  REF_AT_NONE
} ref_at_t;

/// Rest, by inputs that move: how far the force is within |M| = kappa |F|.
ref_real_t ref_bow_margin(const ref_machine_t *machine, ref_state_t x);
static inline bool ref_slips(const ref_orbit_t *orbit) {
  return orbit->mode <= REF_SLIP_MINUS;
}
static inline bool ref_in_stick(const ref_orbit_t *orbit) {
  return orbit->mode == REF_STICK_PLUS || orbit->mode == REF_STICK_MINUS;
}
/// Takes one step, at most to the time `until`.
ref_at_t ref_advance(ref_orbit_t *orbit, ref_real_t until);
/// How (r, p, z, t) change in stretched time.
ref_state_t ref_slope(ref_orbit_t *orbit, ref_state_t x);

#endif
