/// @file
/// The FMU behind both versions of the interface: an instance, what it may be
/// asked in which phase, its motion, and copies of its state. The two versions
/// (fmi2.c, fmi3.c) only translate. Instances and copies live in static pools:
/// there is no heap.
#ifndef TWOFOLD_FMU_MODEL_H
#define TWOFOLD_FMU_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "message.h"
#include "variables.h"

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

/// All that the future depends on. No pointers: a copy is a snapshot.
typedef struct {
  fmu_values_t values;
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

/// What the beginning of an instance logs through, and what it begins with.
/// call: the function that makes it. name: NULL for none.
fmu_t fmu_teller(const char *call, const char *name, bool logging);
/// Takes an instance from the pool. token: in, the one of the model
/// description. Returns: NULL after a message through `teller`, an instance
/// that only carries the logger, where the token is wrong or the pool is empty.
fmu_t *fmu_new(fmu_t *teller, const char *token);
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
/// Checks that a variable can be read, or set to a value, by an importer that
/// takes it for one of `kinds` (bits 1 << fmu_kind_t). what: the name of that
/// type. Returns: FMU_OK, else after a message.
fmu_status_t fmu_check_get(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what);
fmu_status_t fmu_check_set(fmu_t *fmu, uint32_t reference, unsigned kinds,
                           const char *what, double value);
/// Reads or sets a variable for which the check returned FMU_OK. Every number
/// of a whole variable but a count is exact in a double; counts are whole.
double fmu_get_real(fmu_t *fmu, uint32_t reference);
int64_t fmu_get_whole(fmu_t *fmu, uint32_t reference);
void fmu_set(fmu_t *fmu, uint32_t reference, double value);

/// The phases, in order.
fmu_status_t fmu_initialize(fmu_t *fmu, double start_time, bool stops,
                            double stop_time);
fmu_status_t fmu_initialized(fmu_t *fmu, unsigned next_phase); // motion.c
fmu_status_t fmu_reset(fmu_t *fmu);
fmu_status_t fmu_go_to(fmu_t *fmu, unsigned phase);

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

/// Copies of the state of an instance (copies.c). handle: in/out; *handle is a
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
