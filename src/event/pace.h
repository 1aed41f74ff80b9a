// How long the segments of a step are: as long as the tolerance allows, and a
// step that needs more of them than it may use gets a coarser tolerance.
#ifndef TF_PACE_H
#define TF_PACE_H

#include "trajectory.h"

// How far a segment goes [s], and how far off it may be there [m/s].
typedef struct {
  tf_real_t length, error;
} span_t;

#define tf_segment_span TF_LINK(tf_segment_span)
TF_API span_t tf_segment_span(const trajectory_t *path);

// When the pace was last looked at.
typedef struct {
  tf_real_t remaining; // of the step then [s]
  int segment;         // number of the segment then
} pace_t;

// Before a segment beyond TF_LOCATED_SEGMENTS: makes the tolerance such that
// what remains is done in the segments that are left.
#define tf_keep_pace TF_LINK(tf_keep_pace)
TF_API void tf_keep_pace(trajectory_t *path, pace_t *last, int segment);

// Changes the tolerance for segments that are longer by a factor. False where
// it is no coarser than before.
#define tf_lengthen_segments TF_LINK(tf_lengthen_segments)
TF_API bool tf_lengthen_segments(trajectory_t *path, tf_real_t factor);

// The largest factor that is used at once.
#define LARGEST_FACTOR 2

#endif
