// Names of the codes and modes: the only text in the core.
#include "twofold/status.h"

#include "twofold/friction.h"

TF_API const char *tf_status_name(tf_status_t status) {
  switch (status) {
    case TF_OK:
      return "ok";
    case TF_DEGRADED:
      return "degraded: no mode was consistent and admissible";
    case TF_COARSE:
      return "located step missed its tolerance: out of segments";
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

TF_API const char *tf_mode_name(unsigned mode) {
  static const char *const names[TF_MODES] = {"slip+", "slip-", "stick+",
                                              "stick-", "pinned"};
  return mode < TF_MODES ? names[mode] : "unknown mode";
}
