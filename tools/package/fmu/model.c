// Instances and copies of their states, in static pools; the phases of an
// instance and its messages. Copies have a form as bytes: a header that says of
// which FMU they are, and the memory of the state, which has no pointers. The
// same binary reads them back.

#include <string.h>

#include "fmu.h"
#include "fmu_scene.h"

// Places of a pool, which several threads may claim at the same time.
typedef volatile char claim_t;
#if defined(_MSC_VER)
#include <intrin.h>
#define CLAIM(place) (_InterlockedExchange8(place, 1) == 0)
#define RELEASE(place) ((void)_InterlockedExchange8(place, 0))
#else
#define CLAIM(place) (__atomic_exchange_n(place, 1, __ATOMIC_ACQUIRE) == 0)
#define RELEASE(place) __atomic_store_n(place, 0, __ATOMIC_RELEASE)
#endif

const char *const fmu_categories[FMU_CATEGORIES] = {
    "logEvents", "logStatusDiscard", "logStatusError"};

typedef struct {
  void *places;
  size_t size, count;
  claim_t *claims;
} pool_t;

static fmu_t instances[FMU_INSTANCES];
static fmu_motion_t copies[FMU_COPIES];
static claim_t claims[FMU_INSTANCES + FMU_COPIES];
static const pool_t instance_pool = {instances, sizeof instances[0],
                                     FMU_INSTANCES, claims};
static const pool_t copy_pool = {copies, sizeof copies[0], FMU_COPIES,
                                 claims + FMU_INSTANCES};

static void *place_of(const pool_t *pool, size_t i) {
  return (char *)pool->places + i * pool->size;
}

// A free place, from here on the caller's; NULL where there is none.
static void *claim(const pool_t *pool) {
  for (size_t i = 0; i < pool->count; i++)
    if (CLAIM(&pool->claims[i])) return place_of(pool, i);
  return NULL;
}

// The claim of a place in use, NULL for any other address.
static claim_t *claim_of(const pool_t *pool, const void *place) {
  for (size_t i = 0; i < pool->count; i++)
    if (place == place_of(pool, i) && pool->claims[i]) return &pool->claims[i];
  return NULL;
}

// In the order of their bits.
static const char *phase_name(unsigned phase) {
  static const char *const names[] = {"before Initialization Mode",
                                      "in Initialization Mode", "in Event Mode",
                                      "in Step Mode", "after the end"};
  size_t i = 0;
  while ((phase >> i) > 1) i++;
  return names[i];
}

fmu_message_t *fmu_begin_message(fmu_t *fmu) {
  fmu->message.length = 0;
  fmu->message.text[0] = '\0';
  fmu_say(&fmu->message, "%s: ", fmu->call);
  return &fmu->message;
}

fmu_status_t fmu_refuse_so(fmu_t *fmu, fmu_status_t status) {
  const bool discards = status == FMU_DISCARD;
  if (fmu->emit != NULL && (!discards || (fmu->logs & FMU_LOG_DISCARD) != 0))
    fmu->emit(fmu, status, fmu_categories[discards ? 1 : 2], fmu->message.text);
  return status;
}

fmu_status_t fmu_refuse(fmu_t *fmu, fmu_status_t status, const char *format,
                        ...) {
  va_list arguments;
  va_start(arguments, format);
  fmu_say_all(fmu_begin_message(fmu), format, arguments);
  va_end(arguments);
  return fmu_refuse_so(fmu, status);
}

fmu_status_t fmu_go_to(fmu_t *fmu, unsigned phase) {
  fmu->motion.phase = (uint8_t)phase;
  return FMU_OK;
}

fmu_status_t fmu_reset(fmu_t *fmu) {
  memset(&fmu->motion, 0, sizeof fmu->motion);
  fmu_defaults(fmu->motion.values, FMU_SCENE);
  return fmu_go_to(fmu, FMU_INSTANTIATED);
}

