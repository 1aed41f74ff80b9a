// Names of the status codes.
#include "twofold/status.h"

TF_API const char *tf_status_name(tf_status_t status) {
  switch (status) {
    case TF_OK:
      return "ok";
    case TF_DEGRADED:
      return "degraded: no mode was consistent and admissible";
    case TF_COARSE:
      return "too long for this motion: bounded, but not resolved";
    case TF_STALLED:
      return "the motion stalls: its change is lost in rounding";
    case TF_FELL_BACK:
      return "located step fell back on the Moreau-Jean step";
    case TF_BAD_PARAMETER:
      return "parameter out of its range";
    case TF_BAD_STATE:
      return "state or input not finite, out of range or impossible";
    case TF_DIVERGED:
      return "the motion leaves the range of states";
    case TF_STEP_TOO_LONG:
      return "step too long for this motion";
    default:
      return "unknown status";
  }
}
