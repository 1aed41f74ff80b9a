/// @file
/// A part of a piece of work: shard I of N, as typed I/N.
#ifndef TWOFOLD_CLI_SHARD_H
#define TWOFOLD_CLI_SHARD_H

#include <stdint.h>

#include "options.h"

/// index: 1 to of. All of the work is shard 1 of 1.
typedef struct {
  uint64_t index, of;
} cli_shard_t;

/// All of the work.
extern const cli_shard_t cli_whole_shard;

/// Reads I/N.
/// Returns: CLI_DONE; after a message CLI_USAGE, or CLI_REFUSED where I does
/// not lie in [1, N].
int cli_read_shard(const cli_given_t *given, cli_shard_t *shard);

/// The first of the shard's own among `count` pieces of work, and the first
/// after them. Shards differ by one piece at most, and follow each other.
void cli_shard_range(const cli_shard_t *shard, uint64_t count, uint64_t *first,
                     uint64_t *end);

#endif