fmu_t *fmu_new(fmu_t *own, const char *token) {
  if (token == NULL || strcmp(token, FMU_TOKEN) != 0) {
    (void)fmu_error(own, "the token is %s, but that of this FMU is %s",
                    token == NULL ? "missing" : token, FMU_TOKEN);
    return NULL;
  }
  if (fmu_check_arithmetic(own, FMU_ERROR) != FMU_OK) return NULL;
  fmu_t *fmu = claim(&instance_pool);
  if (fmu == NULL) {
    (void)fmu_error(own,
                    "%u instances are in use, which is the limit; compile with"
                    " a larger FMU_INSTANCES",
                    (unsigned)FMU_INSTANCES);
    return NULL;
  }
  *fmu = *own;
  (void)fmu_reset(fmu);
  return fmu;
}

void *fmu_refuse_type(fmu_t *own) {
  (void)fmu_error(own, "this FMU is for co-simulation");
  return NULL;
}

void fmu_free(void *fmu) {
  claim_t *of = claim_of(&instance_pool, fmu);
  if (of != NULL) RELEASE(of);
}

fmu_t *fmu_enter(void *instance, const char *call, unsigned phases) {
  if (claim_of(&instance_pool, instance) == NULL) return NULL;
  fmu_t *fmu = instance;
  fmu->call = call;
  if ((fmu->motion.phase & phases) != 0) return fmu;
  fmu_message_t *message = fmu_begin_message(fmu);
  fmu_say(message,
          phases == 0 ? "this FMU is for co-simulation, without clocks, arrays,"
                        " derivatives or structural parameters"
                      : "not allowed %s; allowed ",
          phase_name(fmu->motion.phase));
  const char *comma = "";
  for (unsigned phase = 1; phase <= FMU_TERMINATED; phase *= 2) {
    if ((phases & phase) == 0) continue;
    fmu_say(message, "%s%s", comma, phase_name(phase));
    comma = ", ";
  }
  (void)fmu_refuse_so(fmu, FMU_ERROR);
  return NULL;
}

fmu_status_t fmu_set_logging(fmu_t *fmu, bool on, size_t count,
                             const char *const categories[]) {
  unsigned chosen = count == 0 ? (1u << FMU_CATEGORIES) - 1 : 0;
  for (size_t i = 0; i < count; i++) {
    const char *name = categories == NULL ? NULL : categories[i];
    size_t k = 0;
    while (k < FMU_CATEGORIES &&
           (name == NULL || strcmp(name, fmu_categories[k]) != 0))
      k++;
    if (k == FMU_CATEGORIES)
      return fmu_error(fmu, "no log category is called %s",
                       name == NULL ? "NULL" : name);
    chosen |= 1u << k;
  }
  fmu->logs = on ? fmu->logs | chosen : fmu->logs & ~chosen;
  return FMU_OK;
}

fmu_status_t fmu_initialize(fmu_t *fmu, double start_time, bool stops,
                            double stop_time) {
  const double limit = 1e300;
  if (!(start_time >= -limit && start_time <= limit))
    return fmu_error(fmu, "startTime is not a finite number");
  if (stops && !(stop_time > start_time))
    return fmu_error(fmu, "stopTime is not after startTime");
  fmu->motion.start_time = start_time;
  fmu->motion.stops = stops;
  fmu->motion.stop_time = stops ? stop_time : 0;
  fmu->motion.begun = false;
  return FMU_OK;
}

typedef struct {
  char magic[8];
  uint64_t token; ///< hash of the token
  uint64_t size;  ///< of header and state
  uint64_t sum;   ///< hash of the state
} header_t;

// FNV-1a.
static uint64_t hash_of(const void *data, size_t size) {
  const unsigned char *byte = data;
  uint64_t hash = UINT64_C(0xCBF29CE484222325);
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ byte[i]) * UINT64_C(0x100000001B3);
  return hash;
}

