// A located step under way: where it is and which of the futures it follows.
#ifndef TF_WALK_H
#define TF_WALK_H

#include "segment.h"
#include "twofold/machine.h"

// A step under way.
typedef struct {
  tf_motion_t motion;
  tf_segment_t segment;
  tf_point_t at;
  tf_real_t omega; // of the turntable now
  tf_real_t left;  // of the step [s]
  tf_real_t phi;   // turned since the start of the step
  tf_real_t tolerance;
  bool coarse;  // tolerance was above the machine's
  bool is_over; // nothing is left, and the force is that of the end
  unsigned mode, set, choices;
  tf_force_t force;
  const tf_state_t *state;
} tf_walk_t;

// The largest set of futures of the step is the one to report.
#define tf_meet TF_LINK(tf_meet)
TF_API void tf_meet(tf_walk_t *walk, unsigned set);

// Slip now.
#define tf_walk_slip TF_LINK(tf_walk_slip)
TF_API tf_slip_t tf_walk_slip(const tf_walk_t *walk);

// Accelerations now.
#define tf_walk_rates TF_LINK(tf_walk_rates)
TF_API tf_rates_t tf_walk_rates(const tf_walk_t *walk);

// What the rounding of v, w and omega0 can make of h and g [m/s].
#define tf_walk_rounding TF_LINK(tf_walk_rounding)
TF_API tf_real_t tf_walk_rounding(const tf_walk_t *walk);

// Puts the point on h = 0 by an impulse of the friction force, the nearest way
// there in the metric of the kinetic energy.
#define tf_project TF_LINK(tf_project)
TF_API void tf_project(tf_walk_t *walk);

// Takes a mode; slip: how it closes where the mode is a slip.
#define tf_go_on_in TF_LINK(tf_go_on_in)
TF_API void tf_go_on_in(tf_walk_t *walk, unsigned mode, tf_closure_t slip,
                        tf_segment_t segment);

// On h = 0, g != 0: lists the futures and takes one; false where none is
// admissible.
#define tf_leave_surface TF_LINK(tf_leave_surface)
TF_API bool tf_leave_surface(tf_walk_t *walk);

// The same at h = g = 0; from_minus: reached at g < 0, and not pinned there.
#define tf_leave_corner TF_LINK(tf_leave_corner)
TF_API bool tf_leave_corner(tf_walk_t *walk, bool from_minus);

// What the step begins with: the state may have been placed by the user, and
// the inputs may have jumped.
#define tf_enter TF_LINK(tf_enter)
TF_API bool tf_enter(tf_walk_t *walk);

#endif
