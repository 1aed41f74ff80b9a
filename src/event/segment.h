// One segment of the located step: how it closes the series and where it ends.
#ifndef TF_SEGMENT_H
#define TF_SEGMENT_H

#include "../friction/codim2.h"
#include "series.h"

// How contact closes the recurrence of the series.
typedef enum {
  TF_FREE,    // no contact
  TF_SLIDE,   // slip off h = g = 0
  TF_DEPART,  // slip from h = g = 0 along a limit direction
  TF_HOLD,    // stick
  TF_THROUGH, // stick from a two-fold
  TF_PIN      // h = g = 0
} tf_closure_t;

typedef struct {
  tf_closure_t closure;
  int side, roll; // signs of h and g, as they are within the segment
  tf_real_t T;    // cot(psi) at the start, for TF_DEPART
  int h_zeros;    // order of the zero that h has at the start
  bool g_is_0;    // g is 0 at the start
  bool A_is_0;    // so is the Delassus scalar
} tf_segment_t;

typedef enum {
  TF_NO_SWITCH,
  TF_KINK,    // g = 0 in slip
  TF_LANDING, // h = 0 in slip
  TF_CORNER,  // h = g = 0
  TF_RELEASE, // |lambda| = mu in stick
  TF_TWOFOLD, // A = 0 in stick
  TF_UNPINNED
} tf_switch_t;

// Fills the series of a segment; false where it has none (A = 0 in stick).
#define tf_expand TF_LINK(tf_expand)
TF_API bool tf_expand(tf_motion_t *s, const tf_segment_t *segment);

// Velocities [m/s] in the n-th term.
#define tf_term_size TF_LINK(tf_term_size)
TF_API tf_real_t tf_term_size(const tf_motion_t *s, int n);

// The longest part of a time over which the series holds: its last two terms
// stay below what is allowed. 0 where there is none.
#define tf_longest TF_LINK(tf_longest)
TF_API tf_real_t tf_longest(const tf_motion_t *s, tf_real_t time,
                            tf_real_t allowed);

// Angle [rad] of the disc since time 0 of the series.
#define tf_turned TF_LINK(tf_turned)
TF_API tf_real_t tf_turned(const tf_motion_t *s, tf_real_t t);

// The first switch in (0, length], and when. capture: the slip [m/s] below
// which h and g count as 0 together.
#define tf_next_switch TF_LINK(tf_next_switch)
TF_API tf_switch_t tf_next_switch(const tf_motion_t *s,
                                  const tf_segment_t *segment, tf_real_t length,
                                  tf_real_t capture, tf_real_t *when);

#endif
