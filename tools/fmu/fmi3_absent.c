// What FMI 3.0 has for model exchange, scheduled execution, clocks, arrays and
// derivatives. Importers look for every function; these refuse by their name.

#include "fmi3.h"
#include "model.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

#define REFUSE(call)                           \
  {                                            \
    (void)fmu_enter(instance, "fmi3" call, 0); \
    return FMI3_ERROR;                         \
  }
// A list of no variables is fine.
#define REFUSE_SOME(call)                                                  \
  {                                                                        \
    if (n == 0 && fmu_enter(instance, "fmi3" call, FMU_ANY_PHASE) != NULL) \
      return FMI3_OK;                                                      \
    REFUSE(call)                                                           \
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

FMI3_FUNCTION(GetBinary)
(void *instance, const fmi3_reference_t references[], size_t n, size_t sizes[],
 const uint8_t *values[], size_t n_values) REFUSE_SOME("GetBinary")

    FMI3_FUNCTION(SetBinary)(void *instance,
                             const fmi3_reference_t references[], size_t n,
                             const size_t sizes[],
                             const uint8_t *const values[], size_t n_values)
        REFUSE_SOME("SetBinary")

            FMI3_FUNCTION(GetClock)(void *instance,
                                    const fmi3_reference_t references[],
                                    size_t n, bool values[])
                REFUSE_SOME("GetClock")

                    FMI3_FUNCTION(SetClock)(void *instance,
                                            const fmi3_reference_t references[],
                                            size_t n, const bool values[])
                        REFUSE_SOME("SetClock")

                            FMI3_FUNCTION(GetNumberOfVariableDependencies)(
                                void *instance, fmi3_reference_t reference,
                                size_t *n)
                                REFUSE("GetNumberOfVariableDependencies")

                                    FMI3_FUNCTION(GetVariableDependencies)(
                                        void *instance,
                                        fmi3_reference_t dependent,
                                        size_t elements[],
                                        fmi3_reference_t independents[],
                                        size_t their_elements[],
                                        fmi3_kind_t kinds[], size_t n)
                                        REFUSE("GetVariableDependencies")

                                            FMI3_FUNCTION(
                                                GetDirectionalDerivative)(
                                                void *instance,
                                                const fmi3_reference_t
                                                    unknowns[],
                                                size_t n_unknowns,
                                                const fmi3_reference_t knowns[],
                                                size_t n_knowns,
                                                const double seed[],
                                                size_t n_seed,
                                                double sensitivity[],
                                                size_t n_sensitivity)
                                                REFUSE(
                                                    "GetDirectionalDerivative")

                                                    FMI3_FUNCTION(
                                                        GetAdjointDerivative)(
                                                        void *instance,
                                                        const fmi3_reference_t
                                                            unknowns[],
                                                        size_t n_unknowns,
                                                        const fmi3_reference_t
                                                            knowns[],
                                                        size_t n_knowns,
                                                        const double seed[],
                                                        size_t n_seed,
                                                        double sensitivity[],
                                                        size_t n_sensitivity)
                                                        REFUSE(
                                                            "GetAdjointDerivati"
                                                            "ve")

                                                            FMI3_FUNCTION(
                                                                GetOutputDerivatives)(
                                                                void *instance,
                                                                const fmi3_reference_t
                                                                    references
                                                                        [],
                                                                size_t n,
                                                                const int32_t
                                                                    orders[],
                                                                double values[],
                                                                size_t n_values)
                                                                REFUSE_SOME(
                                                                    "GetOutputD"
                                                                    "erivative"
                                                                    "s")

                                                                    FMI3_FUNCTION(
                                                                        EnterConfigurationMode)(
                                                                        void *
                                                                            instance)
                                                                        REFUSE(
                                                                            "En"
                                                                            "te"
                                                                            "rC"
                                                                            "on"
                                                                            "fi"
                                                                            "gu"
                                                                            "ra"
                                                                            "ti"
                                                                            "on"
                                                                            "Mo"
                                                                            "d"
                                                                            "e")

                                                                            FMI3_FUNCTION(
                                                                                ExitConfigurationMode)(
                                                                                void *
                                                                                    instance)
                                                                                REFUSE(
                                                                                    "ExitConfigurationMode")

                                                                                    FMI3_FUNCTION(
                                                                                        GetIntervalDecimal)(
                                                                                        void *
                                                                                            instance,
                                                                                        const fmi3_reference_t
                                                                                            references
                                                                                                [],
                                                                                        size_t
                                                                                            n,
                                                                                        double intervals
                                                                                            [],
                                                                                        fmi3_kind_t qualifiers
                                                                                            [])
                                                                                        REFUSE_SOME(
                                                                                            "GetIntervalDecimal")

                                                                                            FMI3_FUNCTION(
                                                                                                GetIntervalFraction)(
                                                                                                void *
                                                                                                    instance,
                                                                                                const fmi3_reference_t
                                                                                                    references
                                                                                                        [],
                                                                                                size_t
                                                                                                    n,
                                                                                                uint64_t counters
                                                                                                    [],
                                                                                                uint64_t resolutions
                                                                                                    [],
                                                                                                fmi3_kind_t qualifiers
                                                                                                    [])
                                                                                                REFUSE_SOME(
                                                                                                    "GetIntervalFraction")

                                                                                                    FMI3_FUNCTION(
                                                                                                        GetShiftDecimal)(
                                                                                                        void *
                                                                                                            instance,
                                                                                                        const fmi3_reference_t
                                                                                                            references
                                                                                                                [],
                                                                                                        size_t
                                                                                                            n,
                                                                                                        double shifts
                                                                                                            [])
                                                                                                        REFUSE_SOME(
                                                                                                            "GetShiftDecimal")

                                                                                                            FMI3_FUNCTION(
                                                                                                                GetShiftFraction)(void *instance, const fmi3_reference_t references[], size_t n, uint64_t counters[],
                                                                                                                                  uint64_t resolutions[])
                                                                                                                REFUSE_SOME(
                                                                                                                    "GetShiftFraction")

                                                                                                                    FMI3_FUNCTION(SetIntervalDecimal)(void
                                                                                                                                                          *instance,
                                                                                                                                                      const fmi3_reference_t
                                                                                                                                                          references
                                                                                                                                                              [],
                                                                                                                                                      size_t
                                                                                                                                                          n,
                                                                                                                                                      const double
                                                                                                                                                          intervals[])
                                                                                                                        REFUSE_SOME(
                                                                                                                            "SetIntervalDecimal")

                                                                                                                            FMI3_FUNCTION(SetIntervalFraction)(void *instance, const fmi3_reference_t references[], size_t n, const uint64_t counters[], const uint64_t resolutions[]) REFUSE_SOME(
                                                                                                                                "SetIntervalFraction")

                                                                                                                                FMI3_FUNCTION(SetShiftDecimal)(void *instance, const fmi3_reference_t references[], size_t n, const double shifts[]) REFUSE_SOME(
                                                                                                                                    "SetShiftDecimal")

                                                                                                                                    FMI3_FUNCTION(
                                                                                                                                        SetShiftFraction)(void *
                                                                                                                                                              instance,
                                                                                                                                                          const fmi3_reference_t references[], size_t n, const uint64_t counters[],
                                                                                                                                                          const uint64_t resolutions
                                                                                                                                                              [])
                                                                                                                                        REFUSE_SOME(
                                                                                                                                            "SetShiftFraction")

                                                                                                                                            FMI3_FUNCTION(EnterContinuousTimeMode)(void *instance) REFUSE(
                                                                                                                                                "EnterContinuousTimeMode")

                                                                                                                                                FMI3_FUNCTION(
                                                                                                                                                    CompletedIntegratorStep)(void *instance, bool no_restore, bool *event,
                                                                                                                                                                             bool *
                                                                                                                                                                                 terminates)
                                                                                                                                                    REFUSE(
                                                                                                                                                        "CompletedIntegratorStep")

                                                                                                                                                        FMI3_FUNCTION(
                                                                                                                                                            SetTime)(
                                                                                                                                                            void *
                                                                                                                                                                instance,
                                                                                                                                                            double time)
                                                                                                                                                            REFUSE(
                                                                                                                                                                "SetTime")

                                                                                                                                                                FMI3_FUNCTION(SetContinuousStates)(void *instance, const double states[], size_t n) REFUSE(
                                                                                                                                                                    "SetContinuousStates")

                                                                                                                                                                    FMI3_FUNCTION(
                                                                                                                                                                        GetContinuousStateDerivatives)(
                                                                                                                                                                        void *
                                                                                                                                                                            instance,
                                                                                                                                                                        double derivatives
                                                                                                                                                                            [],
                                                                                                                                                                        size_t
                                                                                                                                                                            n)
                                                                                                                                                                        REFUSE(
                                                                                                                                                                            "GetContinuousStateDerivatives")

                                                                                                                                                                            FMI3_FUNCTION(GetEventIndicators)(void *
                                                                                                                                                                                                                  instance,
                                                                                                                                                                                                              double indicators
                                                                                                                                                                                                                  [],
                                                                                                                                                                                                              size_t
                                                                                                                                                                                                                  n)
                                                                                                                                                                                REFUSE(
                                                                                                                                                                                    "GetEventIndicators")

                                                                                                                                                                                    FMI3_FUNCTION(GetContinuousStates)(void *instance, double states[], size_t n) REFUSE(
                                                                                                                                                                                        "GetContinuousStates")

                                                                                                                                                                                        FMI3_FUNCTION(
                                                                                                                                                                                            GetNominalsOfContinuousStates)(
                                                                                                                                                                                            void *
                                                                                                                                                                                                instance,
                                                                                                                                                                                            double nominals
                                                                                                                                                                                                [],
                                                                                                                                                                                            size_t
                                                                                                                                                                                                n)
                                                                                                                                                                                            REFUSE(
                                                                                                                                                                                                "GetNominalsOfContinuousStates")

                                                                                                                                                                                                FMI3_FUNCTION(GetNumberOfEventIndicators)(void *
                                                                                                                                                                                                                                              instance,
                                                                                                                                                                                                                                          size_t
                                                                                                                                                                                                                                              *n)
                                                                                                                                                                                                    REFUSE(
                                                                                                                                                                                                        "GetNumberOfEventIndicators")

                                                                                                                                                                                                        FMI3_FUNCTION(
                                                                                                                                                                                                            GetNumberOfContinuousStates)(
                                                                                                                                                                                                            void *
                                                                                                                                                                                                                instance,
                                                                                                                                                                                                            size_t
                                                                                                                                                                                                                *n)
                                                                                                                                                                                                            REFUSE(
                                                                                                                                                                                                                "GetNumberOfContinuousStates")

                                                                                                                                                                                                                FMI3_FUNCTION(
                                                                                                                                                                                                                    ActivateModelPartition)(
                                                                                                                                                                                                                    void *
                                                                                                                                                                                                                        instance,
                                                                                                                                                                                                                    fmi3_reference_t
                                                                                                                                                                                                                        clock,
                                                                                                                                                                                                                    double
                                                                                                                                                                                                                        time)
                                                                                                                                                                                                                    REFUSE(
                                                                                                                                                                                                                        "ActivateModelPartition")
