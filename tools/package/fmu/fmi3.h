/// @file
/// FMI 3.0 for co-simulation: the types and functions of the C interface,
/// written from the text of the standard (fmi-standard.org). Its own headers
/// belong to the importer and are not part of an FMU.
#ifndef TWOFOLD_FMU_FMI3_H
#define TWOFOLD_FMU_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A program that links several FMUs statically gives each a prefix.
#ifdef FMI3_FUNCTION_PREFIX
#define FMI3_PASTE(prefix, name) prefix##name
#define FMI3_PREFIXED(prefix, name) FMI3_PASTE(prefix, name)
#define FMI3(name) FMI3_PREFIXED(FMI3_FUNCTION_PREFIX, fmi3##name)
#else
#define FMI3(name) fmi3##name
#endif
#if defined(_WIN32)
#define FMI3_EXPORT __declspec(dllexport)
#else
#define FMI3_EXPORT __attribute__((visibility("default")))
#endif

typedef uint32_t fmi3_reference_t;
typedef enum {
  FMI3_OK,
  FMI3_WARNING,
  FMI3_DISCARD,
  FMI3_ERROR,
  FMI3_FATAL
} fmi3_status_t;
typedef int fmi3_kind_t; ///< enumerations of which no value is used here

typedef void fmi3_log_t(void *environment, fmi3_status_t status,
                        const char *category, const char *message);
typedef void fmi3_update_t(void *environment, double time, bool may_set,
                           bool may_get, bool finished, bool may_return,
                           bool *wants_return, double *return_time);
typedef void fmi3_clock_update_t(void *environment);
typedef void fmi3_lock_t(void);

/// Reads or sets variables of one type.
#define FMI3_GET(Type, type_t)                                       \
  FMI3_EXPORT fmi3_status_t FMI3(Get##Type)(                         \
      void *instance, const fmi3_reference_t references[], size_t n, \
      type_t values[], size_t n_values)
#define FMI3_SET(Type, type_t)                                       \
  FMI3_EXPORT fmi3_status_t FMI3(Set##Type)(                         \
      void *instance, const fmi3_reference_t references[], size_t n, \
      const type_t values[], size_t n_values)
#define FMI3_BOTH(Type, type_t) \
  FMI3_GET(Type, type_t);       \
  FMI3_SET(Type, type_t)

FMI3_BOTH(Float32, float);
FMI3_BOTH(Float64, double);
FMI3_BOTH(Int8, int8_t);
FMI3_BOTH(UInt8, uint8_t);
FMI3_BOTH(Int16, int16_t);
FMI3_BOTH(UInt16, uint16_t);
FMI3_BOTH(Int32, int32_t);
FMI3_BOTH(UInt32, uint32_t);
FMI3_BOTH(Int64, int64_t);
FMI3_BOTH(UInt64, uint64_t);
FMI3_BOTH(Boolean, bool);
typedef const char *fmi3_string_t;
FMI3_BOTH(String, fmi3_string_t);

/// A function of the interface. All of them but these two return a status.
FMI3_EXPORT const char *FMI3(GetVersion)(void);
FMI3_EXPORT void FMI3(FreeInstance)(void *instance);

FMI3_EXPORT void *FMI3(InstantiateCoSimulation)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, bool event_mode, bool early_return,
    const fmi3_reference_t intermediate[], size_t n_intermediate,
    void *environment, fmi3_log_t *logger, fmi3_update_t *update);
FMI3_EXPORT void *FMI3(InstantiateModelExchange)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger);
FMI3_EXPORT void *FMI3(InstantiateScheduledExecution)(
    const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, fmi3_log_t *logger,
    fmi3_clock_update_t *update, fmi3_lock_t *lock, fmi3_lock_t *unlock);

FMI3_EXPORT fmi3_status_t FMI3(SetDebugLogging)(
    void *instance, bool on, size_t n, const fmi3_string_t categories[]);
FMI3_EXPORT fmi3_status_t FMI3(EnterInitializationMode)(
    void *instance, bool has_tolerance, double tolerance, double start_time,
    bool stops, double stop_time);
FMI3_EXPORT fmi3_status_t FMI3(ExitInitializationMode)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(EnterEventMode)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(EnterStepMode)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(Terminate)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(Reset)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(UpdateDiscreteStates)(
    void *instance, bool *again, bool *terminates, bool *nominals, bool *values,
    bool *has_next, double *next_time);
FMI3_EXPORT fmi3_status_t FMI3(EvaluateDiscreteStates)(void *instance);
FMI3_EXPORT fmi3_status_t FMI3(DoStep)(void *instance, double time,
                                       double length, bool no_restore,
                                       bool *event, bool *terminates,
                                       bool *early, double *last_time);

FMI3_EXPORT fmi3_status_t FMI3(GetFMUState)(void *instance, void **state);
FMI3_EXPORT fmi3_status_t FMI3(SetFMUState)(void *instance, void *state);
FMI3_EXPORT fmi3_status_t FMI3(FreeFMUState)(void *instance, void **state);
FMI3_EXPORT fmi3_status_t FMI3(SerializedFMUStateSize)(void *instance,
                                                       void *state,
                                                       size_t *size);
FMI3_EXPORT fmi3_status_t FMI3(SerializeFMUState)(void *instance, void *state,
                                                  uint8_t bytes[], size_t size);
FMI3_EXPORT fmi3_status_t FMI3(DeserializeFMUState)(void *instance,
                                                    const uint8_t bytes[],
                                                    size_t size, void **state);

// The rest of the interface, of which this FMU has no use, is declared where it
// is refused, in fmi3_absent.c.

#endif
