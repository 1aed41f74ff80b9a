// FMI 2.0, co-simulation: each function checks the phase, translates, and
// leaves the work to model.h. The version has no event mode and no early
// return: the outputs `events` and `event_time` tell of what happened inside a
// communication step.

#include "fmi2.h"

#include <string.h>

#include "model.h"

#define KIND(name) (1u << FMU_KIND_##name)
#define SETTABLE ((unsigned)(FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_STEP))
#define READABLE (SETTABLE | FMU_TERMINATED)

#define ENTER(call, phases)                              \
  fmu_t *fmu = fmu_enter(instance, "fmi2" call, phases); \
  if (fmu == NULL) return FMI2_ERROR

static void emit(const fmu_t *fmu, fmu_status_t status, const char *category,
                 const char *text) {
  ((fmi2_log_t *)fmu->logger)(fmu->environment, fmu->name,
                              (fmi2_status_t)status, category, "%s", text);
}

static fmi2_status_t done(fmu_status_t status) { return (fmi2_status_t)status; }

const char *FMI2(GetTypesPlatform)(void) { return "default"; }
const char *FMI2(GetVersion)(void) { return "2.0"; }

void *FMI2(Instantiate)(fmi2_string_t name, fmi2_type_t type,
                        fmi2_string_t token, fmi2_string_t resources,
                        const fmi2_callbacks_t *callbacks,
                        fmi2_boolean_t visible, fmi2_boolean_t logging) {
  fmu_t teller;
  (void)resources;
  (void)visible;
  memset(&teller, 0, sizeof teller);
  teller.call = "fmi2Instantiate";
  if (name != NULL) strncpy(teller.name, name, sizeof teller.name - 1);
  if (callbacks != NULL && callbacks->logger != NULL) {
    teller.environment = callbacks->environment;
    teller.logger = (void (*)(void))callbacks->logger;
    teller.emit = emit;
  }
  teller.logs = logging ? (1u << FMU_CATEGORIES) - 1 : 0;
  if (type != FMI2_CO_SIMULATION) {
    (void)fmu_error(&teller, "this FMU is for co-simulation");
    return NULL;
  }
  return fmu_new(&teller, token);
}

void FMI2(FreeInstance)(void *instance) { fmu_free(instance); }

fmi2_status_t FMI2(SetDebugLogging)(void *instance, fmi2_boolean_t on, size_t n,
                                    const fmi2_string_t categories[]) {
  ENTER("SetDebugLogging", FMU_ANY_PHASE);
  return done(fmu_set_logging(fmu, on != 0, n, categories));
}

fmi2_status_t FMI2(SetupExperiment)(void *instance,
                                    fmi2_boolean_t has_tolerance,
                                    double tolerance, double start_time,
                                    fmi2_boolean_t stops, double stop_time) {
  ENTER("SetupExperiment", FMU_INSTANTIATED);
  (void)has_tolerance;
  (void)tolerance;
  return done(fmu_initialize(fmu, start_time, stops != 0, stop_time));
}

fmi2_status_t FMI2(EnterInitializationMode)(void *instance) {
  ENTER("EnterInitializationMode", FMU_INSTANTIATED);
  fmu->motion.phase = FMU_INITIALIZATION;
  return FMI2_OK;
}

fmi2_status_t FMI2(ExitInitializationMode)(void *instance) {
  ENTER("ExitInitializationMode", FMU_INITIALIZATION);
  return done(fmu_initialized(fmu, FMU_STEP));
}

fmi2_status_t FMI2(Terminate)(void *instance) {
  ENTER("Terminate", FMU_STEP);
  fmu->motion.phase = FMU_TERMINATED;
  return FMI2_OK;
}

fmi2_status_t FMI2(Reset)(void *instance) {
  ENTER("Reset", FMU_ANY_PHASE);
  fmu_reset(fmu);
  return FMI2_OK;
}

static fmi2_status_t check_lists(fmu_t *fmu, size_t n, const void *references,
                                 const void *values) {
  if (n > 0 && (references == NULL || values == NULL))
    return done(fmu_error(fmu, "value references or values are NULL"));
  return FMI2_OK;
}

