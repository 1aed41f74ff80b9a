/// @file
/// The variables of the FMU: one table, from which the model description is
/// made and by which values are read and written. A variable is a real number
/// or a whole one; truth values and members of enumerations are whole numbers.
#ifndef TWOFOLD_FMU_VARIABLES_H
#define TWOFOLD_FMU_VARIABLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold.h"

/// Real variables. The first TF_PARAMETERS are those of tf_parameter_ranges;
/// of these omega0 and r0 stay unused, because they are inputs.
enum {
  FMU_START_R = TF_PARAMETERS,
  FMU_START_V,
  FMU_START_OMEGA,
  FMU_START_H,
  FMU_START_PHI,
  FMU_OMEGA0,
  FMU_R0,
  FMU_FORCE,
  FMU_TORQUE,
  FMU_ALPHA,
  FMU_R,
  FMU_V,
  FMU_OMEGA,
  FMU_PHI,
  FMU_H,
  FMU_G,
  FMU_F,
  FMU_M,
  FMU_DELASSUS,
  FMU_RESIDUAL,
  FMU_ENERGY,
  FMU_EVENT_TIME,
  FMU_REALS
};

/// Whole variables.
enum {
  FMU_LAW,
  FMU_RULE,
  FMU_SCHEME,
  FMU_SEED,
  FMU_WITH_ANGLE,
  FMU_START_FROM_H,
  FMU_FOLLOW_PROFILE,
  FMU_TAKE,
  FMU_MODE,
  FMU_CHOICES,
  FMU_SET,
  FMU_STATUS,
  FMU_TICK,
  FMU_EVENTS,
  FMU_DEGRADED,
  FMU_FELL_BACK,
  FMU_COARSE,
  FMU_STALLED,
  FMU_REFUSED,
  FMU_FIRST,
  FMU_WHOLES
};

/// Members of the enumeration of FMU_SCHEME.
enum { FMU_MOREAU, FMU_LOCATED, FMU_SCHEMES };

/// Value references: 0 is the time, then the real variables, then the whole
/// ones.
#define FMU_TIME_REFERENCE 0u
#define FMU_REAL_REFERENCE 1u
#define FMU_WHOLE_REFERENCE 101u

/// All values.
typedef struct {
  double real[FMU_REALS];
  int64_t whole[FMU_WHOLES];
} fmu_values_t;

typedef enum {
  FMU_KIND_REAL,    ///< Float64; Real
  FMU_KIND_TRUTH,   ///< Boolean
  FMU_KIND_MEMBER,  ///< Enumeration
  FMU_KIND_SMALL,   ///< Int32; Integer
  FMU_KIND_SEED,    ///< UInt32; Integer
  FMU_KIND_COUNT,   ///< UInt64; Real, which FMI 2 has no better type for
  FMU_KIND_UNKNOWN, ///< no variable
} fmu_kind_t;

/// Who sets a variable, and when.
typedef enum {
  FMU_ROLE_PARAMETER, ///< the importer, before the motion begins
  FMU_ROLE_INPUT,     ///< the importer, at any time
  FMU_ROLE_OUTPUT     ///< the FMU
} fmu_role_t;

/// One variable. low, high: both ends allowed; unused where it is an output.
typedef struct {
  const char *name, *unit, *about;
  fmu_kind_t kind;
  fmu_role_t role;
  const char *(*member)(unsigned i); ///< name of the i-th of an enumeration
  double low, high;
} fmu_variable_t;

/// The variable with a reference; kind FMU_KIND_UNKNOWN where there is none.
/// slot: out, its index among the real or the whole variables.
fmu_variable_t fmu_variable(uint32_t reference, size_t *slot);

/// A real variable by its slot, and a whole one.
fmu_variable_t fmu_real(size_t slot);
fmu_variable_t fmu_whole(size_t slot);

/// The values with which an FMU of a scene begins: those of the scene. A
/// parameter that the law of the scene does not use has the value of the first
/// scene that uses it.
void fmu_defaults(fmu_values_t *values, const tf_scene_t *scene);

#endif
