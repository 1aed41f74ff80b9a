/// Work in shards, as typed I/N, and the checksum of files.
#pragma once

#include "options.h"

/// index: 1 to of. All of the work is shard 1 of 1.
typedef struct {
  uint64_t index, of;
} cli_shard_t;

extern const cli_shard_t cli_whole_shard;

/// Reads I/N, I in [1, N].
int cli_read_shard(const cli_given_t *given, cli_shard_t *shard);

/// The first of the shard's own among `count` pieces of work, and the first
/// after them. Shards differ by one piece at most, and follow each other.
void cli_shard_range(const cli_shard_t *shard, uint64_t count, uint64_t *first,
                     uint64_t *end);

/// The CRC-32 of zlib. before: in, that of the bytes before these, 0: none.
uint32_t cli_crc(uint32_t before, const void *bytes, size_t length);
