/// @file
/// The variables of the FMU: one table, from which the model description is
/// made and by which values are read and written. A variable is a real number
/// or a whole one; truth values and members of enumerations are whole numbers.
#ifndef TWOFOLD_FMU_VARIABLES_H
#define TWOFOLD_FMU_VARIABLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "motion.h"

/// The real variables behind the parameters of tf_parameter_ranges: number,
/// name, unit, role and what it is. omega0 and r0 are inputs, which that table
/// tells of; as parameters they stay unused.
#define FMU_OTHER_REALS(X)                                                     \
  X(START_R, "start.r", "m", PARAMETER,                                        \
    "displacement of the slider at the start")                                 \
  X(START_V, "start.v", "m/s", PARAMETER,                                      \
    "speed of the slider at the start, unless start.from_h")                   \
  X(START_OMEGA, "start.omega", "rad/s", PARAMETER,                            \
    "speed of the disc at the start")                                          \
  X(START_H, "start.h", "m/s", PARAMETER,                                      \
    "lateral slip speed at the start, with start.from_h")                      \
  X(START_PHI, "start.phi", "rad", PARAMETER,                                  \
    "angle of the disc at the start")                                          \
  X(OMEGA0, "", "", INPUT, "")                                                 \
  X(R0, "", "", INPUT, "")                                                     \
  X(FORCE, "force", "N", INPUT, "force on the slider, along r")                \
  X(TORQUE, "torque", "N m", INPUT, "torque on the disc")                      \
  X(ALPHA, "alpha", "rad/s^2", INPUT,                                          \
    "acceleration with which the turntable comes to omega0 at the end of the " \
    "communication step; 0: it has omega0 throughout")                         \
  X(R, "r", "m", OUTPUT, "displacement of the slider")                         \
  X(V, "v", "m/s", OUTPUT, "speed of the slider")                              \
  X(OMEGA, "omega", "rad/s", OUTPUT, "speed of the disc")                      \
  X(PHI, "phi", "rad", OUTPUT, "angle of the disc, with with_angle")           \
  X(H, "h", "m/s", OUTPUT, "lateral slip speed")                               \
  X(G, "g", "m/s", OUTPUT, "rolling speed")                                    \
  X(F, "F", "N", OUTPUT, "friction force, mean over the last step of dt")      \
  X(M, "M", "N m", OUTPUT, "friction moment, mean over the last step of dt")   \
  X(DELASSUS, "delassus", "1/kg", OUTPUT,                                      \
    "Delassus scalar of stick: < 0 where the future may split")                \
  X(RESIDUAL, "residual", "N", OUTPUT,                                         \
    "distance of F and M from the friction law")                               \
  X(ENERGY, "energy", "J", OUTPUT, "mechanical energy")                        \
  X(EVENT_TIME, "event_time", "s", OUTPUT, "time of the last event")           \
  X(TURNTABLE, "turntable", "rad/s", OUTPUT,                                   \
    "speed of the turntable, by the profile or the input omega0")

/// The whole variables: number, name, kind, role, the names of members, the
/// ends of the range and what it is.
#define FMU_ALL_WHOLES(X)                                                     \
  X(LAW, "law", MEMBER, PARAMETER, tf_tyre_law_name, 0, TF_TYRE_LAWS - 1,     \
    "law of friction")                                                        \
  X(RULE, "rule", MEMBER, PARAMETER, tf_rule_name, 0, TF_RULES - 1,           \
    "which of several consistent modes a step takes")                         \
  X(SCHEME, "scheme", MEMBER, PARAMETER, motion_scheme_name, 0,               \
    MOTION_LOCATED, "moreau: steps of fixed length; located: events inside")  \
  X(SEED, "seed", SEED, PARAMETER, NULL, 0, UINT32_MAX, "of the rule random") \
  X(WITH_ANGLE, "with_angle", TRUTH, PARAMETER, NULL, 0, 1, "integrate phi")  \
  X(START_FROM_H, "start.from_h", TRUTH, PARAMETER, NULL, 0, 1,               \
    "start.v follows from start.h")                                           \
  X(FOLLOW_PROFILE, "follow_profile", TRUTH, PARAMETER, NULL, 0, 1,           \
    "the scene drives the turntable until omega0 or alpha does")              \
  X(TAKE, "take", MEMBER, INPUT, take_name, 0, TF_NO_MODE,                    \
    "the next step takes this mode, if it can end in it")                     \
  X(MODE, "mode", MEMBER, OUTPUT, tf_mode_name, 0, TF_MODES - 1,              \
    "mode of contact of the last step")                                       \
  X(CHOICES, "choices", SMALL, OUTPUT, NULL, 0, 0,                            \
    "number of modes that were consistent in the last step")                  \
  X(SET, "set", SMALL, OUTPUT, NULL, 0, 0,                                    \
    "these modes, as a sum: slip+ 1, slip- 2, stick+ 4, stick- 8, pinned 16") \
  X(STATUS, "status", MEMBER, OUTPUT, status_word, TF_STEP_TOO_LONG,          \
    TF_STALLED, "what the last step returned")                                \
  X(TICK, "tick", COUNT, OUTPUT, NULL, 0, 0, "steps of dt since the start")   \
  X(EVENTS, "events", COUNT, OUTPUT, NULL, 0, 0,                              \
    "changes of mode or set since the start")                                 \
  X(DEGRADED, "degraded", COUNT, OUTPUT, NULL, 0, 0,                          \
    "steps in which no mode was consistent")                                  \
  X(FELL_BACK, "fell_back", COUNT, OUTPUT, NULL, 0, 0,                        \
    "steps of scheme located that moreau took")                               \
  X(COARSE, "coarse", COUNT, OUTPUT, NULL, 0, 0,                              \
    "steps too long for the motion, or for the tolerance")                    \
  X(STALLED, "stalled", COUNT, OUTPUT, NULL, 0, 0,                            \
    "steps whose change was lost in rounding")                                \
  X(REFUSED, "refused", COUNT, OUTPUT, NULL, 0, 0, "steps that were refused") \
  X(FIRST, "first", COUNT, OUTPUT, NULL, 0, 0,                                \
    "tick of the first step that these five counted")

#define FMU_NUMBER(number, ...) FMU_##number,
enum {
  FMU_BEFORE_REALS = TF_PARAMETERS - 1,
  FMU_OTHER_REALS(FMU_NUMBER) FMU_REALS
};
enum { FMU_ALL_WHOLES(FMU_NUMBER) FMU_WHOLES };

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
/// about: empty of a parameter of tf_parameter_ranges.
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
