// The header of a frame, for those who need its bytes before COBS.
#ifndef TF_HEADER_H
#define TF_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

// Writes it at wire + 2. Returns: where the payload begins.
#define tf_frame_header TF_LINK(tf_frame_header)
TF_API uint8_t *tf_frame_header(uint8_t *wire, uint8_t type, size_t length,
                                uint32_t sequence, uint64_t tick);

// Undoes COBS. Returns: whether its chain of distances ends at the end.
#define tf_unstuff TF_LINK(tf_unstuff)
TF_API bool tf_unstuff(uint8_t *code, size_t length);

#endif
