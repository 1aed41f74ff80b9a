/// The FMU behind both versions of the interface: its variables, an instance,
/// what it may be asked in which phase, its motion, and copies of its state.
/// The two versions (fmi2.c, fmi3.c) only translate. Instances and copies live
/// in static pools: there is no heap.
#ifndef TWOFOLD_FMU_H
#define TWOFOLD_FMU_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "motion.h"

/// The real variables behind the parameters of tf_parameter_ranges: number,
/// name, unit, role and what it is.
#define FMU_REALS(X)                                                         \
  X(START_R, "start.r", "m", PARAMETER,                                      \
    "displacement of the slider at the start")                               \
  X(START_V, "start.v", "m/s", PARAMETER,                                    \
    "speed of the slider at the start, unless start.from_h")                 \
  X(START_OMEGA, "start.omega", "rad/s", PARAMETER,                          \
    "speed of the disc at the start")                                        \
  X(START_H, "start.h", "m/s", PARAMETER,                                    \
    "lateral slip speed at the start, with start.from_h")                    \
  X(START_PHI, "start.phi", "rad", PARAMETER,                                \
    "angle of the disc at the start")                                        \
  X(FORCE, "force", "N", INPUT, "force on the slider, along r")              \
  X(TORQUE, "torque", "N m", INPUT, "torque on the disc")                    \
  X(ALPHA, "alpha", "rad/s^2", INPUT,                                        \
    "acceleration that brings the turntable to omega0 at the end of the "    \
    "communication step; 0: omega0 throughout")                              \
  X(r, "r", "m", OUTPUT, "displacement of the slider")                       \
  X(v, "v", "m/s", OUTPUT, "speed of the slider")                            \
  X(omega, "omega", "rad/s", OUTPUT, "speed of the disc")                    \
  X(phi, "phi", "rad", OUTPUT, "angle of the disc, with with_angle")         \
  X(h, "h", "m/s", OUTPUT, "lateral slip speed")                             \
  X(g, "g", "m/s", OUTPUT, "rolling speed")                                  \
  X(F, "F", "N", OUTPUT, "friction force, mean over the last step of dt")    \
  X(M, "M", "N m", OUTPUT, "friction moment, mean over the last step of dt") \
  X(delassus, "delassus", "1/kg", OUTPUT,                                    \
    "Delassus scalar of stick: < 0 where the future may split")              \
  X(RESIDUAL, "residual", "N", OUTPUT,                                       \
    "distance of F and M from the friction law")                             \
  X(ENERGY, "energy", "J", OUTPUT, "mechanical energy")                      \
  X(EVENT_TIME, "event_time", "s", OUTPUT, "time of the last event")         \
  X(TURNTABLE, "turntable", "rad/s", OUTPUT,                                 \
    "speed of the turntable, by the profile or the input omega0")

/// The whole variables: number, name, kind, role, the names of members, the
/// ends of the range and what it is.
#define FMU_WHOLES(X)                                                         \
  X(LAW, "law", MEMBER, PARAMETER, tf_tyre_law_name, 0, TF_TYRE_LAWS - 1,     \
    "law of friction")                                                        \
  X(RULE, "rule", MEMBER, PARAMETER, tf_rule_name, 0, TF_RULES - 1,           \
    "which of several consistent modes a step takes")                         \
  X(SCHEME, "scheme", MEMBER, PARAMETER, motion_scheme_name, 0,               \
    MOTION_LOCATED, "moreau: steps of fixed length; located: events inside")  \
  X(SEED, "seed", SEED, PARAMETER, NULL, 0, UINT32_MAX, "for rule random")    \
  X(WITH_ANGLE, "with_angle", TRUTH, PARAMETER, NULL, 0, 1, "integrate phi")  \
  X(START_FROM_H, "start.from_h", TRUTH, PARAMETER, NULL, 0, 1,               \
    "start.v follows from start.h")                                           \
  X(FOLLOW_PROFILE, "follow_profile", TRUTH, PARAMETER, NULL, 0, 1,           \
    "the scene drives the turntable, by the importer's time, until omega0 "   \
    "or alpha is set")                                                        \
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
    "steps that moreau took for located")                                     \
  X(COARSE, "coarse", COUNT, OUTPUT, NULL, 0, 0,                              \
    "steps too long for the motion, or for the tolerance")                    \
  X(STALLED, "stalled", COUNT, OUTPUT, NULL, 0, 0,                            \
    "steps whose change rounding lost")                                       \
  X(REFUSED, "refused", COUNT, OUTPUT, NULL, 0, 0, "steps that were refused") \
  X(FIRST, "first", COUNT, OUTPUT, NULL, 0, 0,                                \
    "tick of the first of these steps")

