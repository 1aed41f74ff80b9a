// Slip near h = g = 0, where the equations are stiff.
#ifndef TF_LIMIT_DIRECTION_H
#define TF_LIMIT_DIRECTION_H

#include "trajectory.h"

// Whether a slip is near h = g = 0 and a segment of this length much shorter
// than the motion from or to there: it may be stiff then.
#define tf_may_be_stiff TF_LINK(tf_may_be_stiff)
TF_API bool tf_may_be_stiff(const trajectory_t *path, tf_real_t length);

// Moves along the limit direction that attracts the slip, to h = g = 0 at most.
// False, and nothing has changed, where the slip is further from that direction
// than the error that is allowed.
#define tf_follow_limit_direction TF_LINK(tf_follow_limit_direction)
TF_API bool tf_follow_limit_direction(trajectory_t *path, tf_real_t allowed);

#endif
