// The tag of a frame: SipHash-2-4 (Aumasson and Bernstein, SipHash: a fast
// short-input PRF, INDOCRYPT 2012), made for messages as short as these.
#ifndef TF_SIPHASH_H
#define TF_SIPHASH_H

#include "twofold/frame.h"

// key: 16 bytes. Returns: the tag; the time depends on the length alone.
#define tf_siphash TF_LINK(tf_siphash)
TF_API uint64_t tf_siphash(const uint8_t *key, const uint8_t *bytes,
                           size_t length);

// Whether a frame in its decoder's buffer ends with the tag of a key.
#define tf_has_tag TF_LINK(tf_has_tag)
TF_API bool tf_has_tag(const tf_frame_t *frame, const uint8_t *key);

#endif
