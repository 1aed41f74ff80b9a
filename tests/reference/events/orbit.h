/// @file
/// The motion from event to event, to a relative tolerance: the reference.
#ifndef REFERENCE_ORBIT_H
#define REFERENCE_ORBIT_H

#include "consistent.h"

typedef enum {
  REF_REACHED,     ///< the end of the time asked for
  REF_TWO_FOLD,    ///< the two-fold: what follows is not unique
  REF_NO_MODE,     ///< h = g = 0, and no mode under the law
  REF_SPIRALS_OUT, ///< h = g = 0, left by a spiral of no definite phase
  REF_TOO_LONG     ///< more events or evaluations than allowed
} ref_stop_t;

/// What happened at an event.
typedef enum {
  REF_CROSSES, ///< slip crosses h = 0
  REF_STICKS,  ///< slip becomes stick
  REF_LEAVES,  ///< stick becomes slip
  REF_TURNS,   ///< stick passes to the other side of g without rest (r = 0)
  REF_CODIM2,  ///< h = g = 0 reached
  REF_EVENTS
} ref_event_t;

typedef struct ref_orbit ref_orbit_t;
/// Called at each event, after the next mode was taken; may be NULL.
typedef void (*ref_watch_t)(const ref_orbit_t *orbit, ref_event_t event);

/// A motion under way. Set machine, x, mode, law, tolerance; ref_begin finds
/// the mode.
struct ref_orbit {
  ref_state_t x;
  ref_state_t at;              ///< where h = g = 0 was last reached
  ref_consistent_t consistent; ///< at the last event at h = 0
  real_t tolerance;
  real_t t;
  real_t step; ///< next step to try [s]
  const ref_machine_t *machine;
  ref_watch_t watch;
  void *context;
  long evaluations, limit; ///< of the right-hand side; limit 0: 20 million
  ref_law_t law;
  ref_mode_t mode;
  ref_mode_t arrived; ///< mode in which h = g = 0 was last reached
  ref_stop_t stop;
  int sign_g; ///< sign of g of the present slip or stick
  int events, codim2_count;
  int chosen; ///< of consistent.list
  int forced; ///< at the next h = g = 0 take this; REF_BY_RULE: by the rule
};
#define REF_BY_RULE (-3)

/// Starts at x. At h = 0 in `mode` where that is consistent; REF_MODES: in
/// stick where that is, as the simulator begins. At h = g = 0 by the rule.
void ref_begin(ref_orbit_t *orbit, const ref_machine_t *machine, ref_state_t x,
               ref_mode_t mode);
/// Goes on to time `end`.
ref_stop_t ref_run(ref_orbit_t *orbit, real_t end);
/// Leaves h = g = 0 by the future `index` of orbit->consistent, or rests.
void ref_leave(ref_orbit_t *orbit, int index);
/// One extrapolated step of length H from orbit->x within its mode.
/// Returns the error over the tolerance.
real_t ref_trial(ref_orbit_t *orbit, real_t H, ref_state_t *end);
/// Force of the present mode at x.
ref_force_t ref_force(const ref_orbit_t *orbit, ref_state_t x);
/// Reason of an end, in words.
const char *ref_stop_name(ref_stop_t stop);

#endif
