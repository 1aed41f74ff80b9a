// Copies of the state of an instance, and their form as bytes: a header that
// says of which FMU they are, and the memory of the state, which has no
// pointers. Bytes can be read back by the same binary.

#include <string.h>

#include "claim.h"
#include "fmu_scene.h"
#include "model.h"

typedef struct {
  char magic[8];
  uint64_t token; ///< hash of the token
  uint64_t size;  ///< of header and state
  uint64_t sum;   ///< hash of the state
} header_t;

static fmu_motion_t copies[FMU_COPIES];
static fmu_claim_t copy_claims[FMU_COPIES];

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

static size_t index_of(const void *handle) {
  size_t i = 0;
  while (i < FMU_COPIES && handle != &copies[i]) i++;
  return i < FMU_COPIES && fmu_claimed(&copy_claims[i]) ? i : FMU_COPIES;
}

// The copy at a handle, or NULL after a message.
static fmu_motion_t *find(fmu_t *fmu, const void *handle) {
  const size_t i = index_of(handle);
  if (i < FMU_COPIES) return &copies[i];
  (void)fmu_error(fmu, "this is no state that the FMU has given out");
  return NULL;
}

static fmu_motion_t *new_copy(fmu_t *fmu) {
  size_t i = 0;
  while (i < FMU_COPIES && !fmu_claim(&copy_claims[i])) i++;
  if (i < FMU_COPIES) return &copies[i];
  (void)fmu_error(fmu,
                  "%u states are kept, which is the limit; free some, keep them"
                  " serialised, or compile with a larger FMU_COPIES",
                  (unsigned)FMU_COPIES);
  return NULL;
}

fmu_status_t fmu_copy(fmu_t *fmu, void **handle) {
  if (handle == NULL) return fmu_error(fmu, "nowhere to put the state: NULL");
  fmu_motion_t *copy = *handle == NULL ? new_copy(fmu) : find(fmu, *handle);
  if (copy == NULL) return FMU_ERROR;
  memcpy(copy, &fmu->motion, sizeof *copy);
  *handle = copy;
  return FMU_OK;
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
  fmu_release(&copy_claims[index_of(*handle)]);
  *handle = NULL;
  return FMU_OK;
}

fmu_status_t fmu_serialized_size(fmu_t *fmu, void *handle, size_t *size) {
  if (find(fmu, handle) == NULL) return FMU_ERROR;
  if (size == NULL) return fmu_error(fmu, "nowhere to put the size: NULL");
  *size = sizeof(header_t) + sizeof(fmu_motion_t);
  return FMU_OK;
}

fmu_status_t fmu_serialize(fmu_t *fmu, void *handle, unsigned char *bytes,
                           size_t size) {
  const fmu_motion_t *copy = find(fmu, handle);
  if (copy == NULL) return FMU_ERROR;
  if (bytes == NULL || size < sizeof(header_t) + sizeof *copy)
    return fmu_error(fmu, "no room for the bytes of the state");
  const header_t header = header_for(copy);
  memcpy(bytes, &header, sizeof header);
  memcpy(bytes + sizeof header, copy, sizeof *copy);
  return FMU_OK;
}

fmu_status_t fmu_deserialize(fmu_t *fmu, const unsigned char *bytes,
                             size_t size, void **handle) {
  fmu_motion_t motion;
  if (bytes == NULL || handle == NULL ||
      size < sizeof(header_t) + sizeof motion)
    return fmu_error(fmu, "too few bytes for a state of this FMU");
  memcpy(&motion, bytes + sizeof(header_t), sizeof motion);
  const header_t header = header_for(&motion);
  if (memcmp(bytes, &header, sizeof header) != 0)
    return fmu_error(fmu,
                     "these bytes are not a state of this FMU, or have"
                     " been changed");
  fmu_motion_t *copy = *handle == NULL ? new_copy(fmu) : find(fmu, *handle);
  if (copy == NULL) return FMU_ERROR;
  memcpy(copy, &motion, sizeof *copy);
  *handle = copy;
  return FMU_OK;
}
