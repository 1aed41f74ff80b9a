// FMI 3.0, co-simulation: each function checks the phase, translates, and
// leaves the work to fmu.h.

#ifndef FMI3_FUNCTION_PREFIX
#define FMI3_FUNCTION_PREFIX
#endif
#define FMI_PREFIX FMI3_FUNCTION_PREFIX
#define FMI_WORD fmi3
#define FMI_VERSION "3.0"
#define FMI_BOOLEAN bool
#define FMI_VALUES(type_t) type_t values[], size_t n_values
#define FMI_COUNT n_values
#define FMI_MOVING ((unsigned)(FMU_EVENT | FMU_STEP))
#include "faces.h"

// Types of the C interface, written from the text of the standard
// (fmi-standard.org).
typedef int fmi3_kind_t; // enumerations of which no value is used here

typedef void fmi3_log_t(void *environment, fmu_status_t status,
                        const char *category, const char *message);
typedef void fmi3_update_t(void *environment, double time, bool may_set,
                           bool may_get, bool finished, bool may_return,
                           bool *wants_return, double *return_time);
typedef void fmi3_clock_update_t(void *environment);
typedef void fmi3_lock_t(void);

static void emit(const fmu_t *fmu, fmu_status_t status, const char *category,
                 const char *text) {
  ((fmi3_log_t *)fmu->logger)(fmu->environment, status, category, text);
}

static fmu_t made_by(const char *call, bool logging, void *environment,
                     fmi3_log_t *logger) {
  return (fmu_t){.call = call,
                 .logs = FMU_LOGS(logging),
                 .environment = environment,
                 .logger = (void (*)(void))logger,
                 .emit = logger == NULL ? NULL : emit,
                 .refusal = FMU_DISCARD};
}

FMI_EXPORT void *FMI(InstantiateCoSimulation)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, bool event_mode, bool early_return,
    const uint32_t intermediate[], size_t n_intermediate, void *environment,
    fmi3_log_t *logger, fmi3_update_t *update) {
  fmu_t own =
      made_by("fmi3InstantiateCoSimulation", logging, environment, logger);
  own.event_mode = event_mode;
  own.early_return = early_return;
  return fmu_new(&own, token);
}

FMI_EXPORT void *FMI(InstantiateModelExchange)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger) {
  fmu_t own =
      made_by("fmi3InstantiateModelExchange", logging, environment, logger);
  return fmu_refuse_type(&own);
}

FMI_EXPORT void *FMI(InstantiateScheduledExecution)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger,
    fmi3_clock_update_t *update, fmi3_lock_t *lock, fmi3_lock_t *unlock) {
  fmu_t own = made_by("fmi3InstantiateScheduledExecution", logging, environment,
                      logger);
  return fmu_refuse_type(&own);
}

FMI_EXPORT fmu_status_t FMI(EnterInitializationMode)(
    void *instance, bool has_tolerance, double tolerance, double start_time,
    bool stops, double stop_time) {
  ENTER("EnterInitializationMode", FMU_INSTANTIATED);
  const fmu_status_t status = fmu_initialize(fmu, start_time, stops, stop_time);
  return status == FMU_OK ? fmu_go_to(fmu, FMU_INITIALIZATION) : status;
}

CALL(ExitInitializationMode, FMU_INITIALIZATION,
     fmu_initialized(fmu, fmu->event_mode ? FMU_EVENT : FMU_STEP),
     void *instance)

FMI_EXPORT fmu_status_t FMI(EnterEventMode)(void *instance) {
  ENTER("EnterEventMode", FMU_STEP);
  if (!fmu->event_mode)
    return fmu_error(fmu, "this instance was made without event mode");
  return fmu_go_to(fmu, FMU_EVENT);
}

CALL(EnterStepMode, FMU_EVENT, fmu_go_to(fmu, FMU_STEP), void *instance)

FMI_EXPORT fmu_status_t FMI(UpdateDiscreteStates)(void *instance, bool *again,
                                                  bool *terminates,
                                                  bool *nominals, bool *values,
                                                  bool *has_next,
                                                  double *next_time) {
  ENTER("UpdateDiscreteStates", FMU_EVENT);
  if (again == NULL || terminates == NULL || nominals == NULL ||
      values == NULL || has_next == NULL || next_time == NULL)
    return fmu_error(fmu, "a pointer to a result is NULL");
  *again = *terminates = *nominals = *values = *has_next = false;
  *next_time = 0;
  return FMU_OK;
}

CALL(EvaluateDiscreteStates, FMU_INITIALIZATION | FMU_EVENT, FMU_OK,
     void *instance)

