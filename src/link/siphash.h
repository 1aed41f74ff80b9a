// The tag of a command: SipHash-2-4 (Aumasson and Bernstein, SipHash: a fast
// short-input PRF, INDOCRYPT 2012), made for messages as short as these.
#ifndef TF_SIPHASH_H
#define TF_SIPHASH_H

#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

// key: 16 bytes. Returns: the tag; the time depends on the length alone.
#define tf_siphash TF_LINK(tf_siphash)
TF_API uint64_t tf_siphash(const uint8_t *key, const uint8_t *bytes,
                           size_t length);

#endif
