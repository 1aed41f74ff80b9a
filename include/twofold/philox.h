/// @file
/// Random numbers of the rule RANDOM and of the studies: draw n under a seed is
/// one number on every board.
#ifndef TWOFOLD_PHILOX_H
#define TWOFOLD_PHILOX_H

#include "twofold/real.h"

TF_BEGIN_C

/// Philox-2x32-10 (Salmon et al. 2011), a counter-based generator: a state
/// carries no stream position but its tick, and a replay needs no history.
/// counter, key: in, any. out: out, 2 words.
#define tf_philox TF_LINK(tf_philox)
TF_API void tf_philox(uint64_t counter, uint32_t key, uint32_t out[2]);

TF_END_C

#endif