FMI_EXPORT fmu_status_t FMI(DoStep)(void *instance, double time, double length,
                                    bool no_restore, bool *event,
                                    bool *terminates, bool *early,
                                    double *last_time) {
  ENTER("DoStep", FMU_STEP);
  fmu_step_t end;
  if (event == NULL || terminates == NULL || early == NULL || last_time == NULL)
    return fmu_error(fmu, "a pointer to a result is NULL");
  const fmu_status_t status = fmu_step(fmu, time, length, &end);
  *event = fmu->event_mode && end.event;
  *terminates = false;
  *early = end.early;
  *last_time = end.time;
  return status;
}

COPIES(FMUState, Deserialize, uint8_t)

ACCESS(Float64, double, KIND(REAL), NUMBER)
ACCESS(Int32, int32_t, KIND(SMALL), NUMBER)
ACCESS(UInt32, uint32_t, KIND(SEED), NUMBER)
ACCESS(Int64, int64_t, KIND(MEMBER), NUMBER)
ACCESS(UInt64, uint64_t, KIND(COUNT), NUMBER)
ACCESS(Boolean, bool, KIND(TRUTH), TRUTH)
NO_ACCESS(Float32, float)
NO_ACCESS(Int8, int8_t)
NO_ACCESS(UInt8, uint8_t)
NO_ACCESS(Int16, int16_t)
NO_ACCESS(UInt16, uint16_t)
NO_ACCESS(String, uintptr_t)

// Model exchange, scheduled execution, clocks, arrays and derivatives.

REFUSE_SOME(GetBinary, const uint32_t references[], size_t n, size_t sizes[],
            const uint8_t *values[], size_t n_values)
REFUSE_SOME(SetBinary, const uint32_t references[], size_t n,
            const size_t sizes[], const uint8_t *const values[],
            size_t n_values)
REFUSE_SOME(GetClock, const uint32_t references[], size_t n, bool values[])
REFUSE_SOME(SetClock, const uint32_t references[], size_t n,
            const bool values[])
REFUSE(GetNumberOfVariableDependencies, uint32_t reference, size_t *n)
REFUSE(GetVariableDependencies, uint32_t dependent, size_t elements[],
       uint32_t independents[], size_t their_elements[], fmi3_kind_t kinds[],
       size_t n)
REFUSE(GetDirectionalDerivative, const uint32_t unknowns[], size_t n_unknowns,
       const uint32_t knowns[], size_t n_knowns, const double seed[],
       size_t n_seed, double sensitivity[], size_t n_sensitivity)
REFUSE(GetAdjointDerivative, const uint32_t unknowns[], size_t n_unknowns,
       const uint32_t knowns[], size_t n_knowns, const double seed[],
       size_t n_seed, double sensitivity[], size_t n_sensitivity)
REFUSE_SOME(GetOutputDerivatives, const uint32_t references[], size_t n,
            const int32_t orders[], double values[], size_t n_values)
CALL(EnterConfigurationMode, 0, FMU_ERROR, void *instance)
CALL(ExitConfigurationMode, 0, FMU_ERROR, void *instance)
REFUSE_SOME(GetIntervalDecimal, const uint32_t references[], size_t n,
            double intervals[], fmi3_kind_t qualifiers[])
REFUSE_SOME(GetIntervalFraction, const uint32_t references[], size_t n,
            uint64_t counters[], uint64_t resolutions[],
            fmi3_kind_t qualifiers[])
REFUSE_SOME(GetShiftDecimal, const uint32_t references[], size_t n,
            double shifts[])
REFUSE_SOME(GetShiftFraction, const uint32_t references[], size_t n,
            uint64_t counters[], uint64_t resolutions[])
REFUSE_SOME(SetIntervalDecimal, const uint32_t references[], size_t n,
            const double intervals[])
REFUSE_SOME(SetIntervalFraction, const uint32_t references[], size_t n,
            const uint64_t counters[], const uint64_t resolutions[])
REFUSE_SOME(SetShiftDecimal, const uint32_t references[], size_t n,
            const double shifts[])
REFUSE_SOME(SetShiftFraction, const uint32_t references[], size_t n,
            const uint64_t counters[], const uint64_t resolutions[])
CALL(EnterContinuousTimeMode, 0, FMU_ERROR, void *instance)
REFUSE(CompletedIntegratorStep, bool no_restore, bool *event, bool *terminates)
REFUSE(SetTime, double time)
REFUSE(SetContinuousStates, const double states[], size_t n)
REFUSE(GetContinuousStateDerivatives, double derivatives[], size_t n)
REFUSE(GetEventIndicators, double indicators[], size_t n)
REFUSE(GetContinuousStates, double states[], size_t n)
REFUSE(GetNominalsOfContinuousStates, double nominals[], size_t n)
REFUSE(GetNumberOfEventIndicators, size_t *n)
REFUSE(GetNumberOfContinuousStates, size_t *n)
REFUSE(ActivateModelPartition, uint32_t clock, double time)
