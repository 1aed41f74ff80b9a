/// What both versions of the interface do alike. Importers look functions up by
/// their names, and nothing of the FMU calls one, so each is declared where it
/// is defined. A file of a version defines before it includes this one:
///   FMI_WORD          fmi2 or fmi3, how the names of its functions begin
///   FMI_VERSION       the version as a text
///   FMI_BOOLEAN       its type of truth values
///   FMI_PREFIX        what a program that links several FMUs statically puts
///                     before them; else nothing
///   FMI_VALUES(type)  the arguments of a list of values
///   FMI_COUNT         how many values there are, of these arguments
///   FMI_MOVING        the phases after initialization
#ifndef TWOFOLD_FMU_FACES_H
#define TWOFOLD_FMU_FACES_H

#include "fmu.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
// Of what the standard hands over some is of no use here.
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
#if defined(_WIN32)
#define FMI_EXPORT __declspec(dllexport)
#else
#define FMI_EXPORT __attribute__((visibility("default")))
#endif
#define FMI_PASTED(prefix, word, name) prefix##word##name
#define FMI_NAMED(prefix, word, name) FMI_PASTED(prefix, word, name)
#define FMI(name) FMI_NAMED(FMI_PREFIX, FMI_WORD, name)
#define FMI_QUOTED(word) #word
#define FMI_TEXT(word) FMI_QUOTED(word)

#define KIND(name) (1u << FMU_KIND_##name)
#define SETTABLE (FMU_INSTANTIATED | FMU_INITIALIZATION | FMI_MOVING)
#define READABLE (SETTABLE | FMU_TERMINATED)

/// The beginning of a function that is allowed in some phases.
// Texts are joined. NOLINTBEGIN(bugprone-macro-parentheses)
#define ENTER(name, phases)                                          \
  fmu_t *fmu = fmu_enter(instance, FMI_TEXT(FMI_WORD) name, phases); \
  if (fmu == NULL) return FMU_ERROR
// NOLINTEND(bugprone-macro-parentheses)

/// A function that is allowed in some phases and returns what an expression
/// does; after the expression its arguments.
#define CALL(name, phases, expression, ...)        \
  FMI_EXPORT fmu_status_t FMI(name)(__VA_ARGS__) { \
    ENTER(#name, phases);                          \
    return expression;                             \
  }

/// Functions for which this FMU has no use; every importer looks for them all
/// the same. SOME: a list of n variables is among the arguments, and an empty
/// one is fine.
#define REFUSE(name, ...) CALL(name, 0, FMU_ERROR, void *instance, __VA_ARGS__)
#define REFUSE_SOME(name, ...) \
  CALL(name, n > 0 ? 0u : FMU_ANY_PHASE, FMU_OK, void *instance, __VA_ARGS__)

/// A value of the interface as a number. Any but 0 is true.
#define NUMBER(value) ((double)(value))
#define TRUTH(value) ((value) != 0 ? 1.0 : 0.0)

/// Reads and sets variables of one type. All are checked before one is set, so
/// that a refused call leaves the instance as it was.
#define ACCESS(Type, type_t, kinds, number)                                    \
  FMI_EXPORT fmu_status_t FMI(Get##Type)(void *instance,                       \
                                         const uint32_t references[],          \
                                         size_t n, FMI_VALUES(type_t)) {       \
    ENTER("Get" #Type, READABLE);                                              \
    fmu_status_t status =                                                      \
        fmu_check_lists(fmu, n, FMI_COUNT, references, values);                \
    for (size_t i = 0; i < n && status == FMU_OK; i++) {                       \
      double value = 0;                                                        \
      status = fmu_get(fmu, references[i], kinds, #Type, &value);              \
      if (status == FMU_OK) values[i] = (type_t)value;                         \
    }                                                                          \
    return status;                                                             \
  }                                                                            \
  FMI_EXPORT fmu_status_t FMI(Set##Type)(void *instance,                       \
                                         const uint32_t references[],          \
                                         size_t n, FMI_VALUES(const type_t)) { \
    ENTER("Set" #Type, SETTABLE);                                              \
    fmu_status_t status =                                                      \
        fmu_check_lists(fmu, n, FMI_COUNT, references, values);                \
    for (size_t i = 0; i < n && status == FMU_OK; i++)                         \
      status =                                                                 \
          fmu_check_set(fmu, references[i], kinds, #Type, number(values[i]));  \
    for (size_t i = 0; i < n && status == FMU_OK; i++)                         \
      fmu_set(fmu, references[i], number(values[i]));                          \
    return status;                                                             \
  }

/// Types of which this FMU has no variable: every reference is refused. A text
/// is passed as an address, which nothing looks at.
#define NO_ACCESS(Type, type_t) ACCESS(Type, type_t, 0, NUMBER)

/// Copies of the state, whose functions the versions spell differently.
#define COPIES(State, Deserialize, byte_t)                                    \
  CALL(Get##State, FMU_ANY_PHASE, fmu_copy(fmu, state), void *instance,       \
       void **state)                                                          \
  CALL(Set##State, FMU_ANY_PHASE, fmu_restore(fmu, state), void *instance,    \
       void *state)                                                           \
  CALL(Free##State, FMU_ANY_PHASE, fmu_free_copy(fmu, state), void *instance, \
       void **state)                                                          \
  CALL(Serialized##State##Size, FMU_ANY_PHASE,                                \
       fmu_serialized_size(fmu, state, size), void *instance, void *state,    \
       size_t *size)                                                          \
  CALL(Serialize##State, FMU_ANY_PHASE,                                       \
       fmu_serialize(fmu, state, (unsigned char *)bytes, size),               \
       void *instance, void *state, byte_t bytes[], size_t size)              \
  CALL(Deserialize##State, FMU_ANY_PHASE,                                     \
       fmu_deserialize(fmu, (const unsigned char *)bytes, size, state),       \
       void *instance, const byte_t bytes[], size_t size, void **state)

FMI_EXPORT const char *FMI(GetVersion)(void) { return FMI_VERSION; }

FMI_EXPORT void FMI(FreeInstance)(void *instance) { fmu_free(instance); }

CALL(SetDebugLogging, FMU_ANY_PHASE,
     fmu_set_logging(fmu, on != 0, n, categories), void *instance,
     FMI_BOOLEAN on, size_t n, const char *const categories[])

CALL(Terminate, FMI_MOVING, fmu_go_to(fmu, FMU_TERMINATED), void *instance)

CALL(Reset, FMU_ANY_PHASE, fmu_reset(fmu), void *instance)

#endif
