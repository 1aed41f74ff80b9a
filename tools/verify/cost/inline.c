// See inline.h. This file is counted, as the core is.
#include "verify/cost/inline.h"

int cost_tyre_is_set_valued(tf_tyre_law_t law) {
  return tf_tyre_is_set_valued(law);
}

uint8_t *cost_wire_put(uint8_t *at, uint64_t value, size_t bytes) {
  return tf_wire_put(at, value, bytes);
}

uint64_t cost_wire_get(const uint8_t *at, size_t bytes) {
  return tf_wire_get(at, bytes);
}

uint8_t *cost_wire_put_real(uint8_t *at, tf_real_t value) {
  return tf_wire_put_real(at, value);
}

tf_real_t cost_wire_get_real(const uint8_t *at) { return tf_wire_get_real(at); }
