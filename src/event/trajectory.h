// One segment of the located step: a stretch of time without an event. Its kind
// decides how the series are closed and which events can end it.
#ifndef TF_TRAJECTORY_H
#define TF_TRAJECTORY_H

#include "../model/rates.h"
#include "series.h"
#include "twofold/machine.h"

// How the contact gives the force, which closes the recurrence of the series.
typedef enum {
  SEGMENT_FREE,           // no contact, no force
  SEGMENT_SLIP,           // slip away from h = g = 0
  SEGMENT_CODIM2_SLIP,    // slip out of h = g = 0 along a limit direction
  SEGMENT_STICK,          // stick, h = 0
  SEGMENT_TWO_FOLD_STICK, // stick out of a two-fold
  SEGMENT_PINNED          // h = g = 0 throughout
} segment_kind_t;

typedef struct {
  segment_kind_t kind;
  sign_t sign_h, sign_g; // inside the segment; at its start h, g may be 0
  tf_real_t T;           // cot(psi) at the start, for SEGMENT_CODIM2_SLIP
  int h_zero_order;      // order of the zero that h has at the start
  bool g_starts_at_zero; // whether g is 0 at the start
  bool A_starts_at_zero; // whether the Delassus scalar is
} segment_t;

typedef enum {
  EVENT_NONE,
  EVENT_G_ZERO,   // slip passes g = 0, where M changes its sign
  EVENT_H_ZERO,   // slip reaches h = 0
  EVENT_CODIM2,   // slip or stick reaches h = g = 0
  EVENT_RELEASE,  // |lambda| = mu in stick
  EVENT_TWO_FOLD, // A = 0 in stick
  EVENT_UNPINNED  // a wheel at rest has a future that ends it
} event_t;

// Computes the series of a segment from their terms 0, with as many terms as
// the tolerance of the machine needs over a time. False where there is no
// solution: a stick needs A != 0, and one from a two-fold A' != 0.
#define tf_taylor_coefficients TF_LINK(tf_taylor_coefficients)
TF_API bool tf_taylor_coefficients(taylor_t *motion, const segment_t *segment,
                                   tf_real_t time);

// An error that is allowed over a time [m/s]: what does not hang on the time,
// and what goes with it, as the change of the velocities does. A force that
// stops them within a part of the time changes them by a part of what it would.
typedef struct {
  tf_real_t at_once, by_change;
} series_error_t;

// The longest part of a time over which the last two terms of a series of the
// highest order stay below the error that is allowed; 0 where there is none.
#define tf_segment_length TF_LINK(tf_segment_length)
TF_API tf_real_t tf_segment_length(const taylor_t *motion, tf_real_t time,
                                   series_error_t allowed);

// The change of the angle of the disc since time 0 of the series [rad].
#define tf_angle_change TF_LINK(tf_angle_change)
TF_API tf_real_t tf_angle_change(const taylor_t *motion, tf_real_t t);

// The first event in (0, length] and its time; length itself without an event.
#define tf_next_event TF_LINK(tf_next_event)
TF_API event_t tf_next_event(const taylor_t *motion, const segment_t *segment,
                             tf_real_t length, tf_real_t *time);

// A located step under way: where the trajectory is, the segment it is on, and
// what the step has met so far.
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
  unsigned set;  // the largest set of consistent modes met in the step
  unsigned here; // that of the last change
  tf_force_t force;
  const tf_state_t *state; // that the step began with
} trajectory_t;

TF_INLINE tf_slip_t trajectory_slip(const trajectory_t *path) {
  return slip_from_pq(path->motion.machine, path->now.p,
                      path->now.r * path->now.z);
}

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

// Slip near h = g = 0, where the equations are stiff.

// Whether a slip is near h = g = 0 and a segment of this length much shorter
// than the motion from or to there: it may be stiff then.
#define tf_may_be_stiff TF_LINK(tf_may_be_stiff)
TF_API bool tf_may_be_stiff(const trajectory_t *path, tf_real_t length);

// Moves along the limit direction that attracts the slip, to h = g = 0 at most.
// False, and nothing has changed, where the slip is further from that direction
// than the error that is allowed.
#define tf_follow_limit_direction TF_LINK(tf_follow_limit_direction)
TF_API bool tf_follow_limit_direction(trajectory_t *path, tf_real_t allowed);

// Which segment comes next: at the start of a step and after each event.

// The segment at the start of the step. The user may have set the state, and
// the inputs may have jumped, so its mode alone does not decide. False where no
// mode is admissible.
#define tf_first_segment TF_LINK(tf_first_segment)
TF_API bool tf_first_segment(trajectory_t *path);

// The segment after an event, or after the end of one without an event. False
// where no mode is admissible.
#define tf_next_segment TF_LINK(tf_next_segment)
TF_API bool tf_next_segment(trajectory_t *path, event_t event);

#endif
