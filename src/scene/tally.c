// Steps counted by status.
#include "twofold/tally.h"

#include "../num/kernel.h"

// A function of its own, so that a step that is TF_OK costs one comparison.
TF_RARE void tally_reservation(tf_tally_t *tally, uint64_t tick,
                               tf_status_t status) {
  if ((tally->degraded | tally->fell_back | tally->coarse | tally->stalled |
       tally->refused) == 0)
    tally->first = tick;
  tally->degraded += status == TF_DEGRADED;
  tally->fell_back += status == TF_FELL_BACK;
  tally->coarse += status == TF_COARSE;
  tally->stalled += status == TF_STALLED;
  tally->refused += status < 0;
}

TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status) {
  if (status != TF_OK) tally_reservation(tally, tick, status);
}
