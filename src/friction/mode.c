// Names of the modes of contact.
#include "twofold/mode.h"

TF_API const char *tf_mode_name(unsigned mode) {
  static const char *const names[TF_MODES] = {"slip+", "slip-", "stick+",
                                              "stick-", "pinned"};
  return mode < TF_MODES ? names[mode] : "unknown mode";
}
