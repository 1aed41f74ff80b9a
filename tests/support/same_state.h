/* same_state.h - whether two states or two reports are one, bit for bit: 0 and
 * -0 are not, NaN and the same NaN are. Padding does not count. */
#ifndef TESTS_SUPPORT_SAME_STATE_H
#define TESTS_SUPPORT_SAME_STATE_H

#include <string.h>

#include "twofold.h"

static inline int same_bits(tf_real_t a, tf_real_t b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static inline int same_state(const tf_state_t *a, const tf_state_t *b) {
  return same_bits(a->r, b->r) && same_bits(a->v, b->v) &&
         same_bits(a->w, b->w) && same_bits(a->phi, b->phi) &&
         a->tick == b->tick && a->seed == b->seed && a->mode == b->mode;
}

static inline int same_report(const tf_report_t *a, const tf_report_t *b) {
  return a->mode == b->mode && a->set == b->set && a->choices == b->choices &&
         a->status == b->status && same_bits(a->force.F, b->force.F) &&
         same_bits(a->force.M, b->force.M) && same_bits(a->slip.h, b->slip.h) &&
         same_bits(a->slip.g, b->slip.g) &&
         same_bits(a->delassus, b->delassus) &&
         same_bits(a->residual, b->residual);
}

#endif
