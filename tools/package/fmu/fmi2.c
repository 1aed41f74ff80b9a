// FMI 2.0, co-simulation: each function checks the phase, translates, and
// leaves the work to fmu.h. The version has no event mode and no early
// return: the outputs `events` and `event_time` tell of what happened inside a
// communication step.

#ifndef FMI2_FUNCTION_PREFIX
#define FMI2_FUNCTION_PREFIX
#endif
#define FMI_PREFIX FMI2_FUNCTION_PREFIX
#define FMI_WORD fmi2
#define FMI_VERSION "2.0"
#define FMI_BOOLEAN int
#define FMI_VALUES(type_t) type_t values[]
#define FMI_COUNT n
#define FMI_MOVING ((unsigned)FMU_STEP)
#include <string.h>

#include "faces.h"

// Types of the C interface, written from the text of the standard
// (fmi-standard.org).
typedef const char *fmi2_string_t;
typedef enum { FMI2_MODEL_EXCHANGE, FMI2_CO_SIMULATION } fmi2_type_t;
typedef enum {
  FMI2_DO_STEP_STATUS,
  FMI2_PENDING_STATUS,
  FMI2_LAST_SUCCESSFUL_TIME,
  FMI2_TERMINATED
} fmi2_question_t;

typedef void fmi2_log_t(void *environment, fmi2_string_t instance,
                        fmu_status_t status, fmi2_string_t category,
                        fmi2_string_t message, ...);
typedef struct {
  fmi2_log_t *logger;
  // cppcheck-suppress unusedStructMember  ; laid out by the standard
  void *(*allocate)(size_t n, size_t size);
  // cppcheck-suppress unusedStructMember  ; laid out by the standard
  void (*free)(void *memory);
  // cppcheck-suppress unusedStructMember  ; laid out by the standard
  void (*step_finished)(void *environment, fmu_status_t status);
  void *environment;
} fmi2_callbacks_t;

static void emit(const fmu_t *fmu, fmu_status_t status, const char *category,
                 const char *text) {
  // Some importers print the format and no arguments: it is the text itself.
  const char *format = text;
  for (const char *at = text; *at != '\0'; at++)
    if (*at == '%') format = "%s";
  ((fmi2_log_t *)fmu->logger)(fmu->environment, fmu->name, status, category,
                              format, text);
}

FMI_EXPORT const char *FMI(GetTypesPlatform)(void) { return "default"; }

FMI_EXPORT void *FMI(Instantiate)(fmi2_string_t name, fmi2_type_t type,
                                  fmi2_string_t token, fmi2_string_t resources,
                                  const fmi2_callbacks_t *callbacks,
                                  FMI_BOOLEAN visible, FMI_BOOLEAN logging) {
  // Discard is for a step of which a part is done, and importers go on.
  fmu_t own = {.call = "fmi2Instantiate",
               .logs = FMU_LOGS(logging),
               .refusal = FMU_ERROR};
  if (name != NULL) strncpy(own.name, name, sizeof own.name - 1);
  if (callbacks != NULL && callbacks->logger != NULL) {
    own.environment = callbacks->environment;
    own.logger = (void (*)(void))callbacks->logger;
    own.emit = emit;
  }
  return type == FMI2_CO_SIMULATION ? fmu_new(&own, token)
                                    : fmu_refuse_type(&own);
}

CALL(SetupExperiment, FMU_INSTANTIATED,
     fmu_initialize(fmu, start_time, stops != 0, stop_time), void *instance,
     FMI_BOOLEAN has_tolerance, double tolerance, double start_time,
     FMI_BOOLEAN stops, double stop_time)

CALL(EnterInitializationMode, FMU_INSTANTIATED,
     fmu_go_to(fmu, FMU_INITIALIZATION), void *instance)

CALL(ExitInitializationMode, FMU_INITIALIZATION, fmu_initialized(fmu, FMU_STEP),
     void *instance)

ACCESS(Real, double, KIND(REAL) | KIND(COUNT), NUMBER)
ACCESS(Integer, int, KIND(MEMBER) | KIND(SMALL) | KIND(SEED), NUMBER)
ACCESS(Boolean, FMI_BOOLEAN, KIND(TRUTH), TRUTH)
NO_ACCESS(String, uintptr_t)

COPIES(FMUstate, DeSerialize, char)

FMI_EXPORT fmu_status_t FMI(DoStep)(void *instance, double time, double length,
                                    FMI_BOOLEAN no_restore) {
  ENTER("DoStep", FMU_STEP);
  fmu_step_t end;
  return fmu_step(fmu, time, length, &end);
}

FMI_EXPORT fmu_status_t FMI(GetRealStatus)(void *instance,
                                           fmi2_question_t question,
                                           double *value) {
  ENTER("GetRealStatus", FMU_STEP | FMU_TERMINATED);
  if (value == NULL || question != FMI2_LAST_SUCCESSFUL_TIME)
    return fmu_error(fmu, "only fmi2LastSuccessfulTime can be queried");
  *value = fmu_time(&fmu->motion);
  return FMU_OK;
}

FMI_EXPORT fmu_status_t FMI(GetBooleanStatus)(void *instance,
                                              fmi2_question_t question,
                                              FMI_BOOLEAN *value) {
  ENTER("GetBooleanStatus", FMU_STEP | FMU_TERMINATED);
  if (value == NULL || question != FMI2_TERMINATED)
    return fmu_error(fmu, "only fmi2Terminated can be queried");
  *value = 0;
  return FMU_OK;
}

// Steps end before fmi2DoStep returns: there is none to cancel or to ask about.
#define NOT_PENDING(name, ...) \
  CALL(name, FMU_ANY_PHASE,    \
       fmu_error(fmu, "no step of this FMU is ever pending"), __VA_ARGS__)
NOT_PENDING(CancelStep, void *instance)
NOT_PENDING(GetStatus, void *instance, fmi2_question_t question,
            fmu_status_t *value)
NOT_PENDING(GetIntegerStatus, void *instance, fmi2_question_t question,
            int *value)
NOT_PENDING(GetStringStatus, void *instance, fmi2_question_t question,
            fmi2_string_t *value)

REFUSE(GetDirectionalDerivative, const uint32_t unknowns[], size_t n_unknowns,
       const uint32_t knowns[], size_t n_knowns, const double seed[],
       double sensitivity[])
REFUSE(SetRealInputDerivatives, const uint32_t references[], size_t n,
       const int orders[], const double values[])
REFUSE(GetRealOutputDerivatives, const uint32_t references[], size_t n,
       const int orders[], double values[])
