// FMI 3.0, co-simulation: each function checks the phase, translates, and
// leaves the work to model.h.

#include "fmi3.h"

#include <string.h>

#include "model.h"

#define KIND(name) (1u << FMU_KIND_##name)
#define MOVING ((unsigned)(FMU_EVENT | FMU_STEP))
#define SETTABLE (FMU_INSTANTIATED | FMU_INITIALIZATION | MOVING)
#define READABLE (SETTABLE | FMU_TERMINATED)

#define ENTER(call, phases)                              \
  fmu_t *fmu = fmu_enter(instance, "fmi3" call, phases); \
  if (fmu == NULL) return FMI3_ERROR

static void emit(const fmu_t *fmu, fmu_status_t status, const char *category,
                 const char *text) {
  ((fmi3_log_t *)fmu->logger)(fmu->environment, (fmi3_status_t)status, category,
                              text);
}

static fmi3_status_t done(fmu_status_t status) { return (fmi3_status_t)status; }

const char *FMI3(GetVersion)(void) { return "3.0"; }

void *FMI3(InstantiateCoSimulation)(const char *name, const char *token,
                                    const char *resources, bool visible,
                                    bool logging, bool event_mode,
                                    bool early_return,
                                    const fmi3_reference_t intermediate[],
                                    size_t n_intermediate, void *environment,
                                    fmi3_log_t *logger, fmi3_update_t *update) {
  fmu_t teller;
  (void)resources;
  (void)visible;
  (void)intermediate;
  (void)n_intermediate;
  (void)update;
  memset(&teller, 0, sizeof teller);
  teller.call = "fmi3InstantiateCoSimulation";
  if (name != NULL) strncpy(teller.name, name, sizeof teller.name - 1);
  teller.environment = environment;
  teller.logger = (void (*)(void))logger;
  teller.emit = logger == NULL ? NULL : emit;
  teller.logs = logging ? (1u << FMU_CATEGORIES) - 1 : 0;
  teller.event_mode = event_mode;
  teller.early_return = early_return;
  return fmu_new(&teller, token);
}

void FMI3(FreeInstance)(void *instance) { fmu_free(instance); }

fmi3_status_t FMI3(SetDebugLogging)(void *instance, bool on, size_t n,
                                    const fmi3_string_t categories[]) {
  ENTER("SetDebugLogging", FMU_ANY_PHASE);
  return done(fmu_set_logging(fmu, on, n, categories));
}

fmi3_status_t FMI3(EnterInitializationMode)(void *instance, bool has_tolerance,
                                            double tolerance, double start_time,
                                            bool stops, double stop_time) {
  ENTER("EnterInitializationMode", FMU_INSTANTIATED);
  (void)has_tolerance;
  (void)tolerance;
  const fmu_status_t status = fmu_initialize(fmu, start_time, stops, stop_time);
  if (status == FMU_OK) fmu->motion.phase = FMU_INITIALIZATION;
  return done(status);
}

fmi3_status_t FMI3(ExitInitializationMode)(void *instance) {
  ENTER("ExitInitializationMode", FMU_INITIALIZATION);
  return done(fmu_initialized(fmu, fmu->event_mode ? FMU_EVENT : FMU_STEP));
}

fmi3_status_t FMI3(EnterEventMode)(void *instance) {
  ENTER("EnterEventMode", FMU_STEP);
  if (!fmu->event_mode)
    return done(fmu_error(fmu, "this instance was made without event mode"));
  fmu->motion.phase = FMU_EVENT;
  return FMI3_OK;
}

fmi3_status_t FMI3(EnterStepMode)(void *instance) {
  ENTER("EnterStepMode", FMU_EVENT);
  fmu->motion.phase = FMU_STEP;
  return FMI3_OK;
}

fmi3_status_t FMI3(Terminate)(void *instance) {
  ENTER("Terminate", MOVING);
  fmu->motion.phase = FMU_TERMINATED;
  return FMI3_OK;
}

fmi3_status_t FMI3(Reset)(void *instance) {
  ENTER("Reset", FMU_ANY_PHASE);
  fmu_reset(fmu);
  return FMI3_OK;
}

fmi3_status_t FMI3(UpdateDiscreteStates)(void *instance, bool *again,
                                         bool *terminates, bool *nominals,
                                         bool *values, bool *has_next,
                                         double *next_time) {
  ENTER("UpdateDiscreteStates", FMU_EVENT);
  if (again == NULL || terminates == NULL || nominals == NULL ||
      values == NULL || has_next == NULL || next_time == NULL)
    return done(fmu_error(fmu, "nowhere to put a result: NULL"));
  *again = *terminates = *nominals = *values = *has_next = false;
  *next_time = 0;
  return FMI3_OK;
}

fmi3_status_t FMI3(EvaluateDiscreteStates)(void *instance) {
  ENTER("EvaluateDiscreteStates", FMU_INITIALIZATION | FMU_EVENT);
  return FMI3_OK;
}

