// The steps that were not TF_OK, in words and as an exit code. A step that fell
// back on another scheme keeps its promise, so it is reported and does not
// change the exit code.

#include "tally.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "message.h"

void cli_tally_print(const tf_tally_t *tally, const char *since, double t) {
  (void)fprintf(stderr, "degraded   %" PRIu64 " steps", tally->degraded);
  if (tally->coarse > 0 || tally->fell_back > 0) {
    (void)fprintf(stderr,
                  "; %" PRIu64 " missed the tolerance, %" PRIu64
                  " fell back on moreau",
                  tally->coarse, tally->fell_back);
  }
  if (tally->degraded + tally->coarse + tally->fell_back > 0 && !isnan(t)) {
    (void)fprintf(stderr, ", %s at t = %g s", since, t);
  }
  (void)fputc('\n', stderr);
}

int cli_tally_code(const tf_tally_t *tally) {
  return tally->degraded > 0 || tally->coarse > 0 ? CLI_FLAGGED : CLI_DONE;
}
