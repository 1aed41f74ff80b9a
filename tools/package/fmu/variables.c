// The variables and their values. Parameters of the machine come from the
// core's own table, with its names, units and ranges. Every value is checked
// where it is set, so that the message names variable, value and range.

#include <string.h>

#include "fmu.h"

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
static const fmu_variable_t others[] = {FMU_REALS(REAL) FMU_WHOLES(WHOLE)};

fmu_variable_t fmu_variable(uint32_t reference) {
  if (reference == FMU_TIME || reference >= FMU_VARIABLES)
    return (fmu_variable_t){.kind = FMU_KIND_UNKNOWN};
  if (reference > TF_PARAMETERS) return others[reference - TF_PARAMETERS - 1];
  const tf_parameter_range_t *range = &tf_parameter_ranges[reference - 1];
  const bool drives = reference == FMU_OMEGA0 || reference == FMU_R0;
  return (fmu_variable_t){
      .name = range->name,
      .unit = range->unit,
      .about = reference == FMU_OMEGA0
                   ? "speed of the turntable as set; see turntable"
                   : "",
      .role = drives ? FMU_ROLE_INPUT : FMU_ROLE_PARAMETER,
      .low = (double)range->low,
      .high = (double)range->high};
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

void fmu_defaults(double values[FMU_VARIABLES], const tf_scene_t *scene) {
  memset(values, 0, FMU_VARIABLES * sizeof *values);
  for (size_t i = 0; i < TF_PARAMETERS; i++)
    values[1 + i] = parameter_of(user_of(scene, i), i);
  values[FMU_START_R] = (double)scene->r;
  values[FMU_START_V] = (double)scene->v;
  values[FMU_START_OMEGA] = (double)scene->omega;
  values[FMU_START_H] = (double)scene->h;
  values[FMU_LAW] = scene->params.law;
  values[FMU_RULE] = scene->params.rule;
  values[FMU_WITH_ANGLE] = scene->params.with_angle;
  values[FMU_START_FROM_H] = !scene->v_is_given;
  values[FMU_FOLLOW_PROFILE] = scene->knots > 0;
  values[FMU_TAKE] = TF_NO_MODE;
}

fmu_status_t fmu_check_lists(fmu_t *fmu, size_t n, size_t n_values,
                             const void *references, const void *values) {
  if (n != n_values)
    return fmu_error(fmu,
                     "the numbers of values and of value references"
                     " differ: every variable is a scalar");
  if (n > 0 && (references == NULL || values == NULL))
    return fmu_error(fmu, "value references or values are NULL");
  return FMU_OK;
}

// Whether a reference is that of a variable of some kinds; if not, after a
// message.
static bool is_known(fmu_t *fmu, uint32_t reference, unsigned kinds,
                     const char *what) {
  if (((kinds >> fmu_variable(reference).kind) & 1u) != 0) return true;
  (void)fmu_error(fmu, "no %s variable has the value reference %u", what,
                  (unsigned)reference);
  return false;
}

fmu_status_t fmu_get(fmu_t *fmu, uint32_t reference, unsigned kinds,
                     const char *what, double *value) {
  const fmu_motion_t *motion = &fmu->motion;
  if (reference == FMU_TIME && ((kinds >> FMU_KIND_REAL) & 1u) != 0) {
    *value = fmu_time(motion);
    return FMU_OK;
  }
  if (!is_known(fmu, reference, kinds, what)) return FMU_ERROR;
  const fmu_variable_t variable = fmu_variable(reference);
  fmu_status_t status = FMU_OK;
  if (variable.role == FMU_ROLE_OUTPUT && motion->phase == FMU_INSTANTIATED)
    return fmu_error(fmu, "%s is not known before Initialization Mode",
                     variable.name);
  if (variable.role == FMU_ROLE_OUTPUT && !motion->begun &&
      motion->phase == FMU_INITIALIZATION)
    status = fmu_begin(fmu);
  *value = motion->values[reference];
  return status;
}

// A mode can be taken that the next step can end in, under the inputs of now.
static fmu_status_t check_take(fmu_t *fmu, unsigned mode) {
  const fmu_motion_t *motion = &fmu->motion;
  const bool stands = mode == (unsigned)motion->values[FMU_TAKE];
  if (mode == TF_NO_MODE || stands) return FMU_OK;
  if ((motion->phase & (FMU_EVENT | FMU_STEP)) == 0)
    return fmu_discard(fmu, "take = %s is not open before the motion begins",
                       tf_mode_name(mode));
  return fmu_check_open(fmu, FMU_DISCARD, mode, motion->now.state.tick + 1);
}

fmu_status_t fmu_check_set(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what, double value) {
  const fmu_motion_t *motion = &fmu->motion;
  const bool moves = (motion->phase & (FMU_EVENT | FMU_STEP)) != 0;
  if (!is_known(fmu, reference, kinds, what)) return FMU_ERROR;
  const fmu_variable_t variable = fmu_variable(reference);
  if (variable.role == FMU_ROLE_OUTPUT)
    return fmu_error(fmu, "%s is an output: it cannot be set", variable.name);
  if (variable.role == FMU_ROLE_PARAMETER && moves)
    return fmu_error(fmu,
                     "%s is a fixed parameter: it can only be set before the"
                     " motion begins",
                     variable.name);
  if (!(value >= variable.low && value <= variable.high))
    return fmu_discard(fmu, "%s = %g must lie in [%g, %g] %s", variable.name,
                       value, variable.low, variable.high, variable.unit);
  if (reference == FMU_TAKE) return check_take(fmu, (unsigned)value);
  return FMU_OK;
}

void fmu_set(fmu_t *fmu, uint32_t reference, double value) {
  fmu_motion_t *motion = &fmu->motion;
  motion->steered |= reference == FMU_OMEGA0 || reference == FMU_ALPHA;
  if (reference == FMU_TAKE && value != motion->values[FMU_TAKE])
    motion->takes = value != TF_NO_MODE;
  motion->values[reference] = value;
  if ((motion->phase & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0)
    motion->begun = false;
}
