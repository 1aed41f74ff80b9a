// What FMI 3.0 has for model exchange, scheduled execution, clocks, arrays and
// derivatives. Importers look for every function; these refuse by their name.

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

fmi3_status_t FMI3(GetBinary)(void *instance,
                              const fmi3_reference_t references[], size_t n,
                              size_t sizes[], const uint8_t *values[],
                              size_t n_values) {
  return refuse_some(instance, "fmi3GetBinary", n);
}

fmi3_status_t FMI3(SetBinary)(void *instance,
                              const fmi3_reference_t references[], size_t n,
                              const size_t sizes[],
                              const uint8_t *const values[], size_t n_values) {
  return refuse_some(instance, "fmi3SetBinary", n);
}

fmi3_status_t FMI3(GetClock)(void *instance,
                             const fmi3_reference_t references[], size_t n,
                             bool values[]) {
  return refuse_some(instance, "fmi3GetClock", n);
}

fmi3_status_t FMI3(SetClock)(void *instance,
                             const fmi3_reference_t references[], size_t n,
                             const bool values[]) {
  return refuse_some(instance, "fmi3SetClock", n);
}

fmi3_status_t FMI3(GetNumberOfVariableDependencies)(void *instance,
                                                    fmi3_reference_t reference,
                                                    size_t *n) {
  return refuse(instance, "fmi3GetNumberOfVariableDependencies");
}

fmi3_status_t FMI3(GetVariableDependencies)(void *instance,
                                            fmi3_reference_t dependent,
                                            size_t elements[],
                                            fmi3_reference_t independents[],
                                            size_t their_elements[],
                                            fmi3_kind_t kinds[], size_t n) {
  return refuse(instance, "fmi3GetVariableDependencies");
}

fmi3_status_t FMI3(GetDirectionalDerivative)(
    void *instance, const fmi3_reference_t unknowns[], size_t n_unknowns,
    const fmi3_reference_t knowns[], size_t n_knowns, const double seed[],
    size_t n_seed, double sensitivity[], size_t n_sensitivity) {
  return refuse(instance, "fmi3GetDirectionalDerivative");
}

fmi3_status_t FMI3(GetAdjointDerivative)(
    void *instance, const fmi3_reference_t unknowns[], size_t n_unknowns,
    const fmi3_reference_t knowns[], size_t n_knowns, const double seed[],
    size_t n_seed, double sensitivity[], size_t n_sensitivity) {
  return refuse(instance, "fmi3GetAdjointDerivative");
}

fmi3_status_t FMI3(GetOutputDerivatives)(void *instance,
                                         const fmi3_reference_t references[],
                                         size_t n, const int32_t orders[],
                                         double values[], size_t n_values) {
  return refuse_some(instance, "fmi3GetOutputDerivatives", n);
}

fmi3_status_t FMI3(EnterConfigurationMode)(void *instance) {
  return refuse(instance, "fmi3EnterConfigurationMode");
}

fmi3_status_t FMI3(ExitConfigurationMode)(void *instance) {
  return refuse(instance, "fmi3ExitConfigurationMode");
}

fmi3_status_t FMI3(GetIntervalDecimal)(void *instance,
                                       const fmi3_reference_t references[],
                                       size_t n, double intervals[],
                                       fmi3_kind_t qualifiers[]) {
  return refuse_some(instance, "fmi3GetIntervalDecimal", n);
}

fmi3_status_t FMI3(GetIntervalFraction)(void *instance,
                                        const fmi3_reference_t references[],
                                        size_t n, uint64_t counters[],
                                        uint64_t resolutions[],
                                        fmi3_kind_t qualifiers[]) {
  return refuse_some(instance, "fmi3GetIntervalFraction", n);
}

fmi3_status_t FMI3(GetShiftDecimal)(void *instance,
                                    const fmi3_reference_t references[],
                                    size_t n, double shifts[]) {
  return refuse_some(instance, "fmi3GetShiftDecimal", n);
}

fmi3_status_t FMI3(GetShiftFraction)(void *instance,
                                     const fmi3_reference_t references[],
                                     size_t n, uint64_t counters[],
                                     uint64_t resolutions[]) {
  return refuse_some(instance, "fmi3GetShiftFraction", n);
}

fmi3_status_t FMI3(SetIntervalDecimal)(void *instance,
                                       const fmi3_reference_t references[],
                                       size_t n, const double intervals[]) {
  return refuse_some(instance, "fmi3SetIntervalDecimal", n);
}

fmi3_status_t FMI3(SetIntervalFraction)(void *instance,
                                        const fmi3_reference_t references[],
                                        size_t n, const uint64_t counters[],
                                        const uint64_t resolutions[]) {
  return refuse_some(instance, "fmi3SetIntervalFraction", n);
}

fmi3_status_t FMI3(SetShiftDecimal)(void *instance,
                                    const fmi3_reference_t references[],
                                    size_t n, const double shifts[]) {
  return refuse_some(instance, "fmi3SetShiftDecimal", n);
}

fmi3_status_t FMI3(SetShiftFraction)(void *instance,
                                     const fmi3_reference_t references[],
                                     size_t n, const uint64_t counters[],
                                     const uint64_t resolutions[]) {
  return refuse_some(instance, "fmi3SetShiftFraction", n);
}

fmi3_status_t FMI3(EnterContinuousTimeMode)(void *instance) {
  return refuse(instance, "fmi3EnterContinuousTimeMode");
}

fmi3_status_t FMI3(CompletedIntegratorStep)(void *instance, bool no_restore,
                                            bool *event, bool *terminates) {
  return refuse(instance, "fmi3CompletedIntegratorStep");
}

fmi3_status_t FMI3(SetTime)(void *instance, double time) {
  return refuse(instance, "fmi3SetTime");
}

fmi3_status_t FMI3(SetContinuousStates)(void *instance, const double states[],
                                        size_t n) {
  return refuse(instance, "fmi3SetContinuousStates");
}

fmi3_status_t FMI3(GetContinuousStateDerivatives)(void *instance,
                                                  double derivatives[],
                                                  size_t n) {
  return refuse(instance, "fmi3GetContinuousStateDerivatives");
}

fmi3_status_t FMI3(GetEventIndicators)(void *instance, double indicators[],
                                       size_t n) {
  return refuse(instance, "fmi3GetEventIndicators");
}

fmi3_status_t FMI3(GetContinuousStates)(void *instance, double states[],
                                        size_t n) {
  return refuse(instance, "fmi3GetContinuousStates");
}

fmi3_status_t FMI3(GetNominalsOfContinuousStates)(void *instance,
                                                  double nominals[], size_t n) {
  return refuse(instance, "fmi3GetNominalsOfContinuousStates");
}

fmi3_status_t FMI3(GetNumberOfEventIndicators)(void *instance, size_t *n) {
  return refuse(instance, "fmi3GetNumberOfEventIndicators");
}

fmi3_status_t FMI3(GetNumberOfContinuousStates)(void *instance, size_t *n) {
  return refuse(instance, "fmi3GetNumberOfContinuousStates");
}

fmi3_status_t FMI3(ActivateModelPartition)(void *instance,
                                           fmi3_reference_t clock,
                                           double time) {
  return refuse(instance, "fmi3ActivateModelPartition");
}
