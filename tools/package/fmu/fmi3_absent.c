// What FMI 3.0 has for model exchange, scheduled execution, clocks, arrays and
// derivatives. Importers look for every function; these refuse by their name.

#include "fmi3.h"

static fmu_status_t refuse(void *instance, const char *call) {
  (void)fmu_enter(instance, call, 0);
  return FMU_ERROR;
}

// A list of no variables is fine.
static fmu_status_t refuse_some(void *instance, const char *call, size_t n) {
  if (n > 0) return refuse(instance, call);
  return fmu_enter(instance, call, FMU_ANY_PHASE) ? FMU_OK : FMU_ERROR;
}

static void *no_instance(bool logging, void *environment, fmi3_log_t *logger,
                         const char *why) {
  if (logging && logger != NULL)
    logger(environment, FMU_ERROR, "logStatusError", why);
  return NULL;
}

FMI_EXPORT void *FMI(InstantiateModelExchange)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger) {
  return no_instance(logging, environment, logger,
                     "fmi3InstantiateModelExchange: this FMU is for"
                     " co-simulation");
}

FMI_EXPORT void *FMI(InstantiateScheduledExecution)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger,
    fmi3_clock_update_t *update, fmi3_lock_t *lock, fmi3_lock_t *unlock) {
  return no_instance(logging, environment, logger,
                     "fmi3InstantiateScheduledExecution: this FMU is for"
                     " co-simulation");
}

// REFUSE(name, arguments after the instance); REFUSE_SOME: a list of n
// variables is among them, and one of none is fine.
#define DEFINE(name, refusal, ...)                                 \
  FMI_EXPORT fmu_status_t FMI(name)(void *instance, __VA_ARGS__) { \
    return refusal;                                                \
  }
#define REFUSE(name, ...) \
  DEFINE(name, refuse(instance, "fmi3" #name), __VA_ARGS__)
#define REFUSE_SOME(name, ...) \
  DEFINE(name, refuse_some(instance, "fmi3" #name, n), __VA_ARGS__)
#define REFUSE_ALONE(name)                            \
  FMI_EXPORT fmu_status_t FMI(name)(void *instance) { \
    return refuse(instance, "fmi3" #name);            \
  }

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
REFUSE_ALONE(EnterConfigurationMode)
REFUSE_ALONE(ExitConfigurationMode)
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
REFUSE_ALONE(EnterContinuousTimeMode)
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
