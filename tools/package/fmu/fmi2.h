/// @file
/// FMI 2.0 for co-simulation: the types and functions of the C interface,
/// written from the text of the standard (fmi-standard.org).
#ifndef TWOFOLD_FMU_FMI2_H
#define TWOFOLD_FMU_FMI2_H

#include <stddef.h>

// A program that links several FMUs statically gives each a prefix.
#ifdef FMI2_FUNCTION_PREFIX
#define FMI2_PASTE(prefix, name) prefix##name
#define FMI2_PREFIXED(prefix, name) FMI2_PASTE(prefix, name)
#define FMI2(name) FMI2_PREFIXED(FMI2_FUNCTION_PREFIX, fmi2##name)
#else
#define FMI2(name) fmi2##name
#endif
#if defined(_WIN32)
#define FMI2_EXPORT __declspec(dllexport)
#else
#define FMI2_EXPORT __attribute__((visibility("default")))
#endif

typedef unsigned fmi2_reference_t;
typedef int fmi2_boolean_t;
typedef const char *fmi2_string_t;
typedef enum {
  FMI2_OK,
  FMI2_WARNING,
  FMI2_DISCARD,
  FMI2_ERROR,
  FMI2_FATAL,
  FMI2_PENDING
} fmi2_status_t;
typedef enum { FMI2_MODEL_EXCHANGE, FMI2_CO_SIMULATION } fmi2_type_t;
typedef enum {
  FMI2_DO_STEP_STATUS,
  FMI2_PENDING_STATUS,
  FMI2_LAST_SUCCESSFUL_TIME,
  FMI2_TERMINATED
} fmi2_question_t;

typedef void fmi2_log_t(void *environment, fmi2_string_t instance,
                        fmi2_status_t status, fmi2_string_t category,
                        fmi2_string_t message, ...);
typedef struct {
  fmi2_log_t *logger;
  void *(*allocate)(size_t n, size_t size);
  void (*free)(void *memory);
  void (*step_finished)(void *environment, fmi2_status_t status);
  void *environment;
} fmi2_callbacks_t;

FMI2_EXPORT const char *FMI2(GetTypesPlatform)(void);
FMI2_EXPORT const char *FMI2(GetVersion)(void);
FMI2_EXPORT void *FMI2(Instantiate)(fmi2_string_t name, fmi2_type_t type,
                                    fmi2_string_t token,
                                    fmi2_string_t resources,
                                    const fmi2_callbacks_t *callbacks,
                                    fmi2_boolean_t visible,
                                    fmi2_boolean_t logging);
FMI2_EXPORT void FMI2(FreeInstance)(void *instance);

FMI2_EXPORT fmi2_status_t
    FMI2(SetDebugLogging)(void *instance, fmi2_boolean_t on, size_t n,
                          const fmi2_string_t categories[]);
FMI2_EXPORT fmi2_status_t FMI2(SetupExperiment)(
    void *instance, fmi2_boolean_t has_tolerance, double tolerance,
    double start_time, fmi2_boolean_t stops, double stop_time);
FMI2_EXPORT fmi2_status_t FMI2(EnterInitializationMode)(void *instance);
FMI2_EXPORT fmi2_status_t FMI2(ExitInitializationMode)(void *instance);
FMI2_EXPORT fmi2_status_t FMI2(Terminate)(void *instance);
FMI2_EXPORT fmi2_status_t FMI2(Reset)(void *instance);

/// Reads or sets variables of one type.
#define FMI2_GET(Type, type_t)                                       \
  FMI2_EXPORT fmi2_status_t FMI2(Get##Type)(                         \
      void *instance, const fmi2_reference_t references[], size_t n, \
      type_t values[])
#define FMI2_SET(Type, type_t)                                       \
  FMI2_EXPORT fmi2_status_t FMI2(Set##Type)(                         \
      void *instance, const fmi2_reference_t references[], size_t n, \
      const type_t values[])
FMI2_GET(Real, double);
FMI2_SET(Real, double);
FMI2_GET(Integer, int);
FMI2_SET(Integer, int);
FMI2_GET(Boolean, fmi2_boolean_t);
FMI2_SET(Boolean, fmi2_boolean_t);
FMI2_GET(String, fmi2_string_t);
FMI2_SET(String, fmi2_string_t);

FMI2_EXPORT fmi2_status_t FMI2(GetFMUstate)(void *instance, void **state);
FMI2_EXPORT fmi2_status_t FMI2(SetFMUstate)(void *instance, void *state);
FMI2_EXPORT fmi2_status_t FMI2(FreeFMUstate)(void *instance, void **state);
FMI2_EXPORT fmi2_status_t FMI2(SerializedFMUstateSize)(void *instance,
                                                       void *state,
                                                       size_t *size);
FMI2_EXPORT fmi2_status_t FMI2(SerializeFMUstate)(void *instance, void *state,
                                                  char bytes[], size_t size);
FMI2_EXPORT fmi2_status_t FMI2(DeSerializeFMUstate)(void *instance,
                                                    const char bytes[],
                                                    size_t size, void **state);

FMI2_EXPORT fmi2_status_t FMI2(DoStep)(void *instance, double time,
                                       double length,
                                       fmi2_boolean_t no_restore);
FMI2_EXPORT fmi2_status_t FMI2(CancelStep)(void *instance);
FMI2_EXPORT fmi2_status_t FMI2(GetStatus)(void *instance,
                                          fmi2_question_t question,
                                          fmi2_status_t *value);
FMI2_EXPORT fmi2_status_t FMI2(GetRealStatus)(void *instance,
                                              fmi2_question_t question,
                                              double *value);
FMI2_EXPORT fmi2_status_t FMI2(GetIntegerStatus)(void *instance,
                                                 fmi2_question_t question,
                                                 int *value);
FMI2_EXPORT fmi2_status_t FMI2(GetBooleanStatus)(void *instance,
                                                 fmi2_question_t question,
                                                 fmi2_boolean_t *value);
FMI2_EXPORT fmi2_status_t FMI2(GetStringStatus)(void *instance,
                                                fmi2_question_t question,
                                                fmi2_string_t *value);

// What this FMU has no use for; every importer looks for it all the same.
FMI2_EXPORT fmi2_status_t FMI2(GetDirectionalDerivative)(
    void *instance, const fmi2_reference_t unknowns[], size_t n_unknowns,
    const fmi2_reference_t knowns[], size_t n_knowns, const double seed[],
    double sensitivity[]);
FMI2_EXPORT fmi2_status_t FMI2(SetRealInputDerivatives)(
    void *instance, const fmi2_reference_t references[], size_t n,
    const int orders[], const double values[]);
FMI2_EXPORT fmi2_status_t FMI2(GetRealOutputDerivatives)(
    void *instance, const fmi2_reference_t references[], size_t n,
    const int orders[], double values[]);

#endif
