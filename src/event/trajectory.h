// A located step under way: where it is and which of the futures it follows.
#ifndef TF_TRAJECTORY_H
#define TF_TRAJECTORY_H

#include "segment.h"
#include "twofold/machine.h"

// A step under way.
typedef struct {
  tf_taylor_t motion;
  tf_segment_t segment;
  tf_phase_point_t at;
  tf_real_t omega; // of the turntable now
  tf_real_t left;  // of the step [s]
  tf_real_t phi;   // turned since the start of the step
  tf_real_t tolerance;
  bool coarse;  // tolerance was above the machine's
  bool is_over; // nothing is left, and the force is that of the end
  unsigned mode, set, choices;
  tf_force_t force;
  const tf_state_t *state;
} tf_trajectory_t;

// The largest set of futures of the step is the one to report.
#define tf_keep_largest_set TF_LINK(tf_keep_largest_set)
TF_API void tf_keep_largest_set(tf_trajectory_t *walk, unsigned set);

// Slip now.
#define tf_trajectory_slip TF_LINK(tf_trajectory_slip)
TF_API tf_slip_t tf_trajectory_slip(const tf_trajectory_t *walk);

// Accelerations now.
#define tf_trajectory_rates TF_LINK(tf_trajectory_rates)
TF_API tf_rates_t tf_trajectory_rates(const tf_trajectory_t *walk);

// What the rounding of v, w and omega0 can make of h and g [m/s].
#define tf_trajectory_rounding TF_LINK(tf_trajectory_rounding)
TF_API tf_real_t tf_trajectory_rounding(const tf_trajectory_t *walk);

// Puts the point on h = 0 by an impulse of the friction force, the nearest way
// there in the metric of the kinetic energy.
#define tf_project TF_LINK(tf_project)
TF_API void tf_project(tf_trajectory_t *walk);

// Takes a mode; slip: how it closes where the mode is a slip.
#define tf_enter_mode TF_LINK(tf_enter_mode)
TF_API void tf_enter_mode(tf_trajectory_t *walk, unsigned mode,
                          tf_contact_t slip, tf_segment_t segment);

// On h = 0, g != 0: lists the futures and takes one; false where none is
// admissible.
#define tf_leave_h_zero TF_LINK(tf_leave_h_zero)
TF_API bool tf_leave_h_zero(tf_trajectory_t *walk);

// The same at h = g = 0; from_minus: reached at g < 0, and not pinned there.
#define tf_leave_codim2 TF_LINK(tf_leave_codim2)
TF_API bool tf_leave_codim2(tf_trajectory_t *walk, bool from_minus);

// What the step begins with: the state may have been placed by the user, and
// the inputs may have jumped.
#define tf_first_segment TF_LINK(tf_first_segment)
TF_API bool tf_first_segment(tf_trajectory_t *walk);

#endif