static header_t header_for(const fmu_motion_t *motion) {
  header_t header;
  memset(&header, 0, sizeof header);
  memcpy(header.magic, "twofold", sizeof "twofold");
  header.token = hash_of(FMU_TOKEN, sizeof FMU_TOKEN);
  header.size = sizeof header + sizeof *motion;
  header.sum = hash_of(motion, sizeof *motion);
  return header;
}

// The copy at a handle, or NULL after a message.
static fmu_motion_t *find(fmu_t *fmu, void *handle) {
  if (claim_of(&copy_pool, handle) != NULL) return handle;
  (void)fmu_error(fmu, "this is not a state from this FMU");
  return NULL;
}

// Puts a motion into the copy at *handle, or into a new one.
static fmu_status_t keep(fmu_t *fmu, const fmu_motion_t *motion,
                         void **handle) {
  const bool is_new = *handle == NULL;
  fmu_motion_t *copy = is_new ? claim(&copy_pool) : find(fmu, *handle);
  if (copy == NULL && is_new)
    return fmu_error(fmu,
                     "%u states are kept, which is the limit; free some, keep"
                     " them serialised, or compile with a larger FMU_COPIES",
                     (unsigned)FMU_COPIES);
  if (copy == NULL) return FMU_ERROR;
  memcpy(copy, motion, sizeof *copy);
  *handle = copy;
  return FMU_OK;
}

fmu_status_t fmu_copy(fmu_t *fmu, void **handle) {
  if (handle == NULL) return fmu_error(fmu, "the pointer to the state is NULL");
  return keep(fmu, &fmu->motion, handle);
}

fmu_status_t fmu_restore(fmu_t *fmu, void *handle) {
  const fmu_motion_t *copy = find(fmu, handle);
  if (copy == NULL) return FMU_ERROR;
  memcpy(&fmu->motion, copy, sizeof *copy);
  return FMU_OK;
}

fmu_status_t fmu_free_copy(fmu_t *fmu, void **handle) {
  if (handle == NULL || *handle == NULL) return FMU_OK;
  if (find(fmu, *handle) == NULL) return FMU_ERROR;
  RELEASE(claim_of(&copy_pool, *handle));
  *handle = NULL;
  return FMU_OK;
}

fmu_status_t fmu_serialized_size(fmu_t *fmu, void *handle, size_t *size) {
  if (find(fmu, handle) == NULL) return FMU_ERROR;
  if (size == NULL) return fmu_error(fmu, "the pointer to the size is NULL");
  *size = sizeof(header_t) + sizeof(fmu_motion_t);
  return FMU_OK;
}

fmu_status_t fmu_serialize(fmu_t *fmu, void *handle, unsigned char *bytes,
                           size_t size) {
  const fmu_motion_t *copy = find(fmu, handle);
  if (copy == NULL) return FMU_ERROR;
  if (bytes == NULL || size < sizeof(header_t) + sizeof *copy)
    return fmu_error(fmu, "the buffer is too small for the state");
  const header_t header = header_for(copy);
  memcpy(bytes, &header, sizeof header);
  memcpy(bytes + sizeof header, copy, sizeof *copy);
  return FMU_OK;
}

fmu_status_t fmu_deserialize(fmu_t *fmu, const unsigned char *bytes,
                             size_t size, void **handle) {
  fmu_motion_t motion;
  if (bytes == NULL || handle == NULL ||
      size != sizeof(header_t) + sizeof motion)
    return fmu_error(fmu, "%u bytes; a state of this FMU has %u",
                     (unsigned)size,
                     (unsigned)(sizeof(header_t) + sizeof motion));
  memcpy(&motion, bytes + sizeof(header_t), sizeof motion);
  const header_t header = header_for(&motion);
  if (memcmp(bytes, &header, sizeof header) != 0)
    return fmu_error(fmu,
                     "these bytes are not a state of this FMU, or are"
                     " damaged");
  return keep(fmu, &motion, handle);
}
