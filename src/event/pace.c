// The tolerance of a step and what its segments cost. Up to
// TF_LOCATED_SEGMENTS segments have the tolerance of the machine. A step that
// is not over then keeps what it has done, and what remains is done with a
// tolerance that lets it end within TF_LOCATED_MOST_SEGMENTS.
#include "pace.h"

#include "twofold/located.h"

// The coarsest tolerance that a step which is short of segments is given.
#ifdef TF_REAL_FLOAT
#define COARSE_TOLERANCE TF_R(1e-3)
#else
#define COARSE_TOLERANCE TF_R(1e-6)
#endif
// The pace is looked at every so many segments.
#define PACE_EVERY 8

// The error that is allowed is the tolerance times what the velocities are and
// may change by in the rest of the step.
TF_API span_t tf_segment_span(const trajectory_t *path) {
  const taylor_t *motion = &path->motion;
  const tf_real_t allowed =
      path->tolerance *
      (tf_term_size(motion, 0) + tf_term_size(motion, 1) * path->remaining);
  return (span_t){tf_segment_length(motion, path->remaining, allowed), allowed};
}

// The last term that is kept goes with the length to the power SERIES_ORDER -
// 1.
TF_API bool tf_lengthen_segments(trajectory_t *path, tf_real_t factor) {
  const tf_real_t finest = path->motion.machine->tolerance;
  const tf_real_t before = path->tolerance;
  tf_real_t tolerance = before;
  if (!(finest < COARSE_TOLERANCE)) return false;
  for (int n = 1; n < SERIES_ORDER; n++) tolerance *= factor;
  path->tolerance = clip(tolerance, finest, COARSE_TOLERANCE);
  path->is_coarse |= path->tolerance > finest;
  return path->tolerance > before;
}

// At the pace since the last look, the remaining time has to be done in three
// quarters of the segments that are left.
TF_API void tf_keep_pace(trajectory_t *path, pace_t *last, int segment) {
  if (segment < TF_LOCATED_SEGMENTS || segment % PACE_EVERY != 0) return;
  const int spare = TF_LOCATED_MOST_SEGMENTS - PACE_EVERY - segment;
  const tf_real_t done = last->remaining - path->remaining;
  const tf_real_t most = LARGEST_FACTOR;
  const tf_real_t reached = TF_R(0.75) * done * (tf_real_t)spare;
  const tf_real_t needed =
      path->remaining * (tf_real_t)(segment - last->segment);
  tf_real_t factor = most;
  if (needed < most * reached) factor = needed / reached;
  tf_lengthen_segments(path, factor > 1 / most ? factor : 1 / most);
  last->remaining = path->remaining;
  last->segment = segment;
}