fmi3_status_t FMI3(DoStep)(void *instance, double time, double length,
                           bool no_restore, bool *event, bool *terminates,
                           bool *early, double *last_time) {
  ENTER("DoStep", FMU_STEP);
  fmu_step_t end;
  (void)no_restore;
  if (event == NULL || terminates == NULL || early == NULL || last_time == NULL)
    return done(fmu_error(fmu, "nowhere to put a result: NULL"));
  const fmu_status_t status = fmu_step(fmu, time, length, &end);
  *event = fmu->event_mode && end.event;
  *terminates = false;
  *early = end.early;
  *last_time = end.time;
  return done(status);
}

fmi3_status_t FMI3(GetFMUState)(void *instance, void **state) {
  ENTER("GetFMUState", FMU_ANY_PHASE);
  return done(fmu_copy(fmu, state));
}

fmi3_status_t FMI3(SetFMUState)(void *instance, void *state) {
  ENTER("SetFMUState", FMU_ANY_PHASE);
  return done(fmu_restore(fmu, state));
}

fmi3_status_t FMI3(FreeFMUState)(void *instance, void **state) {
  ENTER("FreeFMUState", FMU_ANY_PHASE);
  return done(fmu_free_copy(fmu, state));
}

fmi3_status_t FMI3(SerializedFMUStateSize)(void *instance, void *state,
                                           size_t *size) {
  ENTER("SerializedFMUStateSize", FMU_ANY_PHASE);
  return done(fmu_serialized_size(fmu, state, size));
}

fmi3_status_t FMI3(SerializeFMUState)(void *instance, void *state,
                                      uint8_t bytes[], size_t size) {
  ENTER("SerializeFMUState", FMU_ANY_PHASE);
  return done(fmu_serialize(fmu, state, bytes, size));
}

fmi3_status_t FMI3(DeserializeFMUState)(void *instance, const uint8_t bytes[],
                                        size_t size, void **state) {
  ENTER("DeserializeFMUState", FMU_ANY_PHASE);
  return done(fmu_deserialize(fmu, bytes, size, state));
}

static fmi3_status_t check_count(fmu_t *fmu, size_t n, size_t n_values,
                                 const void *references, const void *values) {
  if (n != n_values)
    return done(fmu_error(fmu,
                          "as many values as value references are needed:"
                          " every variable is a scalar"));
  if (n > 0 && (references == NULL || values == NULL))
    return done(fmu_error(fmu, "value references or values are NULL"));
  return FMI3_OK;
}

// Reads variables; of those to be set checks all before it sets one, so that a
// refused call leaves the instance as it was.
#define ACCESS(Type, type_t, kinds, from_t, read)                              \
  FMI3_GET(Type, type_t) {                                                     \
    ENTER("Get" #Type, READABLE);                                              \
    fmi3_status_t status = check_count(fmu, n, n_values, references, values);  \
    for (size_t i = 0; i < n && status == FMI3_OK; i++) {                      \
      status = done(fmu_check_get(fmu, references[i], kinds, #Type));          \
      if (status != FMI3_OK) break;                                            \
      const from_t value = read(fmu, references[i]);                           \
      values[i] = (type_t)value;                                               \
    }                                                                          \
    return status;                                                             \
  }                                                                            \
  FMI3_SET(Type, type_t) {                                                     \
    ENTER("Set" #Type, SETTABLE);                                              \
    fmi3_status_t status = check_count(fmu, n, n_values, references, values);  \
    for (size_t i = 0; i < n && status == FMI3_OK; i++)                        \
      status = done(                                                           \
          fmu_check_set(fmu, references[i], kinds, #Type, (double)values[i])); \
    for (size_t i = 0; i < n && status == FMI3_OK; i++)                        \
      fmu_set(fmu, references[i], (double)values[i]);                          \
    return status;                                                             \
  }

ACCESS(Float64, double, KIND(REAL), double, fmu_get_real)
ACCESS(Int32, int32_t, KIND(SMALL), int64_t, fmu_get_whole)
ACCESS(UInt32, uint32_t, KIND(SEED), int64_t, fmu_get_whole)
ACCESS(Int64, int64_t, KIND(MEMBER), int64_t, fmu_get_whole)
ACCESS(UInt64, uint64_t, KIND(COUNT), int64_t, fmu_get_whole)
ACCESS(Boolean, bool, KIND(TRUTH), int64_t, fmu_get_whole)

// Types of which this FMU has no variable.
#define NO_ACCESS(Type, type_t)                                  \
  FMI3_GET(Type, type_t) {                                       \
    ENTER("Get" #Type, READABLE);                                \
    const fmi3_status_t status =                                 \
        check_count(fmu, n, n_values, references, values);       \
    if (status != FMI3_OK || n == 0) return status;              \
    return done(fmu_check_get(fmu, references[0], 0, #Type));    \
  }                                                              \
  FMI3_SET(Type, type_t) {                                       \
    ENTER("Set" #Type, SETTABLE);                                \
    const fmi3_status_t status =                                 \
        check_count(fmu, n, n_values, references, values);       \
    if (status != FMI3_OK || n == 0) return status;              \
    return done(fmu_check_set(fmu, references[0], 0, #Type, 0)); \
  }

NO_ACCESS(Float32, float)
NO_ACCESS(Int8, int8_t)
NO_ACCESS(UInt8, uint8_t)
NO_ACCESS(Int16, int16_t)
NO_ACCESS(UInt16, uint16_t)
NO_ACCESS(String, fmi3_string_t)
