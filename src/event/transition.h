// Which contact comes next: at the start of a step and after each event.
#ifndef TF_TRANSITION_H
#define TF_TRANSITION_H

#include "trajectory.h"

// The contact at the start of the step. The user may have set the state, and
// the inputs may have jumped, so its mode alone does not tell. False where no
// mode is admissible.
#define tf_first_segment TF_LINK(tf_first_segment)
TF_API bool tf_first_segment(trajectory_t *path);

// The contact after an event, or after the end of a segment without one. False
// where no mode is admissible.
#define tf_next_segment TF_LINK(tf_next_segment)
TF_API bool tf_next_segment(trajectory_t *path, event_t event);

#endif
