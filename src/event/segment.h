// One segment of the located step: a stretch of time without an event. Its
// contact decides how the series are closed and which events can end it.
#ifndef TF_SEGMENT_H
#define TF_SEGMENT_H

#include "../model/consistent.h"
#include "series.h"

// How the contact gives the force, which closes the recurrence of the series.
typedef enum {
  CONTACT_NONE,           // no contact, no force
  CONTACT_SLIP,           // slip away from h = g = 0
  CONTACT_CODIM2_SLIP,    // slip out of h = g = 0 along a limit direction
  CONTACT_STICK,          // stick, h = 0
  CONTACT_TWO_FOLD_STICK, // stick out of a two-fold
  CONTACT_PINNED          // h = g = 0 throughout
} contact_t;

typedef struct {
  contact_t contact;
  sign_t sign_h, sign_g; // inside the segment; at its start h, g may be 0
  tf_real_t T;           // cot(psi) at the start, for CONTACT_CODIM2_SLIP
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
// the tolerance of the machine asks for over a time. False where there is no
// solution: a stick needs A != 0, and one from a two-fold A' != 0.
#define tf_taylor_coefficients TF_LINK(tf_taylor_coefficients)
TF_API bool tf_taylor_coefficients(taylor_t *motion, const segment_t *segment,
                                   tf_real_t time);

// An error that is allowed over a time [m/s]: what does not hang on the time,
// and what goes with it, as the change of the velocities does. A force that
// stops them within a part of the time changes them by a part of what it would.
typedef struct {
  tf_real_t at_once, by_change;
} error_t;

// The longest part of a time over which the last two terms of a series of the
// highest order stay below the error that is allowed; 0 where there is none.
#define tf_segment_length TF_LINK(tf_segment_length)
TF_API tf_real_t tf_segment_length(const taylor_t *motion, tf_real_t time,
                                   error_t allowed);

// By how much the angle of the disc has changed since time 0 of the series
// [rad].
#define tf_angle_change TF_LINK(tf_angle_change)
TF_API tf_real_t tf_angle_change(const taylor_t *motion, tf_real_t t);

// The first event in (0, length] and its time; length itself without an event.
#define tf_next_event TF_LINK(tf_next_event)
TF_API event_t tf_next_event(const taylor_t *motion, const segment_t *segment,
                             tf_real_t length, tf_real_t *time);

#endif
