// What FMI 3.0 has for model exchange, scheduled execution, clocks, arrays and
// derivatives. Importers look for every function; these refuse by their name,
// and since nothing of the FMU calls one, each is declared where it is defined.

#include "fmi3.h"
#include "model.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

static fmi3_status_t refuse(void *instance, const char *call) {
  (void)fmu_enter(instance, call, 0);
  return FMI3_ERROR;
}

// A list of no variables is fine.
static fmi3_status_t refuse_some(void *instance, const char *call, size_t n) {
  if (n > 0) return refuse(instance, call);
  return fmu_enter(instance, call, FMU_ANY_PHASE) ? FMI3_OK : FMI3_ERROR;
}

static void *no_instance(bool logging, void *environment, fmi3_log_t *logger,
                         const char *why) {
  if (logging && logger != NULL)
    logger(environment, FMI3_ERROR, "logStatusError", why);
  return NULL;
}

void *FMI3(InstantiateModelExchange)(const char *name, const char *token,
                                     const char *resources, bool visible,
                                     bool logging, void *environment,
                                     fmi3_log_t *logger) {
  return no_instance(logging, environment, logger,
                     "fmi3InstantiateModelExchange: this FMU is for"
                     " co-simulation");
}

void *FMI3(InstantiateScheduledExecution)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger,
    fmi3_clock_update_t *update, fmi3_lock_t *lock, fmi3_lock_t *unlock) {
  return no_instance(logging, environment, logger,
                     "fmi3InstantiateScheduledExecution: this FMU is for"
                     " co-simulation");
}

// REFUSE(name, arguments after the instance); REFUSE_SOME: a list of n variables
// is among them, and one of none is fine.
#define DEFINE(name, refusal, ...)                                   \
  FMI3_EXPORT fmi3_status_t FMI3(name)(void *instance, __VA_ARGS__); \
  fmi3_status_t FMI3(name)(void *instance, __VA_ARGS__) { return refusal; }
#define REFUSE(name, ...) \
  DEFINE(name, refuse(instance, "fmi3" #name), __VA_ARGS__)
#define REFUSE_SOME(name, ...) \
  DEFINE(name, refuse_some(instance, "fmi3" #name, n), __VA_ARGS__)
#define REFUSE_ALONE(name)                              \
  FMI3_EXPORT fmi3_status_t FMI3(name)(void *instance); \
  fmi3_status_t FMI3(name)(void *instance) {            \
    return refuse(instance, "fmi3" #name);              \
  }

REFUSE_SOME(GetBinary, const fmi3_reference_t references[], size_t n,
            size_t sizes[], const uint8_t *values[], size_t n_values)
REFUSE_SOME(SetBinary, const fmi3_reference_t references[], size_t n,
            const size_t sizes[], const uint8_t *const values[],
            size_t n_values)
REFUSE_SOME(GetClock, const fmi3_reference_t references[], size_t n,
            bool values[])
REFUSE_SOME(SetClock, const fmi3_reference_t references[], size_t n,
            const bool values[])
REFUSE(GetNumberOfVariableDependencies, fmi3_reference_t reference, size_t *n)
REFUSE(GetVariableDependencies, fmi3_reference_t dependent, size_t elements[],
       fmi3_reference_t independents[], size_t their_elements[],
       fmi3_kind_t kinds[], size_t n)
REFUSE(GetDirectionalDerivative, const fmi3_reference_t unknowns[],
       size_t n_unknowns, const fmi3_reference_t knowns[], size_t n_knowns,
       const double seed[], size_t n_seed, double sensitivity[],
       size_t n_sensitivity)
REFUSE(GetAdjointDerivative, const fmi3_reference_t unknowns[],
       size_t n_unknowns, const fmi3_reference_t knowns[], size_t n_knowns,
       const double seed[], size_t n_seed, double sensitivity[],
       size_t n_sensitivity)
REFUSE_SOME(GetOutputDerivatives, const fmi3_reference_t references[], size_t n,
            const int32_t orders[], double values[], size_t n_values)
REFUSE_ALONE(EnterConfigurationMode)
REFUSE_ALONE(ExitConfigurationMode)
REFUSE_SOME(GetIntervalDecimal, const fmi3_reference_t references[], size_t n,
            double intervals[], fmi3_kind_t qualifiers[])
REFUSE_SOME(GetIntervalFraction, const fmi3_reference_t references[], size_t n,
            uint64_t counters[], uint64_t resolutions[],
            fmi3_kind_t qualifiers[])
REFUSE_SOME(GetShiftDecimal, const fmi3_reference_t references[], size_t n,
            double shifts[])
REFUSE_SOME(GetShiftFraction, const fmi3_reference_t references[], size_t n,
            uint64_t counters[], uint64_t resolutions[])
REFUSE_SOME(SetIntervalDecimal, const fmi3_reference_t references[], size_t n,
            const double intervals[])
REFUSE_SOME(SetIntervalFraction, const fmi3_reference_t references[], size_t n,
            const uint64_t counters[], const uint64_t resolutions[])
REFUSE_SOME(SetShiftDecimal, const fmi3_reference_t references[], size_t n,
            const double shifts[])
REFUSE_SOME(SetShiftFraction, const fmi3_reference_t references[], size_t n,
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
REFUSE(ActivateModelPartition, fmi3_reference_t clock, double time)
