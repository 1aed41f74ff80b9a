// What the files of this room share.
#ifndef TF_LINK_PARTS_H
#define TF_LINK_PARTS_H

#include "twofold/frame.h"

// CRC-32 of IEEE 802.3, that of zlib and Ethernet. crc: 0, or the CRC of the
// bytes before these. Returns: the CRC of all bytes so far.
#define tf_crc32 TF_LINK(tf_crc32)
TF_API uint32_t tf_crc32(uint32_t crc, const uint8_t *bytes, size_t length);

// Writes a frame's header at wire + 2, before COBS. Returns: its payload.
#define tf_frame_header TF_LINK(tf_frame_header)
TF_API uint8_t *tf_frame_header(uint8_t *wire, uint8_t type, size_t length,
                                uint32_t sequence, uint64_t tick);

// Undoes COBS in place: code byte and body, of so many bytes together. Returns:
// whether its chain of distances ends at the end.
#define tf_unstuff TF_LINK(tf_unstuff)
TF_API bool tf_unstuff(uint8_t *code, size_t length);

// SipHash-2-4 (Aumasson and Bernstein, SipHash: a fast short-input PRF,
// INDOCRYPT 2012), made for messages as short as these. key: 16 bytes.
// Returns: the tag; the time depends on the length alone.
#define tf_siphash TF_LINK(tf_siphash)
TF_API uint64_t tf_siphash(const uint8_t *key, const uint8_t *bytes,
                           size_t length);

// Whether a frame in its decoder's buffer ends with the tag of a key.
#define tf_has_tag TF_LINK(tf_has_tag)
TF_API bool tf_has_tag(const tf_frame_t *frame, const uint8_t *key);

// The longest decimal: "-1.23456e-308".
#define DECIMAL_SIZE 13

// Writes value without a terminating zero, in up to six digits, in e notation
// below 1e-5 and from 1e6 on; "nan", "inf", "-inf" too. It is scaled by powers
// of ten in tf_real_t, which may cost one unit of the last digit. Returns: the
// length.
#define tf_decimal TF_LINK(tf_decimal)
TF_API size_t tf_decimal(char *out, tf_real_t value);

#endif
