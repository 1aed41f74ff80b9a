// The tables of the core for the page: names, units and ranges of parameters,
// names of modes, laws, rules and codes. The page has no copy of any of them.
#include "cli/setup/setup.h"
#include "module.h"

// A number behind the last has the empty name.
const char *EXPORT(parameter_name)(uint32_t number) {
  return number < TF_PARAMETERS ? tf_parameter_ranges[number].name : "";
}

// Of the others there is no more than one for each of the names; laws: bits of
// those that use it.
#define COLUMN(type, member)                         \
  type EXPORT(parameter_##member)(uint32_t number) { \
    return tf_parameter_ranges[number].member;       \
  }
COLUMN(const char *, unit)
COLUMN(double, low)
COLUMN(double, high)
COLUMN(uint32_t, laws)

// Whether it may have a value, its range apart.
bool EXPORT(parameter_fits)(uint32_t number, double value) {
  return cli_parameter_fits(number, value);
}

// The first scene of the core whose law uses it; TF_SCENES where none does.
uint32_t EXPORT(parameter_scene)(uint32_t number) {
  const uint32_t laws = parameter_laws(number);
  uint32_t scene = 0;
  while (scene < TF_SCENES && !(laws >> tf_scenes[scene]->params.law & 1u))
    scene++;
  return scene;
}

// Its value in that scene; the low end of its range where there is none.
double EXPORT(parameter_there)(uint32_t number) {
  const uint32_t scene = parameter_scene(number);
  if (scene == TF_SCENES) return parameter_low(number);
  return cli_parameter(&tf_scenes[scene]->params, number);
}

double EXPORT(state_limit)(void) { return TF_STATE_LIMIT; }

double EXPORT(least_sine)(void) { return TF_MIN_SINE; }

const char *EXPORT(mode_name)(uint32_t mode) {
  return mode < TF_MODES ? tf_mode_name(mode) : "";
}

const char *EXPORT(law_name)(uint32_t law) { return tf_tyre_law_name(law); }

const char *EXPORT(rule_name)(uint32_t rule) { return tf_rule_name(rule); }

const char *EXPORT(rest_name)(uint32_t law) { return tf_rest_law_name(law); }

const char *EXPORT(status_name)(int32_t status) {
  return tf_status_name((tf_status_t)status);
}
