// FMI 3.0, co-simulation: each function checks the phase, translates, and
// leaves the work to model.h.

#include "fmi3.h"

static void emit(const fmu_t *fmu, fmu_status_t status, const char *category,
                 const char *text) {
  ((fmi3_log_t *)fmu->logger)(fmu->environment, status, category, text);
}

FMI_EXPORT const char *FMI(GetVersion)(void) { return "3.0"; }

FMI_EXPORT void *FMI(InstantiateCoSimulation)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, bool event_mode, bool early_return,
    const uint32_t intermediate[], size_t n_intermediate, void *environment,
    fmi3_log_t *logger, fmi3_update_t *update) {
  fmu_t teller = fmu_teller("fmi3InstantiateCoSimulation", name, logging);
  teller.environment = environment;
  teller.logger = (void (*)(void))logger;
  teller.emit = logger == NULL ? NULL : emit;
  teller.refusal = FMU_DISCARD;
  teller.event_mode = event_mode;
  teller.early_return = early_return;
  return fmu_new(&teller, token);
}

FMI_EXPORT void FMI(FreeInstance)(void *instance) { fmu_free(instance); }

CALL(SetDebugLogging, FMU_ANY_PHASE, fmu_set_logging(fmu, on, n, categories),
     void *instance, bool on, size_t n, const fmi3_string_t categories[])

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

CALL(Terminate, FMI_MOVING, fmu_go_to(fmu, FMU_TERMINATED), void *instance)

CALL(Reset, FMU_ANY_PHASE, fmu_reset(fmu), void *instance)

FMI_EXPORT fmu_status_t FMI(UpdateDiscreteStates)(void *instance, bool *again,
                                                  bool *terminates,
                                                  bool *nominals, bool *values,
                                                  bool *has_next,
                                                  double *next_time) {
  ENTER("UpdateDiscreteStates", FMU_EVENT);
  if (again == NULL || terminates == NULL || nominals == NULL ||
      values == NULL || has_next == NULL || next_time == NULL)
    return fmu_error(fmu, "nowhere to put a result: NULL");
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
    return fmu_error(fmu, "nowhere to put a result: NULL");
  const fmu_status_t status = fmu_step(fmu, time, length, &end);
  *event = fmu->event_mode && end.event;
  *terminates = false;
  *early = end.early;
  *last_time = end.time;
  return status;
}

COPIES(FMUState, Deserialize, uint8_t)

ACCESS(Float64, double, KIND(REAL), double, fmu_get_real, NUMBER)
ACCESS(Int32, int32_t, KIND(SMALL), int64_t, fmu_get_whole, NUMBER)
ACCESS(UInt32, uint32_t, KIND(SEED), int64_t, fmu_get_whole, NUMBER)
ACCESS(Int64, int64_t, KIND(MEMBER), int64_t, fmu_get_whole, NUMBER)
ACCESS(UInt64, uint64_t, KIND(COUNT), int64_t, fmu_get_whole, NUMBER)
ACCESS(Boolean, bool, KIND(TRUTH), int64_t, fmu_get_whole, TRUTH)

// Types of which this FMU has no variable.
NO_ACCESS(Float32, float)
NO_ACCESS(Int8, int8_t)
NO_ACCESS(UInt8, uint8_t)
NO_ACCESS(Int16, int16_t)
NO_ACCESS(UInt16, uint16_t)
NO_ACCESS(String, fmi3_string_t)
