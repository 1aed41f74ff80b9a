// The CRC of frames and of the hash of parameters: CRC-32 of IEEE 802.3, that
// of zlib and Ethernet.
#ifndef TF_CRC_H
#define TF_CRC_H

#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

// crc: 0, or the CRC of the bytes before these. Returns: the CRC of all bytes
// so far.
#define tf_crc32 TF_LINK(tf_crc32)
TF_API uint32_t tf_crc32(uint32_t crc, const uint8_t *bytes, size_t length);

#endif
