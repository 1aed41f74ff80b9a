/// Work in shards, as typed I/N, and the last line of their files: how many
/// rows there are, and their checksum.
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

#define CLI_TRAILER_ROOM 128
#define CLI_TRAILER_MARK "# shard " ///< by which a trailer begins
typedef struct {
  uint64_t rows; ///< lines without the header
  uint32_t crc;  ///< over all bytes, the header's included, by cli_crc
  uint32_t run;  ///< of a text that all shards of a run share, by cli_crc
} cli_trailer_t;

/// Counts lines that are written. rows: how many rows they are.
void cli_trailer_add(cli_trailer_t *trailer, const char *lines, size_t length,
                     uint64_t rows);

/// Writes the line `# shard I/N: ROWS rows, crc32 CRC, run RUN`.
size_t cli_trailer_line(const cli_trailer_t *trailer, const cli_shard_t *shard,
                        char out[CLI_TRAILER_ROOM]);