/// Value references: 0 is the time, then come the parameters of
/// tf_parameter_ranges, which are in the order of tf_params_t, the other real
/// variables and the whole ones.
#define FMU_TIME 0
#define FMU_PLACE(member) \
  (1 + offsetof(tf_params_t, member) / sizeof(tf_real_t))
#define FMU_NUMBER(number, ...) FMU_##number,
enum {
  FMU_R0 = FMU_PLACE(r0),
  FMU_OMEGA0 = FMU_PLACE(omega0),
  FMU_PARAMETERS = TF_PARAMETERS,
  FMU_REALS(FMU_NUMBER) FMU_WHOLES(FMU_NUMBER) FMU_VARIABLES
};

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
/// about: empty for the words of the command line.
typedef struct {
  const char *name, *unit, *about;
  fmu_kind_t kind;
  fmu_role_t role;
  const char *(*member)(unsigned i); ///< name of the i-th of an enumeration
  double low, high;
} fmu_variable_t;

/// The variable with a reference; kind FMU_KIND_UNKNOWN where there is none.
fmu_variable_t fmu_variable(uint32_t reference);

/// The values with which an FMU of a scene begins: those of the scene. A
/// parameter that the law of the scene does not use has the value of the first
/// scene that uses it.
void fmu_defaults(double values[FMU_VARIABLES], const tf_scene_t *scene);

/// Short texts for the logger, without a C library's printf, which may allocate
/// memory.
#define FMU_MESSAGE_ROOM 320

/// A text that grows; what exceeds its room is cut off.
typedef struct {
  char text[FMU_MESSAGE_ROOM];
  size_t length;
} fmu_message_t;

#if defined(__GNUC__)
#define FMU_FORMAT(n) __attribute__((format(printf, n, (n) + 1)))
#else
#define FMU_FORMAT(n)
#endif

/// Appends a text. format: in; in it %s is the next text, of which NULL appends
/// nothing, %u the next unsigned and %g the next double, as decimal_write.
FMU_FORMAT(2)
void fmu_say(fmu_message_t *message, const char *format, ...);
void fmu_say_all(fmu_message_t *message, const char *format, va_list arguments);

/// How many instances, and copies of states of all of them, there may be at a
/// time. Serialised states are the importer's and are not counted.
#ifndef FMU_INSTANCES
#define FMU_INSTANCES 16
#endif
#ifndef FMU_COPIES
#define FMU_COPIES 256
#endif

/// What a call returns: the numbers of both versions.
typedef enum { FMU_OK, FMU_WARNING, FMU_DISCARD, FMU_ERROR } fmu_status_t;

/// The phases of an instance, as bits.
enum {
  FMU_INSTANTIATED = 1,
  FMU_INITIALIZATION = 2,
  FMU_EVENT = 4,
  FMU_STEP = 8,
  FMU_TERMINATED = 16,
  FMU_ANY_PHASE = 31
};

/// Log categories, as bits; their names are fmu_categories. Discards are told
/// until they are switched off, errors always.
enum { FMU_LOG_EVENTS = 1, FMU_LOG_DISCARD = 2 };
#define FMU_CATEGORIES 3
extern const char *const fmu_categories[FMU_CATEGORIES];

/// All that the future depends on. No pointers: a copy is a snapshot. Whole
/// numbers are exact in values, too: they are less than 2^53.
typedef struct {
  double values[FMU_VARIABLES]; ///< by reference
  motion_t now;
  tf_tally_t tally;
  uint64_t events;
  uint64_t event_tick;
  double start_time, stop_time;
  uint8_t phase;
  bool stops;   ///< stop_time is given
  bool begun;   ///< `now` is that of the values
  bool takes;   ///< the next step takes the mode in FMU_TAKE
  bool steered; ///< omega0 and alpha drive, not the profile
} fmu_motion_t;

typedef struct fmu fmu_t;
/// Hands a message to the importer.
typedef void fmu_emit_t(const fmu_t *fmu, fmu_status_t status,
                        const char *category, const char *text);

struct fmu {
  char name[64]; ///< cut off where it is longer
  void *environment;
  void (*logger)(void); ///< of the version's own type
  fmu_emit_t *emit;     ///< NULL: no logger
  unsigned logs;        ///< categories that are on
  bool event_mode;      ///< the importer handles events in event mode
  bool early_return;    ///< a step may end at an event
  fmu_status_t refusal; ///< what a refused step returns, by the version
  fmu_motion_t motion;
  fmu_motion_t before; ///< the motion before the present step
  const char *call;    ///< the function of the interface that is executed
  fmu_message_t message;
};

/// What a communication step ended with.
typedef struct {
  bool event; ///< mode or set changed in the last step of dt
  bool early; ///< the end asked for is not reached
  double time;
} fmu_step_t;