// Reads variables; of those to be set checks all before it sets one, so that a
// refused call leaves the instance as it was. Any number but 0 is true.
#define ACCESS(Type, type_t, kinds, from_t, read, number)                      \
  FMI2_GET(Type, type_t) {                                                     \
    ENTER("Get" #Type, READABLE);                                              \
    fmi2_status_t status = check_lists(fmu, n, references, values);            \
    for (size_t i = 0; i < n && status == FMI2_OK; i++) {                      \
      status = done(fmu_check_get(fmu, references[i], kinds, #Type));          \
      if (status != FMI2_OK) break;                                            \
      const from_t value = read(fmu, references[i]);                           \
      values[i] = (type_t)value;                                               \
    }                                                                          \
    return status;                                                             \
  }                                                                            \
  FMI2_SET(Type, type_t) {                                                     \
    ENTER("Set" #Type, SETTABLE);                                              \
    fmi2_status_t status = check_lists(fmu, n, references, values);            \
    for (size_t i = 0; i < n && status == FMI2_OK; i++)                        \
      status = done(                                                           \
          fmu_check_set(fmu, references[i], kinds, #Type, number(values[i]))); \
    for (size_t i = 0; i < n && status == FMI2_OK; i++)                        \
      fmu_set(fmu, references[i], number(values[i]));                          \
    return status;                                                             \
  }
#define NUMBER(value) ((double)(value))
#define TRUTH(value) ((value) != 0 ? 1.0 : 0.0)

ACCESS(Real, double, KIND(REAL) | KIND(COUNT), double, fmu_get_real, NUMBER)
ACCESS(Integer, int, KIND(MEMBER) | KIND(SMALL) | KIND(SEED), int64_t,
       fmu_get_whole, NUMBER)
ACCESS(Boolean, fmi2_boolean_t, KIND(TRUTH), int64_t, fmu_get_whole, TRUTH)

FMI2_GET(String, fmi2_string_t) {
  ENTER("GetString", READABLE);
  const fmi2_status_t status = check_lists(fmu, n, references, values);
  if (status != FMI2_OK || n == 0) return status;
  return done(fmu_check_get(fmu, references[0], 0, "String"));
}

FMI2_SET(String, fmi2_string_t) {
  ENTER("SetString", SETTABLE);
  const fmi2_status_t status = check_lists(fmu, n, references, values);
  if (status != FMI2_OK || n == 0) return status;
  return done(fmu_check_set(fmu, references[0], 0, "String", 0));
}

fmi2_status_t FMI2(GetFMUstate)(void *instance, void **state) {
  ENTER("GetFMUstate", FMU_ANY_PHASE);
  return done(fmu_copy(fmu, state));
}

fmi2_status_t FMI2(SetFMUstate)(void *instance, void *state) {
  ENTER("SetFMUstate", FMU_ANY_PHASE);
  return done(fmu_restore(fmu, state));
}

fmi2_status_t FMI2(FreeFMUstate)(void *instance, void **state) {
  ENTER("FreeFMUstate", FMU_ANY_PHASE);
  return done(fmu_free_copy(fmu, state));
}

fmi2_status_t FMI2(SerializedFMUstateSize)(void *instance, void *state,
                                           size_t *size) {
  ENTER("SerializedFMUstateSize", FMU_ANY_PHASE);
  return done(fmu_serialized_size(fmu, state, size));
}

fmi2_status_t FMI2(SerializeFMUstate)(void *instance, void *state, char bytes[],
                                      size_t size) {
  ENTER("SerializeFMUstate", FMU_ANY_PHASE);
  return done(fmu_serialize(fmu, state, (unsigned char *)bytes, size));
}

fmi2_status_t FMI2(DeSerializeFMUstate)(void *instance, const char bytes[],
                                        size_t size, void **state) {
  ENTER("DeSerializeFMUstate", FMU_ANY_PHASE);
  return done(fmu_deserialize(fmu, (const unsigned char *)bytes, size, state));
}

fmi2_status_t FMI2(DoStep)(void *instance, double time, double length,
                           fmi2_boolean_t no_restore) {
  ENTER("DoStep", FMU_STEP);
  fmu_step_t end;
  (void)no_restore;
  return done(fmu_step(fmu, time, length, &end));
}

fmi2_status_t FMI2(GetRealStatus)(void *instance, fmi2_question_t question,
                                  double *value) {
  ENTER("GetRealStatus", FMU_STEP | FMU_TERMINATED);
  if (value == NULL || question != FMI2_LAST_SUCCESSFUL_TIME)
    return done(fmu_error(fmu, "only fmi2LastSuccessfulTime can be asked"));
  *value = fmu_time(&fmu->motion);
  return FMI2_OK;
}

fmi2_status_t FMI2(GetBooleanStatus)(void *instance, fmi2_question_t question,
                                     fmi2_boolean_t *value) {
  ENTER("GetBooleanStatus", FMU_STEP | FMU_TERMINATED);
  if (value == NULL || question != FMI2_TERMINATED)
    return done(fmu_error(fmu, "only fmi2Terminated can be asked"));
  *value = 0;
  return FMI2_OK;
}

// Steps end before fmi2DoStep returns: there is none to cancel or to ask about.
#define NOT_PENDING(call)                                               \
  {                                                                     \
    ENTER(call, FMU_ANY_PHASE);                                         \
    return done(fmu_error(fmu, "no step of this FMU is ever pending")); \
  }
fmi2_status_t FMI2(CancelStep)(void *instance) NOT_PENDING("CancelStep")

    fmi2_status_t FMI2(GetStatus)(void *instance, fmi2_question_t question,
                                  fmi2_status_t *value) {
  (void)question;
  (void)value;
  NOT_PENDING("GetStatus")
}

fmi2_status_t FMI2(GetIntegerStatus)(void *instance, fmi2_question_t question,
                                     int *value) {
  (void)question;
  (void)value;
  NOT_PENDING("GetIntegerStatus")
}

fmi2_status_t FMI2(GetStringStatus)(void *instance, fmi2_question_t question,
                                    fmi2_string_t *value) {
  (void)question;
  (void)value;
  NOT_PENDING("GetStringStatus")
}

#define NO_DERIVATIVES(call)                   \
  {                                            \
    (void)fmu_enter(instance, "fmi2" call, 0); \
    return FMI2_ERROR;                         \
  }

fmi2_status_t FMI2(GetDirectionalDerivative)(
    void *instance, const fmi2_reference_t unknowns[], size_t n_unknowns,
    const fmi2_reference_t knowns[], size_t n_knowns, const double seed[],
    double sensitivity[]) {
  (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns;
  (void)seed, (void)sensitivity;
  NO_DERIVATIVES("GetDirectionalDerivative")
}

fmi2_status_t FMI2(SetRealInputDerivatives)(void *instance,
                                            const fmi2_reference_t references[],
                                            size_t n, const int orders[],
                                            const double values[]) {
  (void)references, (void)n, (void)orders, (void)values;
  NO_DERIVATIVES("SetRealInputDerivatives")
}

fmi2_status_t FMI2(GetRealOutputDerivatives)(
    void *instance, const fmi2_reference_t references[], size_t n,
    const int orders[], double values[]) {
  (void)references, (void)n, (void)orders, (void)values;
  NO_DERIVATIVES("GetRealOutputDerivatives")
}
