// The tables of the core for the page: names, units and ranges of parameters,
// names of modes, laws, rules and codes. The page has no copy of any of them.
#include "module.h"

const char *EXPORT(parameter_name)(uint32_t number);
const char *EXPORT(parameter_unit)(uint32_t number);
double EXPORT(parameter_low)(uint32_t number);
double EXPORT(parameter_high)(uint32_t number);
uint32_t EXPORT(parameter_laws)(uint32_t number);
const char *EXPORT(mode_name)(uint32_t mode);
const char *EXPORT(law_name)(uint32_t law);
const char *EXPORT(rule_name)(uint32_t rule);
const char *EXPORT(rest_name)(uint32_t law);
const char *EXPORT(status_name)(int32_t status);
const char *EXPORT(version)(void);

// A number behind the last has the empty name.
const char *parameter_name(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].name : "";
}

const char *parameter_unit(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].unit : "";
}

double parameter_low(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].low : 0;
}

double parameter_high(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].high : 0;
}

// Bits of the laws that use it.
uint32_t parameter_laws(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].laws : 0;
}

const char *mode_name(uint32_t mode) {
  return mode < TF_MODES ? tf_mode_name(mode) : "";
}

const char *law_name(uint32_t law) { return tf_tyre_law_name(law); }

const char *rule_name(uint32_t rule) { return tf_rule_name(rule); }

const char *rest_name(uint32_t law) { return tf_rest_law_name(law); }

const char *status_name(int32_t status) {
  return tf_status_name((tf_status_t)status);
}

const char *version(void) { return TF_VERSION; }
