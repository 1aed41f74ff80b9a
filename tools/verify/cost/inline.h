// The inline functions of the interface as functions, so that their
// instructions can be counted: what they take inside another is less.
#ifndef COST_INLINE_H
#define COST_INLINE_H

#include "twofold.h"

int cost_tyre_is_set_valued(tf_tyre_law_t law);
uint8_t *cost_wire_put(uint8_t *at, uint64_t value, size_t bytes);
uint64_t cost_wire_get(const uint8_t *at, size_t bytes);
uint8_t *cost_wire_put_real(uint8_t *at, tf_real_t value);
tf_real_t cost_wire_get_real(const uint8_t *at);

#endif
