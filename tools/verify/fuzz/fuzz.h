/// @file
/// What every fuzz target shares. A target reads bytes as a small program that
/// drives a public interface, and looks at each promise of that interface
/// after every call. It knows nothing of who feeds it: libFuzzer by entry.c,
/// or the files of the corpus by tests/regress/test_corpus.c.
#ifndef TWOFOLD_FUZZ_H
#define TWOFOLD_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "twofold.h"

/// A target. data: in, size bytes, any.
/// Returns: NULL, or the promise that was broken, as "file:line: condition".
typedef const char *(*fuzz_target_t)(const uint8_t *data, size_t size);

/// Raw bits as parameters, states, inputs; steps of every scheme, analysis.
const char *fuzz_machine(const uint8_t *data, size_t size);
/// Bytes to the decoder of frames, commands to the uplink.
const char *fuzz_frame(const uint8_t *data, size_t size);
/// Text to the reader of scenes, and back to text.
const char *fuzz_scene(const uint8_t *data, size_t size);
/// Text to the reader of inputs over time.
const char *fuzz_table(const uint8_t *data, size_t size);
/// Changes to a file of --save, to the reader of --from.
const char *fuzz_state(const uint8_t *data, size_t size);

/// The analysis of a machine at one state; its phi serves as the g of a place.
/// Returns: as a target.
const char *fuzz_analysis(const tf_machine_t *machine, const tf_input_t *input,
                          const tf_state_t *state);

#define FUZZ_TEXT(x) #x
#define FUZZ_LINE(line) FUZZ_TEXT(line)
/// Leaves the function where a promise is broken.
#define FUZZ_HOLD(condition)                                                   \
  do {                                                                         \
    if (!(condition)) return __FILE__ ":" FUZZ_LINE(__LINE__) ": " #condition; \
  } while (0)
/// Leaves the function where a call has found a broken promise.
#define FUZZ_HOLD_ALL(call)               \
  do {                                    \
    const char *const fuzz_broken = call; \
    if (fuzz_broken) return fuzz_broken;  \
  } while (0)

/// What is left of the input; 0 comes after its end.
typedef struct {
  const uint8_t *at, *end;
} fuzz_bytes_t;

static inline uint8_t fuzz_byte(fuzz_bytes_t *bytes) {
  return bytes->at < bytes->end ? *bytes->at++ : 0;
}

/// The bits of a double, rounded to the real type: so one corpus says the same
/// to both builds.
static inline tf_real_t fuzz_real(fuzz_bytes_t *bytes) {
  uint64_t bits = 0;
  double value;
  for (int i = 0; i < 8; i++) bits |= (uint64_t)fuzz_byte(bytes) << 8 * i;
  memcpy(&value, &bits, sizeof value);
  return (tf_real_t)value;
}

static inline tf_real_t fuzz_magnitude(tf_real_t x) { return x < 0 ? -x : x; }

/// Whether a number is one.
static inline int fuzz_finite(tf_real_t x) {
  return x >= -TF_REAL_MAX && x <= TF_REAL_MAX;
}

/// Whether a state is one that a step may return.
static inline int fuzz_in_reach(const tf_state_t *x) {
  return fuzz_magnitude(x->r) + fuzz_magnitude(x->v) + fuzz_magnitude(x->w) <=
         TF_STATE_LIMIT;
}

/// The same bits, or both not a number.
static inline int fuzz_same(tf_real_t a, tf_real_t b) {
  return memcmp(&a, &b, sizeof a) == 0 ||
         (!fuzz_finite(a) && !fuzz_finite(b) && !(a >= b) && !(a <= b));
}

static inline unsigned fuzz_popcount(unsigned set) {
  unsigned count = 0;
  for (; set != 0; set &= set - 1) count++;
  return count;
}

#endif
