// The table of variables. Parameters of the machine come from the core's own
// table, with its names, units and ranges.

#include "variables.h"

#include <string.h>

// TF_NO_MODE: the rule of the machine decides.
static const char *take_name(unsigned mode) {
  return mode < TF_MODES ? tf_mode_name(mode) : "choose";
}

// One word each, from the lowest code upwards: names of tf_status_name are
// sentences.
static const char *status_word(unsigned i) {
  static const char *const words[] = {"step_too_long", "diverged", "bad_state",
                                      "bad_parameter", "ok",       "degraded",
                                      "fell_back",     "coarse",   "stalled"};
  return words[i];
}

// 0 for an output, at both ends: 0 - 0 has no sign.
#define LIMIT(role) \
  (FMU_ROLE_##role == FMU_ROLE_OUTPUT ? 0 : (double)TF_STATE_LIMIT)
#define REAL(number, name, unit, role, about) \
  {name,                                      \
   unit,                                      \
   about,                                     \
   FMU_KIND_REAL,                             \
   FMU_ROLE_##role,                           \
   NULL,                                      \
   0 - LIMIT(role),                           \
   LIMIT(role)},
#define WHOLE(number, name, kind, role, member, low, high, about) \
  {name, "1", about, FMU_KIND_##kind, FMU_ROLE_##role, member, low, high},
static const fmu_variable_t other_reals[] = {FMU_OTHER_REALS(REAL)};
static const fmu_variable_t wholes[] = {FMU_ALL_WHOLES(WHOLE)};

// about: "" for the words of the command line.
static fmu_variable_t of_range(size_t i, fmu_role_t role, const char *about) {
  const tf_parameter_range_t *range = &tf_parameter_ranges[i];
  return (fmu_variable_t){
      range->name,        range->unit,        about, FMU_KIND_REAL, role, NULL,
      (double)range->low, (double)range->high};
}

// The place of a member of tf_params_t in tf_parameter_ranges.
static size_t place_of(size_t offset) {
  size_t i = 0;
  while (tf_parameter_ranges[i].offset != offset) i++;
  return i;
}

fmu_variable_t fmu_real(size_t slot) {
  const size_t omega0 = place_of(offsetof(tf_params_t, omega0));
  const size_t r0 = place_of(offsetof(tf_params_t, r0));
  if (slot == FMU_OMEGA0)
    return of_range(omega0, FMU_ROLE_INPUT,
                    "speed of the turntable as set; turntable has the actual");
  if (slot == FMU_R0) return of_range(r0, FMU_ROLE_INPUT, "");
  if (slot == omega0 || slot == r0)
    return (fmu_variable_t){.kind = FMU_KIND_UNKNOWN};
  if (slot < TF_PARAMETERS) return of_range(slot, FMU_ROLE_PARAMETER, "");
  return other_reals[slot - TF_PARAMETERS];
}

fmu_variable_t fmu_whole(size_t slot) { return wholes[slot]; }

fmu_variable_t fmu_variable(uint32_t reference, size_t *slot) {
  if (reference - FMU_REAL_REFERENCE < FMU_REALS) {
    *slot = reference - FMU_REAL_REFERENCE;
    return fmu_real(*slot);
  }
  if (reference - FMU_WHOLE_REFERENCE < FMU_WHOLES) {
    *slot = reference - FMU_WHOLE_REFERENCE;
    return fmu_whole(*slot);
  }
  return (fmu_variable_t){.kind = FMU_KIND_UNKNOWN};
}

static double parameter_of(const tf_scene_t *scene, size_t i) {
  tf_real_t value;
  memcpy(&value, (const char *)&scene->params + tf_parameter_ranges[i].offset,
         sizeof value);
  return (double)value;
}

// The scene whose law uses a parameter: the given one, else the first.
static const tf_scene_t *user_of(const tf_scene_t *scene, size_t i) {
  const unsigned needed = tf_parameter_ranges[i].laws;
  if ((needed >> scene->params.law) & 1u) return scene;
  for (size_t k = 0; k < TF_SCENES; k++)
    if ((needed >> tf_scenes[k]->params.law) & 1u) return tf_scenes[k];
  return scene;
}

void fmu_defaults(fmu_values_t *values, const tf_scene_t *scene) {
  memset(values, 0, sizeof *values);
  for (size_t i = 0; i < TF_PARAMETERS; i++)
    values->real[i] = parameter_of(user_of(scene, i), i);
  values->real[FMU_OMEGA0] = (double)scene->params.omega0;
  values->real[FMU_R0] = (double)scene->params.r0;
  values->real[FMU_START_R] = (double)scene->r;
  values->real[FMU_START_V] = (double)scene->v;
  values->real[FMU_START_OMEGA] = (double)scene->omega;
  values->real[FMU_START_H] = (double)scene->h;
  values->whole[FMU_LAW] = (int64_t)scene->params.law;
  values->whole[FMU_RULE] = (int64_t)scene->params.rule;
  values->whole[FMU_WITH_ANGLE] = scene->params.with_angle;
  values->whole[FMU_START_FROM_H] = !scene->v_is_given;
  values->whole[FMU_FOLLOW_PROFILE] = scene->knots > 0;
  values->whole[FMU_TAKE] = TF_NO_MODE;
}
