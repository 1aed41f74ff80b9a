/// @file
/// Random numbers of the rule RANDOM and of the studies: a generator without a
/// stream, so that draw n under a seed is one number on every board.
#ifndef TWOFOLD_PHILOX_H
#define TWOFOLD_PHILOX_H

#include <stdint.h>

#include "twofold/real.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Philox-2x32-10 (Salmon et al. 2011): a counter-based generator, so that a
/// state carries no stream position but its tick, and a replay needs no
/// history.
/// Scheme: none.
/// counter, key: in, any.
/// out: out, 2 words.
/// Returns: nothing.
/// Cost: at most 110 instructions; 10 multiplications 32 x 32 -> 64.
///   Stack: 64 B.
/// Memory: caller's, reentrant.
/// Claims: philox_known_answers
#define tf_philox TF_LINK(tf_philox)
TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]);

#ifdef __cplusplus
}
#endif

#endif
