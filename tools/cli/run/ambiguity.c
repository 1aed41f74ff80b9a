// The instants at which the physics leaves open what follows. One rule for the
// summary of `run` and for the outcome of `sweep`.

#include "ambiguity.h"

#include <math.h>

void cli_ambiguity_begin(cli_ambiguity_t *ambiguity, const tf_report_t *start) {
  ambiguity->start = start != NULL ? start->choices : 0;
  ambiguity->steps = 0;
  ambiguity->since = ambiguity->start > 1 ? 0 : (double)NAN;
}

void cli_ambiguity_see(cli_ambiguity_t *ambiguity, const tf_report_t *report,
                       double t) {
  if (report->choices > 1) {
    ambiguity->steps++;
    ambiguity->since = fmin(ambiguity->since, t); // of NaN and t, t
  }
}
