// Reading and setting variables. Every value is checked where it is set, so
// that the message names the variable, the value and the range.

#include "model.h"

fmu_status_t fmu_check_lists(fmu_t *fmu, size_t n, size_t n_values,
                             const void *references, const void *values) {
  if (n != n_values)
    return fmu_error(fmu,
                     "as many values as value references are needed: every"
                     " variable is a scalar");
  if (n > 0 && (references == NULL || values == NULL))
    return fmu_error(fmu, "value references or values are NULL");
  return FMU_OK;
}

static fmu_status_t unknown_reference(fmu_t *fmu, uint32_t reference,
                                      const char *what) {
  return fmu_error(fmu, "no %s variable has the value reference %u", what,
                   (unsigned)reference);
}

static bool is_of(const fmu_variable_t *variable, unsigned kinds) {
  return ((kinds >> variable->kind) & 1u) != 0;
}

fmu_status_t fmu_check_get(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what) {
  size_t slot;
  if (reference == FMU_TIME_REFERENCE && ((kinds >> FMU_KIND_REAL) & 1u) != 0)
    return FMU_OK;
  const fmu_variable_t variable = fmu_variable(reference, &slot);
  if (!is_of(&variable, kinds)) return unknown_reference(fmu, reference, what);
  if (variable.role != FMU_ROLE_OUTPUT) return FMU_OK;
  if (fmu->motion.phase == FMU_INSTANTIATED)
    return fmu_error(fmu, "%s is not known before Initialization Mode",
                     variable.name);
  if (fmu->motion.phase == FMU_INITIALIZATION && !fmu->motion.begun)
    return fmu_begin(fmu);
  return FMU_OK;
}

// A mode can be taken that the next step can end in, under the inputs of now.
static fmu_status_t check_take(fmu_t *fmu, unsigned mode) {
  const fmu_motion_t *motion = &fmu->motion;
  const bool stands = (int64_t)mode == motion->values.whole[FMU_TAKE];
  if (mode == TF_NO_MODE || stands) return FMU_OK;
  if ((motion->phase & (FMU_EVENT | FMU_STEP)) == 0)
    return fmu_discard(fmu, "take = %s is not open before the motion begins",
                       tf_mode_name(mode));
  return fmu_check_open(fmu, FMU_DISCARD, mode, motion->now.state.tick + 1);
}

fmu_status_t fmu_check_set(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what, double value) {
  size_t slot;
  const fmu_motion_t *motion = &fmu->motion;
  const fmu_variable_t variable = fmu_variable(reference, &slot);
  const bool moves = (motion->phase & (FMU_EVENT | FMU_STEP)) != 0;
  if (!is_of(&variable, kinds)) return unknown_reference(fmu, reference, what);
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
  if (variable.kind == FMU_KIND_MEMBER && slot == FMU_TAKE)
    return check_take(fmu, (unsigned)value);
  return FMU_OK;
}

double fmu_get_real(fmu_t *fmu, uint32_t reference) {
  size_t slot;
  if (reference == FMU_TIME_REFERENCE) return fmu_time(&fmu->motion);
  if (fmu_variable(reference, &slot).kind == FMU_KIND_REAL)
    return fmu->motion.values.real[slot];
  const int64_t whole = fmu_get_whole(fmu, reference);
  return (double)whole;
}

int64_t fmu_get_whole(fmu_t *fmu, uint32_t reference) {
  size_t slot;
  (void)fmu_variable(reference, &slot);
  return fmu->motion.values.whole[slot];
}

void fmu_set(fmu_t *fmu, uint32_t reference, double value) {
  size_t slot;
  fmu_motion_t *motion = &fmu->motion;
  if (fmu_variable(reference, &slot).kind == FMU_KIND_REAL) {
    motion->values.real[slot] = value;
    motion->steered |= slot == FMU_OMEGA0 || slot == FMU_ALPHA;
  } else {
    if (slot == FMU_TAKE && (int64_t)value != motion->values.whole[slot])
      motion->takes = (int64_t)value != TF_NO_MODE;
    motion->values.whole[slot] = (int64_t)value;
  }
  if ((motion->phase & (FMU_INSTANTIATED | FMU_INITIALIZATION)) != 0)
    motion->begun = false;
}
