/* same_state.h - whether two states are one, bit for bit: 0 and -0 are not, NaN
 * and the same NaN are. Padding does not count. */
#ifndef TESTS_SUPPORT_SAME_STATE_H
#define TESTS_SUPPORT_SAME_STATE_H

#include <string.h>

#include "twofold.h"

static inline int same_state(const tf_state_t *a, const tf_state_t *b) {
  return memcmp(&a->r, &b->r, sizeof a->r) == 0 &&
         memcmp(&a->v, &b->v, sizeof a->v) == 0 &&
         memcmp(&a->w, &b->w, sizeof a->w) == 0 &&
         memcmp(&a->phi, &b->phi, sizeof a->phi) == 0 && a->tick == b->tick &&
         a->seed == b->seed && a->mode == b->mode;
}

#endif
