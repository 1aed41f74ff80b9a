// One segment of the located step: how it closes the series and where it ends.
#ifndef TF_SEGMENT_H
#define TF_SEGMENT_H

#include "../friction/codim2.h"
#include "series.h"

// How contact closes the recurrence of the series.
typedef enum {
  TF_CONTACT_NONE,           // no contact
  TF_CONTACT_SLIP,           // slip off h = g = 0
  TF_CONTACT_CODIM2_SLIP,    // slip from h = g = 0 along a limit direction
  TF_CONTACT_STICK,          // stick
  TF_CONTACT_TWO_FOLD_STICK, // stick from a two-fold
  TF_CONTACT_PINNED          // h = g = 0
} tf_contact_t;

typedef struct {
  tf_contact_t closure;
  int side, roll; // signs of h and g, as they are within the segment
  tf_real_t T;    // cot(psi) at the start, for TF_CONTACT_CODIM2_SLIP
  int h_zeros;    // order of the zero that h has at the start
  bool g_is_0;    // g is 0 at the start
  bool A_is_0;    // so is the Delassus scalar
} tf_segment_t;

typedef enum {
  TF_EVENT_NONE,
  TF_EVENT_G_ZERO,   // g = 0 in slip
  TF_EVENT_H_ZERO,   // h = 0 in slip
  TF_EVENT_CODIM2,   // h = g = 0
  TF_EVENT_RELEASE,  // |lambda| = mu in stick
  TF_EVENT_TWO_FOLD, // A = 0 in stick
  TF_EVENT_UNPINNED
} tf_event_t;

// Fills the series of a segment; false where it has none (A = 0 in stick).
#define tf_taylor_coefficients TF_LINK(tf_taylor_coefficients)
TF_API bool tf_taylor_coefficients(tf_taylor_t *s, const tf_segment_t *segment);

// Velocities [m/s] in the n-th term.
#define tf_term_size TF_LINK(tf_term_size)
TF_API tf_real_t tf_term_size(const tf_taylor_t *s, int n);

// The longest part of a time over which the series holds: its last two terms
// stay below what is allowed. 0 where there is none.
#define tf_segment_length TF_LINK(tf_segment_length)
TF_API tf_real_t tf_segment_length(const tf_taylor_t *s, tf_real_t time,
                                   tf_real_t allowed);

// Angle [rad] of the disc since time 0 of the series.
#define tf_angle_change TF_LINK(tf_angle_change)
TF_API tf_real_t tf_angle_change(const tf_taylor_t *s, tf_real_t t);

// The first switch in (0, length], and when. capture: the slip [m/s] below
// which h and g count as 0 together.
#define tf_next_event TF_LINK(tf_next_event)
TF_API tf_event_t tf_next_event(const tf_taylor_t *s,
                                const tf_segment_t *segment, tf_real_t length,
                                tf_real_t capture, tf_real_t *when);

#endif
