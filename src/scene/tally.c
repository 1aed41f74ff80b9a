// Steps counted by status.
#include "twofold/tally.h"

#include <stddef.h>

#include "../num/kernel.h"

static uint64_t *count_of(tf_tally_t *tally, tf_status_t status) {
  switch ((int)status) {
    case TF_DEGRADED:
      return &tally->degraded;
    case TF_FELL_BACK:
      return &tally->fell_back;
    case TF_COARSE:
      return &tally->coarse;
    case TF_STALLED:
      return &tally->stalled;
    default:
      return &tally->refused;
  }
}

// Whether nothing has been counted. By bytes, and with one increment below: an
// AVR has no word of 64 bits, and five of them at a time take 300 B of its
// flash.
static bool is_empty(const tf_tally_t *tally) {
  const unsigned char *byte = (const unsigned char *)tally;
  unsigned any = 0;
  for (size_t i = 0; i < offsetof(tf_tally_t, first); i++) any |= byte[i];
  return any == 0;
}

// A function of its own, so that a step that is TF_OK costs one comparison.
TF_RARE void tally_reservation(tf_tally_t *tally, uint64_t tick,
                               tf_status_t status) {
  if (is_empty(tally)) tally->first = tick;
  (*count_of(tally, status))++;
}

TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status) {
  if (status != TF_OK) tally_reservation(tally, tick, status);
}
