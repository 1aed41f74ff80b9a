// Names of the modes of contact, and of the choices of a user.
#include "twofold/mode.h"

#include "twofold/contact.h"

TF_API const char *tf_mode_name(unsigned mode) {
  static const char *const names[TF_MODES] = {"slip+", "slip-", "stick+",
                                              "stick-", "pinned"};
  return mode < TF_MODES ? names[mode] : "unknown mode";
}

TF_API const char *tf_rule_name(unsigned rule) {
  static const char *const names[TF_RULES] = {"persist", "slip+", "slip-",
                                              "random"};
  return rule < TF_RULES ? names[rule] : "unknown rule";
}

TF_API const char *tf_rest_law_name(unsigned law) {
  static const char *const names[TF_REST_LAWS] = {"hull", "square", "bow_tie"};
  return law < TF_REST_LAWS ? names[law] : "unknown law of rest";
}
