// A located step under way: where the trajectory is, the segment it is on, and
// what the step has met so far.
#ifndef TF_TRAJECTORY_H
#define TF_TRAJECTORY_H

#include "segment.h"
#include "twofold/machine.h"

typedef struct {
  taylor_t motion; // series of the segment, from its start
  segment_t segment;
  phase_point_t now;
  tf_real_t omega;     // speed of the turntable now [rad/s]
  tf_real_t turn;      // by how much it changes in the step, without sign
  tf_real_t remaining; // time until the end of the step [s]
  tf_real_t angle;     // of the disc, since the start of the step [rad]
  bool is_over;        // at the end of the step, and force is that of the end
  bool is_unsure;      // a slip has come to h = g = 0, or as a stick: not known
  uint16_t spent; // of the budget: segments, and tries of a limit direction
  unsigned mode;
  unsigned set; // the largest set of consistent modes met in the step
  tf_force_t force;
  const tf_state_t *state; // that the step began with
} trajectory_t;

// Slip now.
TF_INLINE tf_slip_t trajectory_slip(const trajectory_t *path) {
  return slip_from_pq(path->motion.machine, path->now.p,
                      path->now.r * path->now.z);
}

// Accelerations now.
#define tf_trajectory_rates TF_LINK(tf_trajectory_rates)
TF_API rates_t tf_trajectory_rates(const trajectory_t *path);

// What rounding makes of h and g at a point of the step. That of omega is one
// of omega0 at the end and of its change: where omega0 passes 0 they are larger
// than it is.
TF_INLINE tf_real_t step_rounding(const trajectory_t *path, end_state_t at,
                                  tf_real_t omega) {
  return slip_rounding(path->motion.machine, at.r, at.v, at.w,
                       magnitude(omega) + path->turn);
}

// By how much the h and g of a point of a series may be off by rounding [m/s]:
// an eighth of the bound by which a state is at h = 0, because that point is
// the value of a polynomial and not the end of a step.
TF_INLINE tf_real_t trajectory_rounding(const trajectory_t *path) {
  const phase_point_t at = path->now;
  const tf_real_t v = slider_velocity(path->motion.machine, at.p, at.z);
  return step_rounding(path, (end_state_t){at.r, v, at.z + path->omega},
                       path->omega) /
         8;
}

// Computes the series of the segment from the point where the trajectory is.
// False as tf_taylor_coefficients.
#define tf_begin_series TF_LINK(tf_begin_series)
TF_API bool tf_begin_series(trajectory_t *path);

// How far a segment goes [s], and how far off it may be there [m/s].
typedef struct {
  tf_real_t length, error;
} span_t;

// Of the series: they have as many terms as they need to go on to the end of
// the step, or, where all terms are not enough, end before that. The error that
// is allowed is the tolerance of the machine times what the velocities are and
// may change by in the rest of the step.
#define tf_segment_span TF_LINK(tf_segment_span)
TF_API span_t tf_segment_span(const trajectory_t *path);

// Moves along the series from one of its times to another.
#define tf_advance TF_LINK(tf_advance)
TF_API void tf_advance(trajectory_t *path, tf_real_t from, tf_real_t to);

// Takes the force of the series at one of its times. A segment that another one
// follows needs none, but for what ends a stick.
#define tf_take_force TF_LINK(tf_take_force)
TF_API void tf_take_force(trajectory_t *path, tf_real_t time);

// Puts the trajectory on h = 0 by an impulse of the friction force, which is
// the shortest path there in the metric of the kinetic energy.
#define tf_project TF_LINK(tf_project)
TF_API void tf_project(trajectory_t *path);

#endif