/// The categories of an instance that is made with logging or without.
#define FMU_LOGS(logging) (FMU_LOG_DISCARD | ((logging) ? FMU_LOG_EVENTS : 0u))
/// Takes an instance from the pool. own: in, its logger and options, and the
/// call that makes it. token: in, the one of the model description. Returns:
/// NULL after a message through own->logger where the token is wrong or the
/// pool is empty.
fmu_t *fmu_new(fmu_t *own, const char *token);
/// Refuses to make one of another type. Returns: NULL.
void *fmu_refuse_type(fmu_t *own);
/// Gives it back. fmu: in, any.
void fmu_free(void *fmu);
/// The instance at an address if there is one in use, and if `phases` has its
/// phase, else NULL after a message. call: in, the name of the function.
fmu_t *fmu_enter(void *instance, const char *call, unsigned phases);

/// Refuses a call: logs a message after the name of the call; format as in
/// fmu_say. Returns: status.
FMU_FORMAT(3)
fmu_status_t fmu_refuse(fmu_t *fmu, fmu_status_t status, const char *format,
                        ...);
#define fmu_error(fmu, ...) fmu_refuse(fmu, FMU_ERROR, __VA_ARGS__)
#define fmu_discard(fmu, ...) fmu_refuse(fmu, FMU_DISCARD, __VA_ARGS__)
/// The message, empty but for the name of the call; and the end of a call that
/// is refused with what it has become.
fmu_message_t *fmu_begin_message(fmu_t *fmu);
fmu_status_t fmu_refuse_so(fmu_t *fmu, fmu_status_t status);

/// Switches categories on or off; all of them where count is 0.
fmu_status_t fmu_set_logging(fmu_t *fmu, bool on, size_t count,
                             const char *const categories[]);

/// Checks the lists of a call: as many values as value references, and both are
/// there.
fmu_status_t fmu_check_lists(fmu_t *fmu, size_t n, size_t n_values,
                             const void *references, const void *values);
/// Reads a variable, or checks that it can be set to a value, for an importer
/// that takes it for one of `kinds` (bits 1 << fmu_kind_t). what: the name of
/// that type. Returns: FMU_OK, else after a message.
fmu_status_t fmu_get(fmu_t *fmu, uint32_t reference, unsigned kinds,
                     const char *what, double *value);
fmu_status_t fmu_check_set(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what, double value);
/// Sets a variable for which the check returned FMU_OK.
void fmu_set(fmu_t *fmu, uint32_t reference, double value);

/// The phases, in order.
fmu_status_t fmu_initialize(fmu_t *fmu, double start_time, bool stops,
                            double stop_time);
fmu_status_t fmu_initialized(fmu_t *fmu, unsigned next_phase); // motion.c
fmu_status_t fmu_reset(fmu_t *fmu);
fmu_status_t fmu_go_to(fmu_t *fmu, unsigned phase);

/// Whether the calling thread computes as the core needs (motion.c): an
/// importer may have set another rounding mode. The FMU leaves that mode alone:
/// without FENV_ACCESS, which gcc lacks, no compiler keeps sums between the
/// calls that would change it and change it back.
/// Returns: FMU_OK; status after a message.
fmu_status_t fmu_check_arithmetic(fmu_t *fmu, fmu_status_t status);
/// Prepares machine, state and report from the values (motion.c).
/// Returns: FMU_OK; FMU_DISCARD after a message, motion not begun.
fmu_status_t fmu_begin(fmu_t *fmu);
/// Whether the next step can end in a mode (motion.c). end: in, the tick at
/// which its communication step does. Returns: FMU_OK; status after a message.
fmu_status_t fmu_check_open(fmu_t *fmu, fmu_status_t status, unsigned mode,
                            uint64_t end);
/// Writes the outputs into the values (motion.c).
void fmu_observe(fmu_motion_t *motion);
/// Time of a motion: its start plus a whole number of steps (motion.c).
double fmu_time(const fmu_motion_t *motion);
/// One communication step (motion.c).
/// Returns: FMU_OK; fmu->refusal or FMU_ERROR after a message: the motion is
/// as before the call, but for the count of refused steps.
fmu_status_t fmu_step(fmu_t *fmu, double time, double length, fmu_step_t *end);

/// Copies of the state of an instance. handle: in/out; *handle is a
/// copy to overwrite or NULL for a new one.
fmu_status_t fmu_copy(fmu_t *fmu, void **handle);
fmu_status_t fmu_restore(fmu_t *fmu, void *handle);
fmu_status_t fmu_free_copy(fmu_t *fmu, void **handle);
fmu_status_t fmu_serialized_size(fmu_t *fmu, void *handle, size_t *size);
fmu_status_t fmu_serialize(fmu_t *fmu, void *handle, unsigned char *bytes,
                           size_t size);
fmu_status_t fmu_deserialize(fmu_t *fmu, const unsigned char *bytes,
                             size_t size, void **handle);

#endif
